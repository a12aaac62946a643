// SPDX-License-Identifier: MIT
// What the techniques share: one step while it is under way. Internal to haptics/workspace.
#pragma once

#include "haptics/workspace/technique.hpp"

namespace burin {

struct WorkspaceTurn {
    const WorkspaceSettings& settings;
    WorkspaceInput input;  // made safe to reckon with
    bool went_down = false, went_up = false;
    WorkspaceStep step;  // step.next is changed in place

    [[nodiscard]] WorkspaceState& state() { return step.next; }
    [[nodiscard]] Similarity& map() { return step.next.object_from_device; }
    [[nodiscard]] Vec3 tool_object_m() { return map() * input.position_device_m; }
};

// The mapping with its middle as near to `middle_object_m` as the reach lets it be.
[[nodiscard]] Similarity moved_to(const Similarity& map, const Vec3& middle_object_m,
                                  const WorkspaceSettings& settings) noexcept;

// Moves the mapping at the wanted speed, or as fast as it may: contact, top speed, acceleration, reach.
void glide(WorkspaceTurn& turn, const Vec3& wanted_device_m_per_s) noexcept;

void enter(WorkspaceTurn& turn, WorkspacePhase phase) noexcept;

void step_moving(WorkspaceTurn& turn) noexcept;
void step_clutching(WorkspaceTurn& turn) noexcept;
void step_bubble(WorkspaceTurn& turn) noexcept;
void step_drift(WorkspaceTurn& turn) noexcept;

}  // namespace burin
