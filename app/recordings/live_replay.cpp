// SPDX-License-Identifier: MIT
#include "app/recordings/live_replay.hpp"

#include "app/recordings/changed_settings.hpp"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <iterator>
#include <memory>
#include <optional>

#include "activities/registry.hpp"
#include "activities/replay/device_as_recorded.hpp"
#include "activities/wand/wand_facts.hpp"
#include "app/cli/new_folders.hpp"
#include "base/file_io.hpp"
#include "base/try.hpp"
#include "desk/draw/picture_folder.hpp"
#include "desk/run/session.hpp"
#include "document/document_file.hpp"
#include "record/motion.hpp"
#include "record/record_writer.hpp"
#include "scene/vrml_world.hpp"
#include "scene/world_digest.hpp"
#include "sculpt/carved_workpiece.hpp"
#include "session/drive/headless_session.hpp"
#include "session/drive/tick_comparison.hpp"
#include "session/record/log_outputs.hpp"
#include "session/record/session_log.hpp"
#include "session/record/session_recording.hpp"
#include "session/state/session_settings.hpp"
#include "session/work/opened_work.hpp"

namespace burin::app {
namespace {

constexpr const char* kWorkpieceDigestFact = "workpiece sha256";
constexpr const char* kToolDigestFact = "tool sha256";

// The fact that holds the digest of the wand of a hand after the first.
std::string wand_fact_of(const session::NamedDevice& hand) { return record::kWandDigestFact + (", hand " + hand.hand); }

std::string hands_text(const std::vector<session::NamedDevice>& hands) {
    std::string text;
    for (const session::NamedDevice& one : hands) text += (text.empty() ? "" : " ") + one.hand + "=" + one.device;
    return text;
}

std::string tool_file_of(const session::SessionSetup& options) {
    const std::string& shape = options.hands.tool.shape;
    return shape.starts_with("mesh:") ? shape.substr(5) : std::string();
}

// Returns a device's name without what describes it: simulated-wand of simulated-wand:FILE.
std::string device_kind_of(const std::string& device) { return device.substr(0, device.find(':')); }

// Returns the digest of a file; nothing where there is none.
std::optional<std::string> digest_of(const std::string& path) {
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(path, ignored)) return {};
    const Result<std::string> digest = file_digest(path);
    return digest ? std::optional(*digest) : std::nullopt;
}

std::optional<std::string> digest_of_world(const std::string& path, const scene::WorldReading& reading) {
    if (path.empty()) return {};
    if (document::is_document_name(path)) {
        const Result<session::OpenedWork> saved = session::open_document(path);
        return saved && saved->world ? std::optional(scene::world_digest(saved->world->objects)) : std::nullopt;
    }
    // The session tells its remarks and problems.
    const scene::WorldOrProblems world = scene::read_any_world(path, reading);
    return world ? std::optional(scene::world_digest(world->objects)) : std::nullopt;
}

// A file that a recording depends on: the fact that holds its digest, what it is, and the option that names it.
struct FileOfRecording {
    const char* fact;
    const char* what;
    const char* option;
};

// Fails where the file is another one than was recorded, since its ticks could not be the same. Where the user has put
// another in its place by --set, that is told and no more.
Result<void> check_recorded_file(const record::RecordReader& reader, const FileOfRecording& file,
                                 const std::string& path, const std::optional<std::string>& now,
                                 const std::vector<std::string>& sets) {
    const std::string recorded = reader.fact(file.fact);
    if (recorded.empty() || !now || *now == recorded) return {};
    const std::string what = "is another " + std::string(file.what) + " than the one that was recorded: SHA-256 " +
                             *now + ", recorded: " + recorded;
    const std::string set = std::string(file.option) + "=";
    if (std::ranges::any_of(sets, [&](const std::string& given) { return given.starts_with(set); })) {
        std::fprintf(stderr, "burin: %s: %s\n", path.c_str(), what.c_str());
        return {};
    }
    return fail(path, what, "put the recorded one back, or try this one on purpose by --set " + set + path);
}

// Returns all changes, also of where files are now.
std::vector<std::string> changes_of(const LiveReplay& how) {
    std::vector<std::string> changes = how.sets;
    if (!how.world.empty()) changes.push_back("world=" + how.world);
    if (!how.workpiece.empty()) changes.push_back("workpiece=" + how.workpiece);
    return changes;
}

// Checks that the files which the session read are those that were recorded.
Result<void> check_files(const record::RecordReader& reader, const session::SessionSetup& own,
                         const std::string& first_device, const std::vector<std::string>& sets) {
    const std::string tool = tool_file_of(own), &workpiece = own.carve.workpiece.source, &device = own.hands.device;
    if (std::error_code ignored; !own.scene.world.empty() && !std::filesystem::exists(own.scene.world, ignored))
        return fail(own.scene.world, "is the world of the recording, and is not there",
                    "say where it is now by --world FILE");
    if (const auto same = check_recorded_file(reader, {record::kWorldDigestFact, "world", "world"}, own.scene.world,
                                              digest_of_world(own.scene.world, own.scene.reading), sets);
        !same)
        return same;
    if (const auto same = check_recorded_file(reader, {kWorkpieceDigestFact, "workpiece", "workpiece"}, workpiece,
                                              digest_of(workpiece), sets);
        !same)
        return same;
    if (const auto same =
            check_recorded_file(reader, {kToolDigestFact, "tool", "tool"}, "mesh:" + tool, digest_of(tool), sets);
        !same)
        return same;
    for (std::size_t i = 1; i < own.hands.named.size(); ++i) {
        const session::NamedDevice& hand = own.hands.named[i];
        const std::string fact = wand_fact_of(hand), what = "wand of hand " + hand.hand;
        if (const auto same = check_recorded_file(reader, {fact.c_str(), what.c_str(), "hands"}, hand.device,
                                                  digest_of(activities::wand_file_of(hand.device)), sets);
            !same)
            return same;
    }
    const bool several = !own.hands.named.empty();
    if (device == first_device)
        return activities::check_wand_file(
            reader, device,
            several ? "say where it is now by --set 'hands=" + hands_text(own.hands.named) +
                          "', with its place in there, or put it back"
                    : "say where it is now by --set device=simulated-wand:FILE, or put it back");
    return check_recorded_file(reader, {record::kWandDigestFact, "wand", "device"}, device,
                               digest_of(activities::wand_file_of(device)), sets);
}

// Refuses changes that would have no effect on this recording: they would count as tried.
Result<void> check_changes(const LiveReplay& how, const session::SessionSetup& recorded, bool brings_scene) {
    const bool several = !recorded.hands.named.empty();
    for (const std::string& set : how.sets)
        if (several && set.starts_with("device="))
            return fail("--set " + set, "the recording has several hands, each with its device",
                        "change them by --set 'hands=" + hands_text(recorded.hands.named) + "'");
        else if (set.starts_with("device=") && device_kind_of(set.substr(7)) != device_kind_of(recorded.hands.device))
            return fail("--set " + set,
                        "is another device than the recorded one, " + recorded.hands.device +
                            ": where the hand was and what it gave is that one's",
                        "feel the motion elsewhere by --through a world, or record a session with that device");
    if (brings_scene && !how.world.empty())
        return fail("--world " + how.world, "has no effect: the recording's scene is its study's", "leave it out");
    if (recorded.scene.no_workpiece && !how.workpiece.empty())
        return fail("--workpiece " + how.workpiece, "has no effect: the recording has no workpiece", "leave it out");
    return {};
}

// Makes the activity of a recorded session anew; none where it had none.
Result<session::MadeActivity> activity_of(const record::RecordReader& reader, const std::string& settings_line) {
    BURIN_TRY(settings, session::activity_on(settings_line));
    auto made = activities::activity_as_recorded(settings, [&](const std::string& name) { return reader.fact(name); });
    if (!made && made.error().where == "the recording")
        return fail(reader.path(), made.error().what, made.error().remedy);
    return made;
}

// Holds the log and the options with which a recorded session is replayed.
struct PreparedReplay {
    session::InputLog log;
    session::SessionSetup options;
    bool another_view = false;  // than the recorded one
};

// Reads the log, and makes the activity and the scene of the session anew.
Result<PreparedReplay> read_recorded_session(record::RecordReader& reader) {
    BURIN_TRY(log, session::read_session_log(reader));
    if (log.torn_line || !log.threads)
        return fail(reader.path(), "its log holds no ticks", "it was killed before its first transaction");
    PreparedReplay prepared{std::move(log), {}, false};
    prepared.options.record.input = reader.path();
    prepared.options.desk.offscreen = true;
    BURIN_TRY(made, activity_of(reader, prepared.log.settings));
    prepared.options.activity = std::move(made.activity);
    prepared.options.scene.given = std::move(made.scene);
    return prepared;
}

// Changes what is asked to be changed. Checks that all files of the session are there, and are those that were
// recorded where nobody has put others in their place.
Result<void> change_settings(const record::RecordReader& reader, const LiveReplay& how, PreparedReplay& prepared) {
    session::InputLog& log = prepared.log;
    session::SessionSetup& options = prepared.options;
    BURIN_TRY(first, session::options_as_recorded(log.settings, options));
    BURIN_TRY_DO(check_changes(how, first.options, options.scene.given != nullptr));
    BURIN_TRY(changed, with_changes(log.settings, changes_of(how), options));
    log.settings = std::move(changed.settings);
    options = std::move(changed.options);
    prepared.another_view = changed.another_view;
    options.work.refuses_exports = true;
    options.desk.screenshots = how.pictures;
    if (!how.pictures.empty()) BURIN_TRY_DO(session::make_picture_folder(how.pictures, "--pictures"));
    BURIN_TRY(recorded, session::options_as_recorded(log.settings, options));
    const std::string &device = first.options.hands.device, &now = recorded.options.hands.device;
    BURIN_TRY_DO(check_files(reader, recorded.options, device, how.sets));
    if (now != device) log.device.clear();  // chosen anew
    return session::check_commands(log, reader.path(), options.activity.get());
}

// Compares what was noted on the way: trials, and events.
Result<void> compare_notes(record::RecordReader& reader, const session::SessionNotes& notes, bool whole) {
    BURIN_TRY_DO(session::compare_trials(reader, notes.trials, whole));
    return session::compare_events(reader, notes.events, whole);
}

}  // namespace

