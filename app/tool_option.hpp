// SPDX-License-Identifier: MIT
// The tool that a session works with, as --tool, --operation, --material and --sweep-tolerance name it.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "base/json.hpp"
#include "compute/tool.hpp"

namespace burin {

struct ToolOptions {
    std::string shape =
        "ball:0.01";  // ball:R | cylinder:R,L | cone:R0,R1,L | bullnose:R,C,L | box:X,Y,Z | mesh:FILE, metres
    Operation operation = Operation::cut;
    std::string material;  // R,G,B, 0 to 255 each; empty: a colour of the operation's own
    double sweep_tolerance_cells = 0.1;
    double smooth_strength = 0.5;
};

struct Tool {
    ToolShape shape = BallTool{};
    Operation operation = Operation::cut;
    std::uint8_t material = 0;  // what it leaves behind: an index into the solid's materials
    double tolerance_cells = 0.1;
    double smooth_strength = 0.5;

    // Of the ball that it is; zero for other tools, which are neither felt nor drawn.
    [[nodiscard]] double ball_radius_m() const {
        const auto* ball = std::get_if<BallTool>(&shape);
        return ball != nullptr ? ball->radius_m : 0.0;
    }
    [[nodiscard]] ToolSweep sweep(const Pose& start_object, const Pose& end_object) const {
        return {shape, start_object, end_object, operation, material, tolerance_cells, smooth_strength};
    }
};

// Reads the mesh of mesh:FILE, which must be closed; its remarks are in no report. A box is given by its three sizes, and a
// ball, a box and a mesh are held by their own origin, the other tools by the middle of their tip.
[[nodiscard]] Result<Tool> parse_tool(const ToolOptions& options);
// What the tool leaves: named after the operation, so that cut, filled and painted surfaces can be told apart in display and
// export.
[[nodiscard]] Result<Material> parse_tool_material(const ToolOptions& options);
[[nodiscard]] Json describe_tool(const ToolOptions& options, const Material& material);

// The sweeps of a tool that was at those poses one after the other: the longest runs of poses of one orientation that a
// straight sweep replaces to within tolerance_m, and one sweep from pose to pose where it turns. A single pose is a stamp. A ball
// has no orientation. tolerance_m below zero replaces nothing: one sweep for each pose after the first.
[[nodiscard]] std::vector<ToolSweep> sweeps_along(std::span<const Pose> poses_object, const Tool& tool,
                                                  double tolerance_m);

}  // namespace burin
