// SPDX-License-Identifier: MIT
#include "devices/gloves/glove_hand.hpp"

#include <algorithm>
#include <cmath>

namespace burin::devices {
namespace {

Quat about_x(double angle_rad) { return glm::angleAxis(angle_rad, Vec3(1.0, 0.0, 0.0)); }

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
