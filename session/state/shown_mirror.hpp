// SPDX-License-Identifier: MIT
// What a picture shows of symmetric carving (sculpt/mirror.hpp): the planes as panes of glass, each of its axis'
// colour, and the tool in use once more wherever it works as well. Pure functions; any thread.
#pragma once

#include <array>
#include <memory>

#include "haptics/channels.hpp"
#include "renderer/scene/scene.hpp"

namespace burin::session {

struct SessionState;

// Panes across x, y and z. Null: the session carves nothing.
using MirrorPanes = std::array<std::shared_ptr<const renderer::DrawnMesh>, 3>;
// Makes panes that stand out a little beyond a workpiece with these bounds, around its middle.
[[nodiscard]] MirrorPanes mirror_panes(const Box& workpiece_object);

// Adds panes and images to a picture. Of a tool that is a mesh, images that reverse it are left out: they are carved by
// a mesh of their own, which is not drawn.
void add_mirror(renderer::Scene& scene, const SessionState& state, const haptics::ToolState& tool);

}  // namespace burin::session
