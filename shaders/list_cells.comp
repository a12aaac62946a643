// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_EXT_buffer_reference : require
// Finds what is to be made in a tile, one work group per tile: the signs of its nodes from the z rays, which of its
// marked cells touch one of its own crossed edges, and all crossed edges of those; allocates entries for them in the
// lists of the following stages. What is listed of a tile is in the order of the columns.
#include "shaders/cell_buffers.glsl"

layout(local_size_x = 64) in;

shared uint signs[kNodeColumns];
shared uint made[kCellColumns];  // the marked cells, then those of them that are needed
shared uint cell_sums[kCellGroup];
shared uint edge_sums[3 * kCellGroup];  // axis by axis; numbers of own edges from bit 16 on
shared uint any_inside;
shared uint all_inside;
shared uint first_cell;
shared uint first_edge;
shared uint first_own;
shared uint fits;
shared uint cells_asked;
shared uint edges_asked;

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
uint made_cells_of(int x, int y) {
    if (x < -1 || y < -1 || x >= kMeshTile || y >= kMeshTile) return 0u;
    return made[cell_column(x, y)];
}

// Returns the crossed edges that start in a column of nodes, along each axis.
uvec3 crossed_edges(int x, int y) {
    uint bits = signs[node_column(x, y)];
    uint along_x = x < kMeshTile ? bits ^ signs[node_column(x + 1, y)] : 0u;
    uint along_y = y < kMeshTile ? bits ^ signs[node_column(x, y + 1)] : 0u;
    return uvec3(along_x, along_y, crossed_upwards(bits));
}
// Returns the edges of the cells to make that start in a column of nodes, crossed or not.
uvec3 edges_of_made(int x, int y) {
    uint here = made_cells_of(x, y);
    uint left = made_cells_of(x - 1, y);
    uint low = made_cells_of(x, y - 1);
    uint across = made_cells_of(x - 1, y - 1);
    return uvec3(level_edges_of(here | low), level_edges_of(here | left), here | left | low | across);
}

// Reads the signs, tells the host of them, and reads and frees the tile's row of marked cells.
void load(uint slot, int lane) {
    uint tile = tiles[slot].tile;
    ivec3 node = first_node(tile);
    uint any_of_lane = 0u;
    uint all_of_lane = 0xffffffffu;
    // Each lane has a column at least; a condition at the end saves software drivers a turn.
    int c = lane;
    do {
        ray = ray_at(2, node.x + c % kMeshNodes - 1, node.y + c / kMeshNodes - 1);
        uint bits = node_bits(count_of(ray), node.z);
        signs[c] = bits;
        made_tiles[slot].signs[c] = bits;
        any_of_lane |= bits;
        all_of_lane &= bits;
        c += kCellGroup;
    } while (c < kNodeColumns);
    atomicOr(any_inside, any_of_lane);
    atomicAnd(all_inside, all_of_lane);
    uint row = tiles[slot].mask;
    c = lane;
    do {
        made[c] = masks[row].columns[c];
        masks[row].columns[c] = 0u;
        c += kCellGroup;
    } while (c < kCellColumns);
    if (lane == 0) masks[row].key = 0u;
}

// Allocates what the tile needs of the lists, and tells the host of the tile.
void allocate(uint slot, uint all_cells, uint all_edges, uint all_own) {
    first_cell = atomicAdd(counters.cells, all_cells);
    first_edge = atomicAdd(counters.edges, all_edges);
    first_own = atomicAdd(counters.own_edges, all_own);
    cells_asked = all_cells;
    edges_asked = all_edges;
    fits = first_cell + all_cells <= parameters.most_cells && first_edge + all_edges <= parameters.most_edges &&
                   first_own + all_own <= parameters.most_own_edges
               ? 1u
               : 0u;
    atomicMax(counters.cell_groups[0], (min(first_cell + all_cells, parameters.most_cells) + 63u) / 64u);
    atomicMax(counters.edge_groups[0], (min(first_edge + all_edges, parameters.most_edges) + 63u) / 64u);
    made_tiles[slot].tile = tiles[slot].tile;
    made_tiles[slot].left = 1u - fits;
    made_tiles[slot].first_cell = first_cell;
    made_tiles[slot].cells = all_cells;
    made_tiles[slot].first_edge = first_own;
    made_tiles[slot].edges = all_own;
}

