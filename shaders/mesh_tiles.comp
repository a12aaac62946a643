// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_EXT_buffer_reference : require
// Finds what is to be meshed in a tile, one work group per tile: the signs of its nodes from the z rays, the cells that
// its own crossed edges touch, which of them are made anew, all crossed edges of those, and the quads between others;
// allocates entries for them in the lists of the following stages. A cell that no changed ray reaches is kept: it was
// needed before if it is needed now, since its corners are what they were.
#include "shaders/mesh_buffers.glsl"

layout(local_size_x = 64) in;

shared uint signs[kNodeColumns];
shared uint needed[kCellColumns];
shared uint changed[kCellColumns];  // cells that may differ from those of the old range, then the needed ones of these
shared uint column_first[kCellColumns];
shared uint cell_sums[kMeshGroup];
shared uint edge_sums[3 * kMeshGroup];  // axis by axis; numbers of quads from bit 16 on
shared uint any_inside;
shared uint all_inside;
shared uint first_cell;
shared uint first_edge;
shared uint fits;
shared uint edges_asked;
shared uint quads_asked;
// Numbers of what is listed, then the next entry of each list; their order does not matter.
shared uint made;
shared uint kept;
shared uint copied_quads;
shared uint disagreeing;

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
uint made_cells(int x, int y) {
    if (x < -1 || y < -1 || x >= kMeshTile || y >= kMeshTile) return 0u;
    return changed[cell_column(x, y)];
}

// Returns the crossed edges that start in a column of nodes, along each axis.
uvec3 crossed_edges(int x, int y) {
    uint bits = signs[node_column(x, y)];
    uint along_x = x < kMeshTile ? bits ^ signs[node_column(x + 1, y)] : 0u;
    uint along_y = y < kMeshTile ? bits ^ signs[node_column(x, y + 1)] : 0u;
    return uvec3(along_x, along_y, crossed_upwards(bits));
}
// Returns the edges of the cells made anew that start in a column of nodes, crossed or not.
uvec3 edges_made(int x, int y) {
    uint here = made_cells(x, y);
    uint left = made_cells(x - 1, y);
    uint low = made_cells(x, y - 1);
    uint across = made_cells(x - 1, y - 1);
    return uvec3(level_edges_of(here | low), level_edges_of(here | left), here | left | low | across);
}
// Returns the crossed edges of a column of nodes that the tile owns: each is a quad.
uvec3 quads_of(int x, int y, uvec3 crossed) { return own(x, y) ? crossed & kOwnNodes : uvec3(0u); }

// Returns the bits of MeshCell::made.w without those of quads that have to be made anew.
uint bits_of_kept_quads(uint bits, int x, int y, uint bit) {
    int column = cell_column(x, y);
    int left = max(column - 1, 0);
    int low = max(column - kMeshCells, 0);
    int across = max(column - kMeshCells - 1, 0);
    uint here = changed[column];  // cells of no own node have no such bits
    uvec3 anew = uvec3(level_edges_of(here | changed[low]), level_edges_of(here | changed[left]),
                       here | changed[left] | changed[low] | changed[across]);
    uvec3 of_cell = anew >> bit & 1u;
    uint gone = of_cell.x | of_cell.y << 1 | of_cell.z << 2;
    return bits & ~(gone << kOtherDiagonals | gone << kDisagreements);
}

// Lists the cells that the tile keeps, with what their old range holds of them.
void list_kept(uint slot, uint tile, uint lane) {
    uint first_old = uint(ranges[tile].first_vertex);
    uint count = fits == 1u ? ranges[tile].cells : 0u;
    for (uint i = lane; i < count; i += uint(kMeshGroup)) {
        uvec4 old = pool_kept.at[first_old + i];
        int id = int(old.z >> 16);
        int column = id / kMeshCells;
        uint bit = uint(id % kMeshCells);
        if (((needed[column] & ~changed[column]) >> bit & 1u) == 0u) continue;
        uint at = column_first[column] + uint(bitCount(needed[column] & ((1u << bit) - 1u)));
        uint bits = bits_of_kept_quads(old.w, column % kMeshCells - 1, column / kMeshCells - 1, bit);
        cells[at].what = uvec4(slot, uint(id), old.z & 0xffffu, 0u);
        cells[at].made = uvec4(old.x, old.y, 0u, bits);
        uint disagreements = uint(bitCount(bits >> kDisagreements & 7u));
        if (disagreements > 0u) atomicAdd(disagreeing, disagreements);
        lists[parameters.most_cells - 1u - atomicAdd(kept, 1u)] = at;
    }
}

