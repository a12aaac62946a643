// SPDX-License-Identifier: MIT
// burin combine A B: two closed meshes into one, as solids on a lattice that holds both.
#pragma once

#include <string>
#include <vector>

#include "base/error.hpp"
#include "compute/combine.hpp"

namespace burin {

struct CombineOptions {
    std::string a, b;  // STL, OBJ, PLY, OFF
    Combination operation = Combination::unite;
    int resolution = 256;  // cells along the longest side of both together
    bool close_holes = false;
    std::vector<std::string> exports;  // STL, PLY, OBJ
    std::string report;                // a JSON file; empty: none
    unsigned threads = 0;              // 0: one per core
};

// Writes nothing before all input has been read and the result is known not to be empty.
[[nodiscard]] Result<void> combine_files(const CombineOptions& options);

}  // namespace burin
