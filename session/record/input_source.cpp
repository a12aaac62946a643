// SPDX-License-Identifier: MIT
#include "session/record/input_source.hpp"

#include <algorithm>
#include <utility>

namespace burin::session {
namespace {

bool is_frame(const InputEvent& event) { return std::holds_alternative<FrameStart>(event.input); }

bool asks_for_a_picture(const InputEvent& event) {
    const auto* command = std::get_if<CommandInput>(&event.input);
    return command != nullptr && command->name == "screenshot";
}

bool is_of_tracker(const Input& input) {
    return std::holds_alternative<HeadInput>(input) || std::holds_alternative<WandInput>(input) ||
           std::holds_alternative<WandClick>(input) || std::holds_alternative<WandStick>(input);
}

}  // namespace

Nanoseconds head_sampled_ns(const FrameInput& frame) {
    Nanoseconds sampled_ns = -1;
    for (const InputEvent& event : frame.events)
        if (std::holds_alternative<HeadInput>(event.input)) sampled_ns = event.time_ns;
    return sampled_ns < 0 ? frame.time_ns : sampled_ns;
}

InputSource InputSource::live(std::optional<InputLogWriter> recorder) {
    InputSource source;
    source.recorder_ = std::move(recorder);
    return source;
}

InputSource InputSource::replay(InputLog log, Nanoseconds period_ns) {
    BURIN_CHECK(period_ns > 0);
    InputSource source;
    source.kind_ = Kind::replay;
    source.log_ = std::move(log);
    source.log_has_frames_ = std::ranges::any_of(source.log_.events, is_frame);
    source.period_ns_ = period_ns;
    return source;
}

InputSource InputSource::play(InputLog log, std::optional<InputLogWriter> recorder) {
    InputSource source;
    source.recorder_ = std::move(recorder);
    source.kind_ = Kind::play;
    std::erase_if(log.events, is_frame);
    source.log_ = std::move(log);
    return source;
}

std::optional<Nanoseconds> InputSource::next_event_ns() const {
    if (kind_ != Kind::play || next_ == log_.events.size()) return std::nullopt;
    return log_.events[next_].time_ns;
}

const InputEvent* InputSource::next_command() const {
    if (log_has_frames_) return nullptr;
    const auto left = std::span(log_.events).subspan(next_);
    const auto next = std::ranges::find_if(
        left, [](const InputEvent& event) { return std::holds_alternative<CommandInput>(event.input); });
    return next == left.end() ? nullptr : &*next;
}

void InputSource::push(Nanoseconds now_ns, Input input, bool is_of_device) {
    if (kind_ == Kind::replay || (kind_ == Kind::play && !is_of_device && !is_of_tracker(input))) return;
    if (std::holds_alternative<FrameStart>(input) || !is_sensible(input)) {
        ++refused_;
        return;
    }
    if (kind_ == Kind::play) {  // put among the log's events when its frame begins
        waiting_.push_back({now_ns, std::move(input)});
        return;
    }
    last_ns_ = std::clamp(now_ns, last_ns_, kLongestSession_ns);
    waiting_.push_back({last_ns_, std::move(input)});
    record(waiting_.back());
}

void InputSource::record(const InputEvent& event) {
    if (!recorder_) return;
    if (auto ok = recorder_->append(event); !ok) stop_recording(ok.error());
}

void InputSource::record_threads(const std::string& text) {
    if (!recorder_) return;
    if (auto ok = recorder_->append_threads(last_ns_, text); !ok) stop_recording(ok.error());
}

void InputSource::record_frame(const FrameSeen& frame, const StateWords& state) {
    if (!recorder_) return;
    if (auto ok = recorder_->append_frame(last_ns_, frame, state); !ok) stop_recording(ok.error());
}

void InputSource::stop_recording(Error why) {
    recording_error_ = std::move(why);
    recorder_.reset();
}

std::optional<FrameInput> InputSource::begin_frame(Nanoseconds now_ns, Nanoseconds display_ns) {
    if (kind_ == Kind::live) return live_frame(now_ns, display_ns);
    if (kind_ == Kind::play) return played_frame(now_ns, display_ns);
    return log_has_frames_ ? recorded_frame() : made_up_frame();
}

FrameInput InputSource::live_frame(Nanoseconds now_ns, Nanoseconds display_ns) {
    last_ns_ = std::clamp(now_ns, last_ns_, kLongestSession_ns);
    display_ns = std::clamp(display_ns, last_ns_, kLongestSession_ns);
    record({last_ns_, FrameStart{display_ns}});
    taken_.clear();
    std::swap(taken_, waiting_);
    return {last_ns_, display_ns, taken_};
}

std::optional<FrameInput> InputSource::played_frame(Nanoseconds now_ns, Nanoseconds display_ns) {
    if (over_) return std::nullopt;
    const Nanoseconds before_ns = last_ns_;
    last_ns_ = std::clamp(now_ns, last_ns_, kLongestSession_ns);
    taken_.clear();
    std::swap(taken_, waiting_);
    while (next_ < log_.events.size() && log_.events[next_].time_ns <= last_ns_) {
        taken_.push_back(log_.events[next_++]);
        latest_by_ns_ = std::max(latest_by_ns_, last_ns_ - taken_.back().time_ns);
        if (asks_for_a_picture(taken_.back())) break;
    }
    // Events that the previous frame left over belong to this one.
    for (InputEvent& event : taken_) event.time_ns = std::clamp(event.time_ns, before_ns, last_ns_);
    std::ranges::stable_sort(taken_, {}, &InputEvent::time_ns);
    for (const InputEvent& event : taken_) record(event);
    over_ = next_ == log_.events.size();
    const FrameInput frame{last_ns_, std::clamp(display_ns, last_ns_, kLongestSession_ns), taken_};
    record({last_ns_, FrameStart{frame.display_ns}});
    return frame;
}

std::optional<FrameInput> InputSource::recorded_frame() {
    const std::span all(log_.events);
    std::size_t end = next_;
    while (end < all.size() && !is_frame(all[end])) ++end;
    if (end == all.size()) return std::nullopt;
    const FrameInput frame{all[end].time_ns, std::get<FrameStart>(all[end].input).display_ns,
                           all.subspan(next_, end - next_)};
    next_ = end + 1;
    return frame;
}

std::optional<FrameInput> InputSource::made_up_frame() {
    if (over_) return std::nullopt;
    const std::span all(log_.events);
    const std::size_t first = next_;
    while (next_ < all.size() && all[next_].time_ns <= next_frame_ns_) ++next_;
    const FrameInput frame{next_frame_ns_, next_frame_ns_, all.subspan(first, next_ - first)};
    next_frame_ns_ += period_ns_;
    over_ = next_ == all.size();
    return frame;
}

}  // namespace burin::session
