// SPDX-License-Identifier: MIT
// Written from the Brain Imaging Data Structure 1.9, "Motion". Its tables are text with tabs between the fields, "n/a"
// for what is missing.
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cerrno>
#include <cmath>
#include <filesystem>
#include <map>
#include <optional>
#include <system_error>
#include <utility>

#include "base/json.hpp"
#include "base/text.hpp"
#include "base/try.hpp"
#include "record/export/new_file.hpp"
#include "record/export/table_export.hpp"

namespace burin::record {
namespace {

namespace fs = std::filesystem;

// A folder that appears under its name only when all of it is there.
class NewFolder {
public:
    static Result<NewFolder> create(const std::string& path) {
        NewFolder folder;
        folder.path_ = path;
        while (folder.path_.size() > 1 && folder.path_.ends_with('/')) folder.path_.pop_back();
        BURIN_TRY_DO(check_no_file(folder.path_));
        const std::string temporary = folder.path_ + "." + std::to_string(::getpid()) + ".part";
        if (::mkdir(temporary.c_str(), 0777) != 0)
            return fail(path, "cannot be made: " + std::generic_category().message(errno),
                        "choose a folder that exists and that you may write to");
        folder.temporary_ = temporary;
        return folder;
    }
    ~NewFolder() {
        std::error_code ignored;
        if (!temporary_.empty()) fs::remove_all(temporary_, ignored);
    }
    NewFolder(NewFolder&& other) noexcept
        : path_(std::move(other.path_)), temporary_(std::exchange(other.temporary_, {})) {}
    NewFolder& operator=(NewFolder&&) = delete;