// Reads which cells may have changed, and frees the tile's row of them.
void load_changed(uint slot, uint tile, uint lane) {
    bool whole = slot < parameters.whole;
    uint row = whole ? 0u : jobs[slot].mask;
    for (uint c = lane; c < uint(kCellColumns); c += uint(kMeshGroup)) {
        changed[c] = whole ? below(kMeshTile - 1) | 1u << kMeshTile : masks[row].columns[c];
        if (!whole) masks[row].columns[c] = 0u;
    }
    if (lane == 0u && !whole) masks[row].key = 0u;
    barrier();
    // Vertices and fans at a face that a loop passes twice depend on the cells on both sides: these are never kept.
    uint count = whole || ranges[tile].twice == 0u ? 0u : ranges[tile].cells;
    uint first_old = uint(ranges[tile].first_vertex);
    for (uint i = lane; i < count; i += uint(kMeshGroup)) {
        uvec4 old = pool_kept.at[first_old + i];
        int id = int(old.z >> 16);
        if (old.w >> 16 != 0u) atomicOr(changed[id / kMeshCells], 1u << uint(id % kMeshCells));
    }
}

// Allocates what the tile needs of the lists; made, kept and copied_quads become the first entries.
void allocate_lists(uint slot, uint all_cells, uint all_edges) {
    first_cell = atomicAdd(counters.cells, all_cells);
    first_edge = atomicAdd(counters.edges, all_edges);
    edges_asked = all_edges;
    quads_asked = copied_quads;
    copied_quads = atomicAdd(counters.kept_quads, quads_asked);
    fits = first_cell + all_cells <= parameters.most_cells && first_edge + all_edges <= parameters.most_edges &&
                   copied_quads + quads_asked <= parameters.most_edges
               ? 1u
               : 0u;
    if (fits == 1u) {
        uint to_copy = all_cells - made;
        kept = to_copy > 0u ? atomicAdd(counters.kept_cells, to_copy) : 0u;
        uint to_make = made;
        made = atomicAdd(counters.made_cells, to_make);
        atomicMax(counters.cell_groups[0], (made + to_make + 63u) / 64u);
        atomicMax(counters.copy_groups[0], (kept + to_copy + 63u) / 64u);
        atomicMax(counters.edge_groups[0], (first_edge + all_edges + 63u) / 64u);
        atomicMax(counters.quad_groups[0], (copied_quads + quads_asked + 63u) / 64u);
    }
    jobs[slot].first_cell = first_cell;
    jobs[slot].cells = fits == 1u ? all_cells : 0u;
    jobs[slot].first_edge = first_edge;
    jobs[slot].cell_vertices = 0u;
    jobs[slot].waits = 1u - fits;
    jobs[slot].disagreeing = 0u;
}

