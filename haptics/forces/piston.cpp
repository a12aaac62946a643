// SPDX-License-Identifier: MIT
#include "haptics/forces/piston.hpp"

#include <cmath>

namespace burin::haptics {
namespace {

double length(const Vec3& v) { return std::sqrt(glm::dot(v, v)); }

}  // namespace

PistonForce piston_force(const Vec3& force_N, const Vec3& along, const PistonSettings& settings) noexcept {
    const double magnitude_N = length(force_N), reach = length(along);
    if (magnitude_N == 0.0 && std::isfinite(reach)) return {};
    if (reach == 0.0 && std::isfinite(magnitude_N)) return {.bound = PistonBound::no_axis};
    const double along_N = glm::dot(force_N, along) / reach;
    // NaN and infinity go on: only a force that is known to pull is taken away.
    if (along_N <= 0.0 && std::isfinite(along_N)) return {.bound = PistonBound::pull};
    const double cosine = along_N / magnitude_N;
    const bool held = cosine < settings.least_cosine;
    const double least = held ? settings.least_cosine : cosine, gain = 1.0 / (least * least);
    return {(gain * along_N / reach) * along, gain, held ? PistonBound::near_square : PistonBound::none};
}

Vec3 pushed_part(const Vec3& force_N, const devices::Piston& piston, const Vec3& position_device_m) noexcept {
    if (!piston.drives) return force_N;
    const Vec3 along = position_device_m - piston.foot_device_m;
    const double squared = glm::dot(along, along);
    if (squared == 0.0) return 0.0 * force_N;
    const double share = glm::dot(force_N, along) / squared;
    return (share < 0.0 ? 0.0 * share : share) * along;  // a pull without end stays not finite
}

const char* text(PistonBound bound) noexcept {
    switch (bound) {
        case PistonBound::none: return "as the contact says";
        case PistonBound::near_square: return "less than the contact says: the force is nearly square to the piston";
        case PistonBound::pull: return "none: the contact would draw the fingertip in, and the piston can only push";
        case PistonBound::no_axis: return "none: the fingertip is at the piston's foot, so its direction is not known";
    }
    return "";
}

}  // namespace burin::haptics
