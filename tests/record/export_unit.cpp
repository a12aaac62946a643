// SPDX-License-Identifier: MIT
// Files of other programs: every value is read back by an independent reader and compared with the NumPy array, whose
// values compare_unit.cpp compares with the text.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "record/export/new_file.hpp"
#include "record/export/table_export.hpp"
#include "tests/record/made_ticks.hpp"
#include "tests/support/flush_log.hpp"

namespace burin::record {
namespace {

const std::string kPython = "/usr/bin/python3";

// Records 2300 ticks, some notes and a trial; some values are no numbers.
void recorded_for_export(const std::string& path) {
    test::Recording recording(4096);
    WriterOptions options;
    options.facts = {{"version", "1.2"}, {"stroke", "B\xc3\xb6gen \xf0\x9f\x98\x80.csv"}, {"empty", ""}};
    options.objects = {{1, "stone"}, {2, "W\xc3\xbcrfel"}};
    ASSERT_TRUE(recording.begin(path, options));
    recording.writer->note_line(5'100'000'000, "u 100");
    recording.writer->note_event(5'050'000'000, "button", "pressed\nhard");
    const std::int64_t trial = recording.writer->begin_trial(5'200'000'000, "first");
    recording.writer->end_trial(trial, 6'000'000'000, "done");
    for (std::uint64_t tick = 1; tick <= 2300; ++tick) {
        haptics::TickRecord record = test::made_tick(tick, 2);
        if (tick % 100 == 7) record.sample.position_device_m.x = std::nan("");
        if (tick % 100 == 8) record.sample.position_device_m.x = HUGE_VAL;
        if (tick > 1500) record.contact.point_count = 1;
        recording.ring.push(record);
    }
    ASSERT_TRUE(recording.writer->close());
}

// Damages a block of the hand.
void damage(const std::string& path, int block) {
    auto database = Database::open(path, Database::Use::write);
    ASSERT_TRUE(database);
    ASSERT_TRUE(database->run("UPDATE block SET data = zeroblob(100) WHERE id = " + std::to_string(block)));
    ASSERT_TRUE(database->close());
}

bool has_modules(const Workplace& at, const std::string& modules) {
    return at.run(kPython + " -c 'import " + modules + "'").status == 0;
}

}  // namespace

TEST(NewFiles, AreOnTheDiskBeforeTheyHaveTheirNameAndThenInTheirFolder) {
    const Workplace at;
    for (const bool ends : {true, false}) {
        forget_flushes();
        auto file = NewFile::create(at / "a.csv");
        ASSERT_TRUE(file);
        ASSERT_TRUE(file->write("1,2\n"));
        ASSERT_TRUE(file->write_at(0, "3"));
        if (!ends) break;
        const std::string temporary = file->temporary();
        ASSERT_TRUE(file->finish());
        const std::vector<Flushed> all = all_flushes();
        ASSERT_EQ(all.size(), 2u) << "the file, and then its folder with its name";
        EXPECT_EQ(all[0].path, std::filesystem::weakly_canonical(temporary).string());
        EXPECT_TRUE(all[1].is_folder);
        EXPECT_EQ(all[1].names, std::vector<std::string>{"a.csv"});
        EXPECT_EQ(at.read("a.csv"), "3,2\n");
        std::filesystem::remove(at / "a.csv");
    }
    EXPECT_EQ(at.files(), 0u) << "one that was not ended has left nothing";
}

TEST(NewFiles, OfARecordingAreInTheirFolderFromTheBeginning) {
    const Workplace at;
    forget_flushes();
    test::Recording recording(4096);
    ASSERT_TRUE(recording.begin(at / "a.session", WriterOptions{}));
    const std::vector<Flushed> all = all_flushes();
    const auto is_named = [](const Flushed& one) {
        return one.is_folder && std::ranges::find(one.names, "a.session") != one.names.end();
    };
    EXPECT_TRUE(std::ranges::any_of(all, is_named));
    EXPECT_TRUE(std::ranges::any_of(all, [](const Flushed& one) { return one.path.contains("/a.session"); }));
    ASSERT_TRUE(recording.writer->close());
}

TEST(ExportTrials, HoldTheTicksOfTheirTimesAloneInEveryFormat) {
    const Workplace at;
    recorded_for_export(at / "a");  // a tick each millisecond from 5.001 s; the trial lasts from 5.2 to 6 s
    auto reader = RecordReader::open(at / "a");
    const auto all = *choose_columns(reader->hands()[0].columns, "tick");
    for (const char* list : {"first", "1", "fir*"}) {
        const auto times = times_of_trials(*reader, list);
        ASSERT_TRUE(times) << times.error().line();
        const auto report = export_csv(*reader, 0, all, at / (std::string(list) + ".csv"), *times);
        ASSERT_TRUE(report) << report.error().line();
        EXPECT_EQ(report->rows, 801u) << list;
    }
    const std::string text = at.read("first.csv");
    EXPECT_TRUE(text.starts_with("tick\n200\n201\n")) << text.substr(0, 40);
    EXPECT_TRUE(text.ends_with("\n999\n1000\n"));
    const auto times = *times_of_trials(*reader, "1");
    EXPECT_EQ(export_npy(*reader, 0, all, at / "t.npy", times)->rows, 801u);
    EXPECT_EQ(export_hdf5(*reader, 0, all, at / "t.h5", times)->rows, 801u);
    EXPECT_EQ(export_mat(*reader, 0, all, at / "t.mat", times)->rows, 801u);
    EXPECT_EQ(export_bids(*reader, 0, all, at / "bids", {}, times)->rows, 801u);
    const auto none = times_of_trials(*reader, "1,second");
    ASSERT_FALSE(none);
    EXPECT_NE(none.error().line().find("it has: 1 first"), std::string::npos) << none.error().line();
}

TEST(ExportInputLog, IsTheLogAsItWas) {
    const Workplace at;
    {
        test::Recording recording(64);
        WriterOptions options;
        options.facts = {{kLogHeaderFact, "burin-input 2 some settings"}};
        ASSERT_TRUE(recording.begin(at / "a", options));
        recording.writer->note_line(1, "0.1 mouse 3 4");
        recording.writer->note_event(2, "an event", "that no log has");
        recording.writer->note_line(3, "0.2 frame");
        ASSERT_TRUE(recording.writer->close());
    }
    auto reader = RecordReader::open(at / "a");
    const auto report = export_log(*reader, at / "a.log");
    ASSERT_TRUE(report) << report.error().line();
    EXPECT_EQ(at.read("a.log"), "burin-input 2 some settings\n0.1 mouse 3 4\n0.2 frame\n");
}

TEST(ExportHdf5, H5pyFindsEveryValueUnitAndName) {
    const Workplace at;
    recorded_for_export(at / "a");
    auto reader = RecordReader::open(at / "a");
    const auto all = *choose_columns(reader->hands()[0].columns, "");
    const auto report = export_hdf5(*reader, 0, all, at / "a.h5");
    ASSERT_TRUE(report) << report.error().line();
    EXPECT_EQ(report->rows, 2300u);
    ASSERT_TRUE(export_npy(*reader, 0, all, at / "a.npy"));
    EXPECT_EQ(at.files(), 3u) << "no temporary file is left";
    if (!has_modules(at, "numpy, h5py")) GTEST_SKIP() << "python3-numpy and python3-h5py are not installed";
    at.write("equal.py", R"(
import h5py, numpy
a, h = numpy.load('a.npy'), h5py.File('a.h5', 'r')
assert set(h['ticks']) == set(a.dtype.names)
for name in a.dtype.names:
    d = h['ticks'][name]
    assert d.dtype == a.dtype[name] and d[()].tobytes() == a[name].tobytes(), name
assert h['ticks/position_device_x_m'].attrs['unit'] == 'm' and h['ticks/hip1_object_x_m'].attrs['frame'] == 'object'
meta = dict(zip(h['meta/key'].asstr()[()], h['meta/value'].asstr()[()]))
assert meta['stroke'] == 'B\u00f6gen \U0001f600.csv' and meta['empty'] == '' and meta['end'] == 'regular', meta
assert list(h['objects/number']) == [1, 2] and list(h['objects/name'].asstr()) == ['stone', 'W\u00fcrfel']
print('equal')
)");
    EXPECT_EQ(at.run(kPython + " equal.py").output, "equal\n");
}

TEST(ExportMat, SciPyFindsEveryValueAndName) {
    const Workplace at;
    recorded_for_export(at / "a");
    auto reader = RecordReader::open(at / "a");
    const auto all = *choose_columns(reader->hands()[0].columns, "");
    ASSERT_TRUE(export_mat(*reader, 0, all, at / "a.mat"));
    ASSERT_TRUE(export_mat(*reader, 0, {0, 15}, at / "two.mat"));
    ASSERT_TRUE(export_npy(*reader, 0, all, at / "a.npy"));
    if (!has_modules(at, "numpy, scipy")) GTEST_SKIP() << "python3-scipy is not installed";
    at.write("equal.py", R"(
import numpy, scipy.io
a, m = numpy.load('a.npy'), scipy.io.loadmat('a.mat')
for name in a.dtype.names:
    v = m[name]
    assert v.shape == (len(a), 1) and v.dtype == a.dtype[name] and v.tobytes() == a[name].tobytes(), name
columns = [line.split('\t') for line in m['burin_columns'][0].splitlines()]
assert [c[0] for c in columns] == list(a.dtype.names) and columns[4] == ['position_device_x_m', 'm', 'device', 'f64']
meta = dict(line.split('\t') for line in m['burin_meta'][0].splitlines())
assert meta['stroke'] == 'B\u00f6gen \ufffd.csv' and meta['empty'] == '', ascii(meta)
assert m['burin_objects'][0] == '1\tstone\n2\tW\u00fcrfel\n'
two = scipy.io.loadmat('two.mat')
assert sorted(k for k in two if k[0] != '_' and not k.startswith('burin')) == sorted(a.dtype.names[i] for i in (0, 15))
print('equal')
)");
    EXPECT_EQ(at.run(kPython + " equal.py").output, "equal\n");
}

TEST(ExportBids, EveryChannelIsDescribedAndEveryValueIsThere) {
    const Workplace at;
    recorded_for_export(at / "a");
    auto reader = RecordReader::open(at / "a");
    const auto all = *choose_columns(reader->hands()[0].columns, "");
    const auto report = export_bids(*reader, 0, all, at / "set", {"07", "press"});
    ASSERT_TRUE(report) << report.error().line();
    EXPECT_FALSE(export_bids(*reader, 0, all, at / "set")) << "it exists";
    ASSERT_TRUE(export_npy(*reader, 0, all, at / "a.npy"));
    EXPECT_EQ(at.files(), 3u) << "no temporary folder is left";
    if (!has_modules(at, "numpy")) GTEST_SKIP() << "python3-numpy is not installed";
    at.write("equal.py", R"(
import csv, json, numpy
a, begin = numpy.load('a.npy'), 'set/sub-07/motion/sub-07_task-press_tracksys-hand_'
channels = list(csv.DictReader(open(begin + 'channels.tsv'), delimiter='\t'))
rows = list(csv.reader(open(begin + 'motion.tsv'), delimiter='\t'))
assert len(rows) == len(a) and [c['name'] for c in channels] == ['latency'] + list(a.dtype.names)
assert list(channels[0])[:5] == ['name', 'component', 'type', 'tracked_point', 'units']
for i, row in enumerate(rows):
    assert len(row) == len(channels)
    assert round(float(row[0]) * 1e9) == a['time_ns'][i] - a['time_ns'][0]
    for name, text in zip(a.dtype.names, row[1:]):
        value = a[name][i]
        if text == 'n/a':
            assert not numpy.isfinite(value), (i, name)
        else:
            assert (float(text) if a.dtype[name].kind == 'f' else int(text)) == value, (i, name, text)
by = {c['name']: c for c in channels}
assert by['latency']['type'] == 'LATENCY' and by['latency']['units'] == 's'
def of(name): return [by[name][k] for k in ('component', 'type', 'tracked_point', 'units', 'reference_frame')]
assert of('position_device_y_m') == ['y', 'POS', 'handle', 'm', 'device']
assert of('orientation_device_qw') == ['quat_w', 'ORNT', 'handle', 'n/a', 'device']
assert of('velocity_device_z_m_per_s') == ['z', 'VEL', 'handle', 'm/s', 'device']
assert of('proxy1_object_x_m') == ['x', 'POS', 'proxy1', 'm', 'object']
assert of('force0_device_x_N') == ['x', 'MISC', 'n/a', 'N', 'device']
assert of('buttons') == ['n/a', 'MISC', 'n/a', 'n/a', 'n/a']
motion = json.load(open(begin + 'motion.json'))
assert motion['SamplingFrequency'] == 1000 and motion['TaskName'] == 'press'
assert abs(motion['SamplingFrequencyEffective'] - 1000) < 1e-6
assert motion['MotionChannelCount'] == len(channels)
assert sum(v for k, v in motion.items() if k.endswith('ChannelCount') and k[0:6] != 'Motion') == len(channels)
frames = json.load(open(begin + 'channels.json'))['reference_frame']['Levels']
assert set(frames) == {c['reference_frame'] for c in channels} - {'n/a'}
events = list(csv.DictReader(open(begin + 'events.tsv'), delimiter='\t'))
assert events == [{'onset': '0.049000000', 'duration': '0', 'trial_type': 'button', 'value': 'pressed hard',
                   'state': 'n/a'},
                  {'onset': '0.199000000', 'duration': '0.800000000', 'trial_type': 'first', 'value': 'n/a',
                   'state': 'done'}], events
assert set(json.load(open(begin + 'events.json'))) == {'trial_type', 'value', 'state'}
assert all('RotationOrder' not in frame for frame in frames.values()), 'orientations are quaternions'
assert motion['SoftwareVersions'] == 'Burin 1.2'
assert json.load(open('set/dataset_description.json'))['BIDSVersion'] == '1.9.0'
assert open('set/participants.tsv').read() == 'participant_id\nsub-07\n'
print('equal')
)");
    EXPECT_EQ(at.run(kPython + " equal.py").output, "equal\n");
}

TEST(ExportLog, LinesEventsAndTrialsAreInTheOrderOfTime) {
    const Workplace at;
    recorded_for_export(at / "a");
    auto reader = RecordReader::open(at / "a");
    const auto report = export_log(*reader, at / "a.log");
    ASSERT_TRUE(report) << report.error().line();
    EXPECT_EQ(report->rows, 4u);
    const std::string log = at.read("a.log");
    EXPECT_NE(log.find("# version: 1.2\n"), std::string::npos) << log;
    EXPECT_TRUE(
        log.ends_with("5050000000 event button pressed hard\n5100000000 line u 100\n"
                      "5200000000 trial 1 begins: first\n6000000000 trial 1 ends: done\n"))
        << log;
}

// A disk that refuses the place, and a block that cannot be read.
TEST(ExportAll, DamagedBlocksAreLeftOutAndNothingIsLeftOfWhatFails) {
    const Workplace at;
    recorded_for_export(at / "a");
    damage(at / "a", 2);
    auto reader = RecordReader::open(at / "a");
    const std::vector<std::size_t> columns{0, 1};
    const auto hdf5 = export_hdf5(*reader, 0, columns, at / "a.h5"),
               mat = export_mat(*reader, 0, columns, at / "a.mat"), bids = export_bids(*reader, 0, columns, at / "set");
    for (const auto* report : {&hdf5, &mat, &bids}) {
        ASSERT_TRUE(*report) << report->error().line();
        EXPECT_EQ((*report)->damaged.size(), 1u);
        EXPECT_EQ((*report)->rows, 1300u);
    }
    EXPECT_FALSE(export_hdf5(*reader, 0, columns, at / "no/a.h5"));
    EXPECT_FALSE(export_mat(*reader, 0, columns, at / "no/a.mat"));
    EXPECT_FALSE(export_bids(*reader, 0, columns, at / "no/set"));
    EXPECT_FALSE(export_hdf5(*reader, 0, columns, "-"));
    EXPECT_FALSE(export_mat(*reader, 0, columns, "-"));
    EXPECT_FALSE(export_bids(*reader, 0, columns, "-"));
    EXPECT_FALSE(export_bids(*reader, 0, columns, at / "other", {"a b", "t"}));
    EXPECT_FALSE(check_no_file(at / "a.h5"));
    EXPECT_TRUE(check_no_file(at / "b.h5"));
    EXPECT_EQ(at.files(), 4u);
}

TEST(ColumnList, IsReadAsItWasWrittenAndOthersAreRefused) {
    const std::vector<Column> columns{{"a", "m", "device", ColumnType::f64}, {"b", "", "", ColumnType::u32}};
    EXPECT_EQ(text_of(columns), "name,unit,frame,type\na,m,device,f64\nb,,,u32\n");
    EXPECT_EQ(*columns_in(text_of(columns)), columns);
    for (const char* wrong : {"", "name,unit,frame,type\n", "a,m,device,f64\n", "name,unit,frame,type\na,m,f64\n",
                              "name,unit,frame,type\na,m,device,f64,\n", "name,unit,frame,type\na,m,device,f32\n",
                              "name,unit,frame,type\n,m,device,f64\n", "name,unit,frame,type\na,,,f64\na,,,u32\n"})
        EXPECT_FALSE(columns_in(wrong)) << wrong;
}

}  // namespace burin::record
