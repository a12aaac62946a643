// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <utility>

#include "desk/input/event_times.hpp"
#include "desk/opening/first_time.hpp"
#include "desk/opening/opening.hpp"
#include "desk/present/display_watch.hpp"
#include "desk/present/presenter.hpp"
#include "desk/run/session.hpp"
#include "desk/run/session_frames.hpp"
#include "desk/view/session_tracker.hpp"
#include "devices/trackers/tracker.hpp"
#include "session/drive/end_signals.hpp"
#include "session/drive/recording_start.hpp"
#include "session/drive/session_streams.hpp"
#include "session/hands/machine_pace.hpp"
#include "session/input/input_line.hpp"
#include "session/live/opened_room.hpp"
#include "session/notices/session_watch.hpp"
#include "session/options/option_bounds.hpp"

namespace burin::session {
namespace {

// Between two looks at what the disk has got, while nothing else happens.
constexpr Nanoseconds kLooksForDisk_ns = 50'000'000;
// Longest sleep while nothing happens.
constexpr Nanoseconds kRest_ns = 1'000'000'000;
// Time after the last change for which frames follow the display's refresh.
constexpr Nanoseconds kActive_ns = 300'000'000;
// Time after the last change until the session counts as resting.
constexpr Nanoseconds kSettled_ns = 3'000'000'000;

// ---- Frames

// Makes a frame when the display wants the next one, or, at rest, when something happens.
class LiveFrames final : public SessionFrames {
public:
    // tracker: null where there is none. All must outlive it.
    LiveFrames(LiveSession& session, Presenter& presenter, InputSource input, Clock& clock, devices::Tracker* tracker,
               const std::string& tracker_name)
        : SessionFrames(session, presenter, std::move(input)),
          presenter_(presenter),
          clock_(clock),
          tracker_(tracker),
          first_word_(tracker_name),
          display_(presenter.refresh_Hz()) {}

    // Begins to measure; call it right before drive(). The first frames follow the display.
    void begin() {
        began_ = now();
        changed_ns_ = began_.time_ns;
    }
    // Summarises the frames.
    [[nodiscard]] SessionRecord record() const;

private:
    [[nodiscard]] std::optional<FrameInput> next_input() override;
    void stepped() override;
    [[nodiscard]] bool wants_picture() override { return true; }
    void finished(const FrameInput& frame, bool anew) override;

    [[nodiscard]] std::vector<InputEvent> wait_for_frame();
    [[nodiscard]] std::vector<InputEvent> wait_for_refresh();
    [[nodiscard]] std::vector<InputEvent> wait_for_input(Nanoseconds until_ns);
    [[nodiscard]] std::vector<InputEvent> take_tracker_input();

    // Time on the clock, and processor time of all threads.
    struct Moment {
        Nanoseconds time_ns = 0, processor_ns = 0;
    };
    [[nodiscard]] Moment now() const { return {clock_.now_ns(), process_cpu_ns()}; }

