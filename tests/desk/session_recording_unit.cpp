// SPDX-License-Identifier: MIT
// A live session recorded into a session file: its columns and its log, and both done again.
#include <gtest/gtest.h>

#include <atomic>
#include <filesystem>
#include <thread>

#include "compute/engine/chosen_engine.hpp"
#include "haptics/channels.hpp"
#include "session/record/log_export.hpp"
#include "tests/desk/recorded_session.hpp"
#include "tests/record/failing_disk.hpp"
#include "tests/support/run_command.hpp"

namespace burin::session {
namespace {

void tick(Desk& desk, SimulatedClock& clock, int times) {
    for (int i = 0; i < times; ++i) {
        clock.sleep_until(clock.now_ns() + 1'000'000);
        desk.session().loop().step();
        // Updates that no log has: for ticks that are not done again. Without them samples would be dropped.
        if (i % 1000 != 999) continue;
        EXPECT_TRUE(desk.session().scene().update(clock.now_ns()));
    }
}

void one_frame(Recorded& of, SimulatedClock& clock) {
    const auto begun = of.input->begin_frame(clock.now_ns(), clock.now_ns());
    const haptics::ToolState tool = of.desk->session().newest_tool();
    of.desk->step(*begun, {.size = kShownSize}, tool, [](Executor::Order) {});
    of.recorder->frame(std::span(&tool, 1), {}, {{{.size = kShownSize}}, of.desk->measured(), of.desk->words()});
}

std::string told_by(Recorded& of) {
    testing::internal::CaptureStderr();
    of.recorder->finish({});
    return testing::internal::GetCapturedStderr();
}

}  // namespace

TEST(SessionRecording, OfAMouseOnTheSurfaceIsDoneAgainToTheBit) {
    const Workplace place;
    const std::string path = (place / "a.session").string();
    SessionSetup options = short_options(path);
    options.hands.mouse = MouseMode::surface;
    options.carve.mirror.across[0] = true;
    ASSERT_TRUE(settle_mouse(options));
    const std::uint64_t ticks = record_live(options,
                                            "burin-input 1 test\n0.02 mouse 320 180\n0.1 command mirror xz\n"
                                            "0.2 button press left\n"
                                            "0.3 mouse 330 184\n0.4 mouse 350 190\n0.5 button release left\n"
                                            "0.55 button press right\n0.6 mouse 380 190\n0.62 button release right\n"
                                            "0.8 close\n");
    auto log = log_in(path);
    ASSERT_TRUE(log) << log.error().line();
    EXPECT_NE(log->settings.find("--mouse surface"), std::string::npos) << log->settings;
    const auto recorded = options_as_recorded(log->settings, short_options(""));
    ASSERT_TRUE(recorded) << recorded.error().line();
    EXPECT_EQ(recorded->options.hands.mouse, MouseMode::surface);
    EXPECT_EQ(recorded->options.hands.device, "mouse");
    SessionSetup again = recorded->options;
    again.carve.engine = compute::EngineChoice::cpu;
    const Judged is = judged(std::move(*log), path, again);
    ASSERT_TRUE(is.done) << is.done.error().line();
    EXPECT_EQ(is.found.ticks, ticks);
    EXPECT_EQ(is.departed, 0u);
}

TEST(SessionRecording, OfADeskIsDoneAgainToTheBitInEveryColumn) {
    const Workplace place;
    const std::string path = (place / "a.session").string();
    const std::uint64_t ticks = record_live(short_options(path));
    ASSERT_GE(ticks, 500u) << "however busy the machine is: the script's half second has its ticks";

    auto log = log_in(path);
    ASSERT_TRUE(log) << log.error().line();
    EXPECT_EQ(log->threads->ticks.count, 0u) << "they are in the columns alone";
    EXPECT_TRUE(log->threads->end_check);
    EXPECT_EQ(log->device, short_options("").hands.device);
    const Judged is = judged(*log, path, short_options(""));
    ASSERT_TRUE(is.done) << is.done.error().line();
    EXPECT_EQ(is.found.ticks, ticks);
    EXPECT_GT(is.found.columns, 60u);
    EXPECT_EQ(is.departed, 0u);
    EXPECT_EQ(is.unrecorded, 0u);

    // The log as text is the same log, and leads to the same ticks.
    auto reader = record::RecordReader::open(path);
    ASSERT_TRUE(export_session_log(*reader, (place / "a.log").string()));
    auto text = read_input_log(place / "a.log");
    ASSERT_TRUE(text) << text.error().line();
    EXPECT_EQ(text->settings, log->settings);
    EXPECT_EQ(text->events.size(), log->events.size());
    EXPECT_EQ(text->threads->frames.size(), log->threads->frames.size());
    const Judged by_text = judged(std::move(*text), path, short_options(""));
    ASSERT_TRUE(by_text.done) << by_text.done.error().line();
    EXPECT_EQ(by_text.found.ticks, ticks);

    // Another workpiece tells where it first differs: its workspace is another, also where a busy machine left the hand
    // no time to touch it.
    SessionSetup other = short_options("");
    other.carve.workpiece.source = "ball:0.12";
    const Judged changed = judged(std::move(*log), path, other);
    ASSERT_FALSE(changed.done);
    ASSERT_TRUE(changed.found.difference);
    EXPECT_FALSE(changed.found.difference->column.empty());
    EXPECT_NE(changed.found.difference->first, changed.found.difference->second);
    EXPECT_EQ(static_cast<std::uint64_t>(changed.found.difference->tick), changed.found.ticks + 1);
}

// What hands touch, what an activity has them hold, and how the object moves and is felt then. The session runs in real
// time, and its script waits for the hand's ticks.
TEST(SessionRecording, OfAnActivityThatGraspsWithFourFingersIsDoneAgainToTheBit) {
    const std::string script = R"(burin-input 1 test
0.02 mouse 320 180
0.05 scroll 0 9
0.2 button press left
2.0 mouse 330 170
2.1 mouse 350 160
2.6 button release left
5.2 close
)";
    const Workplace place;
    const std::string path = (place / "a.session").string();
    const auto live = std::make_shared<Grasping>();
    const std::uint64_t ticks = record_live(grasp_options(path, live), script);
    ASSERT_EQ(live->holds.size(), 2u) << "it was taken, and let go of";
    EXPECT_GE(live->holds[0].by.size(), 2u);
    const double way_m = glm::length(live->let_go_m - live->took_m);
    EXPECT_GT(way_m, 0.001);
    // The hand's way is known from the first frame that sees the block move, which is later the slower frames are.
    EXPECT_GT(glm::length(live->at.position_m), 0.7 * way_m) << "it has gone along with the hand";
    EXPECT_LT(glm::length(live->at.position_m), 2.0 * way_m) << "it has gone along with the hand";

