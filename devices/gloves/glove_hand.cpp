// SPDX-License-Identifier: MIT
#include "devices/gloves/glove_hand.hpp"

#include <algorithm>
#include <cmath>

namespace burin::devices {
namespace {

Quat about_x(double angle_rad) { return glm::angleAxis(angle_rad, Vec3(1.0, 0.0, 0.0)); }

// The thumb stands across the palm and faces the fingers.
Quat thumb_turn() { return glm::angleAxis(1.1, Vec3(0.0, 0.0, 1.0)) * glm::angleAxis(-1.2, Vec3(0.0, 1.0, 0.0)); }

}  // namespace

const GloveHand& usual_hand() {
    static const GloveHand hand{{
        {{Vec3(-0.03, -0.03, -0.01), thumb_turn()}, {0.046, 0.034, 0.026}, Vec3(0.02, -0.005, -0.02)},
        {{Vec3(-0.025, 0.045, 0.0), Quat(1.0, 0.0, 0.0, 0.0)}, {0.044, 0.026, 0.02}, Vec3(-0.01, 0.0, -0.02)},
        {{Vec3(-0.003, 0.048, 0.0), Quat(1.0, 0.0, 0.0, 0.0)}, {0.049, 0.030, 0.021}, Vec3(0.0, 0.0, -0.02)},
        {{Vec3(0.018, 0.044, 0.0), Quat(1.0, 0.0, 0.0, 0.0)}, {0.045, 0.028, 0.02}, Vec3(0.01, 0.0, -0.02)},
    }};
    return hand;
}

FingertipPlace place_of(const FingerChain& finger, const FingerAngles& angles) {
    const Quat side = glm::angleAxis(angles[0], Vec3(0.0, 0.0, 1.0));
    Vec3 tip_base_m(0.0);
    double flexion_rad = 0.0;
    for (std::size_t i = 0; i < finger.lengths_m.size(); ++i) {
        flexion_rad += angles[i + 1];
        tip_base_m += about_x(-flexion_rad) * Vec3(0.0, finger.lengths_m[i], 0.0);
    }
    const Pose& base = finger.hand_from_base;
    FingertipPlace place;
    place.hand_from_tip.position_m = base * (side * tip_base_m);
    place.hand_from_tip.orientation = glm::normalize(base.orientation * side * about_x(-flexion_rad));
    // The first joint turns everything beyond it about its -X.
    const Vec3 way_base = glm::cross(Vec3(-1.0, 0.0, 0.0), tip_base_m);
    place.flexes_hand = glm::normalize(base.orientation * (side * way_base));
    place.piston_hand = glm::normalize(place.hand_from_tip.position_m - finger.piston_hand_m);
    return place;
}

PistonForce piston_force(const FingertipPlace& place, const Vec3& force_hand_N) {
    const double work_N = glm::dot(force_hand_N, place.flexes_hand);
    const double cosine = glm::dot(place.piston_hand, place.flexes_hand);
    // A tip that flexes comes nearer to the palm: the cosine is below 0.
    const double bounded = std::min(cosine, -kLeastPistonCosine);
    const double wanted_N = work_N / bounded;
    const double given_N = std::clamp(wanted_N, 0.0, kMostPistonForce_N);
    return {given_N, cosine > -kLeastPistonCosine || wanted_N > kMostPistonForce_N};
}

}  // namespace burin::devices