    Presenter& presenter_;
    Clock& clock_;
    devices::Tracker* tracker_;
    FirstWordWatch first_word_;
    DisplayWatch display_;
    EventTimes event_times_;
    FramePlan plan_;              // of the frame in progress
    Moment began_, turn_;         // when the session began, and when the wait for this frame did
    Moment lasted_;               // from the beginning to the end of the last frame
    Moment rested_;               // spent in turns without anything new, once the session had settled
    Nanoseconds changed_ns_ = 0;  // when something new was drawn last
    std::string named_;           // what the windows' titles say of the document
};

std::optional<FrameInput> LiveFrames::next_input() {
    if (end_.came()) {
        if (input_.next_event_ns()) static_cast<void>(look_for_signal());  // a script was not done
        return std::nullopt;
    }
    SessionTimes& times = session_.times();
    times.begin();
    turn_ = now();
    std::vector<InputEvent> happened = wait_for_frame();
    if (presenter_.has_lost_display()) return std::nullopt;
    times.reached(FrameStage::wait);
    for (InputEvent& event : in_order_of_time(std::move(happened), take_tracker_input()))
        input_.push(event.time_ns, std::move(event.input));
    for (std::string& command : session_.hands().take_commands())
        input_.push(clock_.now_ns() - session_.start_ns(), CommandInput{std::move(command), {}}, true);
    for (CommandInput& told : session_.take_told())
        input_.push(clock_.now_ns() - session_.start_ns(), std::move(told), true);
    recorder_.outside();
    const auto frame =
        input_.begin_frame(clock_.now_ns() - session_.start_ns(), plan_.display_ns - session_.start_ns());
    if (!frame) return std::nullopt;
    times.reached(FrameStage::input);
    presenter_.look();
    if (presenter_.has_lost_display()) return std::nullopt;  // its windows have no size any more
    return frame;
}

// Waits until it is time for the next frame, plans it, and returns what has happened in the windows.
std::vector<InputEvent> LiveFrames::wait_for_frame() {
    const bool active = presenter_.takes_turns(session_) || presenter_.owes_full_picture() ||
                        clock_.now_ns() - changed_ns_ < kActive_ns;
    presenter_.refine_beside(!active);
    display_.shown_at(presenter_.refresh_Hz());
    if (active) return wait_for_refresh();
    Nanoseconds until_ns = clock_.now_ns() + kRest_ns;
    if (const auto event_ns = input_.next_event_ns()) until_ns = std::min(until_ns, session_.start_ns() + *event_ns);
    if (session_.waits_for_the_disk()) until_ns = std::min(until_ns, clock_.now_ns() + kLooksForDisk_ns);
    if (const auto change_ns = session_.changes_ns()) until_ns = std::min(until_ns, session_.start_ns() + *change_ns);
    std::vector<InputEvent> happened = wait_for_input(until_ns);
    plan_ = display_.plan(clock_.now_ns());
    plan_.wake_ns = clock_.now_ns();
    return happened;
}

// Waits as late as the display allows. Polls the display meanwhile.
std::vector<InputEvent> LiveFrames::wait_for_refresh() {
    plan_ = display_.plan(clock_.now_ns());
    std::vector<InputEvent> happened;
    do {
        const Nanoseconds look_ns = display_.next_look_ns().value_or(plan_.wake_ns);
        for (InputEvent& event : wait_for_input(std::min(plan_.wake_ns, look_ns))) happened.push_back(std::move(event));
        display_.look(presenter_, clock_.now_ns());
    } while (clock_.now_ns() < plan_.wake_ns);
    return happened;
}

// Waits until the time has come or something happens; returns what has happened.
std::vector<InputEvent> LiveFrames::wait_for_input(Nanoseconds until_ns) {
    if (presenter_.shows()) {
        const Nanoseconds asked_ns = clock_.now_ns();
        std::vector<Input> told = presenter_.inputs(std::max(seconds(until_ns - asked_ns), 0.0));
        return event_times_.timed(std::move(told), asked_ns - session_.start_ns(),
                                  clock_.now_ns() - session_.start_ns());
    }
    clock_.sleep_until(until_ns);
    return {};
}

std::vector<InputEvent> LiveFrames::take_tracker_input() {
    std::vector<InputEvent> heard;
    if (tracker_ == nullptr) return heard;
    for (devices::TrackerSample& sample : tracker_->take())
        heard.push_back({sample.time_ns - session_.start_ns(), input_of(std::move(sample.input))});
    for (const std::string& message : tracker_->take_messages())
        session_.notify_of_event(message, MessageKind::warning);
    if (const auto silent = first_word_.look(!heard.empty(), clock_.now_ns()))
        session_.notify_of_event(*silent, MessageKind::warning);
    return heard;
}

void LiveFrames::stepped() {
    if (presenter_.shows() && session_.wants_full_screen_exchanged()) presenter_.exchange_full_screen();
    for (const std::string& message : presenter_.take_messages()) session_.notify_of_event(message);
    if (streams_ != nullptr)
        for (const std::string& message : streams_->take_messages()) session_.notify_of_event(message);
    if (const auto& told = session_.state().asked.told) {
        std::string name = short_name(*told) + " \u2014 " + state_text(*told);
        if (std::exchange(named_, name) != name) presenter_.name_windows(name);
    }
    session_.times().reached(FrameStage::step);
}

void LiveFrames::finished(const FrameInput& frame, bool anew) {
    if (anew) {
        changed_ns_ = clock_.now_ns();
        display_.finished(presenter_, plan_, session_.start_ns() + frame.time_ns, changed_ns_);
    }
    static_cast<void>(presenter_.take_blocked());  // blocked time of a turn without a new picture
    session_.times().finished(anew, display_.beat(session_));
    const Moment end = now();
    lasted_ = {end.time_ns - began_.time_ns, end.processor_ns - began_.processor_ns};
    if (anew || turn_.time_ns - changed_ns_ < kSettled_ns) return;
    rested_.time_ns += end.time_ns - turn_.time_ns;
    rested_.processor_ns += end.processor_ns - turn_.processor_ns;
}

SessionRecord LiveFrames::record() const {
    SessionRecord record;
    record.frames = session_.times().frames();
    record.skipped = session_.times().skipped();
    record.wall_ns = lasted_.time_ns;
    record.processor_ns = lasted_.processor_ns;
    record.rested_ns = rested_.time_ns;
    record.rested_processor_ns = rested_.processor_ns;
    for (const FrameWarning& warning : session_.times().warnings()) record.warnings.push_back(warning.line);
    record.device = presenter_.device_name();
    return record;
}

// Adds what the threads did; call it after they have ended.
void add_threads(SessionRecord& record, LiveSession& session) {
    const haptics::HapticLoop& loop = session.loop();
    record.carve_update = summarised(session.carving_duration());
    if (const compute::CarvingEngine* const engine = session.engine()) {
        record.engine = engine->name();
        record.engine_traffic = engine->traffic();
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
Result<void> begin_recording(InputSource& input, const SculptOptions& options, const SessionFacts& facts,
                             LiveSession& session, SessionStreams* streams) {
    if (input.records()) return {};
    if (options.live.record.empty()) {
        if (streams != nullptr) streams->read_rings();
        return {};
    }
    Result<InputLogWriter> writer =
        create_recording(options, facts, session, streams != nullptr ? streams->taker() : record::OnRecord());
    if (!writer) return std::unexpected(writer.error());
    input.record_to(std::move(*writer));
    return {};
}

// Completes the options by what the display says: the size of letters, and that of the window, which follows it.
SculptOptions as_displayed(SculptOptions options, const SessionWall& wall, Presenter& presenter) {
    if (!options.live.panel_scale) options.live.panel_scale = presenter.display_scale();
    presenter.look();
    const ImageSize size = presenter.place().size;
    if (!wall.desk || !presenter.has_windows() || is_empty(size)) return options;
    options.live.width = std::clamp(static_cast<int>(size.width), kPictureBounds.least, kPictureBounds.most);
    options.live.height = std::clamp(static_cast<int>(size.height), kPictureBounds.least, kPictureBounds.most);
    return options;
}

// Makes the workpiece while the window shows it; nothing where its user has ended that.
Result<std::optional<sculpt::MadeWorkpiece>> open_workpiece(Presenter& presenter, const SculptOptions& options,
                                                            const SessionWall& wall) {
    presenter.name_windows(std::filesystem::path(options.workpiece.source).filename().string());
    auto made = open_before_eyes(presenter, options, wall, [&options](OpeningSight& sight) {
        return make_in_sight(options.workpiece, options.engine, options.threads, sight);
    });
    if (made && !*made && !options.live.record.empty())
        std::fprintf(stderr, "burin: ended while it was opened: %s was not begun\n", options.live.record.c_str());
    return made;
}

// Says what a session file holds now.
void tell_of(const SessionRecording& recording) {
    const SessionRecording::Progress done = recording.progress();
    std::printf("%s: %s ticks recorded, acknowledged up to tick %s, %s lost\n", recording.path().c_str(),
                std::to_string(done.recorded).c_str(), std::to_string(done.acknowledged).c_str(),
                std::to_string(done.lost).c_str());
}

}  // namespace

haptics::LoopPace pace_of(haptics::LoopPace asked, bool felt_by_person, bool has_activity) {
    asked.rests = asked.rests && !has_activity && !felt_by_person;
    return asked;
}

Result<SessionRecord> run_in_real_time(const SculptOptions& given, const SessionWall& wall, InputSource input,
                                       RealTimeRun run) {
    MonotonicClock clock;
    Result<Presenter> presenter = Presenter::open(given.live, wall, std::move(run.driver));
    if (!presenter) return std::unexpected(presenter.error());
    const SculptOptions options = as_displayed(given, wall, *presenter);
    const auto wake = [&to = *presenter] { to.wake(); };
    const double machine_pace = run.machine_pace ? *run.machine_pace : measured_pace();
    std::optional<sculpt::MadeWorkpiece> made;
    // A document is there at once: nothing has to be read, checked and converted.
    const bool takes_long = has_workpiece(options) && !is_document(options.workpiece);
    if (run.opens_before_eyes && wall.desk && presenter->has_windows() && takes_long) {
        auto opening = open_workpiece(*presenter, options, wall);
        if (!opening) return std::unexpected(opening.error());
        if (!*opening) return SessionRecord{};
        made = std::move(*opening);
    }
    auto opened = LiveSession::create(options, wall, clock, machine_pace, std::move(made));
    if (!opened) return std::unexpected(opened.error());
    LiveSession& session = **opened;
    presenter->name_windows(session.document_name());
    if (options.live.first_steps) remember_first_time();
    const auto streams = SessionStreams::open(options.live, session, clock);
    if (!streams) return std::unexpected(streams.error());
    InputSource source = std::move(input);  // its recording reads the session's rings: it goes before them
    if (const auto begun = begin_recording(source, options, run.facts, session, streams->get()); !begun)
        return std::unexpected(begun.error());
    const std::shared_ptr<SessionRecording> recording = source.recording();
    if (run.keep_frames) session.times().keep_frames();
    const Result<SessionTracker> heard = session_tracker(options.live, wall.setup);
    if (!heard) return std::unexpected(heard.error());
    std::unique_ptr<devices::Tracker> tracker;
    if (!heard->where.empty()) {
        auto port = open_tracker(*heard, wall.setup, {clock, wake, parse_tracker_line});
        if (!port) return std::unexpected(port.error());
        tracker = std::move(*port);
    }

    if (options.live.detail == DetailChoice::automatic) presenter->draw_less_in_motion();
    LiveFrames frames(session, *presenter, std::move(source), clock, tracker.get(), heard->where);
    if (*streams) frames.stream_to(&(*streams)->lsl());
    // A stream of a thousand samples a second has them also while nothing moves.
    const bool needs_all_ticks = session.has_activity() || options.live.lsl;
    const haptics::LoopPace pace = pace_of(run.pace, session.hands().felt_by_person(), needs_all_ticks);
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
    if (*streams) std::printf("streams: %s\n", (*streams)->finish().text().c_str());
    if (presenter->has_lost_display())
        return fail("the display", "is gone, and so is the session's window", "what was done up to then is kept");
    if (!driven) return std::unexpected(driven.error());
    if (!ended) return std::unexpected(ended.error());
    SessionRecord record = frames.record();
    add_threads(record, session);
    if (record.lost_targets > 0) {
        session.notify_of_event(std::to_string(record.lost_targets) +
                                " places of the hand were lost: its ticks stood still for too long");
    }
    if (const auto whole = session.files().outcome(); !whole) return std::unexpected(whole.error());
    return record;
}

}  // namespace burin::session
