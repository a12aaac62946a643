// SPDX-License-Identifier: MIT
// The two techniques in which the mapping moves by itself.
#include <algorithm>
#include <cmath>

#include "haptics/workspace/turn.hpp"

namespace burin {

// Dominjon et al. 2005: V = k (|d| - R)^3 d/|d|, F = -s (|d| - R) d/|d|.
void step_bubble(WorkspaceTurn& turn) noexcept {
    const WorkspaceSettings& s = turn.settings;
    const Vec3& d = turn.input.position_device_m;
    const double distance = std::sqrt(glm::dot(d, d));
    const double beyond = distance - s.bubble_radius_m;
    turn.step.picture.bubble_radius_object_m = s.bubble_radius_m * turn.map().scale;
    const WorkspacePhase phase = beyond > 0.0 ? WorkspacePhase::gliding : WorkspacePhase::editing;
    if (phase != turn.state().phase) enter(turn, phase);
    const Vec3 outwards = beyond > 0.0 ? d / distance : Vec3(0.0);
    glide(turn, outwards * (s.bubble_rate_per_m2s * beyond * beyond * beyond));
    turn.step.force_device_N = -s.bubble_stiffness_N_per_m * std::max(beyond, 0.0) * outwards;
}

// Conti and Khatib 2005: in proportion to the hand's speed and to its distance from the middle.
void step_drift(WorkspaceTurn& turn) noexcept {
    const WorkspaceSettings& s = turn.settings;
    Vec3 outwards(0.0);
    for (int axis = 0; axis < 3; ++axis) {
        const double half = 0.5 * s.workspace_device_m[axis];
        if (half > 0.0) outwards[axis] = std::clamp(turn.input.position_device_m[axis] / half, -1.0, 1.0);
    }
    const double length = std::sqrt(glm::dot(outwards, outwards));
    if (length > 1.0) outwards /= length;
    const Vec3& v = turn.input.velocity_device_m_per_s;
    glide(turn, outwards * (s.drift_ratio * std::sqrt(glm::dot(v, v))));
}

}  // namespace burin
