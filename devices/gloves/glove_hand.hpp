// SPDX-License-Identifier: MIT
// Where a glove's fingertips are in the hand, and what its pistons can do there. Plain data and pure functions.
//
// Frame: the hand's, whose origin is the middle of the palm, +Y from the wrist to the fingers, +Z out of the hand's
// back, +X to its right. Of a right hand the thumb is at -X. Units: metres, radians.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "base/space.hpp"
#include "devices/gloves/glove_frame.hpp"

namespace burin::devices {

// A chain of three segments. Its first joint lies at base; straight, it points about along the base's +Y, and it flexes
// towards the base's -Z. The last segment ends in the pad of the fingertip, where it touches.
struct FingerChain {
    Pose hand_from_base;
    std::array<Vec3, 3> segments_base_m{};  // of the straight finger
    Vec3 piston_hand_m{0.0};                // where its piston stands on the palm
};
using GloveHand = std::array<FingerChain, kGloveFingers>;

// A right hand: thumb, index, middle, ring. Its figures are those of the hand that is drawn
// (geometry/hand/hand_model.hpp), measured on nobody; its pistons' places are assumed.
[[nodiscard]] const GloveHand& usual_hand();

// How far a healthy finger bends; as that of the hand that is drawn (geometry/hand/hand_joints.hpp), to its last digit.
struct AngleLimits {
    FingerAngles lowest{}, highest{};
};
[[nodiscard]] const AngleLimits& angle_limits(std::size_t finger);

// How far any finger bends, whatever has become of it: what is beyond has been read falsely. Readings within are a
// person's own, such as a middle joint that bends backwards in a swan neck. Sources: a knuckle bends backwards by 30
// degrees and more in loose-jointed people, and passively by 70 to 80 often (Reider, The Orthopaedic Physical
// Examination, ch. 4); a hitchhiker's thumb does so in its end joint by 50 degrees and more (Glass and Kistler 1953,
// Acta Genetica et Statistica Medica 4: 192-206). For flexion, about a quarter more than is usual there. For what is
// left we found no figure that bounds it: 75 degrees backwards and to the side are ours. The ends of what a frame
// carries, -90 and 180 degrees, are always beyond: a torn wire reads one of them.
[[nodiscard]] const AngleLimits& angle_bounds(std::size_t finger);
// Returns the first joint whose angle is beyond its bounds, or is no number; none: all can be.
[[nodiscard]] std::optional<std::size_t> joint_beyond(std::size_t finger, const FingerAngles& angles);
// Returns what is told of a joint beyond its bounds: "the index finger's middle joint reads -80 degrees, ...".
[[nodiscard]] std::string false_reading_text(std::size_t finger, std::size_t joint, double angle_rad);

// What is wrong with a finger's angles that follow others after so long, in seconds: beyond its bounds; or turned
// faster than any finger does. A fist in one set is that.
inline constexpr double kFastestJoint_rad_per_s = 40.0;
enum class AngleFault : std::uint8_t { none, beyond_bounds, jumped };
[[nodiscard]] AngleFault angle_fault(std::size_t finger, const FingerAngles& before, const FingerAngles& now,
                                     double between_s);

// A fingertip, and how its piston meets it.
struct FingertipPlace {
    Pose hand_from_tip;     // its +Y is the last segment's
    Vec3 flexes_hand{0.0};  // unit: where the tip goes as the finger flexes in its first joint
    Vec3 piston_hand{0.0};  // unit: along the piston, away from the palm
    double piston_m = 0.0;  // its length
};
[[nodiscard]] FingertipPlace place_of(const FingerChain& finger, const FingerAngles& angles);

// The least cosine between a piston and its tip's way: nearer to a right angle, the piston cannot give the force.
inline constexpr double kLeastPistonCosine = 0.2;
inline constexpr double kMostPistonForce_N = 10.0;

// How the tip moves as its piston grows longer, in metres a metre: t / (p . t).
struct PistonWay {
    Vec3 moves_hand{0.0};
    bool is_bounded = false;  // by the cosine
};
[[nodiscard]] PistonWay piston_way(const FingertipPlace& place);

struct PistonForce {
    double force_N = 0.0;     // away from the palm; 0 to kMostPistonForce_N, since a piston does not pull
    bool is_bounded = false;  // by the cosine or by the most
};
// Returns the piston's force that does the same virtual work at the fingertip as a force there: F . t / (p . t).
[[nodiscard]] PistonForce piston_force(const FingertipPlace& place, const Vec3& force_hand_N);

}  // namespace burin::devices
