// SPDX-License-Identifier: MIT
#include "app/session/session.hpp"

#include <algorithm>
#include <cstdio>

#include "app/session/carving_thread.hpp"
#include "app/session/frame_pacing.hpp"
#include "app/session/live_session.hpp"
#include "app/session/recorded_session.hpp"
#include "app/session/session_settings.hpp"
#include "app/session/session_stage.hpp"
#include "app/session/shown_frames.hpp"
#include "app/session/thread_recorder.hpp"
#include "app/session/tracker_port.hpp"
#include "haptics/realtime.hpp"

namespace burin {
namespace {

constexpr Nanoseconds kUpdatePeriod_ns = CarvingThread::kPeriod_ns;
constexpr Nanoseconds kRest_ns = 100'000'000;    // between looks at what may have changed, when nothing happens
constexpr Nanoseconds kActive_ns = 300'000'000;  // after the last change frames follow the display's beat

Result<InputLog> open_log(const std::string& path) {
    Result<InputLog> log = read_input_log(path);
    if (log && log->torn_line) std::fprintf(stderr, "burin: %s\n", log->torn_line->c_str());
    return log;
}

// Of a user, or of a log in their place; recorded if that is asked for.
Result<InputSource> open_input(const SculptOptions& options, std::optional<InputLog> log) {
    std::optional<InputLogWriter> recorder;
    if (!options.live.record.empty()) {
        Result<InputLogWriter> writer = InputLogWriter::create(options.live.record, settings_line(options));
        if (!writer) return std::unexpected(writer.error());
        recorder = std::move(*writer);
    }
    return log ? InputSource::play(std::move(*log), std::move(recorder)) : InputSource::live(std::move(recorder));
}

// ---- Simulated time

Result<void> run_in_simulated_time(const SculptOptions& options, const SessionWall& wall, InputSource input) {
    SimulatedClock clock;
    auto session = LiveSession::create(options, wall, clock);
    if (!session) return std::unexpected(session.error());
    Result<SessionStage> stage = SessionStage::open(options.live, wall);
    if (!stage) return std::unexpected(stage.error());
    LiveSession& s = **session;
    if (auto news = s.desk().take_news()) s.take(std::move(*news));
    Nanoseconds next_update_ns = kUpdatePeriod_ns;
    while (const auto frame = input.begin_frame(0, 0)) {
        while (clock.now_ns() + s.loop().period_ns() <= frame->time_ns) {
            clock.sleep_until(clock.now_ns() + s.loop().period_ns());
            s.loop().step();
            if (clock.now_ns() < next_update_ns) continue;
            if (const auto updated = s.desk().update(clock.now_ns()); !updated) return updated;
            next_update_ns += kUpdatePeriod_ns;
        }
        stage->look();
        s.step(*frame, stage->place(), s.newest_tool(), [&](CarvingOrder order) {
            s.desk().order(order);
            s.desk().finish_export();  // so that what comes after finds it done
        });
        if (auto news = s.desk().take_news()) s.take(std::move(*news));
        if (stage->has_windows()) static_cast<void>(stage->inputs(0.0));  // the script has the say
        // Without a window nobody sees a frame that is not photographed.
        if (stage->has_windows() || s.wants_screenshots()) {
            if (const auto drawn = stage->draw(s, frame->display_ns); !drawn) return std::unexpected(drawn.error());
        }
        if (s.state().quit) break;
    }
    return {};
}

// ---- Real time

// What the display tells of the frames that it was handed, to the pacing.
struct DisplayWatch {
    ShownFrames frames;
    PacingState pacing;

