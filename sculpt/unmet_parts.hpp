// SPDX-License-Identifier: MIT
// What no ray of a solid met: pins and tips that pass between the rays, so that the solid is shorter than its mesh. The
// bounds of both are compared; a part within the solid's bounds is not found. Metres, object frame. Any thread.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/json.hpp"
#include "compute/rays/solid.hpp"
#include "geometry/mesh/triangle_mesh.hpp"

namespace burin::sculpt {

// What a mesh has beyond its solid on one side, by more than a cell.
struct UnmetPart {
    int axis = 0;  // x, y, z
    bool is_upper = true;
    double length_m = 0.0;  // by which the mesh reaches farther
    double width_m = 0.0;   // of what lies there: of a square pin its side, 4 volume / area
};

// Finds them by sides: -x, +x, -y, ... The mesh is closed and faces outwards.
[[nodiscard]] std::vector<UnmetPart> find_unmet_parts(const geometry::TriangleMesh& mesh, const compute::Solid& solid);
// Returns the resolution at which the rays meet them all; nothing where no lattice is so fine.
[[nodiscard]] std::optional<int> resolution_that_meets(const std::vector<UnmetPart>& parts,
                                                       const compute::Lattice& lattice);
// Says it in words, empty where there are none: "no ray met what reaches 20 mm farther along +z (a cell is 1.562 mm
// wide), which --resolution 490 keeps".
[[nodiscard]] std::string in_words(const std::vector<UnmetPart>& parts, const compute::Lattice& lattice);
[[nodiscard]] Json describe(const std::vector<UnmetPart>& parts, const compute::Lattice& lattice);

}  // namespace burin::sculpt
