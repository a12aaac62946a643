// SPDX-License-Identifier: MIT
#include "geometry/hand/hand_model.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/try.hpp"
#include "geometry/mesh/vertex_weld.hpp"

namespace burin::geometry {
namespace {

Quat turned_about_x(double angle_rad) { return glm::angleAxis(angle_rad, Vec3(1.0, 0.0, 0.0)); }
Quat turned_about_z(double angle_rad) { return glm::angleAxis(angle_rad, Vec3(0.0, 0.0, 1.0)); }

Quat quat_of(const Vec3& x, const Vec3& y, const Vec3& z) {
    return glm::normalize(glm::quat_cast(glm::dmat3(x, y, z)));
}

Pose pose_after(const Pose& c_from_b, const Pose& b_from_a) {
    return {c_from_b * b_from_a.position_m, c_from_b.orientation * b_from_a.orientation};
}
Pose pose_back(const Pose& pose) {
    const Quat back = glm::conjugate(pose.orientation);
    return {-(back * pose.position_m), back};
}

// Returns where the hand's frame (hand_model.hpp) is in the file's.
Pose file_from_hand(const std::array<Pose, kHandJoints>& rest) {
    const Vec3 &wrist = rest[kWrist].position_m, &middle = rest[first_joint(Finger::middle)].position_m;
    const Vec3 y = glm::normalize(middle - wrist);
    const Vec3 back = rest[first_joint(Finger::middle)].orientation * Vec3(0.0, 1.0, 0.0);
    const Vec3 x = glm::normalize(glm::cross(y, back));
    return {0.5 * (wrist + middle), quat_of(x, y, glm::cross(x, y))};
}

// Returns the bones of a finger at rest, whose joints are in the hand's frame.
FingerBones bones_of(Finger finger, const std::array<Pose, kHandJoints>& rest) {
    const std::size_t first = first_joint(finger);
    Vec3 x(0.0);  // the mean of the axes about which its joints flex
    for (std::size_t i = 0; i < 3; ++i) x += rest[first + i].orientation * Vec3(1.0, 0.0, 0.0);
    x = glm::normalize(x);
    const Vec3 along = rest[first + 1].position_m - rest[first].position_m;
    // A finger is straight in the plane of the palm; the thumb where its first bone is at rest.
    const Vec3 y = finger == Finger::thumb ? glm::normalize(along - glm::dot(along, x) * x)
                                           : glm::normalize(glm::cross(Vec3(0.0, 0.0, 1.0), x));
    FingerBones bones;
    bones.hand_from_base = {rest[first].position_m, quat_of(x, y, glm::cross(x, y))};
    const Quat base_from_hand = glm::conjugate(bones.hand_from_base.orientation);
    double flexion_rad = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec3 bone = base_from_hand * (rest[first + i + 1].position_m - rest[first + i].position_m);
        const double flexed_rad = -std::atan2(bone.z, bone.y);
        bones.rest[i + 1] = flexed_rad - flexion_rad;
        flexion_rad = flexed_rad;
        const Quat straighten = turned_about_x(flexed_rad);
        bones.bones_base_m[i] = straighten * bone;
        bones.straight_from_joint[i] = straighten * base_from_hand * rest[first + i].orientation;
    }
    bones.straight_from_joint[3] = turned_about_x(flexion_rad) * base_from_hand * rest[first + 3].orientation;
    return bones;
}

// Returns the number of each joint of the file, by ours; an Error where one is missing.
Result<std::array<std::uint16_t, kHandJoints>> joints_by_name(const SkinnedMesh& mesh, const std::string& name) {
    std::array<std::uint16_t, kHandJoints> numbers{};
    for (std::size_t i = 0; i < kHandJoints; ++i) {
        const auto found = std::ranges::find(mesh.joints, kHandJointNames[i], &SkinJoint::name);
        if (found == mesh.joints.end())
            return fail(name, "has no joint " + std::string(kHandJointNames[i]),
                        "name a hand with the 25 joints of WebXR");
        numbers[i] = static_cast<std::uint16_t>(found - mesh.joints.begin());
    }
    return numbers;
}

void take_skin(HandModel& hand, const SkinnedMesh& mesh, const std::array<std::uint16_t, kHandJoints>& numbers,
               const Pose& hand_from_file) {
    std::map<std::uint16_t, std::uint16_t> ours;  // a joint that no finger has moves as the wrist
    for (std::size_t i = 0; i < kHandJoints; ++i) ours[numbers[i]] = static_cast<std::uint16_t>(i);
    std::vector<Vec3> places;
    VertexWeld weld(places);
    std::vector<std::uint32_t> place_of_vertex;
    for (std::size_t i = 0; i < mesh.positions_m.size(); ++i) {
        const std::uint32_t place = weld.index_of(mesh.positions_m[i]);
        place_of_vertex.push_back(place);
        if (place < hand.bindings.size()) continue;
        SkinBinding binding = mesh.bindings[i];
        for (std::uint16_t& joint : binding.joints) {
            const auto known = ours.find(joint);
            joint = known != ours.end() ? known->second : std::uint16_t{0};
        }
        hand.bindings.push_back(binding);
    }
    for (const Vec3& place : places) hand.skin_m.push_back(hand_from_file * place);
    for (const auto& [a, b, c] : mesh.triangles) {
        const std::array corners{place_of_vertex[a], place_of_vertex[b], place_of_vertex[c]};
        if (corners[0] != corners[1] && corners[1] != corners[2] && corners[2] != corners[0])
            hand.triangles.push_back(corners);
    }
}

}  // namespace

