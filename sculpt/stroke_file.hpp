// SPDX-License-Identifier: MIT
// A stroke, which is the motion of a tool over time, as a CSV file, and carving along it with a rigid hand.
//
// Columns, named in the first line in this order: time_s, x_m, y_m, z_m, qx, qy, qz, qw, button. Positions are in the
// object frame, metres; the quaternion turns tool into object (x, y, z, w; any length but zero). In its place axis_x,
// axis_y, axis_z, angle_rad are an axis of any length and an angle (Rodrigues). button is 1 while the tool works and 0
// while it only moves. Times rise from row to row. Lines that start with # and empty lines are skipped.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "base/space.hpp"
#include "sculpt/sculpture.hpp"
#include "toolbox/tool_options.hpp"

namespace burin::sculpt {

struct StrokeRow {
    double time_s = 0.0;
    Vec3 position_object_m{0.0};
    Quat orientation_object{1.0, 0.0, 0.0, 0.0};  // unit length
    bool button = false;
};

using Stroke = std::vector<StrokeRow>;

// Reads a stroke of at least one row. An Error names the file and the line.
[[nodiscard]] Result<Stroke> read_stroke(const std::filesystem::path& path);
[[nodiscard]] Result<Stroke> parse_stroke(std::string_view text, const std::string& name);

// Carves along the stroke (--hand rigid): the tool follows it exactly, without device or forces. A pressed row sweeps
// the tool from the row before if that was pressed too, else it stamps the tool where it is. Each sweep is an update.
// With merge_rows, a straight sweep replaces rows of one orientation that it follows to within the tool's tolerance;
// without, every pressed row is a sweep. Shows its progress on standard error.
[[nodiscard]] Result<void> carve_rigidly(Sculpture& sculpture, const Stroke& stroke, const toolbox::Tool& tool,
                                         bool merge_rows);

}  // namespace burin::sculpt
