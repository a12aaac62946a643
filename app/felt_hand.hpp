// SPDX-License-Identifier: MIT
// The script of the simulated hand: the stroke, fitted into the device's workspace, and pressed into the material.
#pragma once

#include <functional>

#include "app/feel_options.hpp"
#include "app/stroke_file.hpp"
#include "base/space.hpp"

namespace burin {

// The stroke's bounds are centred in the workspace, and the motion is scaled up where they are larger.
[[nodiscard]] Similarity fit_into_workspace(const Stroke& stroke, const Vec3& workspace_m);

inline constexpr double kHandRests_s = 0.3;  // before and after the stroke: the gate's ramp must be over

// Unit, into the material near a place in the object frame; zero where there is none.
using IntoMaterial = std::function<Vec3(const Vec3&)>;

// While the button is pressed the hand wants the tool press_N / grip beyond the stroke, into the material: held on the stroke it
// would press with that force. It presses as much as it moves, up to the middle speed of the pressed rows, and eases where it
// rests: a tool that is pressed and not moved sinks.
[[nodiscard]] Result<SimulatedHand> hand_along(const Stroke& stroke, const Similarity& object_from_device,
                                               const Feel& feel, const IntoMaterial& into_material);

}  // namespace burin
