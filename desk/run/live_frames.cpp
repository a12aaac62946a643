// SPDX-License-Identifier: MIT
#include "desk/run/live_frames.hpp"

#include <algorithm>
#include <utility>

#include "session/input/input_line.hpp"
#include "session/stream/lsl_streams.hpp"

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
// Between two frames of a session that nobody sees.
constexpr Nanoseconds kUnseen_ns = kNanosecondsPerSecond / 60;

}  // namespace

// ---- Both

std::optional<FrameInput> RealTimeFrames::next_input() {
    if (end_.came()) {
        if (input_.next_event_ns()) static_cast<void>(look_for_signal());  // a script was not done
        return std::nullopt;
    }
    SessionTimes& times = desk_.times();
    times.begin();
    turn_ = now();
    Turn turn = wait_for_frame();
    if (shown_on_.has_lost_display()) return std::nullopt;
    times.reached(FrameStage::wait);
    for (InputEvent& event : in_order_of_time(std::move(turn.happened), take_tracker_input()))
        input_.push(event.time_ns, std::move(event.input));
    for (std::string& command : session_.hands().take_commands())
        input_.push(clock_.now_ns() - session_.start_ns(), CommandInput{std::move(command), {}}, true);
    for (CommandInput& told : session_.take_told())
        input_.push(clock_.now_ns() - session_.start_ns(), std::move(told), true);
    recorder_.outside(desk_.take_refused());
    if (const auto kept = recorder_.kept()) desk_.note_acknowledged(kept->acknowledged, kept->goes_on);
    const auto frame = input_.begin_frame(clock_.now_ns() - session_.start_ns(), turn.display_ns - session_.start_ns());
    if (!frame) return std::nullopt;
    times.reached(FrameStage::input);
    shown_on_.look();
    if (shown_on_.has_lost_display()) return std::nullopt;  // its windows have no size any more
    return frame;
}

std::vector<InputEvent> RealTimeFrames::take_tracker_input() {
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

void RealTimeFrames::stepped() {
    if (streams_ != nullptr)
        for (const std::string& message : streams_->take_messages()) session_.notify_of_event(message);
    desk_.times().reached(FrameStage::step);
}

void RealTimeFrames::finished(const FrameInput&, bool anew) {
    if (anew) changed_ns_ = clock_.now_ns();
    desk_.times().finished(anew, beat());
    const Moment end = now();
    lasted_ = {end.time_ns - began_.time_ns, end.processor_ns - began_.processor_ns};
    if (anew || turn_.time_ns - changed_ns_ < kSettled_ns) return;
    rested_.time_ns += end.time_ns - turn_.time_ns;
    rested_.processor_ns += end.processor_ns - turn_.processor_ns;
}

SessionRecord RealTimeFrames::record() const {
    SessionRecord record;
    record.frames = desk_.times().frames();
    record.skipped = desk_.times().skipped();
    record.wall_ns = lasted_.time_ns;
    record.processor_ns = lasted_.processor_ns;
    record.rested_ns = rested_.time_ns;
    record.rested_processor_ns = rested_.processor_ns;
    for (const FrameWarning& warning : desk_.times().warnings()) record.warnings.push_back(warning.line);
    return record;
}

// ---- Seen

// Waits until it is time for the next frame, plans it, and returns what has happened in the windows.
RealTimeFrames::Turn LiveFrames::wait_for_frame() {
    const bool active =
        presenter_.takes_turns(desk_) || presenter_.owes_full_picture() || clock_.now_ns() - changed_ns_ < kActive_ns;
    presenter_.refine_beside(!active);
    display_.shown_at(presenter_.refresh_Hz());
    if (active) {
        std::vector<InputEvent> happened = wait_for_refresh();
        return {plan_.display_ns, std::move(happened)};
    }
    Nanoseconds until_ns = clock_.now_ns() + kRest_ns;
    if (const auto event_ns = input_.next_event_ns()) until_ns = std::min(until_ns, session_.start_ns() + *event_ns);
    if (session_.work().waits_for_the_disk()) until_ns = std::min(until_ns, clock_.now_ns() + kLooksForDisk_ns);
    if (const auto change_ns = desk_.changes_ns()) until_ns = std::min(until_ns, session_.start_ns() + *change_ns);
    std::vector<InputEvent> happened = wait_for_input(until_ns);
    plan_ = display_.plan(clock_.now_ns());
    plan_.wake_ns = clock_.now_ns();
    return {plan_.display_ns, std::move(happened)};
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

void LiveFrames::stepped() {
    if (presenter_.shows() && desk_.wants_full_screen_exchanged()) presenter_.exchange_full_screen();
    for (const std::string& message : presenter_.take_messages()) session_.notify_of_event(message);
    if (const auto& told = session_.state().asked.told) {
        std::string name = short_name(*told) + " \u2014 " + state_text(*told);
        if (std::exchange(named_, name) != name) presenter_.name_windows(name);
    }
    RealTimeFrames::stepped();
}

void LiveFrames::finished(const FrameInput& frame, bool anew) {
    if (anew) display_.finished(presenter_, plan_, session_.start_ns() + frame.time_ns, clock_.now_ns());
    static_cast<void>(presenter_.take_blocked());  // blocked time of a turn without a new picture
    RealTimeFrames::finished(frame, anew);
}

// ---- Unseen

RealTimeFrames::Turn UnseenFrames::wait_for_frame() {
    next_ns_ = std::max(next_ns_ + kUnseen_ns, clock_.now_ns());
    clock_.sleep_until(next_ns_);
    return {next_ns_, {}};
}

}  // namespace burin::session
