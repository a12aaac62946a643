// SPDX-License-Identifier: MIT
#include "workpiece/loaded_workpiece.hpp"

namespace burin::workpiece {

Box lattice_bounds(const compute::Lattice& lattice) {
    const Vec3 size = Vec3(lattice.cells[0], lattice.cells[1], lattice.cells[2]) * lattice.spacing_m;
    return {lattice.origin_object, lattice.origin_object + size};
}

Box workpiece_bounds(const compute::Lattice& lattice) {
    // The lattice has about one and a half empty cells around the workpiece.
    const Vec3 inset(1.5 * lattice.spacing_m);
    const Box all = lattice_bounds(lattice);
    return {all.lo + inset, all.hi - inset};
}

}  // namespace burin::workpiece