    auto log = log_in(path);
    ASSERT_TRUE(log) << log.error().line();
    const auto repeated = std::make_shared<Grasping>();
    const Judged is = judged(std::move(*log), path, grasp_options("", repeated));
    ASSERT_TRUE(is.done) << is.done.error().line();
    EXPECT_EQ(is.found.ticks, 4 * ticks);
    EXPECT_FALSE(is.found.difference);
    EXPECT_EQ(is.departed, 0u);
    EXPECT_EQ(repeated->contacts, live->contacts);
    EXPECT_EQ(repeated->holds, live->holds);
    EXPECT_EQ(repeated->at, live->at);

    // Its trial is compared, and a row that was changed is told.
    auto reader = record::RecordReader::open(path);
    ASSERT_TRUE(reader);
    std::vector<TrialMark> trials = is.trials;
    ASSERT_EQ(trials.size(), 2u);
    const auto same = compare_trials(*reader, trials, true);
    EXPECT_TRUE(same) << same.error().line();
    const auto told = [&](const std::vector<TrialMark>& others, bool whole) {
        const auto compared = compare_trials(*reader, others, whole);
        return compared ? std::string("nothing") : compared.error().line();
    };
    EXPECT_TRUE(told({{trials[0].time_ns, "reach"}, trials[1]}, true).contains("is done again as reach"));
    EXPECT_TRUE(told({{trials[0].time_ns + 1, "grasp"}, trials[1]}, true).contains("began at"));
    EXPECT_TRUE(told({trials[0], {trials[1].time_ns, "", "given up"}}, true).contains("again as 'given up'"));
    EXPECT_TRUE(told({trials[0], {trials[1].time_ns + 1, "", "let go"}}, true).contains("ended as 'let go'"));
    EXPECT_TRUE(told({}, true).contains("is not there"));
    EXPECT_TRUE(told({trials[0], trials[1], {trials[1].time_ns, "grasp"}}, true).contains("has 1 trials, and 2"));
    EXPECT_EQ(told({}, false), "nothing") << "of a log that was torn off before";
    EXPECT_EQ(told({trials[0]}, false), "nothing") << "or within it";
}

