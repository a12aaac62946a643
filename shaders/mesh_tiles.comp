// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_EXT_buffer_reference : require
// Finds what is to be meshed in a tile, one work group per tile: the signs of its nodes from the z rays, the cells that
// its own crossed edges touch, and all crossed edges of these cells; allocates entries for them in the lists of the
// following stages.
#include "shaders/mesh_buffers.glsl"

layout(local_size_x = 64) in;

shared uint signs[kNodeColumns];
shared uint needed[kCellColumns];
shared uint cell_sums[kMeshGroup];
shared uint edge_sums[3 * kMeshGroup];  // axis by axis
shared uint quad_sums[3 * kMeshGroup];
shared uint first_cell;
shared uint first_edge;
shared uint fits;
shared uint cells_asked;
shared uint edges_asked;
shared uint any_inside;
shared uint all_inside;

RayRef ray;
DexelEnd load_end(uint index) { return store.at[ray.first + index]; }
#include "shaders/shared/ray_crossing.h"

bool own(int x, int y) { return x >= 0 && y >= 0 && x < kMeshTile && y < kMeshTile; }
// Returns the cells of a column that touch own crossed edges. An edge is own when it starts at an own node.
uint needed_cells(int x, int y) {
    int column = node_column(x, y);
    uint low = signs[column];
    uint right = signs[column + 1];
    uint upper = signs[column + kMeshNodes];
    uint across = signs[column + kMeshNodes + 1];
    uint at_low = own(x, y) ? kOwnNodes : 0u;
    uint at_right = own(x + 1, y) ? kOwnNodes : 0u;
    uint at_upper = own(x, y + 1) ? kOwnNodes : 0u;
    uint at_across = own(x + 1, y + 1) ? kOwnNodes : 0u;
    uint sideways = ((low ^ right) | (low ^ upper)) & at_low;
    sideways |= (upper ^ across) & at_upper;
    sideways |= (right ^ across) & at_right;
    uint upright = (crossed_upwards(low) & at_low) | (crossed_upwards(right) & at_right) |
                   (crossed_upwards(upper) & at_upper) | (crossed_upwards(across) & at_across);
    return cells_beside_edges(sideways, upright);
}
uint cells_at(int x, int y) {
    return x >= -1 && y >= -1 && x < kMeshTile && y < kMeshTile ? needed[cell_column(x, y)] : 0u;
}

// Returns the crossed edges of these cells that start in a column of nodes, along each axis.
uvec3 needed_edges(int x, int y) {
    uint here = cells_at(x, y);
    uint left = cells_at(x - 1, y);
    uint low = cells_at(x, y - 1);
    uint across = cells_at(x - 1, y - 1);
    uint bits = signs[node_column(x, y)];
    uint along_x = x < kMeshTile ? bits ^ signs[node_column(x + 1, y)] : 0u;
    uint along_y = y < kMeshTile ? bits ^ signs[node_column(x, y + 1)] : 0u;
    return uvec3(along_x & level_edges_of(here | low), along_y & level_edges_of(here | left),
                 crossed_upwards(bits) & (here | left | low | across));
}

