// SPDX-License-Identifier: MIT
#include "geometry/hand/hand_joints.hpp"

#include <algorithm>
#include <numbers>

namespace burin::geometry {
namespace {

constexpr double degrees(double angle) { return angle * std::numbers::pi / 180.0; }

constexpr BendLimits kFingerLimits{{degrees(-20), degrees(-20), 0.0, degrees(-5)},
                                   {degrees(20), degrees(90), degrees(110), degrees(80)}};
constexpr BendLimits kThumbLimits{{degrees(-45), degrees(-20), degrees(-10), degrees(-15)},
                                  {degrees(30), degrees(50), degrees(60), degrees(80)}};

}  // namespace

const BendLimits& limits_of(Finger finger) { return finger == Finger::thumb ? kThumbLimits : kFingerLimits; }

FingerBend within_limits(Finger finger, const FingerBend& bend) {
    const BendLimits& limits = limits_of(finger);
    FingerBend within{};
    for (std::size_t i = 0; i < kBends; ++i) within[i] = std::clamp(bend[i], limits.lowest[i], limits.highest[i]);
    return within;
}

double closure_of(Finger finger, const FingerBend& bend) {
    const BendLimits& limits = limits_of(finger);
    double sum = 0.0, most = 0.0;
    for (std::size_t i = 1; i < kBends; ++i) {
        sum += bend[i];
        most += limits.highest[i];
    }
    return std::max(sum / most, 0.0);
}

}  // namespace burin::geometry
