// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_EXT_buffer_reference : require
// Marks the cells that the rays changed by a cut can have altered (cells_changed in shaders/shared/mesh_tile.h), and
// lists the tiles that see them: one invocation per ray, or per several where a cut may have changed very many. A tile
// that gets no row or no slot is missed, and the host then makes all cells of the update.
#include "shaders/shared/cut_job.h"
#include "shaders/cell_buffers.glsl"

layout(local_size_x = 64) in;
layout(std430, binding = 12) readonly buffer CutCount { CutCounters cut; };
layout(std430, binding = 13) readonly buffer Changed { ChangedRay changed[]; };

const uint kNoRow = 0xffffffffu;
const uint kMostProbes = 32u;

// Returns the tile's row of marked cells; the first to ask for it puts the tile on the list.
uint row_of(uint tile) {
    uint at = tile * 0x9e3779b1u >> 8;
    uint row = kNoRow;
    bool is_first = false;
    uint probe = 0u;
    do {
        uint next = at++ & (parameters.mask_rows - 1u);
        uint key = masks[next].key;
        if (key == 0u) {
            key = atomicCompSwap(masks[next].key, 0u, tile + 1u);
            is_first = key == 0u;
        }
        if (is_first || key == tile + 1u) row = next;
    } while (row == kNoRow && ++probe < kMostProbes);
    bool has_slot = row != kNoRow;
    if (is_first) {
        uint slot = atomicAdd(counters.tiles, 1u);
        has_slot = slot < parameters.slots;
        if (has_slot) {
            tiles[slot].tile = tile;
            tiles[slot].mask = row;
            atomicAdd(counters.tile_groups[0], 1u);
        }
    }
    if (!has_slot) atomicAdd(counters.missed, 1u);
    return row;
}

void mark_around(ChangedRay ray) {
    CellRange cells = cells_changed(axis_of(ray.ray), u_of(ray.ray), v_of(ray.ray), ray.changed_lo, ray.changed_hi);
    ivec3 lo = ivec3(cells.lo[0], cells.lo[1], cells.lo[2]);
    ivec3 hi = ivec3(cells.hi[0], cells.hi[1], cells.hi[2]);
    ivec3 last = ivec3(parameters.nodes[0], parameters.nodes[1], parameters.nodes[2]) - 1;
    ivec3 from = clamp(lo, ivec3(0), last) / kMeshTile;
    ivec3 to = clamp(hi + 1, ivec3(0), last) / kMeshTile;  // the tile above sees the cell too
    // One loop over all tiles and one over all columns, with the conditions at their ends: software drivers turn each
    // loop as often as the busiest of eight lanes needs, and once more where the condition comes first.
    ivec3 tiles_near = to - from + 1;
    int i = 0;
    do {
        ivec3 at = from + ivec3(i % tiles_near.x, i / tiles_near.x % tiles_near.y, i / (tiles_near.x * tiles_near.y));
        CellRange seen = cells_seen(cells, at.x, at.y, at.z);
        int wide = seen.hi[0] - seen.lo[0] + 1;
        int columns = wide * (seen.hi[1] - seen.lo[1] + 1);
        if (seen.lo[2] > seen.hi[2]) continue;
        uint row = row_of(uint((at.z * parameters.tiles[1] + at.y) * parameters.tiles[0] + at.x));
        if (row == kNoRow || wide <= 0 || columns <= 0) continue;
        uint bits = cells_between(seen.lo[2], seen.hi[2]);
        int c = 0;
        do {
            atomicOr(masks[row].columns[cell_column(seen.lo[0] + c % wide, seen.lo[1] + c / wide)], bits);
        } while (++c < columns);
    } while (++i < tiles_near.x * tiles_near.y * tiles_near.z);
}

void main() {
    uint number = gl_GlobalInvocationID.x;
    if (number >= cut.changed) return;
    do {
        mark_around(changed[number]);
        number += gl_NumWorkGroups.x * uint(kCellGroup);
    } while (number < cut.changed);
}