Result<HandModel> hand_model_of(const SkinnedMesh& mesh, const std::string& name) {
    BURIN_TRY(numbers, joints_by_name(mesh, name));
    HandModel hand;
    for (std::size_t i = 0; i < kHandJoints; ++i) hand.rest[i] = mesh.joints[numbers[i]].mesh_from_joint;
    for (std::size_t i = 1; i < kHandJoints; ++i)
        if (!(glm::length(hand.rest[i].position_m - hand.rest[parent_of(i)].position_m) > 1e-4))
            return fail(name, "its joint " + std::string(kHandJointNames[i]) + " lies where its parent does",
                        "name a hand whose joints have lengths between them");
    const Pose hand_from_file = pose_back(file_from_hand(hand.rest));
    for (Pose& joint : hand.rest) joint = pose_after(hand_from_file, joint);
    for (const Finger finger : kAllFingers)
        hand.fingers[static_cast<std::size_t>(finger)] = bones_of(finger, hand.rest);
    hand.is_left = hand.rest[first_joint(Finger::thumb)].position_m.x > 0.0;
    take_skin(hand, mesh, numbers, hand_from_file);
    return hand;
}

Result<HandModel> read_hand_model(const std::filesystem::path& path) {
    BURIN_TRY(mesh, read_skinned_glb(path));
    return hand_model_of(mesh, path.string());
}

const HandModel& known_hand_model(bool is_left) {
    const auto made = [](bool left) {
        const auto mesh = read_skinned_glb(known_hand(left), left ? "left hand" : "right hand");
        const auto hand = mesh ? hand_model_of(*mesh, "hand") : Result<HandModel>(std::unexpected(mesh.error()));
        BURIN_CHECK(hand.has_value());
        return hand.value_or(HandModel{});
    };
    static const HandModel left = made(true), right = made(false);
    return is_left ? left : right;
}

HandBend bend_at_rest(const HandModel& hand) {
    HandBend bend{};
    for (std::size_t i = 0; i < kHandFingers; ++i) bend[i] = hand.fingers[i].rest;
    return bend;
}

HandSkeleton pose_of(const HandModel& hand, const HandBend& bend, const Pose& frame_from_hand) {
    HandSkeleton skeleton;
    for (std::size_t i = 0; i < kHandJoints; ++i) skeleton[i] = pose_after(frame_from_hand, hand.rest[i]);
    for (const Finger finger : kAllFingers) {
        const FingerBones& bones = hand.finger(finger);
        const FingerBend& bent = bend[static_cast<std::size_t>(finger)];
        const Quat side = turned_about_z(hand.is_left ? -bent[0] : bent[0]);
        Pose joint = bones.hand_from_base;
        double flexion_rad = 0.0;
        const std::size_t first = first_joint(finger);
        for (std::size_t i = 0; i < 4; ++i) {
            if (i < 3) flexion_rad += bent[i + 1];
            joint.orientation = bones.hand_from_base.orientation * side * turned_about_x(-flexion_rad);
            const Pose own{joint.position_m, glm::normalize(joint.orientation * bones.straight_from_joint[i])};
            skeleton[first + i] = pose_after(frame_from_hand, own);
            if (i < 3) joint.position_m += joint.orientation * bones.bones_base_m[i];
        }
    }
    return skeleton;
}

Pose hand_from_tip(const HandModel& hand, Finger finger, const FingerBend& bend) {
    const FingerBones& bones = hand.finger(finger);
    const Quat side = turned_about_z(hand.is_left ? -bend[0] : bend[0]);
    Vec3 tip_base_m(0.0);
    double flexion_rad = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
        flexion_rad += bend[i + 1];
        tip_base_m += turned_about_x(-flexion_rad) * bones.bones_base_m[i];
    }
    return {bones.hand_from_base * (side * tip_base_m),
            glm::normalize(bones.hand_from_base.orientation * side * turned_about_x(-flexion_rad))};
}

Pose frame_from_hand(const HandModel& hand, Finger finger, const FingerBend& bend, const Pose& frame_from_tip) {
    Pose pose = pose_after(frame_from_tip, pose_back(hand_from_tip(hand, finger, bend)));
    pose.orientation = glm::normalize(pose.orientation);
    return pose;
}

std::array<BoneCapsule, kBoneCapsules> capsules_of(const HandSkeleton& skeleton) {
    // Radii at the joints of a hand of this model's size: half of what its skin measures across there.
    constexpr std::array<std::array<double, 3>, kHandFingers> kRadii{{{0.0135, 0.0105, 0.0095},
                                                                      {0.0095, 0.0085, 0.0075},
                                                                      {0.0095, 0.0085, 0.0075},
                                                                      {0.0090, 0.0080, 0.0070},
                                                                      {0.0080, 0.0070, 0.0062}}};
    constexpr double kPalm_m = 0.0125;
    std::array<BoneCapsule, kBoneCapsules> capsules{};
    std::size_t next = 0;
    for (const Finger finger : kAllFingers) {
        const std::size_t first = first_joint(finger);
        for (std::size_t i = 0; i < 3; ++i)
            capsules[next++] = {skeleton[first + i].position_m, skeleton[first + i + 1].position_m,
                                kRadii[static_cast<std::size_t>(finger)][i]};
    }
    // Across the palm from each finger's first joint to the other end of its metacarpal; the thumb's goes to the wrist.
    const Vec3& wrist = skeleton[kWrist].position_m;
    for (const Finger finger : kAllFingers) {
        const std::size_t first = first_joint(finger);
        const Vec3& to = finger == Finger::thumb ? wrist : skeleton[first - 1].position_m;
        capsules[next++] = {skeleton[first].position_m, to, kPalm_m};
    }
    return capsules;
}

}  // namespace burin::geometry