void main() {
    uint slot = gl_WorkGroupID.x;
    int lane = int(gl_LocalInvocationID.x);
    if (lane == 0) {
        any_inside = 0u;
        all_inside = 0xffffffffu;
    }
    barrier();
    load(slot, lane);
    barrier();
    bool has_surface = any_inside != 0u && all_inside != (1u << uint(kMeshNodes)) - 1u;
    int cell_columns = has_surface ? kCellColumns : 0;
    int node_columns = has_surface ? kNodeColumns : 0;
    int c = lane;
    do {
        made[c] &= has_surface ? needed_cells(c % kMeshCells - 1, c / kMeshCells - 1) : 0u;
        c += kCellGroup;
    } while (c < kCellColumns);
    barrier();
    // Each lane counts adjacent columns, so that the lists are in the order of the columns.
    const int kCellShare = (kCellColumns + kCellGroup - 1) / kCellGroup;
    const int kNodeShare = (kNodeColumns + kCellGroup - 1) / kCellGroup;
    int cells_from = lane * kCellShare;
    int cells_to = min(cells_from + kCellShare, cell_columns);
    int nodes_from = lane * kNodeShare;
    int nodes_to = min(nodes_from + kNodeShare, node_columns);
    uint cell_sum = 0u;
    uvec3 edge_sum = uvec3(0u);
    uint edge_bits[3 * kNodeShare];  // axis by axis
    uint busy = 0u;                  // which of them are not 0
    for (int i = cells_from; i < cells_to; ++i) cell_sum += uint(bitCount(made[i]));
    for (int i = 0; i < kNodeShare; ++i) {
        int n = nodes_from + i;
        int x = n % kMeshNodes - 1;
        int y = n / kMeshNodes - 1;
        uvec3 edges_here = n < nodes_to ? crossed_edges(x, y) & edges_of_made(x, y) : uvec3(0u);
        uint own_nodes = own(x, y) ? kOwnNodes : 0u;
        for (int axis = 0; axis < 3; ++axis) {
            edge_bits[axis * kNodeShare + i] = edges_here[axis];
            busy |= (edges_here[axis] != 0u ? 1u : 0u) << (axis * kNodeShare + i);
        }
        edge_sum += uvec3(bitCount(edges_here)) + (uvec3(bitCount(edges_here & own_nodes)) << 16);
    }
    cell_sums[lane] = cell_sum;
    for (int axis = 0; axis < 3; ++axis) edge_sums[axis * kCellGroup + lane] = edge_sum[axis];
    barrier();
    if (lane == 0) {
        uint all_cells = 0u;
        uint all_edges = 0u;
        for (int i = 0; i < kCellGroup; ++i) {
            uint of_lane = cell_sums[i];
            cell_sums[i] = all_cells;
            all_cells += of_lane;
        }
        for (int i = 0; i < 3 * kCellGroup; ++i) {
            uint of_lane = edge_sums[i];
            edge_sums[i] = all_edges;
            all_edges += of_lane;
        }
        allocate(slot, all_cells, all_edges & 0xffffu, all_edges >> 16);
    }
    barrier();
    // The entries of a failed allocation may lie between those of other tiles and hold an older update's data: void
    // them.
    if (fits == 0u) {
        uint end_of_cells = min(first_cell + cells_asked, parameters.most_cells);
        uint end_of_edges = min(first_edge + edges_asked, parameters.most_edges);
        for (uint i = first_cell + uint(lane); i < end_of_cells; i += uint(kCellGroup)) cells[i].what.x = kNoSlot;
        for (uint i = first_edge + uint(lane); i < end_of_edges; i += uint(kCellGroup)) edges[i].what.x = kNoSlot;
        return;
    }
    uint at = first_cell + cell_sums[lane];
    for (int i = cells_from; i < cells_to; ++i) {
        uint bits = made[i];
        if (bits == 0u) continue;
        int column = node_column(i % kMeshCells - 1, i / kMeshCells - 1);
        uint p00 = signs[column];
        uint p10 = signs[column + 1];
        uint p01 = signs[column + kMeshNodes];
        uint p11 = signs[column + kMeshNodes + 1];
        do {
            int bit = findLSB(bits);
            bits &= bits - 1u;
            uint pattern = corner_pattern(p00, p10, p01, p11, uint(bit));
            cells[at++].what = uvec2(slot, uint(i * kMeshCells + bit) | pattern << 16);
        } while (bits != 0u);
    }
    // One loop over all entries of the lane: software drivers turn each loop as often as the busiest of eight lanes.
    uint left = 0u;
    uint own_place = 0u;
    uint inside = 0u;
    uint own_nodes = 0u;
    ivec3 column = ivec3(0);
    int last_axis = -1;
    while ((busy | left) != 0u) {
        if (left == 0u) {  // the first entry of an empty column is never read
            int k = findLSB(busy);
            busy &= busy - 1u;
            int axis = k / kNodeShare;
            int n = nodes_from + k % kNodeShare;
            left = edge_bits[k];
            inside = signs[n];
            column = ivec3(n % kMeshNodes - 1, n / kMeshNodes - 1, axis);
            own_nodes = own(column.x, column.y) ? kOwnNodes : 0u;
            if (axis != last_axis) {
                uint sum = edge_sums[axis * kCellGroup + lane];
                at = first_edge + (sum & 0xffffu);
                own_place = first_own + (sum >> 16);
                last_axis = axis;
            }
            tiles[slot].edge_columns[axis * kNodeColumns + n] = uvec2(left, at);
        }
        int bit = findLSB(left);
        left &= left - 1u;
        bool is_own = (own_nodes >> uint(bit) & 1u) != 0u;
        uint place = edge_place(column.z, ivec3(column.xy, bit - 1), inside >> bit & 1u);
        edges[at++].what = uvec4(slot, place, is_own ? own_place : kNotOwn, 0u);
        own_place += is_own ? 1u : 0u;
    }
}
