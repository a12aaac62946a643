// SPDX-License-Identifier: MIT
#include "desk/run/session.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>

#include "base/try.hpp"
#include "desk/draw/picture_folder.hpp"
#include "desk/opening/first_time.hpp"
#include "desk/view/session_tracker.hpp"
#include "devices/registry/device_registry.hpp"
#include "geometry/mesh/crumbs.hpp"
#include "session/drive/session_streams.hpp"
#include "session/drive/tick_comparison.hpp"
#include "session/live/opened_room.hpp"
#include "session/record/input_files.hpp"
#include "session/record/log_outputs.hpp"
#include "session/record/recordings.hpp"
#include "session/record/session_log.hpp"
#include "session/state/session_settings.hpp"
#include "session/work/journal_folder.hpp"

namespace burin::session {
namespace {

Result<InputLog> log_of_session(const std::string& path) {
    BURIN_TRY(reader, record::RecordReader::open(path));
    return read_session_log(reader);
}

// Reads a log, all of whose commands make sense.
Result<InputLog> open_log(const std::string& path, const Activity* activity = nullptr) {
    Result<InputLog> log = is_database(path) ? log_of_session(path) : read_input_log(path);
    if (!log) return log;
    if (log->torn_line) {
        // A script's last command would be left undone; a session that broke off is repeated as far as it was recorded.
        if (!log->threads) return fail(path, "the last line has no end", "end it with a line feed, or take it away");
        std::fprintf(stderr, "burin: %s\n", log->torn_line->c_str());
    }
    // Whose commands they are comes first: what a search is told makes no sense elsewhere.
    if (log->threads) BURIN_TRY_DO(check_activity_on(log->settings, activity));
    BURIN_TRY_DO(check_commands(*log, path, activity));
    return log;
}

// Refuses what only carving along a stroke does: a session would leave it undone without a word.
Result<void> check_for_a_session(const SessionSetup& options) {
    struct Misplaced {
        bool given;
        const char *option, *instead;
    };
    const std::array misplaced{
        Misplaced{!options.carve.stroke.file.empty(), "--stroke",
                  "carve it without a session first, or write it as an --input"},
        Misplaced{!options.carve.exports.files.empty(), "--export",
                  "export from the session's panel, or with 'command export FILE' in its --input"},
        Misplaced{!options.carve.stroke.pictures.empty(), "--pictures",
                  "press F12 in the session, or give 'command screenshot FILE' in its --input"},
        Misplaced{!options.carve.stroke.report.empty(), "--report", "time sessions with burin profile --json"},
    };
    if (!options.carve.stroke.file.empty() && (options.record.lsl || options.record.lsl_markers))
        return fail("--stroke", "is carved without a session, and --lsl and --lsl-markers are of sessions",
                    "leave them out, or write the stroke as an --input");
    for (const Misplaced& one : misplaced)
        if (one.given) return fail(one.option, "belongs to carving along a --stroke and not to a session", one.instead);
    return {};
}

// Reports errors in the options before a window opens, also those in the file of a mesh tool.
Result<void> check(const SessionSetup& options) {
    BURIN_TRY_DO(toolbox::parse_tool(options.hands.tool));
    BURIN_TRY_DO(geometry::check_crumbs(options.carve.exports.crumbs_m));
    BURIN_TRY_DO(toolbox::parse_feel(options.carve.feel));
    if (options.scene.no_workpiece && !has_world(options))
        return fail("--no-workpiece", "leaves nothing, since there is no world", "name one: burin world FILE");
    if (options.carve.mirror.any() && !has_workpiece(options))
        return fail("--mirror", "is for a workpiece, and the world has none",
                    "open it with a --workpiece, or leave it out");
    std::error_code ignored;
    if (!options.scene.world.empty() && !std::filesystem::is_regular_file(options.scene.world, ignored))
        return fail(
            options.scene.world,
            std::filesystem::exists(options.scene.world, ignored) ? "is no file that can be read" : "does not exist",
            "name a world: .toml, .wrl, or a mesh");
    const auto has_points = [](const NamedDevice& hand) {
        return devices::has_handle(hand.device, &session_recordings());
    };
    if (!options.hands.points.empty() && std::ranges::none_of(devices_of(options.hands), has_points))
        return fail("--points", "belongs to a handle with points, and the device is " + options.hands.device,
                    "give --device " + devices::devices_with_handles() + ", or leave --points out");
    return workpiece::check_units(options.carve.workpiece, false);  // a session has no tool from a file
}

Result<void> check_somebody_leads(const SessionSetup& setup, const SessionWall& wall) {
    const bool has_window = std::ranges::any_of(wall.screens, [](const SessionScreen& s) { return !s.direct; });
    const bool has_tracker =
        setup.desk.tracker.empty() ? !wall.setup.tracker_toml.empty() : setup.desk.tracker != kNoTracker;
    if (has_window || has_tracker || !setup.record.input.empty()) return {};
    return fail(setup.desk.wall, "has no screen in a window, and so neither keys nor a mouse",
                "give a --tracker whose wand works the panel, or an --input; or try the wall with --windowed");
}

// A session in simulated time hears nothing from outside, since its result depends on its --input alone.
void tell_of_unheard_tracker(const SessionSetup& setup) {
    if (setup.desk.tracker.empty() || setup.desk.tracker == kNoTracker) return;
    std::fprintf(
        stderr,
        "burin: --tracker %s: is not opened, since an --input is done in simulated time; with --record as well "
        "it is played in real time, and the tracker is heard\n",
        setup.desk.tracker.c_str());
}

// Does a session file again, and compares every tick on the way.
Result<void> run_compared(const SessionSetup& options, InputLog log) {
    BURIN_TRY(reader, record::RecordReader::open(options.record.input));
    BURIN_TRY(judge, TickComparison::create(reader, {}, TickComparison::AtDifference::goes_on));
    SessionNotes notes;
    const ReplayManner manner{.witness = &judge, .ticks = &reader, .notes = &notes};
    const Result<void> done = run_as_recorded(options, std::move(log), manner);
    const record::Comparison& found = judge.found();
    if (found.difference) return fail(options.record.input, "differs: " + found.difference->line());
    if (!done) {  // such as a picture that was asked for and is missing, which is no difference of the ticks
        std::printf("%s: %s ticks were compared, none differs\n", options.record.input.c_str(),
                    std::to_string(found.ticks).c_str());
        return done;
    }
    if (found.ticks == 0)
        return fail(options.record.input,
                    "none of its ticks was compared: its log ends before them, or they are missing",
                    "burin session check names what is missing");
    BURIN_TRY_DO(compare_trials(reader, notes.trials, reader.is_closed()));
    BURIN_TRY_DO(compare_events(reader, notes.events, reader.is_closed()));
    BURIN_TRY_DO(check_unchanged(reader));
    std::printf("%s: %s ticks, %zu columns: equal to the bit\n", options.record.input.c_str(),
                std::to_string(found.ticks).c_str(), found.columns);
    return {};
}

}  // namespace

bool wants_session(const SessionSetup& options) {
    const bool named = options.desk.live || options.desk.offscreen || !options.desk.wall.empty() ||
                       !options.record.input.empty() || !options.record.path.empty() || !options.work.outputs.empty() ||
                       wants_streams(options.record);
    return named || (options.carve.stroke.file.empty() && options.carve.exports.files.empty() &&
                     options.carve.stroke.pictures.empty() && options.carve.stroke.report.empty());
}

Result<void> run_as_recorded(const SessionSetup& given, InputLog log, const ReplayManner& manner) {
    BURIN_TRY(recorded, options_as_recorded(log.settings, given));
    if (!log.device.empty()) recorded.options.hands.device = log.device;
    recorded.options.record.tools_of_input = tools_in(log);
    for (const std::string& message : recorded.overruled) std::fprintf(stderr, "burin: %s\n", message.c_str());
    BURIN_TRY_DO(check(recorded.options));
    BURIN_TRY(wall, session_wall(recorded.options.desk));
    return replay_as_recorded(recorded.options, wall, std::move(log), manner);
}

Result<void> run_session(const SessionSetup& given, const SessionFacts& facts) {
    SessionSetup options = given;
    BURIN_TRY_DO(check_for_a_session(options));
    BURIN_TRY_DO(check_streams(options.record));
    if (options.desk.live && options.desk.offscreen)
        return fail("--offscreen", "opens no window, and --live asks for one", "leave one of them out");
    // What is recorded or streamed is played in real time.
    const bool in_real_time = !options.record.path.empty() || wants_streams(options.record);
    if (options.desk.offscreen && options.record.input.empty()) {
        return fail("--offscreen", "needs an --input: without a window nobody can do anything",
                    "give a log or a script, or leave --offscreen out");
    }
    if (!options.work.outputs.empty() && options.record.input.empty()) {
        return fail("--outputs", "is where the files of an --input go, and there is none",
                    "leave it out: keys and panel name a file's place, --screenshots that of pictures");
    }
    if (!options.desk.screenshots.empty()) {
        BURIN_TRY_DO(make_picture_folder(options.desk.screenshots, "--screenshots"));
    }
    std::optional<InputLog> log;
    if (!options.record.input.empty()) {
        BURIN_TRY(read, open_log(options.record.input, options.activity.get()));
        const SessionOutputs outputs(options, inputs_of(options).list());
        BURIN_TRY_DO(outputs.prepare(read, options.record.input));
        if (!in_real_time) tell_of_unheard_tracker(options);
        if (read.threads && !in_real_time) {
            return is_database(options.record.input) ? run_compared(options, std::move(read))
                                                     : run_as_recorded(options, std::move(read), {});
        }
        options.record.tools_of_input = tools_in(read);
        log = std::move(read);
    }
    if (!log && options.work.journal.empty()) options.work.journal = usual_journal_folder();
    if (options.work.journal == kNoJournal) options.work.journal.clear();
    BURIN_TRY_DO(settle_document(options));
    BURIN_TRY_DO(take_settings_of_document(options));
    BURIN_TRY_DO(settle_mouse(options));
    settle_view(options);
    if (!log) options.carve.workpiece.close_small_holes = true;
    settle_room(options, true);
    options.carve.exports.usual_crumbs = !log;
    BURIN_TRY_DO(check(options));
    BURIN_TRY(wall, session_wall(options.desk));
    BURIN_TRY_DO(check_somebody_leads(options, wall));
    options.desk.first_steps = !log && wall.desk && options.hands.mouse == MouseMode::surface && is_first_time();
    if (log && !in_real_time) return run_in_simulated_time(options, wall, std::move(*log));
    const LogNeeds needs = log ? needs_of(log->events) : LogNeeds{.pictures = true, .panel = true};
    const auto run = run_in_real_time(options, wall, log ? InputSource::play(std::move(*log)) : InputSource::live(),
                                      {.facts = facts, .needs = needs, .opens_before_eyes = !log});
    return run ? Result<void>{} : std::unexpected(run.error());
}

Result<SessionRecord> time_session(SessionSetup options, bool for_a_device) {
    options.work.writes_nothing = true;
    options.carve.workpiece.close_small_holes = true;
    BURIN_TRY_DO(settle_mouse(options));
    BURIN_TRY_DO(check(options));
    BURIN_TRY(wall, session_wall(options.desk));
    BURIN_TRY(log, open_log(options.record.input));
    options.record.tools_of_input = tools_in(log);
    RealTimeRun run{.keep_frames = true};
    if (for_a_device) run.pace = {.lead_ns = haptics::HapticLoop::kLead_ns};
    return run_in_real_time(options, wall, InputSource::play(std::move(log)), std::move(run));
}

}  // namespace burin::session