void main() {
    uint slot = gl_WorkGroupID.x;
    int lane = int(gl_LocalInvocationID.x);
    uint tile = dirty[slot];
    ivec3 node = first_node(tile);
    if (lane == 0) {
        any_inside = 0u;
        all_inside = 0xffffffffu;
        made = 0u;
        kept = 0u;
        copied_quads = 0u;
        disagreeing = 0u;
    }
    barrier();
    uint any_of_lane = 0u;
    uint all_of_lane = 0xffffffffu;
    // Each lane has a column at least; a condition at the end saves software drivers a turn.
    int c = lane;
    do {
        ray = ray_at(2, node.x + c % kMeshNodes - 1, node.y + c / kMeshNodes - 1);
        uint bits = node_bits(count_of(ray), node.z);
        signs[c] = bits;
        jobs[slot].signs[c] = bits;
        any_of_lane |= bits;
        all_of_lane &= bits;
        c += kMeshGroup;
    } while (c < kNodeColumns);
    atomicOr(any_inside, any_of_lane);
    atomicAnd(all_inside, all_of_lane);
    load_changed(slot, tile, uint(lane));
    barrier();
    // Most tiles of a solid are empty or full and have nothing to count.
    bool has_surface = any_inside != 0u && all_inside != (1u << uint(kMeshNodes)) - 1u;
    int cell_columns = has_surface ? kCellColumns : 0;
    int node_columns = has_surface ? kNodeColumns : 0;
    c = lane;
    do {
        uint cells_of_column = has_surface ? needed_cells(c % kMeshCells - 1, c / kMeshCells - 1) : 0u;
        needed[c] = cells_of_column;
        changed[c] &= cells_of_column;
        c += kMeshGroup;
    } while (c < kCellColumns);
    barrier();
    // Each lane counts adjacent columns, so that the lists are in the order of the columns.
    const int kCellShare = (kCellColumns + kMeshGroup - 1) / kMeshGroup;
    const int kNodeShare = (kNodeColumns + kMeshGroup - 1) / kMeshGroup;
    int cells_from = lane * kCellShare;
    int cells_to = min(cells_from + kCellShare, cell_columns);
    int nodes_from = lane * kNodeShare;
    int nodes_to = min(nodes_from + kNodeShare, node_columns);
    uint cell_sum = 0u;
    uint made_of_lane = 0u;
    uint copied_of_lane = 0u;
    uvec3 edge_sum = uvec3(0u);
    uint edge_bits[3 * kNodeShare];  // axis by axis
    uint quad_bits[3 * kNodeShare];
    uint busy = 0u;  // which of them are not 0
    for (int c = cells_from; c < cells_to; ++c) {
        cell_sum += uint(bitCount(needed[c]));
        made_of_lane += uint(bitCount(changed[c]));
    }
    for (int i = 0; i < kNodeShare; ++i) {
        int c = nodes_from + i;
        int x = c % kMeshNodes - 1;
        int y = c / kMeshNodes - 1;
        uvec3 crossed = c < nodes_to ? crossed_edges(x, y) : uvec3(0u);
        uvec3 edges_here = crossed & edges_made(x, y);
        uvec3 quads_here = quads_of(x, y, crossed);
        for (int axis = 0; axis < 3; ++axis) {
            edge_bits[axis * kNodeShare + i] = edges_here[axis];
            quad_bits[axis * kNodeShare + i] = quads_here[axis];
            busy |= ((edges_here[axis] | quads_here[axis]) != 0u ? 1u : 0u) << (axis * kNodeShare + i);
        }
        edge_sum += uvec3(bitCount(edges_here)) + (uvec3(bitCount(quads_here)) << 16);
        ivec3 copied = bitCount(quads_here & ~edges_here);
        copied_of_lane += uint(copied.x + copied.y + copied.z);
    }
    cell_sums[lane] = cell_sum;
    for (int axis = 0; axis < 3; ++axis) edge_sums[axis * kMeshGroup + lane] = edge_sum[axis];
    atomicAdd(made, made_of_lane);
    atomicAdd(copied_quads, copied_of_lane);
    barrier();
    if (lane == 0) {
        uint all_cells = 0u;
        uint all_edges = 0u;
        for (int i = 0; i < kMeshGroup; ++i) {
            uint c = cell_sums[i];
            cell_sums[i] = all_cells;
            all_cells += c;
        }
        for (int i = 0; i < 3 * kMeshGroup; ++i) {
            uint e = edge_sums[i];
            edge_sums[i] = all_edges;
            all_edges += e;
        }
        uint all_quads = all_edges >> 16;
        all_edges &= 0xffffu;
        jobs[slot].tile = tile;
        jobs[slot].quads = all_quads;
        jobs[slot].edges = all_edges;
        jobs[slot].extras = 0u;
        jobs[slot].extras_made = 0u;
        jobs[slot].made = made;
        allocate_lists(slot, all_cells, all_edges);
    }
    barrier();
    // The entries of a failed allocation may lie between those of other tiles and hold an older frame's data: void
    // them.
    if (fits == 0u) {
        uint end_of_edges = min(first_edge + edges_asked, parameters.most_edges);
        uint end_of_quads = min(copied_quads + quads_asked, parameters.most_edges);
        for (uint i = first_edge + uint(lane); i < end_of_edges; i += uint(kMeshGroup)) edges[i].what.x = kNoSlot;
        for (uint i = copied_quads + uint(lane); i < end_of_quads; i += uint(kMeshGroup)) kept_quads[i].x = kNoSlot;
    }
    uint at = first_cell + cell_sums[lane];
    uint made_at = fits == 1u && made_of_lane > 0u ? atomicAdd(made, made_of_lane) : 0u;
    for (int c = cells_from; c < (fits == 1u ? cells_to : 0); ++c) {
        uint here = needed[c];
        jobs[slot].cell_columns[c] = uvec2(here, at);
        column_first[c] = at;
        int column = node_column(c % kMeshCells - 1, c / kMeshCells - 1);
        uint p00 = signs[column];
        uint p10 = signs[column + 1];
        uint p01 = signs[column + kMeshNodes];
        uint p11 = signs[column + kMeshNodes + 1];
        for (uint bits = changed[c]; bits != 0u; bits &= bits - 1u) {
            int bit = findLSB(bits);
            uint pattern = corner_pattern(p00, p10, p01, p11, uint(bit));
            uint number = at + uint(bitCount(here & ((1u << uint(bit)) - 1u)));
            cells[number].what = uvec4(slot, uint(c * kMeshCells + bit) | pattern << 16, 0u, 0u);
            lists[made_at++] = number;
        }
        at += uint(bitCount(here));
    }
    uint copied_at = fits == 1u && copied_of_lane > 0u ? atomicAdd(copied_quads, copied_of_lane) : 0u;
    // One loop over all entries of the lane: software drivers turn each loop as often as the busiest of eight lanes.
    busy = fits == 1u ? busy : 0u;
    uint edges_left = 0u;
    uint quads_left = 0u;
    uint quad = 0u;
    uint inside = 0u;
    ivec3 column = ivec3(0);
    int last_axis = -1;
    while ((busy | edges_left | quads_left) != 0u) {
        if ((edges_left | quads_left) == 0u) {  // the first entry of an empty column is never read
            int k = findLSB(busy);
            busy &= busy - 1u;
            int axis = k / kNodeShare;
            int c = nodes_from + k % kNodeShare;
            edges_left = edge_bits[k];
            quads_left = quad_bits[k];
            inside = signs[c];
            column = ivec3(c % kMeshNodes - 1, c / kMeshNodes - 1, axis);
            if (axis != last_axis) {
                uint sum = edge_sums[axis * kMeshGroup + lane];
                at = first_edge + (sum & 0xffffu);
                quad = sum >> 16;
                last_axis = axis;
            }
            jobs[slot].edge_columns[axis * kNodeColumns + c] = uvec2(edges_left, at);
        }
        int bit = findLSB(edges_left | quads_left);
        uint here = 1u << uint(bit);
        bool is_own = (quads_left & here) != 0u;
        uint place = edge_place(column.z, ivec3(column.xy, bit - 1), inside >> bit & 1u);
        if ((edges_left & here) != 0u) {
            edges[at++].what = uvec4(slot, place, is_own ? quad : kNotOwn, 0u);
        } else {
            kept_quads[copied_at++] = uvec2(slot, place | quad << 18);
        }
        quad += is_own ? 1u : 0u;
        edges_left &= ~here;
        quads_left &= ~here;
    }
    barrier();
    list_kept(slot, tile, uint(lane));
    barrier();
    if (lane == 0 && disagreeing > 0u) atomicAdd(jobs[slot].disagreeing, disagreeing);
}
