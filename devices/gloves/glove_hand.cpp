// SPDX-License-Identifier: MIT
#include "devices/gloves/glove_hand.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/text.hpp"

namespace burin::devices {
namespace {

Quat about_x(double angle_rad) { return glm::angleAxis(angle_rad, Vec3(1.0, 0.0, 0.0)); }

constexpr double degrees(double angle) { return angle * std::numbers::pi / 180.0; }

constexpr AngleLimits kFingerLimits{{degrees(-20), degrees(-20), 0.0, degrees(-5)},
                                    {degrees(20), degrees(90), degrees(110), degrees(80)}};
constexpr AngleLimits kThumbLimits{{degrees(-45), degrees(-20), degrees(-10), degrees(-15)},
                                   {degrees(30), degrees(50), degrees(60), degrees(80)}};

// To the side; then the knuckle, the middle joint and the end joint, of the thumb those of its base and its two
// phalanges.
constexpr AngleLimits kFingerBounds{{degrees(-75), degrees(-85), degrees(-75), degrees(-75)},
                                    {degrees(75), degrees(115), degrees(140), degrees(115)}};
constexpr AngleLimits kThumbBounds{{degrees(-75), degrees(-75), degrees(-75), degrees(-88)},
                                   {degrees(75), degrees(90), degrees(110), degrees(115)}};

constexpr std::array<const char*, kGloveFingers> kOwners{"thumb's", "index finger's", "middle finger's",
                                                         "ring finger's"};
constexpr std::array<const char*, kFingerJoints> kFingerJointNames{"knuckle to the side", "knuckle", "middle joint",
                                                                   "end joint"};
constexpr std::array<const char*, kFingerJoints> kThumbJointNames{"base to the side", "base", "middle joint",
                                                                  "end joint"};

Quat unit(double w, double x, double y, double z) { return glm::normalize(Quat(w, x, y, z)); }

}  // namespace

const GloveHand& usual_hand() {
    static const GloveHand hand{{
        {{Vec3(-0.026867, -0.008852, -0.018841), unit(0.7049894, 0.0169506, -0.6235514, 0.3374704)},
         {Vec3(-0.002288, 0.032432, 0.0), Vec3(0.003019, 0.033658, 0.0), Vec3(-0.000557, 0.009727, -0.008632)},
         Vec3(0.02, -0.005, -0.02)},
        {{Vec3(-0.021746, 0.043296, -0.005411), unit(0.9990681, -0.0008037, -0.0214396, -0.0374522)},
         {Vec3(-0.001045, 0.045335, 0.0), Vec3(-0.000056, 0.024304, 0.0), Vec3(0.000449, 0.007918, -0.005481)},
         Vec3(-0.01, 0.0, -0.02)},
        {{Vec3(0.0, 0.045849, 0.0), unit(0.9974166, 0.0009275, 0.0130994, -0.0706236)},
         {Vec3(-0.001201, 0.046872, 0.0), Vec3(-0.000215, 0.027549, 0.0), Vec3(-0.000180, 0.011628, -0.005826)},
         Vec3(0.0, 0.0, -0.02)},
        {{Vec3(0.019159, 0.038649, -0.003692), unit(0.9897952, 0.0077920, 0.0597198, -0.1291447)},
         {Vec3(-0.000482, 0.042865, 0.0), Vec3(0.000479, 0.026569, 0.0), Vec3(-0.000823, 0.011144, -0.005697)},
         Vec3(0.01, 0.0, -0.02)},
    }};
    return hand;
}

const AngleLimits& angle_limits(std::size_t finger) { return finger == 0 ? kThumbLimits : kFingerLimits; }

const AngleLimits& angle_bounds(std::size_t finger) { return finger == 0 ? kThumbBounds : kFingerBounds; }

std::optional<std::size_t> joint_beyond(std::size_t finger, const FingerAngles& angles) {
    constexpr double kStep_rad = kAngleRange_rad / 4095;
    constexpr double kSlack_rad = 1.5 * kStep_rad;  // a step, and half a step of rounding
    const AngleLimits& bounds = angle_bounds(finger);
    for (std::size_t i = 0; i < kFingerJoints; ++i)
        if (!(angles[i] >= bounds.lowest[i] - kSlack_rad && angles[i] <= bounds.highest[i] + kSlack_rad)) return i;
    return std::nullopt;
}

std::string false_reading_text(std::size_t finger, std::size_t joint, double angle_rad) {
    const auto in_degrees = [](double rad) { return rad * 180.0 / std::numbers::pi; };
    const AngleLimits& bounds = angle_bounds(finger);
    return formatted("the %s %s reads %.0f degrees, and none bends beyond %.0f to %.0f: see to its sensor",
                     kOwners[finger], (finger == 0 ? kThumbJointNames : kFingerJointNames)[joint],
                     in_degrees(angle_rad), in_degrees(bounds.lowest[joint]), in_degrees(bounds.highest[joint]));
}

AngleFault angle_fault(std::size_t finger, const FingerAngles& before, const FingerAngles& now, double between_s) {
    if (joint_beyond(finger, now)) return AngleFault::beyond_bounds;
    for (std::size_t i = 0; i < kFingerJoints; ++i)
        if (!(std::abs(now[i] - before[i]) <= kFastestJoint_rad_per_s * between_s)) return AngleFault::jumped;
    return AngleFault::none;
}

FingertipPlace place_of(const FingerChain& finger, const FingerAngles& angles) {
    const Quat side = glm::angleAxis(angles[0], Vec3(0.0, 0.0, 1.0));
    Vec3 tip_base_m(0.0);
    double flexion_rad = 0.0;
    for (std::size_t i = 0; i < finger.segments_base_m.size(); ++i) {
        flexion_rad += angles[i + 1];
        tip_base_m += about_x(-flexion_rad) * finger.segments_base_m[i];
    }
    const Pose& base = finger.hand_from_base;
    FingertipPlace place;
    place.hand_from_tip.position_m = base * (side * tip_base_m);
    place.hand_from_tip.orientation = glm::normalize(base.orientation * side * about_x(-flexion_rad));
    // The first joint turns everything beyond it about its -X.
    const Vec3 way_base = glm::cross(Vec3(-1.0, 0.0, 0.0), tip_base_m);
    place.flexes_hand = glm::normalize(base.orientation * (side * way_base));
    const Vec3 piston_m = place.hand_from_tip.position_m - finger.piston_hand_m;
    place.piston_hand = glm::normalize(piston_m);
    place.piston_m = glm::length(piston_m);
    return place;
}

PistonWay piston_way(const FingertipPlace& place) {
    const double cosine = glm::dot(place.piston_hand, place.flexes_hand);
    // A tip that flexes comes nearer to the palm: the cosine is below 0.
    return {place.flexes_hand / std::min(cosine, -kLeastPistonCosine), cosine > -kLeastPistonCosine};
}

PistonForce piston_force(const FingertipPlace& place, const Vec3& force_hand_N) {
    const PistonWay way = piston_way(place);
    const double wanted_N = glm::dot(force_hand_N, way.moves_hand);
    const double given_N = std::clamp(wanted_N, 0.0, kMostPistonForce_N);
    return {given_N, way.is_bounded || wanted_N > kMostPistonForce_N};
}

}  // namespace burin::devices
