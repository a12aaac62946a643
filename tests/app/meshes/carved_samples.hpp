// SPDX-License-Identifier: MIT
// Carved parts for tests of what their files hold: every kind of tool, turned, on blocks, balls and a part from a file.
#pragma once

#include <string>
#include <vector>

#include "tests/support/run_command.hpp"

namespace burin::app {

struct CarvedSample {
    std::string name;
    std::string options;  // of burin sculpt: workpiece, tool and what it does; metres
    std::string stroke;   // its CSV
    int resolution = 128;
};

// Returns ten parts, finer from one to the next: 128 to 512 cells along the longest side.
[[nodiscard]] std::vector<CarvedSample> carved_samples();

// Writes the files that the samples name: a mesh as a workpiece and one as a tool.
void write_meshes_of_samples(const Workplace& place);

// Carves the sample and exports it in the unit as NAME-UNIT.stl, .ply and .obj; the report is NAME-UNIT.json.
[[nodiscard]] Workplace::Outcome carve_sample(const Workplace& place, const CarvedSample& sample,
                                              const std::string& unit);

}  // namespace burin::app
