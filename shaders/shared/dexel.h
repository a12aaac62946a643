// SPDX-License-Identifier: MIT
// The data of the tri-dexel solid, as CPU and GPU both store it.
//
// Lattice units: a lattice cell is kUnitsPerCell = 4096 units wide; every coordinate and depth of the solid is a whole
// number of units, counted from the lattice origin. A depth takes 24 bits, so a lattice has at most 4095 cells an axis.
// Each axis a = 0, 1, 2 (x, y, z) has one set of rays along it, through the lattice nodes (u, v), where u runs along
// axis (a + 1) % 3 and v along axis (a + 2) % 3; s is the depth along axis a. The index of ray (u, v) is
// u + v * (cells_u + 1).
//
// A ray holds sorted ends e0 < e1 < e2 ..., an even number of them: material fills e0..e1, e2..e3, and so on. A node at
// depth d is inside when e(2i) <= d < e(2i + 1).
#ifndef BURIN_SHARED_DEXEL_H
#define BURIN_SHARED_DEXEL_H
#include "shaders/shared/portable.h"

BURIN_SHARED_BEGIN

const int kSubcellBits = 12;
const int kUnitsPerCell = 4096;
const int kMaxCells = 4095;
const int kMaxDepth = 0xffffff;

// One end of an interval: 8 bytes.
struct DexelEnd {
    uint depth_material;  // depth in the low 24 bits, material in the high 8
    uint normal;          // octahedral.h; points out of the material
};

// The location of a ray's ends in its set's store: 8 bytes.
struct RayRef {
    uint first;
    // Low 24 bits: number of ends; the 8 above: log2 of the number of ends allocated for them.
    uint count_room;
};

BURIN_FN DexelEnd make_end(int depth, uint material, uint normal) {
    DexelEnd end;
    end.depth_material = uint(depth) | (material << 24);
    end.normal = normal;
    return end;
}

BURIN_FN int depth_of(DexelEnd end) { return int(end.depth_material & uint(0xffffff)); }
BURIN_FN uint material_of(DexelEnd end) { return end.depth_material >> 24; }
BURIN_FN uint count_of(RayRef ray) { return ray.count_room & uint(0xffffff); }
BURIN_FN uint room_of(RayRef ray) { return uint(1) << (ray.count_room >> 24); }

// The whole depths lo..hi of a ray that a tool covers; empty when lo > hi.
struct RaySpan {
    int lo;
    int hi;
};

BURIN_SHARED_END

#ifdef __cplusplus
static_assert(sizeof(burin::shared::DexelEnd) == 8 && sizeof(burin::shared::RayRef) == 8);
#endif
#endif
