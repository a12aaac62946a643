// SPDX-License-Identifier: MIT
#include "haptics/workspace/turn.hpp"

#include <algorithm>
#include <cmath>

namespace burin {
namespace {

// Half the extents of the turned and scaled workspace along the object's axes.
Vec3 half_extent_object(const Similarity& map, const Vec3& workspace_device_m) {
    const glm::dmat3 turn = glm::mat3_cast(map.orientation);
    Vec3 half(0.0);
    for (int axis = 0; axis < 3; ++axis) half += glm::abs(turn[axis]) * (0.5 * map.scale * workspace_device_m[axis]);
    return half;
}

Vec3 shortened(const Vec3& v, double longest) {
    const double length = std::sqrt(glm::dot(v, v));
    return length > longest ? v * (longest / length) : v;
}

}  // namespace

Similarity moved_to(const Similarity& map, const Vec3& middle_object_m, const WorkspaceSettings& settings) noexcept {
    Similarity moved = map;
    moved.position_m = middle_object_m;
    const Box& reach = settings.reach_object;
    if (reach.empty()) return moved;
    const Vec3 half = half_extent_object(map, settings.workspace_device_m);
    for (int axis = 0; axis < 3; ++axis) {
        const double lo = reach.lo[axis] + half[axis], hi = reach.hi[axis] - half[axis];
        moved.position_m[axis] = lo <= hi ? std::clamp(middle_object_m[axis], lo, hi) : reach.center()[axis];
    }
    return moved;
}

void glide(WorkspaceTurn& turn, const Vec3& wanted_device_m_per_s) noexcept {
    const WorkspaceSettings& s = turn.settings;
    Vec3& now = turn.state().glide_device_m_per_s;
    const double top = turn.input.in_contact ? s.max_speed_in_contact_m_per_s : s.max_speed_m_per_s;
    const double soon = std::sqrt(glm::dot(now, now)) + s.max_acceleration_m_per_s2 * turn.input.dt_s;
    now = shortened(wanted_device_m_per_s, std::min(top, soon));
    const Vec3 on_object_m = apply_to_vector(turn.map(), now * turn.input.dt_s);
    turn.map() = moved_to(turn.map(), turn.map().position_m + on_object_m, s);
}

void enter(WorkspaceTurn& turn, WorkspacePhase phase) noexcept {
    turn.state().phase = phase;
    turn.state().phase_s = 0.0;
}

}  // namespace burin
