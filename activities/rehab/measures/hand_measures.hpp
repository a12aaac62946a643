// SPDX-License-Identifier: MIT
// Measures a hand's fingers while an exercise runs: their forces, how far and how fast they went, and how still the
// others stayed while one moved. Pure; any thread.
//
// Forces are those of the exercise's body. What a finger is pushed with by anything else, such as the table on which it
// leans, is told apart and measures nothing.
// Only sound readings count: not those of a finger whose device reports a fault, nor any way across a gap or a fault. A
// joint's least and most are angles beyond which it stayed for kHeld_s: a reading that is off for a moment is no range
// of motion.
// An end of a finger's way is its own only where nothing pushed it there: by more than kPushed_N that was told, or more
// than kStopped_N that was measured. Ends of free readings are kept apart, and beside them how far it closed while it
// was pushed: a body stopped it where that is as far.
// Speed and stillness come from the way that a finger's flexion (the sum of its three joints that bend) makes in each
// kWindow_s, from end to end: a glove's readings come in steps, and their differences from tick to tick are noise.
// Fractionation of a finger, over the windows in which it went farthest of all and more than kMoved_rad: 1 less the
// mean way of the others over its own. 1: it moves alone; 0: all move with it. (Schieber 1991, "Individuated finger
// movements of rhesus monkeys", J Neurophysiol 65(6): the individuation index, there of one instructed movement.)
// Units: newtons, radians, seconds. Fingers: thumb, index, middle, ring, as the glove has them.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "devices/gloves/glove_frame.hpp"
#include "geometry/hand/hand_joints.hpp"

namespace burin::activities {

using FingerForces = std::array<double, devices::kGloveFingers>;  // magnitudes
inline constexpr std::array<const char*, devices::kGloveFingers> kFingerNames{"thumb", "index", "middle", "ring"};
// A finger's colour on screen and page, 0xRRGGBB: of Okabe and Ito, which all can tell apart.
inline constexpr std::array<std::uint32_t, devices::kGloveFingers> kFingerColours_srgb{0x0072b2, 0xd55e00, 0x009e73,
                                                                                       0xcc79a7};

// A turn of the haptic loop, as an exercise sees it.
struct FingersTurn {
    double dt_s = 0.0;        // since the turn before
    FingerForces forces_N{};  // that the device was told to give, of the exercise's body
    devices::GloveJoints joints_rad{};
    std::array<bool, devices::kGloveFingers> has_fault{};  // by its device
    std::array<std::optional<double>, devices::kGloveFingers>
        measured_N{};                                          // that it gives of these, where it measures that
    FingerForces elsewhere_N{};                                // that it was told to give of anything else
    std::array<double, devices::kGloveFingers> body_shares{};  // of what it was told, that is the body's
    // All that it gives, where it measures that, whoever's it is.
    std::array<std::optional<double>, devices::kGloveFingers> drive_N{};
};

// A mean force is over the time in which the finger was told to be pushed at all: by more than kPushed_N; the measured
// one over as much of that as was measured. A mean speed is over the windows in which it moved at all: more than
// kMoved_rad.
struct FingerMeasures {
    static constexpr double kPushed_N = 0.05, kWindow_s = 0.05, kMoved_rad = 0.01, kLed_rad = 0.5, kHeld_s = 0.05;
    static constexpr double kStopped_N = 0.15;  // measured: above what a piston's sensor tells of a free finger
    static constexpr std::size_t kHeldParts = 5;
    using Joints = std::array<double, devices::kFingerJoints>;
    struct Part {  // of kHeld_s: the least and the most angle of each joint in it
        Joints least_rad{}, most_rad{};
        bool is_free = true;  // of a push, throughout
        bool operator==(const Part&) const = default;
    };

    double peak_N = 0.0, pushed_s = 0.0, impulse_Ns = 0.0;
    double elsewhere_peak_N = 0.0;  // told, of anything but the body
    double measured_peak_N = 0.0, measured_s = 0.0, measured_impulse_Ns = 0.0;
    Joints least_rad{HUGE_VAL, HUGE_VAL, HUGE_VAL, HUGE_VAL}, most_rad{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
    Joints free_least_rad = least_rad, free_most_rad = most_rad;  // likewise, of free readings alone
    Joints pushed_most_rad = most_rad;                            // and of those while it was pushed
    std::array<Part, kHeldParts> parts{};                         // the newest, without a gap; the last is under way
    std::size_t parts_begun = 0;                                  // of these; 0: the next reading begins one
    double part_s = 0.0;                                          // of the one under way
    double peak_rad_per_s = 0.0, moved_rad = 0.0, moved_s = 0.0;
    double led_rad = 0.0, followed_rad = 0.0;  // while it led: its own way, and the mean of the others'

    [[nodiscard]] double mean_N() const { return pushed_s > 0.0 ? impulse_Ns / pushed_s : 0.0; }
    // Returns nothing where nothing was measured.
    [[nodiscard]] std::optional<double> mean_measured_N() const {
        return measured_s > 0.0 ? std::optional(measured_impulse_Ns / measured_s) : std::nullopt;
    }
    [[nodiscard]] double range_rad(std::size_t joint) const {
        return most_rad[joint] > least_rad[joint] ? most_rad[joint] - least_rad[joint] : 0.0;
    }
    // Returns whether it was read for long enough, free of a push.
    [[nodiscard]] bool was_free() const;
    // Returns how far it opened and closed by itself, as a closure of that finger. Requires was_free().
    [[nodiscard]] double open_closure(geometry::Finger finger) const;
    [[nodiscard]] double closed_closure(geometry::Finger finger) const;
    // Returns whether it closed farther than anything has stopped it. Requires was_free().
    [[nodiscard]] bool closed_freely(geometry::Finger finger) const;
    [[nodiscard]] double mean_rad_per_s() const { return moved_s > 0.0 ? moved_rad / moved_s : 0.0; }
    // Returns nothing where the finger led by less than kLed_rad in all: that it led at all may be chance.
    [[nodiscard]] std::optional<double> fractionation() const {
        return led_rad >= kLed_rad ? std::optional(1.0 - followed_rad / led_rad) : std::nullopt;
    }
    bool operator==(const FingerMeasures&) const = default;
};

struct HandMeasures {
    bool begun = false;
    std::array<FingerMeasures, devices::kGloveFingers> fingers{};
    double window_s = 0.0;                                         // since the window under way began
    std::array<double, devices::kGloveFingers> window_from_rad{};  // each finger's flexion then
    std::array<bool, devices::kGloveFingers> window_is_sound{};    // each finger's readings since then
    bool operator==(const HandMeasures&) const = default;
};

[[nodiscard]] HandMeasures with_turn(HandMeasures measures, const FingersTurn& turn);

}  // namespace burin::activities
