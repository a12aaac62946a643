// SPDX-License-Identifier: MIT
// Interpolation between orientations with +, -, *, / and sqrt alone, so that every machine computes the same bits.
#pragma once

#include <cmath>

#include "base/space.hpp"

namespace burin::devices {

[[nodiscard]] inline double length2(const Quat& q) { return q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z; }

[[nodiscard]] inline Quat scaled(const Quat& q, double s) { return Quat(q.w * s, q.x * s, q.y * s, q.z * s); }

[[nodiscard]] inline Quat normalised(const Quat& q) { return scaled(q, 1.0 / std::sqrt(length2(q))); }

// Normalised linear interpolation the shorter way round, so that q and -q, which are one rotation, do not pass through
// a half turn.
[[nodiscard]] inline Quat normalised_lerp(const Quat& a, const Quat& b, double t) {
    const double dot = a.w * b.w + a.x * b.x + a.y * b.y + a.z * b.z;
    const double s = dot < 0.0 ? -t : t;
    const double r = 1.0 - t;
    const Quat q(a.w * r + b.w * s, a.x * r + b.x * s, a.y * r + b.y * s, a.z * r + b.z * s);
    const double l2 = length2(q);
    // Orientations exactly opposite have no shorter way: stay at the first.
    return l2 > 1e-12 ? scaled(q, 1.0 / std::sqrt(l2)) : a;
}

}  // namespace burin::devices
