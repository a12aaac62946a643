// SPDX-License-Identifier: MIT
#include "geometry/hand/gesture.hpp"

#include <algorithm>

namespace burin::geometry {
namespace {

constexpr std::size_t kThumb = 0, kIndex = 1, kMiddle = 2, kRing = 3;
using Fingers = std::array<bool, kHandFingers>;

// Returns the fingers that touch an object.
Fingers touching(const GestureInput& input, std::uint64_t object) {
    Fingers fingers{};
    for (std::size_t i = 0; i < kHandFingers; ++i) fingers[i] = input.touched[i] == object;
    return fingers;
}

long count_of(const Fingers& fingers) { return std::ranges::count(fingers, true); }

double mean_closure(const GestureInput& input, const Fingers& fingers) {
    double sum = 0.0;
    for (std::size_t i = 0; i < kHandFingers; ++i) sum += fingers[i] ? input.closures[i] : 0.0;
    return sum / static_cast<double>(std::max(count_of(fingers), 1L));
}

Gesture grasp_of(const Fingers& fingers) {
    return fingers[kThumb] && fingers[kIndex] && count_of(fingers) == 2 ? Gesture::pinch : Gesture::whole;
}

bool points(const GestureInput& input, const GestureSettings& settings, double slack) {
    return input.closures[kIndex] < settings.points_straight + slack &&
           std::min(input.closures[kMiddle], input.closures[kRing]) > settings.points_closed - slack;
}

// Goes on with a grasp, or ends it.
GestureState gone_on(GestureState state, const GestureInput& input, const GestureSettings& settings,
                     Nanoseconds since_ns) {
    const Fingers now = touching(input, state.object);
    for (std::size_t i = 0; i < kHandFingers; ++i) state.holds[i] = state.holds[i] || now[i];
    state.gesture = grasp_of(state.holds);
    const double closed = mean_closure(input, state.holds);
    state.closed = std::max(state.closed, closed);
    const bool has_opened = closed < state.closed - settings.ends_opened && count_of(now) < 2;
    state.opens_ns = has_opened ? state.opens_ns + since_ns : 0;
    if (state.opens_ns < settings.ends_after_ns) return state;
    return {.time_ns = input.time_ns};
}

// Returns the grasp that begins, or the gesture of a hand that touches nothing.
GestureState begun(GestureState state, const GestureInput& input, const GestureSettings& settings) {
    const bool pointed = state.gesture == Gesture::point;
    state = {.time_ns = input.time_ns};
    for (const std::uint64_t object : input.touched) {
        const Fingers fingers = touching(input, object);
        if (object == 0 || count_of(fingers) < 2) continue;
        const double closed = mean_closure(input, fingers);
        if (closed < settings.begins_closed) continue;
        state.gesture = grasp_of(fingers);
        state.object = object;
        state.holds = fingers;
        state.closed = closed;
        return state;
    }
    if (points(input, settings, pointed ? settings.point_slack : 0.0)) state.gesture = Gesture::point;
    return state;
}

}  // namespace

GestureState step_gesture(GestureState state, const GestureInput& input, const GestureSettings& settings) {
    const Nanoseconds since_ns = state.time_ns > 0 ? input.time_ns - state.time_ns : 0;
    if (since_ns > kMostGap_ns) state = {};
    state.time_ns = input.time_ns;
    // What was about to end before a gap does not end by the gap alone.
    constexpr Nanoseconds kUsual_ns = 20'000'000;
    return state.grasps() ? gone_on(state, input, settings, std::min(since_ns, kUsual_ns))
                          : begun(state, input, settings);
}

}  // namespace burin::geometry
