// SPDX-License-Identifier: MIT
// A hand as it is drawn: its bones, its skin, and where both are when its fingers bend. Pure functions; any thread.
//
// Frame: the hand's, whose origin is midway between the wrist and the middle finger's first joint, +Y from the one to
// the other, +Z out of the hand's back, +X to its right. So the thumb of a right hand is at -X, and that of a left one
// at +X. Metres.
// A finger is a chain of three bones: its base turns to the side about the base's +Z, then each joint flexes about the
// base's -X. A straight finger lies in the plane of the palm. Bones keep the small angles that they have sideways at
// rest, so that the hand at rest is exactly the file's.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "geometry/files/glb_skin.hpp"
#include "geometry/hand/hand_joints.hpp"

namespace burin::geometry {

struct FingerBones {
    Pose hand_from_base;
    std::array<Vec3, 3> bones_base_m{};  // from joint to joint to tip, in the base's frame while the finger is straight
    std::array<Quat, 4> straight_from_joint{};  // the joints' own frames, likewise
    FingerBend rest{};
};

struct HandModel {
    bool is_left = false;
    std::array<Pose, kHandJoints> rest;  // hand_from_joint
    std::array<FingerBones, kHandFingers> fingers;
    std::vector<Vec3> skin_m;                             // at rest; welded: each place once
    std::vector<SkinBinding> bindings;                    // one for each place of the skin
    std::vector<std::array<std::uint32_t, 3>> triangles;  // counter-clockwise seen from outside; closed

    [[nodiscard]] const FingerBones& finger(Finger of) const { return fingers[static_cast<std::size_t>(of)]; }
};

// Makes a hand of a skinned mesh that has the 25 joints by their names. Which hand it is follows from its thumb.
// Returns an Error that names what is missing. `name` stands for the file in messages.
[[nodiscard]] Result<HandModel> hand_model_of(const SkinnedMesh& mesh, const std::string& name);
[[nodiscard]] Result<HandModel> read_hand_model(const std::filesystem::path& path);

// Returns the file of a hand that comes with the program (assets/hands), and the hand itself.
[[nodiscard]] std::span<const std::byte> known_hand(bool is_left);
[[nodiscard]] const HandModel& known_hand_model(bool is_left);

// Returns the hand with a finer skin: each triangle becomes four, and every place moves to where the surface that
// Loop's rules subdivide without end comes nearer (Loop, Smooth Subdivision Surfaces Based on Triangles, 1987). The
// border of a skin that is open follows the rules of Hoppe and others (Piecewise Smooth Surface Reconstruction, 1994).
// Bindings are subdivided by the same rules, and keep their four greatest weights.
[[nodiscard]] HandModel with_finer_skin(const HandModel& hand);

// Where all joints are. With `hand_from_joint` at rest the skin is as in the file.
using HandSkeleton = std::array<Pose, kHandJoints>;

[[nodiscard]] HandBend bend_at_rest(const HandModel& hand);
// Returns the joints in the frame that `frame_from_hand` leads to. Limits are the caller's to keep.
[[nodiscard]] HandSkeleton pose_of(const HandModel& hand, const HandBend& bend, const Pose& frame_from_hand);

// Where the last bone of a finger is: its frame has +Y along the straight finger and +Z out of its back.
[[nodiscard]] Pose hand_from_tip(const HandModel& hand, Finger finger, const FingerBend& bend);
// Returns where the hand must be for a fingertip to be at `frame_from_tip`.
[[nodiscard]] Pose frame_from_hand(const HandModel& hand, Finger finger, const FingerBend& bend,
                                   const Pose& frame_from_tip);

// Returns the skin's places, blended with dual quaternions (Kavan and others, Geometric Skinning with Approximate Dual
// Quaternion Blending, 2008): linear blending flattens the knuckles of a fist.
[[nodiscard]] std::vector<Vec3> skinned(const HandModel& hand, const HandSkeleton& skeleton);

// A bone as a segment that is thickened by a radius, as the skin is around it on average in a hand of this size.
struct BoneCapsule {
    Vec3 from_m{0.0}, to_m{0.0};
    double radius_m = 0.0;
};
// Three capsules of each finger, and five across the palm.
inline constexpr std::size_t kBoneCapsules = 20;
[[nodiscard]] std::array<BoneCapsule, kBoneCapsules> capsules_of(const HandSkeleton& skeleton);

}  // namespace burin::geometry
