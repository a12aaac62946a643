// SPDX-License-Identifier: MIT
// burin convert IN OUT: any mesh format in, STL, PLY or OBJ out; prints the mesh's size and health. A document likewise
// (app/meshes/document_command.hpp). Of a session file:
// burin convert FILE.session [OUT] --to csv|npy|hdf5|mat|bids|log (app/recordings/session_export.hpp).
#pragma once

#include <optional>
#include <string>

#include "app/cli/command_table.hpp"
#include "base/error.hpp"
#include "base/length_unit.hpp"
#include "base/space.hpp"
#include "document/document_file.hpp"

namespace burin::app {

struct ConvertOptions {
    std::string in, out;
    std::optional<LengthUnit> units;         // of IN; none: as the file states, else guessed (mesh_unit.hpp)
    std::optional<LengthUnit> export_units;  // of OUT; none: those of IN
    bool close_holes = false;
    std::optional<double> weld_m;                // corners at open edges that are joined; none: with close_holes alone
    std::optional<double> simplify_m;            // bound on the surface's motion; none: all triangles
    bool center = false;                         // as a place of 0,0,0
    std::optional<Vec3> place_m;                 // where the middle of the mesh's box goes; none: it stays
    std::optional<double> scale;                 // none: 1
    std::string to;                              // format of a session file's table; empty: IN is a mesh
    std::string columns, part, trials;           // of that table
    std::string subject = "01", task = "touch";  // labels of a BIDS data set

    [[nodiscard]] bool is_of_session() const { return !to.empty(); }
    [[nodiscard]] bool is_of_document() const { return document::is_document_name(in); }
    [[nodiscard]] bool is_misused() const { return out.empty() && to.empty(); }
};
[[nodiscard]] CommandRow convert_row();

}  // namespace burin::app