TEST(SessionRecording, LosesNothingWhereTheFramesStandStill) {
    const Workplace place;
    const std::string path = (place / "a.session").string();
    SimulatedClock clock;
    Recorded recorded(path, clock, Recorded::Of::nobody);
    tick(*recorded.desk, clock, 10);
    one_frame(recorded, clock);
    // More ticks than a ring holds, without a frame: the writer takes them. Simulated time is not held back by a clock.
    for (int i = 0; i < 4; ++i) {
        tick(*recorded.desk, clock, 5000);
        recorded.input->recording()->take_ticks();
    }
    one_frame(recorded, clock);
    EXPECT_FALSE(recorded.input->recording_error());
    recorded.recorder->finish({});
    const auto log = log_in(path);
    ASSERT_TRUE(log) << log.error().line();
    EXPECT_EQ(log->threads->frames.size(), 2u);
    auto reader = record::RecordReader::open(path);
    EXPECT_EQ(reader->hands().front().rows(), 20'010u);
    EXPECT_EQ(reader->facts().at("ticks lost, hand 0"), "0");
}

TEST(SessionRecording, EndsItsLogAndCountsWhatIsLostWhereTheDiskStandsStillForTooLong) {
    const Workplace place;
    const std::string path = (place / "a.session").string();
    record::test::FailingDisk& disk = record::test::failing_disk();
    disk.reset();
    SimulatedClock clock;
    Recorded recorded(path, clock, record::test::FailingDisk::kName);
    tick(*recorded.desk, clock, 10);
    one_frame(recorded, clock);
    recorded.input->recording()->take_ticks();
    std::atomic<bool> stands_still{true};
    std::atomic<int> flushes{0};
    disk.set_before_sync([&] {
        ++flushes;
        while (stands_still) std::this_thread::yield();
    });
    tick(*recorded.desk, clock, 2000);  // a block or two are full: a transaction begins
    while (flushes == 0) std::this_thread::yield();
    tick(*recorded.desk, clock, 20'000);
    stands_still = false;
    one_frame(recorded, clock);
    recorded.input->recording()->take_ticks();
    tick(*recorded.desk, clock, 10);
    recorded.input->recording()->take_ticks();
    one_frame(recorded, clock);
    ASSERT_TRUE(recorded.input->recording_error());
    EXPECT_NE(recorded.input->recording_error()->line().find("ticks were lost after tick"), std::string::npos);
    EXPECT_NE(told_by(recorded).find("ticks were lost"), std::string::npos);
    EXPECT_FALSE(recorded.desk->session().files().outcome());
    disk.reset();

    auto reader = record::RecordReader::open(path);
    ASSERT_TRUE(reader) << reader.error().line();
    const std::uint64_t lost = recorded.desk->session().channels().records.refused();
    EXPECT_GT(lost, 0u);
    EXPECT_EQ(reader->facts().at("ticks lost, hand 0"), std::to_string(lost));
    EXPECT_EQ(reader->hands().front().rows(), 22'020u - lost);
    EXPECT_EQ(reader->events()->front().name, "log ended");
    // What comes before can be done again.
    const auto log = read_session_log(*reader);
    ASSERT_TRUE(log) << log.error().line();
    auto ticks = ticks_of_columns(*reader);
    ASSERT_TRUE(ticks);
    std::uint64_t before = 0;
    while ((*ticks)->next(0).value()) ++before;
    EXPECT_LT(before, 22'020u - lost) << "up to the first that was lost";
}

TEST(SessionRecording, NamesADiskThatFailsAndTheSessionGoesOn) {
    const Workplace place;
    record::test::FailingDisk& disk = record::test::failing_disk();
    disk.reset();
    SimulatedClock clock;
    Recorded recorded((place / "a.session").string(), clock, record::test::FailingDisk::kName);
    disk.does_not_sync = true;
    tick(*recorded.desk, clock, 3000);
    one_frame(recorded, clock);
    // The file is taken away: that is no matter of patience.
    std::filesystem::remove(place / "a.session");
    const std::string told = told_by(recorded);
    EXPECT_NE(told.find("taken away"), std::string::npos) << told;
    EXPECT_FALSE(recorded.desk->session().files().outcome());
    disk.reset();
}

TEST(SessionRecording, LeavesAnExistingFileAlone) {
    const Workplace place;
    place.write("a.session", "mine");
    SimulatedClock clock;
    const SessionSetup options = short_options((place / "a.session").string());
    auto desk = Desk::create(options, *session_wall(options.desk), clock);
    ASSERT_TRUE(desk);
    const auto writer = create_recording(options, {}, (*desk)->session());
    ASSERT_FALSE(writer);
    EXPECT_NE(writer.error().line().find("never overwrites"), std::string::npos) << writer.error().line();
    EXPECT_EQ(place.read("a.session"), "mine");
    EXPECT_FALSE(log_in((place / "a.session").string()));
}

}  // namespace burin::session