std::vector<std::pair<std::string, std::string>> facts_of_live(const session::SessionSetup& options,
                                                               const std::string& command) {
    std::vector<std::pair<std::string, std::string>> facts{{"program", "burin"},
                                                           {"version", BURIN_VERSION},
                                                           {"compiler", __VERSION__},
                                                           {"command", command},
                                                           {"time", "real"}};
    if (!options.scene.world.empty()) facts.emplace_back("world", options.scene.world);
    if (!options.scene.no_workpiece) facts.emplace_back("workpiece", options.carve.workpiece.source);
    const auto add = [&](const char* fact, const std::optional<std::string>& digest) {
        if (digest) facts.emplace_back(fact, *digest);
    };
    add(record::kWorldDigestFact, digest_of_world(options.scene.world, options.scene.reading));
    if (!options.scene.no_workpiece) add(kWorkpieceDigestFact, digest_of(options.carve.workpiece.source));
    add(kToolDigestFact, digest_of(tool_file_of(options)));
    std::ranges::move(activities::facts_of_wand_file(options.hands.device), std::back_inserter(facts));
    for (std::size_t i = 1; i < options.hands.named.size(); ++i)
        if (const auto digest = digest_of(activities::wand_file_of(options.hands.named[i].device)))
            facts.emplace_back(wand_fact_of(options.hands.named[i]), *digest);
    return facts;
}

