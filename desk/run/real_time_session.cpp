// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "base/try.hpp"
#include "desk/opening/first_time.hpp"
#include "desk/opening/opening.hpp"
#include "desk/present/offscreen_output.hpp"
#include "desk/present/presenter.hpp"
#include "desk/run/live_frames.hpp"
#include "desk/run/session.hpp"
#include "desk/view/session_tracker.hpp"
#include "devices/trackers/tracker.hpp"
#include "gpu/device.hpp"
#include "haptics/realtime.hpp"
#include "session/drive/executors.hpp"
#include "session/drive/recording_start.hpp"
#include "session/drive/session_streams.hpp"
#include "session/hands/machine_pace.hpp"
#include "session/input/input_line.hpp"
#include "session/options/option_bounds.hpp"
#include "session/record/session_recording.hpp"
#include "session/stream/lsl_streams.hpp"
#include "workpiece/workpiece.hpp"

namespace burin::session {
namespace {

// Adds what the threads did; call it after they have ended.
void add_threads(SessionRecord& record, Session& session) {
    const haptics::HapticLoop& loop = session.loop();
    record.carve_update = summarised(session.scene_side().news().carving_duration());
    if (const compute::CarvingEngine* const engine = session.scene_side().engine()) {
        record.engine = engine->name();
        record.engine_traffic = engine->traffic();
        record.updates = session.scene_side().workpiece()->work().updates;
        record.rays_changed = session.scene_side().workpiece()->work().rays_changed;
    }
    record.machine_pace = session.hands().pace();
    record.lost_targets = session.hands().lost_targets();
    record.ticks = loop.ticks();
    record.late_ticks = loop.late_ticks();
    record.missed_deadlines = loop.skipped_deadlines();
    record.tick_lateness = summarised(loop.lateness());
    record.tick_duration = summarised(loop.duration());
}

// Begins the recording that the options ask for.
Result<void> begin_recording(InputSource& input, const SessionSetup& options, const SessionFacts& facts,
                             Session& session, SessionStreams* streams) {
    if (input.records()) return {};
    if (options.record.path.empty()) {
        if (streams != nullptr) streams->read_rings();
        return {};
    }
    BURIN_TRY(writer,
              create_recording(options, facts, session, streams != nullptr ? streams->taker() : record::OnRecord()));
    input.record_to(std::move(writer));
    return {};
}

// Completes the options by what the display says: the size of letters, and that of the window, which follows it.
SessionSetup as_displayed(SessionSetup options, const SessionWall& wall, Presenter& presenter) {
    if (!options.desk.panel_scale) options.desk.panel_scale = presenter.display_scale();
    presenter.look();
    const ImageSize size = presenter.place().size;
    if (!wall.desk || !presenter.has_windows() || is_empty(size)) return options;
    options.desk.width = std::clamp(static_cast<int>(size.width), kPictureBounds.least, kPictureBounds.most);
    options.desk.height = std::clamp(static_cast<int>(size.height), kPictureBounds.least, kPictureBounds.most);
    return options;
}

// Makes the workpiece while the window shows it; nothing where its user has ended that.
Result<std::unique_ptr<workpiece::Workpiece>> open_workpiece(Presenter& presenter, const SessionSetup& options,
                                                             const SessionWall& wall) {
    presenter.name_windows(std::filesystem::path(options.carve.workpiece.source).filename().string());
    auto made = open_before_eyes(presenter, options, wall, [&options](OpeningSight& sight) {
        return make_in_sight(options.carve, options.threads, sight);
    });
    if (made && !*made && !options.record.path.empty())
        std::fprintf(stderr, "burin: ended while it was opened: %s was not begun\n", options.record.path.c_str());
    return made;
}

// Says what a session file holds now.
void tell_of(const SessionRecording& recording) {
    const SessionRecording::Progress done = recording.progress();
    std::printf("%s: %s ticks recorded, acknowledged up to tick %s, %s lost\n", recording.path().c_str(),
                std::to_string(done.recorded).c_str(), std::to_string(done.acknowledged).c_str(),
                std::to_string(done.lost).c_str());
}

// A session in real time but for its frames, which are made for it and run with it.
struct RealTimeSession {
    std::unique_ptr<Desk> desk;
    std::unique_ptr<SessionStreams> streams;    // null: there are none
    InputSource input;                          // its recording reads the session's rings: it goes before them
    std::unique_ptr<devices::Tracker> tracker;  // null: there is none
    std::string tracker_name;
};
using Wake = std::function<void()>;  // ends a wait of the frames' thread; any thread

// made: the workpiece, where it is ready already.
Result<RealTimeSession> open_in_real_time(const SessionSetup& options, const SessionWall& wall, Clock& clock,
                                          InputSource input, const RealTimeRun& run, const Wake& wake,
                                          std::unique_ptr<workpiece::Workpiece> made = {}) {
    const double machine_pace = run.machine_pace ? *run.machine_pace : measured_pace();
    BURIN_TRY(opened, Desk::create(options, wall, clock, machine_pace, std::move(made)));
    RealTimeSession whole{
        .desk = std::move(opened), .streams = {}, .input = std::move(input), .tracker = {}, .tracker_name = {}};
    BURIN_TRY(streams, SessionStreams::open(options.record, whole.desk->session(), clock));
    whole.streams = std::move(streams);
    BURIN_TRY_DO(begin_recording(whole.input, options, run.facts, whole.desk->session(), whole.streams.get()));
    if (run.keep_frames) whole.desk->times().keep_frames();
    BURIN_TRY(heard, session_tracker(options, wall.setup));
    whole.tracker_name = heard.where;
    if (heard.where.empty()) return whole;
    BURIN_TRY(port, open_tracker(heard, wall.setup, {clock, wake, parse_tracker_line}));
    whole.tracker = std::move(port);
    return whole;
}

// Runs it to its end. recording: null where there is none.
Result<SessionRecord> run_to_its_end(RealTimeSession& whole, RealTimeFrames& frames, const FrameOutput& output,
                                     Clock& clock, bool streams_all, haptics::LoopPace asked, const Wake& wake,
                                     const std::shared_ptr<SessionRecording>& recording) {
    Session& session = whole.desk->session();
    if (whole.streams) frames.stream_to(&whole.streams->lsl());
    // A stream of a thousand samples a second has them also while nothing moves.
    const bool needs_all_ticks = session.activity().is_there() || streams_all;
    const haptics::LoopPace pace = pace_of(asked, session.hands().felt_by_person(), needs_all_ticks);
    ThreadedExecutor threads(clock, session.loop(), session.channels_of_parts(), session.scene(), pace,
                             [&session, &wake](const auto& ended) {
                                 if (session.collect(ended) || ended.failed) wake();
                             });
    const haptics::RealtimeNotice notice = threads.start();
    // A tick that comes late disturbs a hand that feels it; who carves with a mouse reads it in the terminal alone.
    if (!notice.text.empty() && session.hands().felt_by_person()) session.notify_of_event(notice.text);
    if (!notice.text.empty() && !session.hands().felt_by_person())
        std::fprintf(stderr, "burin: %s\n", notice.text.c_str());
    frames.begin();
    const Result<void> driven = drive(threads, frames);
    const Result<void> ended = frames.finish(threads);  // also after an error: it completes the recording
    if (recording) tell_of(*recording);
    if (whole.streams) std::printf("streams: %s\n", whole.streams->finish().text().c_str());
    if (output.has_lost_display())
        return fail("the display", "is gone, and so is the session's window", "what was done up to then is kept");
    if (!driven) return std::unexpected(driven.error());
    if (!ended) return std::unexpected(ended.error());
    SessionRecord record = frames.record();
    add_threads(record, session);
    if (record.lost_targets > 0) {
        session.notify_of_event(std::to_string(record.lost_targets) +
                                " places of the hand were lost: its ticks stood still for too long");
    }
    BURIN_TRY_DO(session.files().outcome());
    return record;
}

// Runs a session that nobody sees, whose pictures, if any are asked for after all, are files.
Result<SessionRecord> run_unseen(const SessionSetup& options, const SessionWall& wall, InputSource input,
                                 const RealTimeRun& run) {
    MonotonicClock clock;
    OffscreenOutput output(options.desk, wall);
    const Wake wake = [] {};  // its frames come by themselves
    BURIN_TRY(whole, open_in_real_time(carving_with(output, options), wall, clock, std::move(input), run, wake));
    if (!run.needs.panel) whole.desk->leave_panel_out();
    const std::shared_ptr<SessionRecording> recording = whole.input.recording();
    UnseenFrames frames(*whole.desk, output, std::move(whole.input), clock, whole.tracker.get(), whole.tracker_name);
    return run_to_its_end(whole, frames, output, clock, options.record.lsl, run.pace, wake, recording);
}

}  // namespace

haptics::LoopPace pace_of(haptics::LoopPace asked, bool felt_by_person, bool has_activity) {
    asked.rests = asked.rests && !has_activity && !felt_by_person;
    return asked;
}

Result<SessionRecord> run_in_real_time(const SessionSetup& given, const SessionWall& wall, InputSource input,
                                       RealTimeRun run) {
    if (given.desk.offscreen && !run.keep_frames && !run.needs.pictures)
        return run_unseen(given, wall, std::move(input), run);
    MonotonicClock clock;
    BURIN_TRY(presenter, Presenter::open(given.desk, wall, std::move(run.driver)));
    const SessionSetup options = carving_with(presenter, as_displayed(given, wall, presenter));
    const Wake wake = [&to = presenter] { to.wake(); };
    std::unique_ptr<workpiece::Workpiece> made;
    // A document is there at once: nothing has to be read, checked and converted.
    const bool takes_long = has_workpiece(options) && !is_document(options.carve.workpiece);
    if (run.opens_before_eyes && wall.desk && presenter.has_windows() && takes_long) {
        BURIN_TRY(opening, open_workpiece(presenter, options, wall));
        if (!opening) return SessionRecord{};
        made = std::move(opening);
    }
    BURIN_TRY(whole, open_in_real_time(options, wall, clock, std::move(input), run, wake, std::move(made)));
    presenter.name_windows(whole.desk->session().found().name);
    if (options.desk.first_steps) remember_first_time();
    const std::shared_ptr<SessionRecording> recording = whole.input.recording();
    if (options.desk.detail == DetailChoice::automatic) presenter.draw_less_in_motion();
    LiveFrames frames(*whole.desk, presenter, std::move(whole.input), clock, whole.tracker.get(), whole.tracker_name);
    auto record = run_to_its_end(whole, frames, presenter, clock, options.record.lsl, run.pace, wake, recording);
    if (!record) return record;
    record->device = presenter.device_name();
    const gpu::WorkAsked drawn = presenter.device().asked();
    record->picture_traffic = {drawn.submissions,   drawn.blocking_waits,    drawn.bytes_to_device,
                               drawn.bytes_to_host, drawn.most_memory_bytes, drawn.bytes_written_to_host};
    return record;
}

}  // namespace burin::session
