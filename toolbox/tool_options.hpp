// SPDX-License-Identifier: MIT
// The tool that a session works with: as text, as the options --tool, --operation, --material and --sweep-tolerance
// write it (ToolOptions), as typed settings (ToolSettings), and ready to carve (Tool); and its sweeps along a path.
// Lengths in metres. Functions are pure, but for make_tool and parse_tool, which read the file of a mesh; any thread.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "base/json.hpp"
#include "compute/tools/tool.hpp"
#include "haptics/tool_action.hpp"
#include "toolbox/tool_kinds.hpp"

namespace burin::toolbox {

// As the command line and the first line of an input log have it.
struct ToolOptions {
    std::string shape = {};  // KIND:SIZES or mesh:FILE (tool_kinds.hpp); empty: one that suits the workpiece
    compute::Operation operation = compute::Operation::cut;
    std::string material = {};  // R,G,B, 0 to 255 each; empty: the operation's colour
    double sweep_tolerance_cells = 0.1;
    double smooth_strength = 0.5;
    std::optional<LengthUnit> units = std::nullopt;  // of a mesh's file (geometry/files/mesh_unit.hpp)
};

struct ToolSettings {
    ToolSpec shape = {};
    compute::Operation operation = compute::Operation::cut;
    std::optional<std::array<std::uint8_t, 3>> colour = {};  // sRGB; none: the operation's
    double sweep_tolerance_cells = 0.1;
    double smooth_strength = 0.5;

    bool operator==(const ToolSettings&) const = default;
};

struct Tool {
    compute::ToolShape shape = compute::BallTool{};
    compute::Operation operation = compute::Operation::cut;
    std::uint8_t material = 0;  // of the surface that it leaves: an index into the solid's materials
    double tolerance_cells = 0.1;
    double smooth_strength = 0.5;
    bool fills_at_hand = false;  // material is added where the hand is, and not where the tool rests on the surface

    // Returns the radius of a ball; 0 for other tools.
    [[nodiscard]] double ball_radius_m() const {
        const auto* ball = std::get_if<compute::BallTool>(&shape);
        return ball != nullptr ? ball->radius_m : 0.0;
    }
    // Tells whether its orientation matters.
    [[nodiscard]] bool turns() const { return !std::holds_alternative<compute::BallTool>(shape); }
    [[nodiscard]] compute::ToolSweep sweep(const Pose& start_object, const Pose& end_object) const {
        return {shape, start_object, end_object, operation, material, tolerance_cells, smooth_strength};
    }
};

// Returns the options with a tool that suits the workpiece in place of none: a ball whose radius is 5 % of the
// workpiece's longest side, to two digits.
[[nodiscard]] ToolOptions with_tool(ToolOptions options, double longest_side_m);

// Parses and checks all options; reads no file. Without a shape the settings have the ball of a ToolSpec, until the
// workpiece is known (with_tool).
[[nodiscard]] Result<ToolSettings> parse_tool_settings(const ToolOptions& options);
// Fails on sizes that make no tool.
[[nodiscard]] Result<void> check_tool(const ToolSettings& settings);
// Makes the tool; its material is the solid's first until the caller sets it. Reads the file of a mesh, which must be
// closed. A box is given by its three sizes.
[[nodiscard]] Result<Tool> make_tool(const ToolSettings& settings);
// Makes the tool from its shape, which is there already.
[[nodiscard]] Tool make_tool(const ToolSettings& settings, compute::ToolShape shape);
// Parses and makes the tool.
[[nodiscard]] Result<Tool> parse_tool(const ToolOptions& options);
// Returns the material of the surface that the tool leaves. It is named after the operation, so that cut, filled and
// painted surfaces can be told apart in display and export.
[[nodiscard]] geometry::Material material_of(const ToolSettings& settings);
// Describes the tool for a report, its shape in the user's own words.
[[nodiscard]] Json describe_tool(const ToolOptions& options, const geometry::Material& material);

// Says that a tool is wider than the whole workpiece or narrower than a cell of its lattice, with both sizes and the
// remedy; nothing where they suit one another.
[[nodiscard]] std::optional<std::string> misfit(const ToolSettings& settings, const Tool& tool, double longest_side_m,
                                                double cell_m);

// Returns what the tick does while the tool works with this operation. Smoothing has no force of its own: its tool only
// touches.
[[nodiscard]] haptics::ToolAction action_of(compute::Operation operation);

// Returns the radius of a ball about a tool's place that holds the tool and what the tick looks at around it.
[[nodiscard]] double around_m(const Tool& tool);

// Returns the sweeps of a tool that was at these poses one after the other. From the first pose on, the longest run of
// which one sweep, straight and evenly turning, replaces to within tolerance_m everywhere on the tool becomes one
// sweep. A single pose is a stamp. A ball has no orientation. tolerance_m below zero replaces nothing.
[[nodiscard]] std::vector<compute::ToolSweep> sweeps_along(std::span<const Pose> poses_object, const Tool& tool,
                                                           double tolerance_m);

}  // namespace burin::toolbox