void main() {
    uint slot = gl_WorkGroupID.x;
    int lane = int(gl_LocalInvocationID.x);
    uint tile = dirty[slot];
    ivec3 node = first_node(tile);
    if (lane == 0) {
        any_inside = 0u;
        all_inside = 0xffffffffu;
    }
    barrier();
    uint any_of_lane = 0u;
    uint all_of_lane = 0xffffffffu;
    for (int c = lane; c < kNodeColumns; c += kMeshGroup) {
        ray = ray_at(2, node.x + c % kMeshNodes - 1, node.y + c / kMeshNodes - 1);
        uint bits = node_bits(count_of(ray), node.z);
        signs[c] = bits;
        jobs[slot].signs[c] = bits;
        any_of_lane |= bits;
        all_of_lane &= bits;
    }
    atomicOr(any_inside, any_of_lane);
    atomicAnd(all_inside, all_of_lane);
    barrier();
    // Most tiles of a solid are empty or full and have nothing to count.
    bool has_surface = any_inside != 0u && all_inside != (1u << uint(kMeshNodes)) - 1u;
    int cell_columns = has_surface ? kCellColumns : 0;
    int node_columns = has_surface ? kNodeColumns : 0;
    for (int c = lane; c < cell_columns; c += kMeshGroup) {
        needed[c] = needed_cells(c % kMeshCells - 1, c / kMeshCells - 1);
    }
    barrier();
    // Each lane counts adjacent columns, so that the lists are in the order of the columns.
    const int kCellShare = (kCellColumns + kMeshGroup - 1) / kMeshGroup;
    const int kNodeShare = (kNodeColumns + kMeshGroup - 1) / kMeshGroup;
    int cells_from = lane * kCellShare;
    int cells_to = min(cells_from + kCellShare, cell_columns);
    int nodes_from = lane * kNodeShare;
    int nodes_to = min(nodes_from + kNodeShare, node_columns);
    uint cell_sum = 0u;
    uvec3 edge_sum = uvec3(0u);
    uvec3 quad_sum = uvec3(0u);
    uvec3 edge_bits[kNodeShare];
    for (int c = cells_from; c < cells_to; ++c) cell_sum += uint(bitCount(needed[c]));
    for (int i = 0; i < kNodeShare; ++i) {
        int c = nodes_from + i;
        int x = c % kMeshNodes - 1;
        int y = c / kMeshNodes - 1;
        edge_bits[i] = uvec3(0u);
        if (c < nodes_to) edge_bits[i] = needed_edges(x, y);
        edge_sum += uvec3(bitCount(edge_bits[i]));
        quad_sum += own(x, y) ? uvec3(bitCount(edge_bits[i] & kOwnNodes)) : uvec3(0u);
    }
    cell_sums[lane] = cell_sum;
    for (int axis = 0; axis < 3; ++axis) {
        edge_sums[axis * kMeshGroup + lane] = edge_sum[axis];
        quad_sums[axis * kMeshGroup + lane] = quad_sum[axis];
    }
    barrier();
    if (lane == 0) {
        uint all_cells = 0u;
        uint all_edges = 0u;
        uint all_quads = 0u;
        for (int i = 0; i < kMeshGroup; ++i) {
            uint c = cell_sums[i];
            cell_sums[i] = all_cells;
            all_cells += c;
        }
        for (int i = 0; i < 3 * kMeshGroup; ++i) {
            uint e = edge_sums[i];
            uint q = quad_sums[i];
            edge_sums[i] = all_edges;
            quad_sums[i] = all_quads;
            all_edges += e;
            all_quads += q;
        }
        first_cell = atomicAdd(counters.cells, all_cells);
        first_edge = atomicAdd(counters.edges, all_edges);
        fits = first_cell + all_cells <= parameters.most_cells && first_edge + all_edges <= parameters.most_edges
                   ? 1u
                   : 0u;
        cells_asked = all_cells;
        edges_asked = all_edges;
        if (fits == 1u) {
            atomicMax(counters.cell_groups[0], (first_cell + all_cells + 63u) / 64u);
            atomicMax(counters.edge_groups[0], (first_edge + all_edges + 63u) / 64u);
        }
        jobs[slot].tile = tile;
        jobs[slot].first_cell = first_cell;
        jobs[slot].cells = fits == 1u ? all_cells : 0u;
        jobs[slot].first_edge = first_edge;
        jobs[slot].edges = fits == 1u ? all_edges : 0u;
        jobs[slot].quads = all_quads;
        jobs[slot].extras = 0u;
        jobs[slot].extras_made = 0u;
        jobs[slot].cell_vertices = 0u;
        jobs[slot].waits = 1u - fits;
        jobs[slot].disagreeing = 0u;
    }
    barrier();
    // The entries of a failed allocation may lie between those of other tiles and hold an older frame's data: void
    // them.
    if (fits == 0u) {
        uint end_of_cells = min(first_cell + cells_asked, parameters.most_cells);
        uint end_of_edges = min(first_edge + edges_asked, parameters.most_edges);
        for (uint i = first_cell + uint(lane); i < end_of_cells; i += uint(kMeshGroup)) cells[i].what.x = kNoSlot;
        for (uint i = first_edge + uint(lane); i < end_of_edges; i += uint(kMeshGroup)) edges[i].what.x = kNoSlot;
    }
    uint at = first_cell + cell_sums[lane];
    for (int c = fits == 1u ? cells_from : cells_to; c < cells_to; ++c) {
        uint bits = needed[c];
        jobs[slot].cell_columns[c] = uvec2(bits, at);
        int column = node_column(c % kMeshCells - 1, c / kMeshCells - 1);
        uint p00 = signs[column];
        uint p10 = signs[column + 1];
        uint p01 = signs[column + kMeshNodes];
        uint p11 = signs[column + kMeshNodes + 1];
        for (; bits != 0u; bits &= bits - 1u) {
            int bit = findLSB(bits);
            uint pattern = corner_pattern(p00, p10, p01, p11, uint(bit));
            cells[at].what = uvec4(slot, uint(c * kMeshCells + bit) | pattern << 16, 0u, 0u);
            ++at;
        }
    }
    for (int axis = 0; axis < 3; ++axis) {
        at = first_edge + edge_sums[axis * kMeshGroup + lane];
        uint quad = quad_sums[axis * kMeshGroup + lane];
        for (int i = 0; i < kNodeShare; ++i) {
            uint bits = fits == 1u ? edge_bits[i][axis] : 0u;
            if (bits == 0u) continue;  // the first entry of an empty column is never read
            int c = nodes_from + i;
            int x = c % kMeshNodes - 1;
            int y = c / kMeshNodes - 1;
            uint inside = signs[c];
            jobs[slot].edge_columns[axis * kNodeColumns + c] = uvec2(bits, at);
            do {
                int bit = findLSB(bits);
                bool is_own = own(x, y) && (kOwnNodes >> bit & 1u) != 0u;
                edges[at].what = uvec4(slot, edge_place(axis, ivec3(x, y, bit - 1), inside >> bit & 1u),
                                       is_own ? quad : kNotOwn, 0u);
                quad += is_own ? 1u : 0u;
                ++at;
                bits &= bits - 1u;
            } while (bits != 0u);
        }
    }
}
