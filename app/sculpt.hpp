// SPDX-License-Identifier: MIT
// burin sculpt: a workpiece, a tool and a stroke in; a carved mesh, pictures and a report out.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/feel_options.hpp"
#include "app/session/session_options.hpp"
#include "app/tool_option.hpp"
#include "app/workpiece.hpp"

namespace burin {

enum class EngineChoice { automatic, cpu, vulkan };
enum class HandChoice { rigid, simulated };

struct SculptOptions {
    WorkpieceOptions workpiece;
    ToolOptions tool;
    std::string stroke;      // a CSV file; empty: nothing is carved
    bool merge_rows = true;  // with a rigid hand: nearly straight runs of rows are one sweep
    EngineChoice engine = EngineChoice::automatic;
    HandChoice hand = HandChoice::rigid;
    FeelOptions feel;  // with a simulated hand
    bool real_time = false;
    std::size_t undo = 0;                // strokes to take back at the end, from press to release
    std::size_t undo_memory_MiB = 1024;  // for the strokes that can be taken back
    std::vector<std::string> exports;    // STL, PLY, OBJ
    std::optional<double> simplify_m;    // how far the exported surface may move; none: all triangles
    std::string pictures;                // a folder; empty: none
    std::string report;                  // a JSON file; empty: none. Plots of what was felt go beside it
    unsigned threads = 0;                // 0: one per core
    LiveOptions live;
};

// Writes nothing before all input has been read and all output places have been looked at.
[[nodiscard]] Result<void> sculpt(const SculptOptions& options);

// burin convert IN OUT: any mesh format in, STL, PLY or OBJ out; prints the mesh's health.
struct ConvertOptions {
    std::string in, out;
    bool close_holes = false;
    std::optional<double> simplify_m;  // how far the surface may move
};
[[nodiscard]] Result<void> convert(const ConvertOptions& options);

// burin --version: the version, and the Vulkan devices found.
void print_version();

}  // namespace burin
