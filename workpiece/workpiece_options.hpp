// SPDX-License-Identifier: MIT
// What is carved, as --workpiece and --resolution name it. Lengths in metres. Plain data.
#pragma once

#include <optional>
#include <string>

#include "base/error.hpp"
#include "base/length_unit.hpp"

namespace burin::workpiece {

// Default room on every side of a workpiece, as a share of its longest side.
inline constexpr double kUsualRoom = 0.15;

struct WorkpieceOptions {
    std::string source = "ball:0.1";  // FILE | block:X,Y,Z | ball:R
    int resolution = 256;             // lattice cells along the longest side
    // Empty room on every side for what is added, as a share of the longest side. None: where it is not settled.
    std::optional<double> room = std::nullopt;
    bool close_holes = false;
    bool close_small_holes = false;  // where none of them is larger around than the mesh's shortest side
    std::optional<LengthUnit> units = std::nullopt;  // of a file; none: as it states, else guessed (mesh_unit.hpp)
    std::optional<double> weld_m = std::nullopt;     // of a file; none: by its numbers (join_open_edges)
};

// Returns whether the source is a shape, whose sizes are in metres, and no file.
[[nodiscard]] bool is_shape(const std::string& source);
// Checks whether --units has a mesh file to speak of: sizes of shapes are in metres.
[[nodiscard]] Result<void> check_units(const WorkpieceOptions& options, bool tool_is_a_file);

}  // namespace burin::workpiece
