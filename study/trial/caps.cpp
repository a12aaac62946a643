// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "study/trial/stage_step.hpp"

namespace burin::study {
namespace {

// Axes with z along `away`; y is as near to the world's up as that allows, so that a wand held upright lies along it.
CapBox cap_at(const Vec3& centre_m, const Vec3& away, const StudyWorld& world) {
    CapBox cap;
    cap.centre_m = centre_m;
    cap.z = glm::normalize(away);
    const Vec3 up = std::abs(cap.z.y) < 0.99 ? Vec3{0.0, 1.0, 0.0} : Vec3{1.0, 0.0, 0.0};
    cap.x = glm::normalize(glm::cross(up, cap.z));
    cap.y = glm::cross(cap.z, cap.x);
    cap.half_width_m = world.cap_half_width_m;
    cap.depth_m = world.cap_depth_m;
    return cap;
}

}  // namespace

CapBox start_cap(const StudyWorld& world) {
    BURIN_CHECK(world.spine_m.size() >= 2);
    return cap_at(world.spine_m[0], world.spine_m[0] - world.spine_m[1], world);
}

CapBox end_cap(const StudyWorld& world) {
    BURIN_CHECK(world.spine_m.size() >= 2);
    const std::size_t n = world.spine_m.size();
    return cap_at(world.spine_m[n - 1], world.spine_m[n - 1] - world.spine_m[n - 2], world);
}

std::optional<Inside> inside(const CapBox& cap, const Vec3& from_m, const Vec3& to_m) {
    // Slabs (Kay and Kajiya, "Ray tracing complex scenes", 1986), in the box's own axes.
    const Vec3 a = from_m - cap.centre_m, d = to_m - from_m;
    const std::array axes{cap.x, cap.y, cap.z};
    const std::array lows{-cap.half_width_m, -cap.half_width_m, 0.0};
    const std::array highs{cap.half_width_m, cap.half_width_m, cap.depth_m};
    Inside found{0.0, 1.0, false};
    for (std::size_t i = 0; i < axes.size(); ++i) {
        const double at = glm::dot(a, axes[i]), rate = glm::dot(d, axes[i]);
        if (rate == 0.0) {
            if (at < lows[i] || at > highs[i]) return std::nullopt;
            continue;
        }
        const double near = ((rate > 0.0 ? lows[i] : highs[i]) - at) / rate;
        const double far = ((rate > 0.0 ? highs[i] : lows[i]) - at) / rate;
        if (near >= found.enters && near >= 0.0) found.through_face = i == 2 && rate > 0.0;
        found.enters = std::max(found.enters, near);
        found.leaves = std::min(found.leaves, far);
    }
    return found.enters <= found.leaves ? std::optional(found) : std::nullopt;
}

NearestOnLine nearest_on(std::span<const Vec3> line_m, const Vec3& point_m) {
    NearestOnLine best;
    if (line_m.empty()) return best;
    best = {line_m[0], glm::distance(line_m[0], point_m), 0.0};
    double along_m = 0.0;
    for (std::size_t i = 1; i < line_m.size(); ++i) {
        const Vec3 edge = line_m[i] - line_m[i - 1];
        const double squared = glm::dot(edge, edge);
        const double t = squared > 0.0 ? std::clamp(glm::dot(point_m - line_m[i - 1], edge) / squared, 0.0, 1.0) : 0.0;
        const Vec3 place = line_m[i - 1] + t * edge;
        const double length = std::sqrt(squared), distance = glm::distance(place, point_m);
        if (distance < best.distance_m) best = {place, distance, along_m + t * length};
        along_m += length;
    }
    return best;
}

}  // namespace burin::study
