// SPDX-License-Identifier: MIT
#include "app/session/real_time_session.hpp"

#include <algorithm>
#include <utility>

#include "app/session/carving_thread.hpp"
#include "app/session/display_watch.hpp"
#include "app/session/end_signals.hpp"
#include "app/session/live_session.hpp"
#include "app/session/session_stage.hpp"
#include "app/session/thread_recorder.hpp"
#include "app/session/tracker_port.hpp"
#include "haptics/realtime.hpp"

namespace burin {
namespace {

constexpr Nanoseconds kRest_ns = 1'000'000'000;     // between looks at what may have changed, when nothing happens
constexpr Nanoseconds kActive_ns = 300'000'000;     // after the last change frames follow the display's beat
constexpr Nanoseconds kSettled_ns = 3'000'000'000;  // then all threads rest, and levels of detail are worked out

// What has happened when the time has come, or something happens before.
std::vector<Input> wait_for_input(SessionStage& stage, Clock& clock, Nanoseconds until_ns) {
    if (stage.shows()) return stage.inputs(std::max(seconds(until_ns - clock.now_ns()), 0.0));
    clock.sleep_until(until_ns);
    return {};
}

// When a frame is drawn, and what has happened by then.
struct Turn {
    FramePlan plan;
    std::vector<Input> happened;
};

// While things happen: as late as the display allows. The display is watched meanwhile.
Turn next_on_the_beat(SessionStage& stage, Clock& clock, DisplayWatch& display) {
    Turn turn{display.plan(clock.now_ns()), {}};
    const Nanoseconds until_ns = turn.plan.wake_ns;
    do {
        const Nanoseconds look_ns = display.next_look_ns().value_or(until_ns);
        for (Input& input : wait_for_input(stage, clock, std::min(until_ns, look_ns)))
            turn.happened.push_back(std::move(input));
        display.look(stage, clock.now_ns());
    } while (clock.now_ns() < until_ns);
    return turn;
}

// While nothing happens: at once when something does.
Turn next_at_rest(SessionStage& stage, Clock& clock, DisplayWatch& display, Nanoseconds until_ns) {
    Turn turn{{}, wait_for_input(stage, clock, until_ns)};
    turn.plan = display.plan(clock.now_ns());
    turn.plan.wake_ns = clock.now_ns();
    return turn;
}

void hear(TrackerPort& tracker, InputSource& input, LiveSession& session) {
    for (TrackerPort::Heard& heard : tracker.take())
        input.push(heard.time_ns - session.start_ns(), std::move(heard.input));
    for (const std::string& message : tracker.take_messages()) session.hear(message);
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

}  // namespace

Result<SessionRecord> run_in_real_time(const SculptOptions& options, const SessionWall& wall, InputSource input,
                                       RealTimeRun run) {
    MonotonicClock clock;
    Result<SessionStage> stage = SessionStage::open(options.live, wall, std::move(run.driver));
    if (!stage) return std::unexpected(stage.error());
    auto session = LiveSession::create(options, wall, clock);
    if (!session) return std::unexpected(session.error());
    LiveSession& s = **session;
    if (auto news = s.desk().take_news()) s.take(std::move(*news));
    ThreadRecorder recorder(input, s);
    CarvingThread carving(s.desk(), clock, [&to = *stage] { to.wake(); });
    HapticThread touch(s.loop(), run.pace);
    const RealtimeNotice notice = touch.start();
    if (!notice.text.empty()) s.hear(notice.text);
    carving.start();

    std::unique_ptr<TrackerPort> tracker;
    if (!options.live.tracker.empty()) {
        auto opened = TrackerPort::open(options.live.tracker, clock, [&to = *stage] { to.wake(); });
        if (!opened) return std::unexpected(opened.error());
        tracker = std::move(*opened);
    }

    DisplayWatch display(stage->refresh_Hz());
    SessionTimes& times = s.times();
    if (run.keep_frames) times.keep_frames();
    const Nanoseconds began_ns = clock.now_ns(), processor_ns = process_cpu_ns();
    Nanoseconds changed_ns = began_ns, rested_ns = 0, rested_processor_ns = 0;
    Result<void> outcome;
    const EndSignals end;
    while (outcome && !s.state().quit && !end.came()) {
        times.begin();
        const Nanoseconds turn_ns = clock.now_ns(), turn_processor_ns = process_cpu_ns();
        const bool active = stage->takes_turns(s) || clock.now_ns() - changed_ns < kActive_ns;
        stage->refine_beside(!active);
        display.shown_at(stage->refresh_Hz());
        Nanoseconds due_ns = clock.now_ns() + kRest_ns;
        if (const auto event_ns = input.next_event_ns()) due_ns = std::min(due_ns, s.start_ns() + *event_ns);
        Turn turn = active ? next_on_the_beat(*stage, clock, display) : next_at_rest(*stage, clock, display, due_ns);
        times.reached(FrameStage::wait);
        if (tracker) hear(*tracker, input, s);  // first: it happened before
        for (Input& event : turn.happened) input.push(clock.now_ns() - s.start_ns(), std::move(event));
        recorder.outside();
        const auto frame = input.begin_frame(clock.now_ns() - s.start_ns(), turn.plan.display_ns - s.start_ns());
        if (!frame) break;
        times.reached(FrameStage::input);
        stage->look();
        const ToolState tool = s.newest_tool();
        s.step(*frame, stage->place(), tool, [&](CarvingOrder order) { carving.order(std::move(order)); });
        CarvingThread::Taken carved = carving.take_news();
        if (carved.news) s.take(std::move(*carved.news));
        if (const auto failed = carving.failure()) outcome = std::unexpected(*failed);
        recorder.frame(tool.tick, carved.updates, stage->places());
        if (stage->shows() && s.wants_full_screen_exchanged()) stage->exchange_full_screen();
        for (const std::string& message : stage->take_messages()) s.hear(message);
        times.reached(FrameStage::step);
        const Result<bool> drawn = stage->draw(s, frame->display_ns);
        if (!drawn) outcome = stage->recover(s, drawn.error());
        if (drawn && *drawn) {
            changed_ns = clock.now_ns();
            display.finished(*stage, turn.plan, s.start_ns() + frame->time_ns, changed_ns);
        }
        static_cast<void>(stage->take_blocked());  // of a turn without a new picture
        times.finished(drawn && *drawn, display.beat(s));
        if (turn_ns - changed_ns < kSettled_ns || !drawn || *drawn) continue;
        rested_ns += clock.now_ns() - turn_ns;
        rested_processor_ns += process_cpu_ns() - turn_processor_ns;
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
    record.rested_ns = rested_ns;
    record.rested_processor_ns = rested_processor_ns;
    record.device = stage->device_name();
    return record;
}

}  // namespace burin
