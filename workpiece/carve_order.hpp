// SPDX-License-Identifier: MIT
// Orders to a workpiece (workpiece.hpp): what keys, panel, script or recording ask of it. Plain data.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <variant>

#include "base/error.hpp"
#include "base/length_unit.hpp"
#include "compute/light/lamp.hpp"
#include "geometry/mesh/triangle_mesh.hpp"
#include "toolbox/mirror.hpp"
#include "toolbox/tool_options.hpp"

namespace burin::workpiece {

// Button of a hand that a mouse leads, beside the first: the cursor has left the surface within a stroke. A tool that
// fills at the hand touches what it has just added, and would go on adding into the air.
inline constexpr std::uint32_t kOverAir = 1u << 2;

struct UseTool {
    toolbox::Tool tool;           // its material's index is looked up when the order is carried out
    geometry::Material material;  // added to the solid's table if it is new
    double hardness_Ns_per_m3 = 0.0;
};
struct MirrorStrokes {
    toolbox::Mirror mirror;  // of all hands, from the next update on
};
struct UndoStroke {};
struct RedoStroke {};
// What was undone is not repeated any more: something else was done.
struct ForgetUndone {};
struct ExportSurface {
    std::string path;    // .stl, .ply or .obj
    std::string name{};  // what the message calls it; empty: its path
    LengthUnit unit = LengthUnit::m;
    double crumbs_m = 0.0;           // loose pieces below this size are left out (crumbs.hpp)
    std::size_t asked_by = 0;        // comes back with the outcome; whoever gives the order knows what it means
    std::optional<Error> refused{};  // why nothing is written; carving takes the same course as if it were
};
struct LightFrom {
    compute::Lamp lamp_object;
};
// Has the scene saved as it is between two orders: after the undo that was asked for before.
struct SaveScene {
    std::function<void()> save;
};
using CarveOrder =
    std::variant<UseTool, MirrorStrokes, UndoStroke, RedoStroke, ForgetUndone, ExportSurface, LightFrom, SaveScene>;

}  // namespace burin::workpiece
