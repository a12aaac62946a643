// SPDX-License-Identifier: MIT
#include "activities/grasp/hand_reading.hpp"

#include <algorithm>

namespace burin::activities {
namespace {

constexpr std::size_t kRing = 3, kLittle = 4;

geometry::FingerBend bend_of(const haptics::TickRecord& tick) {
    geometry::FingerBend bend{};
    std::copy_n(tick.sample.joints.begin(), bend.size(), bend.begin());
    return bend;
}

FingerReading finger_of(const haptics::TickRecord& tick) {
    FingerReading finger;
    finger.bend = bend_of(tick);
    finger.at_scene_m = tick.contact.points[0].hip_object_m;
    if (!tick.in_contact()) return finger;
    const haptics::PointRecord& deepest = tick.deepest();
    finger.object = deepest.object;
    finger.normal_scene = deepest.normal_object;
    finger.out_scene_m = deepest.proxy_object_m - deepest.hip_object_m;
    return finger;
}

// Returns where the hand is in the device's frame, of its thumb's tip.
Pose device_from_hand(const haptics::TickRecord& thumb) {
    const Pose tip = devices::place_of(devices::usual_hand()[0], bend_of(thumb)).hand_from_tip;
    const Quat turn = glm::normalize(thumb.sample.orientation_device * glm::conjugate(tip.orientation));
    return {thumb.sample.position_device_m - turn * tip.position_m, turn};
}

}  // namespace

HandReading reading_of(const std::array<const haptics::TickRecord*, kFelt>& ticks) {
    HandReading hand;
    hand.time_ns = ticks[0]->time_ns;
    for (std::size_t i = 0; i < kFelt; ++i) {
        hand.fingers[i] = finger_of(*ticks[i]);
        hand.bend[i] = hand.fingers[i].bend;
    }
    hand.bend[kLittle] = hand.bend[kRing];
    const Pose pose = device_from_hand(*ticks[0]);
    hand.scene_from_hand = ticks[0]->motion.object_from_device * Similarity{pose.position_m, pose.orientation, 1.0};
    return hand;
}

geometry::HandBend drawn_bend(const HandReading& hand) {
    constexpr int kSteps = 4;
    constexpr double kMostStep_rad = 0.15;
    // Share of a turn that each joint takes, from the palm on: a joint near the palm moves the tip most.
    constexpr std::array<double, 3> kTakes{1.0, 0.7, 0.4};
    geometry::HandBend bend = hand.bend;
    const Quat hand_from_scene = glm::conjugate(hand.scene_from_hand.orientation);
    for (std::size_t i = 0; i < kFelt; ++i) {
        const FingerReading& finger = hand.fingers[i];
        if (finger.object == 0) continue;
        const Vec3 out_m = hand_from_scene * finger.out_scene_m / hand.scene_from_hand.scale;
        const double depth_m = glm::length(out_m);
        if (!(depth_m > 1e-5)) continue;
        const Vec3 way = out_m / depth_m;
        const auto& shape = devices::usual_hand()[i];
        const Vec3 from_m = devices::place_of(shape, bend[i]).hand_from_tip.position_m;
        const auto opened = [&](geometry::FingerBend by, double angle_rad) {
            for (std::size_t k = 0; k < kTakes.size(); ++k) by[k + 1] -= angle_rad * kTakes[k];
            return by;
        };
        const auto out_of = [&](const geometry::FingerBend& of) {
            return glm::dot(devices::place_of(shape, of).hand_from_tip.position_m - from_m, way);
        };
        for (int step = 0; step < kSteps; ++step) {
            constexpr double kTurn_rad = 1e-4;
            const double missing_m = depth_m - out_of(bend[i]);
            const double slope = (out_of(opened(bend[i], kTurn_rad)) - out_of(bend[i])) / kTurn_rad;
            if (slope < 1e-3) break;  // opening takes it no farther out
            bend[i] = opened(bend[i], std::clamp(missing_m / slope, -kMostStep_rad, kMostStep_rad));
        }
    }
    bend[kLittle] = bend[kRing];
    return bend;
}

std::array<std::uint64_t, geometry::kHandFingers> opposed_contacts(const HandReading& hand) {
    constexpr double kMostCosine = 0.26;
    std::array<std::uint64_t, geometry::kHandFingers> touched{};
    for (std::size_t i = 0; i < kFelt; ++i)
        for (std::size_t j = 0; j < kFelt; ++j) {
            const FingerReading &a = hand.fingers[i], &b = hand.fingers[j];
            if (i != j && a.object != 0 && a.object == b.object &&
                glm::dot(a.normal_scene, b.normal_scene) < kMostCosine)
                touched[i] = a.object;
        }
    return touched;
}

}  // namespace burin::activities
