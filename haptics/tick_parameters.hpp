// SPDX-License-Identifier: MIT
// What a tick is told: the parameters that frame or study publish to the haptic thread (channels.hpp). Plain data of
// fixed size. Units are SI; a name carries its frame. "Object" is the workpiece's frame.
#pragma once

#include <array>
#include <cstdint>

#include "haptics/contact/probe.hpp"
#include "haptics/contact/tool_shape.hpp"
#include "haptics/contact/work_counts.hpp"
#include "haptics/forces/guidance.hpp"
#include "haptics/forces/tool_surface.hpp"
#include "haptics/forces/touch_material.hpp"
#include "haptics/signals/filters.hpp"
#include "haptics/stability/coupled_wall.hpp"
#include "haptics/stability/gate_limits.hpp"
#include "haptics/stability/passivity_settings.hpp"
#include "haptics/tool_action.hpp"
#include "haptics/workspace/workspace_settings.hpp"

namespace burin::haptics {

// Settings of a tick. Written by the frame or the study, never by the haptic thread. A set for which
// parameters_are_sensible() (haptics/tick.hpp) is false gives zero force and GateCause::bad_parameters.
struct TickParameters {
    std::uint64_t sequence = 0;  // 0: the defaults, never published
    // Mapping from device to scene; its scale is the position gain g: motions grow by g, forces shrink by g.
    WorkspaceSettings workspace;
    Probe probe;
    ProxyPlacement placement;
    ToolShape shape;   // what touches instead of the probe's first ball, where it has pieces
    ToolSurface tool;  // what cuts; count 0: nothing
    // The ball that touches is smaller than the ball that carves by this fraction of its radius. A ball lying in the
    // groove it has cut would otherwise be pinched by the facets, which cut the circle's corner: a facet of length s
    // stands s^2 / (8 R) proud. 0.02 leaves room for facets of 0.4 R.
    double clearance_ratio = 0.02;
    bool shading = true;  // force shading, see haptics/contact/god_object.hpp
    std::array<TouchMaterial, kMostMaterials> materials{};
    ToolAction action = ToolAction::touch;
    FillPlace fills = FillPlace::surface;
    // Limits the stiffness of materials to what the device renders passively; false: uses it as set.
    bool limit_stiffness = true;
    VirtualCoupling coupling;
    PassivitySettings passivity;
    SignalSettings signals;
    WeightSettings weight;
    GuidanceSettings guidance;
    GuidanceCurve curve;
    // The noise bound of the velocity estimate, in the device frame: the encoder's step.
    double position_noise_m = 0.000055;
    // A device whose controller can is offered the law of a contact that rests (haptics/local_law.hpp).
    bool local_rendering = false;
    bool enabled = true;  // false: no contact, zero force, the proxy stays with the HIP
    // The hand holds what it would touch: nothing pushes it, and a force that there was fades out.
    bool holds = false;
    // The tool touches while its first button is down, and else the proxy stays with the HIP: for a hand that is led
    // from outside and may pass through the material, where its proxy would be caught on the other side.
    bool touches_while_pressed = false;
    // A drill: a proxy in contact stays where it is, as if its work never sufficed. The watch lets the hand go.
    bool catch_drill = false;
    // In contact, a surface older than this is not trusted and gives zero force. 0: a surface of any age is trusted.
    double max_surface_age_s = 0.5;
    GateLimits limits;
    WorkSettings work;
};

}  // namespace burin::haptics