Result<void> run_recorded_session(const session::SessionSetup& given, const std::string& command) {
    session::SessionSetup options = given;
    options.carve.make_workpiece = sculpt::make_carved_workpiece;
    options.work.provenance = {{"program", "burin"}, {"version", BURIN_VERSION}, {"compiler", __VERSION__}};
    NewFolders folders({options.work.outputs, options.desk.screenshots});
    Result<void> done;
    if (session::is_session_file(options.record.path)) {
        BURIN_TRY_DO(session::settle_document(options));
        BURIN_TRY_DO(record::check_new_place(options.record.path));
        done = session::run_session(options, facts_of_live(options, command));
    } else {
        done = session::run_session(options);
    }
    if (done) folders.keep();
    return done;
}

std::optional<double> live_ball_radius_m(const record::RecordReader& reader) {
    const Result<std::string> shape = session::option_on(activities::live_settings_of(reader), "--tool");
    if (!shape) return {};
    const auto tool = toolbox::parse_tool_spec(*shape, "--tool");
    if (!tool || tool->kind != toolbox::ToolKind::ball) return {};
    return tool->sizes_m[0];
}

Result<LiveReplayed> replay_live(record::RecordReader& reader, const LiveReplay& how, const record::TickRange& range) {
    const bool had_viewer = reader.fact(session::kViewerFact) != session::kNoViewer;
    if (!had_viewer && !how.sets.empty())
        return fail("--set", "is for sessions that a person leads, and " + reader.path() + " has a hand of its own",
                    "leave it out");
    BURIN_TRY(prepared, read_recorded_session(reader));
    BURIN_TRY_DO(change_settings(reader, how, prepared));
    BURIN_TRY(judge,
              session::TickComparison::create(reader, range,
                                              how.pictures.empty() ? session::TickComparison::AtDifference::ends
                                                                   : session::TickComparison::AtDifference::goes_on));
    prepared.options.carve.make_workpiece = sculpt::make_carved_workpiece;
    session::ReplayManner manner;
    manner.draws = !how.pictures.empty();
    manner.only_compares = true;
    manner.another_view = prepared.another_view || !had_viewer;
    manner.picture_every_ns = nanoseconds(how.every_s);
    manner.witness = &judge;
    manner.ticks = &reader;
    session::SessionNotes notes;
    manner.notes = &notes;
    const Result<void> done = session::run_as_recorded(prepared.options, std::move(prepared.log), manner);
    LiveReplayed replayed{judge.found(), judge.unrecorded(), 0};
    if (!done && !replayed.comparison.difference) return std::unexpected(done.error());
    std::uint64_t rows = 0;
    for (const record::HandRecord& part : reader.hands()) rows += part.rows();
    replayed.left = rows - std::min(rows, judge.repeated());
    const bool whole = reader.is_closed() && replayed.left == 0 && replayed.unrecorded == 0;
    if (!done || replayed.comparison.difference) return replayed;
    BURIN_TRY_DO(compare_notes(reader, notes, whole));
    return replayed;
}

}  // namespace burin::app
