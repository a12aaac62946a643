// SPDX-License-Identifier: MIT
#include "desk/timing/shown_frames.hpp"

#include <algorithm>

namespace burin::session {

void ShownFrames::handed(const FrameMeasure& measure, std::uint64_t picture, Nanoseconds now_ns) {
    if (waiting_.empty()) looked_ns_ = now_ns;  // it cannot have been seen earlier
    const bool shown_anew = picture != last_picture_;
    last_picture_ = picture;
    waiting_.push_back({measure, shown_anew ? std::optional(picture) : std::nullopt, now_ns});
}

std::vector<FrameMeasure> ShownFrames::look(Nanoseconds now_ns, const WasShown& was_shown) {
    std::vector<FrameMeasure> known;
    while (!waiting_.empty()) {
        Frame& oldest = waiting_.front();
        const std::optional<bool> shown = oldest.picture ? was_shown(*oldest.picture) : std::nullopt;
        if (shown == false && now_ns - oldest.handed_ns < kPatience_ns) {
            looked_ns_ = now_ns;
            break;
        }
        sharp_ = shown == true && looked_ns_ && now_ns - *looked_ns_ <= kSharp_ns;
        if (sharp_) oldest.measure.flip_ns = oldest.measure.displayed_ns = now_ns;
        // It is unknown when the next one was last not seen.
        looked_ns_.reset();
        known.push_back(oldest.measure);
        waiting_.pop_front();
    }
    return known;
}

std::optional<Nanoseconds> ShownFrames::next_look_ns() const {
    if (waiting_.empty()) return std::nullopt;
    const Frame& oldest = waiting_.front();
    const Nanoseconds next_ns = looked_ns_.value_or(oldest.handed_ns) + kLookEvery_ns;
    return sharp_ ? std::max(next_ns, oldest.measure.plan.display_ns - kSharp_ns) : next_ns;
}

}  // namespace burin::session
