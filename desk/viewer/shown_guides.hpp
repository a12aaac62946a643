// SPDX-License-Identifier: MIT
// What a picture shows besides things, to guide the hand. Of symmetric carving (sculpt/mirror.hpp): the planes as panes
// of glass, each of its axis' colour, and the tool in use once more wherever it works as well. Of adding material: the
// border of the room that there is for it, while the tool is near. Pure functions; any thread.
#pragma once

#include <array>
#include <memory>

#include "haptics/tick_record.hpp"
#include "haptics/tool_state.hpp"
#include "picture/picture.hpp"

namespace burin::session {

struct Room;
struct SessionState;

// A plane, and the frame around it by which it is seen from its own edge as well. Null: the session carves nothing.
struct MirrorPane {
    std::shared_ptr<const picture::DrawnMesh> pane, frame;
};
// Across x, y and z.
using MirrorPanes = std::array<MirrorPane, 3>;
// Makes panes that stand out a little beyond a workpiece with these bounds, around its middle.
[[nodiscard]] MirrorPanes mirror_panes(const Box& workpiece_object);

// Adds panes and images to a picture. Of a tool that is a mesh, images that reverse it are left out: they are carved by
// a mesh of their own, which is not drawn.
void add_mirror(picture::Picture& scene, const SessionState& state, const Room& room, const MirrorPanes& panes,
                const haptics::ToolState& tool);

// Shows the border of the room as a box of lines where the tool in use adds material within its own width of it.
void add_border(picture::Picture& scene, const SessionState& state, const Room& room, const haptics::ToolState& tool);

}  // namespace burin::session