    [[nodiscard]] fs::path operator/(const std::string& name) const { return fs::path(temporary_) / name; }
    [[nodiscard]] Result<void> write(const fs::path& place, std::string_view text) const {
        BURIN_TRY(file, NewFile::create(place.string()));
        BURIN_TRY_DO(file.write(text));
        return file.finish();
    }
    [[nodiscard]] Result<void> finish() {
        BURIN_TRY_DO(check_no_file(path_));
        if (::rename(temporary_.c_str(), path_.c_str()) != 0)
            return fail(path_, "cannot be made: " + std::generic_category().message(errno), "choose another name");
        temporary_.clear();
        return {};
    }

private:
    NewFolder() = default;
    std::string path_, temporary_;
};

// How BIDS names what a column holds.
struct BidsChannel {
    std::string name, component = "n/a", type = "MISC", point = "n/a", units = "n/a", frame = "n/a",
                      description = "n/a";
};

std::string bids_component(const std::string& name) {
    constexpr std::array<std::array<const char*, 2>, 7> parts{
        {{"x", "x"}, {"y", "y"}, {"z", "z"}, {"qx", "quat_x"}, {"qy", "quat_y"}, {"qz", "quat_z"}, {"qw", "quat_w"}}};
    for (std::size_t begin = 0; begin <= name.size();) {
        const std::size_t end = std::min(name.find('_', begin), name.size());
        for (const auto& [part, component] : parts)
            if (name.substr(begin, end - begin) == part) return component;
        begin = end + 1;
    }
    return "n/a";
}

// Returns "hip0" of "hip0_object_x_m"; empty where the name does not begin with the word and a number.
std::string numbered(const std::string& name, const std::string& word) {
    std::size_t end = word.size();
    if (!name.starts_with(word)) return {};
    while (end < name.size() && name[end] >= '0' && name[end] <= '9') ++end;
    return end > word.size() ? name.substr(0, end) : std::string();
}

BidsChannel channel_of(const HandRecord& table, const Column& column) {
    BidsChannel channel;
    channel.name = column.name;
    if (!column.unit.empty() && column.unit != "rad or m") channel.units = column.unit;
    if (!column.frame.empty()) channel.frame = column.frame;
    channel.component = bids_component(column.name);
    const bool is_place = column.unit == "m" && channel.component != "n/a";
    const auto is = [&](const char* begin) { return column.name.starts_with(begin); };
    std::string point = numbered(column.name, "hip");
    if (point.empty()) point = numbered(column.name, "proxy");
    if (is_place && !point.empty()) {
        channel.type = "POS";
        channel.point = point;
    } else if (is("position_device")) {
        channel.type = "POS";
    } else if (is("orientation_device")) {
        channel.type = "ORNT";
    } else if (is("velocity_device")) {
        channel.type = "VEL";
    } else if (is("angular_velocity_device")) {
        channel.type = "GYRO";
    }
    if (channel.type != "MISC" && channel.point == "n/a") channel.point = "handle";
    if (!numbered(column.name, "object").empty() && !is("object_from")) {
        channel.description = "number of the object touched, 0: none";
        for (const RecordedObject& object : table.objects)
            channel.description += "; " + std::to_string(object.number) + ": " + object.name;
    }
    for (char& c : channel.description)
        if (c == '\t' || c == '\n' || c == '\r') c = ' ';
    return channel;
}

std::string channels_table(const std::vector<BidsChannel>& channels) {
    std::string text = "name\tcomponent\ttype\ttracked_point\tunits\treference_frame\tdescription\n";
    for (const BidsChannel& c : channels)
        text += c.name + "\t" + c.component + "\t" + c.type + "\t" + c.point + "\t" + c.units + "\t" + c.frame + "\t" +
                c.description + "\n";
    return text;
}

// What a value is in a table of BIDS, which knows no infinite numbers.
std::string bids_value(Word word, ColumnType type) {
    if (type == ColumnType::f64 && !std::isfinite(std::bit_cast<double>(word))) return "n/a";
    return text_of(word, type);
}

// Whole seconds and nine digits, from whole nanoseconds.
std::string bids_seconds(std::int64_t ns) {
    const std::uint64_t size =
        ns < 0 ? std::uint64_t{0} - static_cast<std::uint64_t>(ns) : static_cast<std::uint64_t>(ns);
    return formatted("%s%llu.%09llu", ns < 0 ? "-" : "", static_cast<unsigned long long>(size / 1'000'000'000),
                     static_cast<unsigned long long>(size % 1'000'000'000));
}

// First and last tick and time, for the rate.
struct BidsSpan {
    std::optional<std::size_t> tick, time;  // columns
    bool began = false;
    std::int64_t first_tick = 0, last_tick = 0, first_ns = 0, last_ns = 0;

    explicit BidsSpan(const HandRecord& table) {
        for (std::size_t c = 0; c < table.columns.size(); ++c) {
            if (table.columns[c].type != ColumnType::i64) continue;
            if (table.columns[c].name == "tick") tick = c;
            if (table.columns[c].name == "time_ns") time = c;
        }
    }
    void see(const Block& block, std::uint32_t row) {
        last_tick = tick ? static_cast<std::int64_t>(block.at(*tick, row)) : last_tick + 1;
        last_ns = time ? static_cast<std::int64_t>(block.at(*time, row)) : last_ns;
        if (!std::exchange(began, true)) first_tick = last_tick, first_ns = last_ns;
    }
    [[nodiscard]] double duration_s() const {
        return 1e-9 * (static_cast<double>(last_ns) - static_cast<double>(first_ns));
    }
    // Ticks a second by their numbers, so that lost ones count; 1000 where that cannot be told.
    [[nodiscard]] double rate_Hz() const {
        const double ticks = static_cast<double>(last_tick) - static_cast<double>(first_tick), s = duration_s();
        return ticks > 0.0 && s > 0.0 ? ticks / s : 1000.0;
    }
};

Result<void> write_motion(RecordReader& reader, std::size_t table, const std::vector<std::size_t>& columns,
                          const std::string& path, const TickTimes& times, BidsSpan& span, ExportReport& report) {
    BURIN_TRY(file, NewFile::create(path));
    std::string line;
    const auto done = each_block(reader, table, times, report, [&](const Block& block) -> Result<void> {
        for (std::uint32_t row = 0; row < block.rows(); ++row) {
            span.see(block, row);
            std::int64_t since_ns = 0;
            if (__builtin_sub_overflow(span.last_ns, span.first_ns, &since_ns)) since_ns = 0;
            line = bids_seconds(since_ns);
            for (const std::size_t c : columns) line += "\t" + bids_value(block.at(c, row), block.type(c));
            BURIN_TRY_DO(file.write(line + "\n"));
        }
        return {};
    });
    if (!done) return done;
    return file.finish();
}

Json motion_json(const std::vector<BidsChannel>& channels, const BidsSpan& span, const RecordReader& reader,
                 const HandRecord& table, const BidsLabels& labels, std::uint64_t rows) {
    const double rate = span.rate_Hz(), whole = std::round(rate);
    Json json;
    json["TaskName"] = labels.task;
    json["SamplingFrequency"] = whole >= 1.0 ? whole : rate;
    json["SamplingFrequencyEffective"] =
        span.duration_s() > 0.0 && rows > 1 ? static_cast<double>(rows - 1) / span.duration_s() : rate;
    json["TrackingSystemName"] = table.name;
    const std::string device = reader.fact("device"), version = reader.fact("version");
    json["ManufacturersModelName"] = device.empty() ? table.name : device;
    if (!version.empty()) json["SoftwareVersions"] = "Burin " + version;  // else nobody knows: the key may be missing
    json["RecordingDuration"] = span.duration_s();
    json["MissingValues"] = "n/a";
    json["MotionChannelCount"] = channels.size();
    std::map<std::string, std::size_t> of_type, of_point;
    for (const BidsChannel& channel : channels) {
        ++of_type[channel.type];
        if (channel.point != "n/a") ++of_point[channel.point];
    }
    json["TrackedPointsCount"] = of_point.size();
    for (const auto& [type, count] : of_type) json[type + "ChannelCount"] = count;
    return json;
}

// Orientations are quaternions, which have no RotationOrder: that is of Euler angles, and has no word for none.
Json frames_json() {
    const auto frame = [](const char* words) {
        return Json{{"SpatialAxes", "RSP"}, {"RotationRule", "right-hand"}, {"Description", words}};
    };
    Json json;
    json["reference_frame"]["Description"] = "x to the right, y up, z to the person; metres";
    json["reference_frame"]["Levels"]["device"] = frame("of the device: its origin is the middle of its workspace");
    json["reference_frame"]["Levels"]["object"] = frame("of what is touched; forces are given at the device");
    return json;
}

// A row of the table of events.
struct BidsEvent {
    std::int64_t onset_ns = 0;
    std::string duration, type, value, state;
};

// What stands in a cell of a table.
std::string bids_cell(std::string text) {
    std::ranges::replace_if(text, [](char c) { return c == '\t' || c == '\n' || c == '\r'; }, ' ');
    return text.empty() ? "n/a" : text;
}

// Trials and events in the order of time; empty where there are none. What happens at an instant has no duration.
Result<std::string> events_table(RecordReader& reader, std::int64_t first_ns) {
    BURIN_TRY(trials, reader.trials());
    BURIN_TRY(events, reader.events());
    std::vector<BidsEvent> rows;
    for (const TrialRecord& trial : trials) {
        std::int64_t onset_ns = 0, length_ns = 0;
        if (__builtin_sub_overflow(trial.begun_ns, first_ns, &onset_ns) ||
            __builtin_sub_overflow(trial.ended_ns, trial.begun_ns, &length_ns))
            continue;
        rows.push_back({onset_ns, trial.state == "open" ? "n/a" : bids_seconds(length_ns), bids_cell(trial.name), "n/a",
                        bids_cell(trial.state)});
    }
    for (const EventRecord& event : events) {
        std::int64_t onset_ns = 0;
        if (__builtin_sub_overflow(event.time_ns, first_ns, &onset_ns)) continue;
        rows.push_back({onset_ns, "0", bids_cell(event.name), bids_cell(event.value), "n/a"});
    }
    if (rows.empty()) return std::string();
    std::ranges::stable_sort(rows, {}, &BidsEvent::onset_ns);
    std::string text = "onset\tduration\ttrial_type\tvalue\tstate\n";
    for (const BidsEvent& row : rows)
        text += bids_seconds(row.onset_ns) + "\t" + row.duration + "\t" + row.type + "\t" + row.value + "\t" +
                row.state + "\n";
    return text;
}

Json events_json() {
    Json json;
    json["trial_type"]["Description"] =
        "what happened: the name of a trial, from its beginning to its end, or of an event, which has no duration";
    json["value"]["Description"] = "what was noted with an event, such as why an attempt failed";
    json["state"]["Description"] = "how a trial ended: done, or why it failed; open: it has no end";
    return json;
}

// The group of a study's participant is the recording's own fact; other recordings have none.
struct BidsPeople {
    std::string table;
    Json described;  // null: there is nothing but the code
};

BidsPeople people_of(const RecordReader& reader, const std::string& subject) {
    const std::string group = reader.fact("study group");
    if (group.empty()) return {"participant_id\n" + subject + "\n", {}};
    Json json;
    json["group"]["Description"] = "the group of the study that the participant was allocated to";
    return {"participant_id\tgroup\n" + subject + "\t" + bids_cell(group) + "\n", std::move(json)};
}

}  // namespace

Result<void> check_labels(const BidsLabels& labels) {
    for (const auto& [option, label] : {std::pair("--subject", &labels.subject), std::pair("--task", &labels.task)}) {
        const auto is_plain = [](char c) {
            return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
        };
        if (label->empty() || label->size() > 50 || !std::ranges::all_of(*label, is_plain))
            return fail(option, "'" + *label + "' is no label of BIDS", "use letters and digits only");
    }
    return {};
}

Result<ExportReport> export_bids(RecordReader& reader, std::size_t table, const std::vector<std::size_t>& columns,
                                 const std::string& path, const BidsLabels& labels, const TickTimes& times) {
    BURIN_TRY_DO(check_labels(labels));
    if (path == "-") return fail("bids", "cannot go to standard output: it is a folder", "name a folder");
    Result<NewFolder> folder = NewFolder::create(path);
    if (!folder) return std::unexpected(folder.error());
    const std::string subject = "sub-" + labels.subject;
    std::error_code made;
    fs::create_directories(*folder / subject / "motion", made);
    if (made) return fail(path, "cannot be made: " + made.message(), "free some space or choose another folder");
    const std::string begin =
        (*folder / subject / "motion" / (subject + "_task-" + labels.task + "_tracksys-hand_")).string();
    const HandRecord& of = reader.table(table);
    std::vector<BidsChannel> channels{{"latency", "n/a", "LATENCY", "n/a", "s", "n/a", "since the first tick"}};
    for (const std::size_t c : columns) channels.push_back(channel_of(of, of.columns[c]));

    BidsSpan span(of);
    ExportReport report{0, columns.size(), {}};
    BURIN_TRY_DO(write_motion(reader, table, columns, begin + "motion.tsv", times, span, report));
    const Result<std::string> events = events_table(reader, span.first_ns);
    if (!events) return std::unexpected(events.error());
    const BidsPeople people = people_of(reader, subject);
    const Json set{{"Name", "Burin session"},
                   {"BIDSVersion", "1.9.0"},
                   {"DatasetType", "raw"},
                   {"GeneratedBy", Json::array({Json{{"Name", "burin convert"}}})}};
    std::vector<std::pair<fs::path, std::string>> texts{
        {*folder / "dataset_description.json", json_text(set)},
        {*folder / "README",
         "Ticks of a Burin session, as motion: one line a tick of the haptic loop. Columns and frames stand in the "
         "files "
         "*_channels.*, what program and device recorded them in *_motion.json. Events and trials, where there are "
         "any, are in *_events.tsv, the participant's group in participants.tsv.\n"},
        {*folder / "participants.tsv", people.table},
        {begin + "channels.tsv", channels_table(channels)},
        {begin + "channels.json", json_text(frames_json())},
        {begin + "motion.json", json_text(motion_json(channels, span, reader, of, labels, report.rows))}};
    if (!people.described.is_null()) texts.emplace_back(*folder / "participants.json", json_text(people.described));
    if (!events->empty()) {
        texts.emplace_back(begin + "events.tsv", *events);
        texts.emplace_back(begin + "events.json", json_text(events_json()));
    }
    for (const auto& [place, text] : texts) BURIN_TRY_DO(folder->write(place, text));
    BURIN_TRY_DO(folder->finish());
    return report;
}

}  // namespace burin::record
