// SPDX-License-Identifier: MIT
// The gestures of a hand (G10): it grasps with the whole hand, pinches between thumb and index, or points. A pure step
// from data of the fingers to what they do.
//
// A grasp begins when two fingers or more touch one object and are closed beyond a threshold: a closed hand without
// contact is no grasp. It ends when they have opened behind where they were and touch nothing of it any more, for a
// time. Thumb and index alone pinch; with any other finger it is the whole hand. A hand points that has its index
// straight and the others closed. The thresholds of beginning and ending lie apart, so that noise of the joints (a
// degree) neither ends a grasp nor begins one.
// Data may stop: over a gap of up to kMostGap_ns the gesture stays, beyond that it ends.
// Units: nanoseconds; closures as closure_of() gives them. No heap; any thread.
#pragma once

#include <array>
#include <cstdint>

#include "base/clock.hpp"
#include "geometry/hand/hand_joints.hpp"

namespace burin::geometry {

enum class Gesture : std::uint8_t { none, whole, pinch, point };

struct GestureInput {
    Nanoseconds time_ns = 0;
    std::array<double, kHandFingers> closures{};
    std::array<std::uint64_t, kHandFingers> touched{};  // the object that each finger touches; 0: none
};

struct GestureSettings {
    // A grasp begins with its fingers closed at least so far, on average. A straight finger has 0, and a ball of
    // 10 cm across is held with about 0.3.
    double begins_closed = 0.12;
    // It ends where they have opened by so much since they were closed farthest in it ...
    double ends_opened = 0.06;
    // ... for so long without contact of two of them.
    Nanoseconds ends_after_ns = 80'000'000;
    // A hand points while its index is closed less than the first, and middle and ring more than the second; it goes on
    // within `point_slack` of them.
    double points_straight = 0.2, points_closed = 0.5, point_slack = 0.06;
};
inline constexpr Nanoseconds kMostGap_ns = 100'000'000;

struct GestureState {
    Gesture gesture = Gesture::none;
    std::uint64_t object = 0;                // that is grasped; 0: none
    std::array<bool, kHandFingers> holds{};  // the fingers of the grasp
    double closed = 0.0;                     // the farthest mean closure of those fingers in it
    Nanoseconds opens_ns = 0;                // for how long it has been about to end
    Nanoseconds time_ns = 0;                 // of the newest data; 0: none yet

    [[nodiscard]] bool grasps() const { return gesture == Gesture::whole || gesture == Gesture::pinch; }
    bool operator==(const GestureState&) const = default;
};

[[nodiscard]] GestureState step_gesture(GestureState state, const GestureInput& input,
                                        const GestureSettings& settings = {});

}  // namespace burin::geometry
