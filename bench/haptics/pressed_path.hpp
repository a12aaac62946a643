// SPDX-License-Identifier: MIT
// The path of the hand in bench haptics: along a bumpy sphere at
// 100 mm/s, one tick a millisecond, pressed in by a given depth.
#pragma once

#include <cmath>
#include <cstdint>

#include "bench/haptics/bumpy_sphere.hpp"

namespace burin::bench {

class PressedPath {
public:
    struct Depth {
        double mean_m = 0.0015, swing_m = 0.0005;
    };
    static constexpr double kSpeed_m_per_s = 0.1, kTick_s = 0.001, kSwings_Hz = 0.7;

    PressedPath(const BumpySphere& shape, const Depth& depth) : shape_(shape), depth_(depth) {}

    void step() {
        walk_.step(kSpeed_m_per_s * kTick_s / shape_.radius_m);
        phase_ += 2.0 * 3.14159265358979 * kSwings_Hz * kTick_s;
        const Vec3& n = walk_.outward();
        hip_m_ = (shape_.radius_at_m(n) - depth_.mean_m - depth_.swing_m * std::sin(phase_)) * n;
    }
    [[nodiscard]] const Vec3& hip_m() const { return hip_m_; }
    [[nodiscard]] Quat orientation() const { return walk_.orientation(); }
    [[nodiscard]] const Vec3& outward() const { return walk_.outward(); }

private:
    BumpySphere shape_;
    Depth depth_;
    SphereWalk walk_;
    double phase_ = 0.0;
    Vec3 hip_m_{0.0};
};

}  // namespace burin::bench
