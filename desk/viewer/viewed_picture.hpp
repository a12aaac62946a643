// SPDX-License-Identifier: MIT
// Makes the pictures that a viewer's screens show of a session. Pure; any thread.
#pragma once

#include <optional>

#include "desk/viewer/viewer.hpp"
#include "haptics/tick_record.hpp"
#include "haptics/tool_state.hpp"
#include "picture/picture.hpp"
#include "wall/comfort.hpp"

namespace burin::session {

// Returns the scene that one screen shows, with the tool of the hand in use; nothing where an eye is not in front of
// it.
[[nodiscard]] std::optional<picture::Picture> scene_of(const ViewedSession& seen, std::size_t screen,
                                                       const Vec3& lattice_origin_object,
                                                       const haptics::ToolState& tool);
// Adds the tool of another part of the hands to a picture: the tool of a hand, where a part of it has it.
void add_tool(picture::Picture& scene, const SessionState& state, std::size_t hand, const haptics::ToolState& tool);
// Returns whether the screens are such that parallax could fade towards an edge: a lone one, which both eyes see their
// own pictures on. Adjoining screens have no edge that could cut off what stands in front, and a fade would break the
// picture apart there.
[[nodiscard]] bool could_fade_at_edges(const ViewedSession& seen, std::size_t screen);
// Returns whether it does.
[[nodiscard]] bool fades_at_edges(const ViewedSession& seen, std::size_t screen);
// Judges what in the scene strains the eyes, on the main screen.
[[nodiscard]] wall::ComfortFinding comfort_of(const ViewedSession& seen, const haptics::ToolState& tool);

}  // namespace burin::session