    FramePlan plan(Nanoseconds now_ns) {
        const PlannedFrame planned = plan_frame(pacing, now_ns);
        pacing = planned.state;
        return planned.plan;
    }
    void look(const SessionStage& stage, Nanoseconds now_ns) {
        const auto was_shown = [&](std::uint64_t picture) { return stage.was_shown(picture); };
        for (const FrameMeasure& measure : frames.look(now_ns, was_shown)) pacing = after_frame(pacing, measure);
    }
    void finished(SessionStage& stage, const FramePlan& plan, Nanoseconds sampled_ns, Nanoseconds now_ns) {
        const SessionWindow::Blocked blocked = stage.take_blocked();
        FrameMeasure measure;
        measure.plan = plan;
        measure.sampled_ns = sampled_ns;
        measure.finished_ns = measure.submitted_ns = now_ns - blocked.for_ns;  // waiting is no work
        measure.blocked_ns = blocked.for_ns;
        measure.flip_ns = blocked.until_ns;
        pacing = frame_finished(pacing, plan, now_ns);
        frames.handed(measure, stage.presented(), now_ns);
        look(stage, now_ns);
    }
    // To another monitor, perhaps.
    void shown_at(double refresh_Hz) {
        const Nanoseconds period_ns = nanoseconds(1.0 / refresh_Hz);
        if (period_ns != pacing.settings.period_ns) pacing = display_changed(pacing, period_ns);
    }
};

// What has happened when the time has come, or something happens before.
std::vector<Input> wait_for_input(SessionStage& stage, Clock& clock, Nanoseconds until_ns) {
    if (stage.has_windows()) return stage.inputs(std::max(seconds(until_ns - clock.now_ns()), 0.0));
    clock.sleep_until(until_ns);
    return {};
}

// All that happens until the frame's time, which is as late as it can be; the display is watched meanwhile.
std::vector<Input> gather_input(SessionStage& stage, Clock& clock, Nanoseconds until_ns, DisplayWatch& display) {
    std::vector<Input> gathered;
    do {
        const Nanoseconds look_ns = display.frames.next_look_ns().value_or(until_ns);
        for (Input& input : wait_for_input(stage, clock, std::min(until_ns, look_ns)))
            gathered.push_back(std::move(input));
        display.look(stage, clock.now_ns());
    } while (clock.now_ns() < until_ns);
    return gathered;
}

void hear(TrackerPort& tracker, InputSource& input, LiveSession& session) {
    for (TrackerPort::Heard& heard : tracker.take())
        input.push(heard.time_ns - session.start_ns(), std::move(heard.input));
    for (const std::string& message : tracker.take_messages()) session.hear(message);
}

DisplayBeat beat_of(const PacingState& pacing, const LiveSession& session) {
    DisplayBeat beat;
    const SessionWall& wall = session.room().wall;
    const EyeTimes eyes = eye_times(timing_in(wall.setup, session.output_on(wall.main).mode), 0);
    beat.right_eye_later_ns = eyes.right_ns - eyes.left_ns;
    beat.period_ns = static_cast<Nanoseconds>(pacing.period_ns);
    if (pacing.flips_seen) beat.vblank_ns = pacing.vblank_ns;
    return beat;
}

// After the threads have ended.
SessionRecord record_of(LiveSession& session, const CarvingThread& carving) {
    SessionRecord record;
    record.frames = session.times().frames();
    record.skipped = session.times().skipped();
    record.carve_update = summarised(carving.update_duration());
    const HapticLoop& loop = session.loop();
    record.ticks = loop.ticks();
    record.late_ticks = loop.late_ticks();
    record.missed_deadlines = loop.skipped_deadlines();
    record.tick_lateness = summarised(loop.lateness());
    record.tick_duration = summarised(loop.duration());
    for (const FrameWarning& warning : session.times().warnings()) record.warnings.push_back(warning.line);
    return record;
}

Result<SessionRecord> run_in_real_time(const SculptOptions& options, const SessionWall& wall, InputSource input,
                                       bool keep_frames) {
    MonotonicClock clock;
    Result<SessionStage> stage = SessionStage::open(options.live, wall);
    if (!stage) return std::unexpected(stage.error());
    auto session = LiveSession::create(options, wall, clock);
    if (!session) return std::unexpected(session.error());
    LiveSession& s = **session;
    if (auto news = s.desk().take_news()) s.take(std::move(*news));
    ThreadRecorder recorder(input, s);
    CarvingThread carving(s.desk(), clock, [shown = stage->has_windows()] {
        if (shown) window::wake();
    });
    // The hand is simulated: nobody feels it. What is measured is what a device's user would.
    HapticThread touch(s.loop(), keep_frames ? HapticLoop::kLead_ns : 0);
    const RealtimeNotice notice = touch.start();
    if (!notice.text.empty()) s.hear(notice.text);
    carving.start();

    std::unique_ptr<TrackerPort> tracker;
    if (!options.live.tracker.empty()) {
        auto opened = TrackerPort::open(options.live.tracker, clock, [shown = stage->has_windows()] {
            if (shown) window::wake();
        });
        if (!opened) return std::unexpected(opened.error());
        tracker = std::move(*opened);
    }

    DisplayWatch display{.frames = {}, .pacing = begin_pacing({.period_ns = nanoseconds(1.0 / stage->refresh_Hz())})};
    SessionTimes& times = s.times();
    if (keep_frames) times.keep_frames();
    const Nanoseconds began_ns = clock.now_ns(), processor_ns = process_cpu_ns();
    Nanoseconds changed_ns = began_ns;
    Result<void> outcome;
    while (outcome && !s.state().quit) {
        times.begin();
        const bool active = stage->takes_turns(s) || clock.now_ns() - changed_ns < kActive_ns;
        stage->refine_beside(!active);
        display.shown_at(stage->refresh_Hz());
        FramePlan plan;
        std::vector<Input> happened;
        if (active) {
            plan = display.plan(clock.now_ns());
            happened = gather_input(*stage, clock, plan.wake_ns, display);
        } else {
            Nanoseconds until_ns = clock.now_ns() + kRest_ns;
            if (const auto due_ns = input.next_event_ns()) until_ns = std::min(until_ns, s.start_ns() + *due_ns);
            happened = wait_for_input(*stage, clock, until_ns);
            plan = display.plan(clock.now_ns());
            plan.wake_ns = clock.now_ns();  // it begins at once
        }
        times.reached(FrameStage::wait);
        if (tracker) hear(*tracker, input, s);  // first: it happened before
        for (Input& event : happened) input.push(clock.now_ns() - s.start_ns(), std::move(event));
        recorder.outside();
        const auto frame = input.begin_frame(clock.now_ns() - s.start_ns(), plan.display_ns - s.start_ns());
        if (!frame) break;
        times.reached(FrameStage::input);
        stage->look();
        const ToolState tool = s.newest_tool();
        s.step(*frame, stage->place(), tool, [&](CarvingOrder order) { carving.order(std::move(order)); });
        CarvingThread::Taken carved = carving.take_news();
        if (carved.news) s.take(std::move(*carved.news));
        if (const auto failed = carving.failure()) outcome = std::unexpected(*failed);
        recorder.frame(tool.tick, carved.updates, stage->places());
        if (stage->has_windows() && s.wants_full_screen_exchanged()) stage->exchange_full_screen();
        for (const std::string& message : stage->take_messages()) s.hear(message);
        times.reached(FrameStage::step);
        const Result<bool> drawn = stage->draw(s, frame->display_ns);
        if (!drawn) outcome = stage->recover(s, drawn.error());
        if (drawn && *drawn) {
            changed_ns = clock.now_ns();
            display.finished(*stage, plan, s.start_ns() + frame->time_ns, changed_ns);
        }
        static_cast<void>(stage->take_blocked());  // of a turn without a new picture
        times.finished(drawn && *drawn, beat_of(display.pacing, s));
    }
    const Nanoseconds wall_ns = clock.now_ns() - began_ns, worked_ns = process_cpu_ns() - processor_ns;
    touch.stop();
    carving.stop();
    s.desk().finish_export();
    CarvingThread::Taken last = carving.take_news();
    recorder.finish(last.updates);
    add(last.news, s.desk().take_news());
    if (last.news)
        for (const std::string& message : last.news->messages) s.say(message);
    if (!outcome) return std::unexpected(outcome.error());
    SessionRecord record = record_of(s, carving);
    record.wall_ns = wall_ns;
    record.processor_ns = worked_ns;
    record.device = stage->device_name();
    return record;
}

// What is wrong with the options is said before a window opens.
Result<void> check(const SculptOptions& options) {
    if (const auto tool = parse_tool(options.tool); !tool) return std::unexpected(tool.error());
    if (const auto material = parse_tool_material(options.tool); !material) return std::unexpected(material.error());
    if (const auto feel = parse_feel(options.feel); !feel) return std::unexpected(feel.error());
    return {};
}

// What decides on its frames is the recording's.
Result<void> run_as_recorded(const SculptOptions& given, InputLog log) {
    const Result<RecordedOptions> recorded = options_as_recorded(log.settings, given);
    if (!recorded) return std::unexpected(recorded.error());
    for (const std::string& message : recorded->overruled) std::fprintf(stderr, "burin: %s\n", message.c_str());
    if (const auto ok = check(recorded->options); !ok) return ok;
    const Result<SessionWall> wall = session_wall(recorded->options.live);
    if (!wall) return std::unexpected(wall.error());
    return replay_as_recorded(recorded->options, *wall, std::move(log));
}

bool writes_a_file(const InputEvent& event) {
    const auto* command = std::get_if<CommandInput>(&event.input);
    return command != nullptr && (command->name == "screenshot" || command->name == "export");
}

}  // namespace

bool wants_session(const SculptOptions& options) {
    const LiveOptions& live = options.live;
    const bool named = live.live || live.offscreen || !live.wall.empty() || !live.input.empty() || !live.record.empty();
    return named ||
           (options.stroke.empty() && options.exports.empty() && options.pictures.empty() && options.report.empty());
}

Result<void> run_session(const SculptOptions& options) {
    if (options.live.offscreen && options.live.input.empty()) {
        return fail("--offscreen", "needs an --input: without a window nobody can do anything",
                    "give a log or a script, or leave --offscreen out");
    }
    std::optional<InputLog> log;
    if (!options.live.input.empty()) {
        Result<InputLog> read = open_log(options.live.input);
        if (!read) return std::unexpected(read.error());
        if (read->threads && options.live.record.empty()) return run_as_recorded(options, std::move(*read));
        log = std::move(*read);
    }
    if (const auto ok = check(options); !ok) return ok;
    const Result<SessionWall> wall = session_wall(options.live);
    if (!wall) return std::unexpected(wall.error());
    if (log && options.live.record.empty())
        return run_in_simulated_time(options, *wall, InputSource::replay(std::move(*log)));
    Result<InputSource> input = open_input(options, std::move(log));
    if (!input) return std::unexpected(input.error());
    const auto run = run_in_real_time(options, *wall, std::move(*input), false);
    return run ? Result<void>{} : std::unexpected(run.error());
}

Result<SessionRecord> time_session(const SculptOptions& options) {
    if (const auto ok = check(options); !ok) return std::unexpected(ok.error());
    const Result<SessionWall> wall = session_wall(options.live);
    if (!wall) return std::unexpected(wall.error());
    Result<InputLog> log = open_log(options.live.input);
    if (!log) return std::unexpected(log.error());
    std::erase_if(log->events, writes_a_file);
    return run_in_real_time(options, *wall, InputSource::play(std::move(*log)), true);
}

}  // namespace burin
