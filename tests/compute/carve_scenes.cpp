// SPDX-License-Identifier: MIT
#include "tests/compute/carve_scenes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "shaders/shared/octahedral.h"

namespace burin::test {
namespace {

constexpr double kPi = std::numbers::pi;

double cube_distance(const Vec3& p) {
    const Vec3 d = glm::abs(p - Vec3(0.5)) - Vec3(0.5);
    return glm::length(glm::max(d, Vec3(0.0))) + std::min(std::max({d.x, d.y, d.z}), 0.0);
}

struct Nearest {
    double distance = std::numeric_limits<double>::infinity();  // to the union of the swept balls; below zero inside
    double second = std::numeric_limits<double>::infinity();    // to the next sweep's
    Vec3 towards_axis{0.0};
};

Nearest nearest_sweep(std::span<const BallSweep> sweeps, const Vec3& p) {
    Nearest nearest;
    for (const BallSweep& s : sweeps) {
        const Vec3 e = s.end_object_m - s.start_object_m;
        const double length2 = glm::dot(e, e);
        const double t = length2 > 0 ? glm::clamp(glm::dot(p - s.start_object_m, e) / length2, 0.0, 1.0) : 0.0;
        const Vec3 to_axis = s.start_object_m + e * t - p;
        const double distance = glm::length(to_axis) - s.radius_m;
        if (distance < nearest.distance) {
            nearest.second = nearest.distance;
            nearest.distance = distance;
            nearest.towards_axis = to_axis;
        } else {
            nearest.second = std::min(nearest.second, distance);
        }
    }
    return nearest;
}

class Measurement {
public:
    Measurement(const Surface& surface, const CarveScene& scene) : surface_(surface), scene_(scene) {}

    CarveErrors run() {
        for (std::uint32_t t = 0; t < surface_.tile_count(); ++t) {
            const TileMesh& tile = surface_.tile(t);
            for (const shared::SurfaceVertex& v : tile.vertices) vertex(v);
            for (std::size_t i = 0; i < tile.indices.size(); i += 3) {
                Vec3 sum(0.0);
                for (std::size_t k = 0; k < 3; ++k) sum += place(tile.vertices[tile.indices[i + k]]);
                cut_sample(sum / 3.0, nullptr);
            }
        }
        errors_.surface_rms_m = samples_ > 0 ? std::sqrt(sum2_ / static_cast<double>(samples_)) : 0.0;
        errors_.volume = (surface_.volume_m3() - (1.0 - scene_.removed_m3)) / scene_.removed_m3;
        return errors_;
    }

private:
    [[nodiscard]] Vec3 place(const shared::SurfaceVertex& v) const {
        return surface_.lattice().origin_object + Vec3(v.x, v.y, v.z);
    }

    void vertex(const shared::SurfaceVertex& v) {
        const Vec3 p = place(v);
        cut_sample(p, &v);
        untouched_edge(p);
    }

    void cut_sample(const Vec3& p, const shared::SurfaceVertex* v) {
        constexpr double kCutRegion_m = 0.02;
        const Nearest nearest = nearest_sweep(scene_.sweeps, p);
        if (nearest.distance > kCutRegion_m) return;
        const double cube = cube_distance(p), f = std::abs(std::max(cube, -nearest.distance));
        sum2_ += f * f;
        ++samples_;
        errors_.surface_max_m = std::max(errors_.surface_max_m, f);
        // Away from rims and from where two sweeps meet, the normal is the tool's.
        const double away = 2 * surface_.lattice().spacing_m;
        if (v == nullptr || cube > -away || nearest.second - nearest.distance < away) return;
        const shared::Direction n = shared::decode_normal(v->normal);
        const Vec3 exact = glm::normalize(nearest.towards_axis);
        errors_.normal_max_rad = std::max(errors_.normal_max_rad, glm::length(glm::cross(Vec3(n.x, n.y, n.z), exact)));
        if (glm::dot(Vec3(n.x, n.y, n.z), exact) < 0) errors_.normal_max_rad = kPi;
    }

    // A vertex whose cell holds a piece of one of the cube's edges, or a corner, must lie on it.
    void untouched_edge(const Vec3& p) {
        const double h = surface_.lattice().spacing_m;
        const Vec3 nearest_corner = glm::round(p);
        std::array<bool, 3> in_cell{};
        int axes_at_face = 0;
        for (int a = 0; a < 3; ++a) {
            const auto cell = [&](double x) { return std::floor((x - surface_.lattice().origin_object[a]) / h); };
            in_cell[static_cast<std::size_t>(a)] = cell(p[a]) == cell(nearest_corner[a]);
            axes_at_face += in_cell[static_cast<std::size_t>(a)] ? 1 : 0;
        }
        if (axes_at_face < 2 || nearest_sweep(scene_.sweeps, p).distance < 2 * h) return;
        double distance2 = 0;
        for (int a = 0; a < 3; ++a) {
            const double d = p[a] - nearest_corner[a];
            if (in_cell[static_cast<std::size_t>(a)]) distance2 += d * d;
        }
        double& worst = axes_at_face == 3 ? errors_.corner_max_m : errors_.edge_max_m;
        worst = std::max(worst, std::sqrt(distance2));
    }

    const Surface& surface_;
    const CarveScene& scene_;
    CarveErrors errors_;
    double sum2_ = 0;
    std::size_t samples_ = 0;
};

}  // namespace

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
    for (int i = 0; i < 1000; ++i) {
        const double t = i / 999.0;
        const Vec3 p(0.5 + 0.42 * std::sin(6 * kPi * t), 0.5 + 0.42 * std::sin(4 * kPi * t + 0.6),
                     0.985 + 0.03 * std::sin(10 * kPi * t));
        scene.sweeps.push_back({p, p, 0.06, 0});
    }
    return scene;
}

CarveErrors measure(const Surface& surface, const CarveScene& scene) { return Measurement(surface, scene).run(); }

}  // namespace burin::test
