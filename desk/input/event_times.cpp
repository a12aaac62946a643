// SPDX-License-Identifier: MIT
#include "desk/input/event_times.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace burin::session {

std::vector<InputEvent> EventTimes::timed(std::vector<Input> told, Nanoseconds asked_ns, Nanoseconds now_ns) {
    const Nanoseconds before_ns = std::exchange(looked_ns_, now_ns);
    const auto count = static_cast<Nanoseconds>(told.size());
    const bool lay_ready = now_ns - asked_ns < kAtOnce_ns;
    const Nanoseconds apart_ns =
        lay_ready && count > 0 ? std::clamp<Nanoseconds>((now_ns - before_ns) / count, 0, kReport_ns) : 0;
    std::vector<InputEvent> events;
    Nanoseconds time_ns = now_ns - std::max<Nanoseconds>(count - 1, 0) * apart_ns;
    for (Input& input : told) {
        const bool moves = std::holds_alternative<MouseMove>(input);
        if (moves && mouse_ && time_ns - mouse_->time_ns > kRest_ns)
            events.push_back({time_ns - kReport_ns, mouse_->input});
        events.push_back({time_ns, std::move(input)});
        if (moves) mouse_ = events.back();
        time_ns += apart_ns;
    }
    return events;
}

std::vector<InputEvent> in_order_of_time(std::vector<InputEvent> of_window, std::vector<InputEvent> of_trackers) {
    std::vector<InputEvent> all = std::move(of_window);
    std::ranges::move(of_trackers, std::back_inserter(all));
    std::ranges::stable_sort(all, {}, &InputEvent::time_ns);
    return all;
}

}  // namespace burin::session
