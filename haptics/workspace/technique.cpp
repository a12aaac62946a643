// SPDX-License-Identifier: MIT
#include "haptics/workspace/technique.hpp"

#include <cmath>

namespace burin {

const char* text(WorkspaceTechnique) noexcept { return ""; }
const char* text(WorkspacePhase) noexcept { return ""; }

WorkspaceStep step_workspace(const WorkspaceState& state, const WorkspaceSettings& settings,
                             const WorkspaceInput& input) noexcept {
    WorkspaceStep step;
    const Similarity& map = settings.object_from_device;
    step.jumped = !state.begun || state.settings_map.position_m != map.position_m ||
                  state.settings_map.orientation != map.orientation || state.settings_map.scale != map.scale;
    step.next = state;
    step.next.begun = true;
    step.next.settings_map = step.next.object_from_device = step.object_from_device = map;
    step.next.position_device_m = input.position_device_m;
    step.picture.object_from_device = map;
    return step;
}

bool settings_are_sensible(const WorkspaceSettings& settings) noexcept {
    const Similarity& map = settings.object_from_device;
    const Quat& q = map.orientation;
    const double length2 = q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z;
    return std::isfinite(glm::dot(map.position_m, map.position_m)) && std::abs(length2 - 1.0) <= 2e-6 &&
           std::isfinite(map.scale) && map.scale > 0.0;
}

}  // namespace burin
