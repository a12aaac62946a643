// SPDX-License-Identifier: MIT
// The joints of a drawn hand, what each hangs on, and how far a finger bends. Plain data.
//
// There are 25 joints, in the order and by the names of WebXR (Hand Input, level 1): the wrist, four of the thumb and
// five of each finger. A joint's frame at rest has -Z along its bone and +Y out of the hand's back, so that a finger
// flexes about -X. A file of such a hand lists them side by side; what hangs on what is said here.
// Units: radians.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace burin::geometry {

inline constexpr std::size_t kHandJoints = 25, kHandFingers = 5;

enum class Finger : std::uint8_t { thumb, index, middle, ring, little };
inline constexpr std::array kAllFingers{Finger::thumb, Finger::index, Finger::middle, Finger::ring, Finger::little};

inline constexpr std::array<std::string_view, kHandJoints> kHandJointNames{
    "wrist",
    "thumb-metacarpal",
    "thumb-phalanx-proximal",
    "thumb-phalanx-distal",
    "thumb-tip",
    "index-finger-metacarpal",
    "index-finger-phalanx-proximal",
    "index-finger-phalanx-intermediate",
    "index-finger-phalanx-distal",
    "index-finger-tip",
    "middle-finger-metacarpal",
    "middle-finger-phalanx-proximal",
    "middle-finger-phalanx-intermediate",
    "middle-finger-phalanx-distal",
    "middle-finger-tip",
    "ring-finger-metacarpal",
    "ring-finger-phalanx-proximal",
    "ring-finger-phalanx-intermediate",
    "ring-finger-phalanx-distal",
    "ring-finger-tip",
    "pinky-finger-metacarpal",
    "pinky-finger-phalanx-proximal",
    "pinky-finger-phalanx-intermediate",
    "pinky-finger-phalanx-distal",
    "pinky-finger-tip",
};

inline constexpr std::size_t kWrist = 0;
// Returns the joint in which a finger begins to bend: the metacarpal of the thumb, the proximal phalanx of a finger.
// The three joints that follow are those of its next two phalanges and its tip.
[[nodiscard]] constexpr std::size_t first_joint(Finger finger) {
    return finger == Finger::thumb ? 1 : 1 + 5 * static_cast<std::size_t>(finger);
}
// Returns what a joint hangs on; the wrist hangs on itself.
[[nodiscard]] constexpr std::size_t parent_of(std::size_t joint) {
    const bool begins_finger = joint == 1 || (joint >= 5 && joint % 5 == 0);
    return joint == kWrist || begins_finger ? kWrist : joint - 1;
}

// How a finger is bent: to the side (positive towards the thumb), then the flexion of its three joints from the palm
// on. A finger without any is straight; the thumb's first joint is as at rest.
inline constexpr std::size_t kBends = 4;
using FingerBend = std::array<double, kBends>;
using HandBend = std::array<FingerBend, kHandFingers>;

struct BendLimits {
    FingerBend lowest{}, highest{};
};
// Returns how far healthy fingers bend: about the ranges that the American Academy of Orthopaedic Surgeons gives
// (Joint Motion, 1965), rounded to 5 degrees.
[[nodiscard]] const BendLimits& limits_of(Finger finger);
// Brings a bend within the limits.
[[nodiscard]] FingerBend within_limits(Finger finger, const FingerBend& bend);
// Returns how far a finger is closed: the sum of its flexions, as a share of the most that it can flex; 0 for a
// straight one. (G7's parameter.)
[[nodiscard]] double closure_of(Finger finger, const FingerBend& bend);

}  // namespace burin::geometry
