// SPDX-License-Identifier: MIT
// Options of carving: what is carved, by which engine, how it feels, what leaves; and those of a stroke that is carved
// without a person.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/length_unit.hpp"
#include "compute/engine/chosen_engine.hpp"
#include "toolbox/feel_options.hpp"
#include "toolbox/mirror.hpp"
#include "workpiece/workpiece_maker.hpp"
#include "workpiece/workpiece_options.hpp"

namespace burin::session {

// How the surface is exported.
struct ExportOptions {
    std::vector<std::string> files;                  // STL, PLY, OBJ
    std::optional<LengthUnit> units = std::nullopt;  // none: those of the workpiece's file, metres for a shape
    std::optional<double> simplify_m;                // bound on the surface's motion; none: all triangles
    std::optional<double> crumbs_m;  // size below which loose pieces are not exported; none: as usual_crumbs says
    bool usual_crumbs = false;       // kCrumbCells; else all are kept. No option of the command line
};

enum class HandChoice { rigid, simulated };

// A stroke that is carved without a session.
struct StrokeOptions {
    std::string file;        // CSV; empty: nothing is carved
    bool merge_rows = true;  // with a rigid hand: merge nearly straight runs of rows into one sweep
    HandChoice hand = HandChoice::rigid;
    bool real_time = false;
    std::size_t undo = 0;  // strokes to undo at the end, from press to release
    std::string pictures;  // a folder; empty: none
    std::string report;    // a JSON file; empty: none; plots of the felt stroke lie beside it
};

struct CarveOptions {
    workpiece::WorkpieceOptions workpiece;
    toolbox::Mirror mirror;  // planes on whose other sides the tool works as well
    compute::EngineChoice engine = compute::EngineChoice::automatic;
    // Makes it; none: the processor's, and a device that is asked for is refused. No option of the command line.
    compute::EngineMaker make_engine;
    // Makes the workpiece (sculpt/carved_workpiece.hpp); none: there can be none. No option of the command line.
    workpiece::WorkpieceMaker make_workpiece;
    toolbox::FeelOptions feel;           // press and grip: of a simulated hand
    std::size_t undo_memory_MiB = 1024;  // memory for strokes that can be undone
    ExportOptions exports;
    StrokeOptions stroke;
};

}  // namespace burin::session
