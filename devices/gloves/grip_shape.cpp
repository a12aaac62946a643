// SPDX-License-Identifier: MIT
#include "devices/gloves/grip_shape.hpp"

#include <algorithm>

namespace burin::devices {
namespace {

using Fingers = std::array<FingerAngles, kGloveFingers>;
constexpr Fingers kRelaxed{
    {{0.5, -0.3, 0.15, 0.0}, {0.03, 0.12, 0.15, 0.05}, {0.0, 0.15, 0.18, 0.08}, {-0.03, 0.2, 0.2, 0.1}}};
// Thumb and fingers come at a ball of 7 cm from opposite sides.
constexpr Fingers kWhole{
    {{0.4, 0.15, 0.8, 0.15}, {0.0, 0.95, 0.85, 0.5}, {0.0, 0.95, 0.9, 0.5}, {0.0, 0.95, 0.95, 0.5}}};
// The pads of thumb and index come to meet; the others are out of the way.
constexpr Fingers kPinch{{{0.15, 0.5, 0.2, -0.05}, {0.0, 1.0, 0.8, 0.35}, {0.0, 0.4, 0.45, 0.2}, {0.0, 0.3, 0.4, 0.2}}};
constexpr Fingers kPoint{
    {{-0.35, 0.3, 0.65, 0.6}, {0.0, 0.04, 0.06, 0.02}, {0.0, 1.35, 1.55, 0.9}, {0.0, 1.35, 1.55, 0.9}}};

}  // namespace

std::optional<GripShape> grip_named(std::string_view name) {
    for (std::size_t i = 0; i < kGripNames.size(); ++i)
        if (kGripNames[i] == name) return static_cast<GripShape>(i);
    return std::nullopt;
}

FingerAngles bent_in(GripShape shape, std::size_t finger, double closed) {
    const Fingers& end = shape == GripShape::whole ? kWhole : shape == GripShape::pinch ? kPinch : kPoint;
    FingerAngles bent{};
    for (std::size_t i = 0; i < kFingerJoints; ++i)
        bent[i] = kRelaxed[finger][i] + closed * (end[finger][i] - kRelaxed[finger][i]);
    return bent;
}

Grip stepped(Grip grip, double towards, const GloveForces& pushed_N, double time_s) {
    const double most = Grip::kCloses_per_s * time_s;
    for (std::size_t i = 0; i < kGloveFingers; ++i) {
        const double slowed = std::clamp(1.0 - pushed_N[i] / Grip::kHolds_N, -1.0, 1.0);
        const double way = std::clamp(towards - grip.closed[i], -most, most);
        // One that opens is not held up; one that is pushed beyond what it holds against gives way.
        grip.closed[i] = std::clamp(grip.closed[i] + (way >= 0.0 ? std::min(slowed * most, way) : way), 0.0, 1.0);
    }
    return grip;
}

}  // namespace burin::devices
