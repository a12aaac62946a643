// SPDX-License-Identifier: MIT
#include "bench/scenes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bench/exact_rays.hpp"

namespace burin::bench {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kPlaces = 1000;
constexpr double kStrokeRadius_m = 0.06;

Vec3 stroke_place(int i) {
    const double t = i / (kPlaces - 1.0);
    return {0.5 + 0.42 * std::sin(6 * kPi * t), 0.5 + 0.42 * std::sin(4 * kPi * t + 0.6),
            0.985 + 0.03 * std::sin(10 * kPi * t)};
}

}  // namespace

bool CarveScene::only_stamps() const {
    return std::ranges::all_of(sweeps, [](const BallSweep& s) { return s.start_object_m == s.end_object_m; });
}

CarveScene ball_scene() {
    constexpr double r = 0.2, depth = 0.05, cap_height = r - depth;
    const Vec3 center(0.47, 0.52, 1.0 - depth);
    const double cap = kPi * cap_height * cap_height * (3 * r - cap_height) / 3;
    return {"ball", {{center, center, r, 0}}, 4.0 / 3.0 * kPi * r * r * r - cap};
}

CarveScene capsule_scene() {
    constexpr double r = 0.12;
    const Vec3 from(0.31, 0.27, 1.0), to(0.66, 0.71, 1.0);
    const double length = glm::length(to - from);
    return {"capsule", {{from, to, r, 0}}, 0.5 * kPi * r * r * (length + 4.0 / 3.0 * r)};
}

CarveScene cavity_scene() {
    constexpr double r = 0.13;
    const Vec3 from(0.3, 0.35, 0.31), to(0.62, 0.55, 0.7);
    const double length = glm::length(to - from);
    return {"cavity", {{from, to, r, 0}}, kPi * r * r * (length + 4.0 / 3.0 * r)};
}

CarveScene stroke_1000_scene() {
    CarveScene scene{"stroke-1000", {}, 0.03323742};
    for (int i = 0; i < kPlaces; ++i) {
        scene.sweeps.push_back({stroke_place(i), stroke_place(i), kStrokeRadius_m, 0});
    }
    return scene;
}

CarveScene stroke_1000_swept_scene() {
    CarveScene scene{"stroke-1000-swept", {}, 0.03326625};
    for (int i = 0; i + 1 < kPlaces; ++i) {
        scene.sweeps.push_back({stroke_place(i), stroke_place(i + 1), kStrokeRadius_m, 0});
    }
    return scene;
}

CarveScene beginning_of(const CarveScene& scene, std::size_t sweeps, int rays_a_side) {
    CarveScene beginning{scene.name, scene.sweeps, 0.0};
    beginning.sweeps.resize(std::min(sweeps, scene.sweeps.size()));
    beginning.name += " (first " + std::to_string(beginning.sweeps.size()) + ")";
    beginning.removed_m3 = removed_volume_m3(beginning.sweeps, rays_a_side);
    return beginning;
}

}  // namespace burin::bench
