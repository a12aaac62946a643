// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_EXT_buffer_reference : require
// What there is to mesh in a tile, one work group a tile: the signs of its nodes from the z rays, the cells that its own
// crossed edges touch, all crossed edges of these cells; and a place for each in the lists of the stages that follow.
#include "shaders/mesh_buffers.glsl"

layout(local_size_x = 64) in;

shared uint signs[kNodeColumns];
shared uint needed[kCellColumns];
shared uint cell_sums[kMeshGroup];
shared uint edge_sums[kMeshGroup];
shared uint quad_sums[kMeshGroup];
shared uint first_cell;
shared uint first_edge;
shared uint fits;
shared uint cells_asked;
shared uint edges_asked;
shared uint any_inside;
shared uint all_inside;

const uint kOwn = 0xffffu << 1;

// Bits of the tile's nodes that are inside. A node at depth d is inside when lo <= d < hi.
uint node_bits(RayRef ray, int first) {
    uint bits = 0u;
    uint count = count_of(ray);
    for (uint i = 0u; i < count; i += 2u) {
        int from = (depth_of(store.at[ray.first + i]) + kUnitsPerCell - 1) / kUnitsPerCell - (first - 1);
        int to = (depth_of(store.at[ray.first + i + 1u]) + kUnitsPerCell - 1) / kUnitsPerCell - (first - 1);
        from = max(from, 0);
        to = min(to, kMeshNodes);
        if (from >= kMeshNodes) break;
        if (from < to) bits |= ((1u << uint(to)) - 1u) & ~((1u << uint(from)) - 1u);
    }
    return bits;
}

uint crossed(int axis, int x, int y) {
    uint here = signs[node_column(x, y)];
    if (axis == 0) return x < kMeshTile ? here ^ signs[node_column(x + 1, y)] : 0u;
    if (axis == 1) return y < kMeshTile ? here ^ signs[node_column(x, y + 1)] : 0u;
    return (here ^ (here >> 1)) & ((1u << uint(kMeshNodes - 1)) - 1u);
}
bool own(int x, int y) { return x >= 0 && y >= 0 && x < kMeshTile && y < kMeshTile; }
uint own_crossed(int axis, int x, int y) { return own(x, y) ? crossed(axis, x, y) & kOwn : 0u; }
uint both_cells(uint edge_bits) { return edge_bits | edge_bits >> 1; }  // an edge along x or y touches z and z - 1
uint both_nodes(uint cell_bits) { return cell_bits | cell_bits << 1; }

// The cells of a column that own crossed edges touch.
uint needed_cells(int x, int y) {
    uint bits = both_cells(own_crossed(0, x, y)) | both_cells(own_crossed(1, x, y)) | own_crossed(2, x, y);
    bits |= both_cells(own_crossed(0, x, y + 1)) | own_crossed(2, x, y + 1);
    bits |= both_cells(own_crossed(1, x + 1, y)) | own_crossed(2, x + 1, y);
    return bits | own_crossed(2, x + 1, y + 1);
}
uint cells_at(int x, int y) { return x >= -1 && y >= -1 && x < kMeshTile && y < kMeshTile ? needed[cell_column(x, y)] : 0u; }

// The crossed edges of these cells that start in a column of nodes.
uint needed_edges(int axis, int x, int y) {
    uint here = cells_at(x, y);
    uint left = cells_at(x - 1, y);
    uint low = cells_at(x, y - 1);
    uint across = cells_at(x - 1, y - 1);
    uint wanted = axis == 0 ? both_nodes(here | low) : (axis == 1 ? both_nodes(here | left) : here | left | low | across);
    return crossed(axis, x, y) & wanted;
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
        uint bits = node_bits(ray_at(2, node.x + c % kMeshNodes - 1, node.y + c / kMeshNodes - 1), node.z);
        signs[c] = bits;
        jobs[slot].signs[c] = bits;
        any_of_lane |= bits;
        all_of_lane &= bits;
    }
    atomicOr(any_inside, any_of_lane);
    atomicAnd(all_inside, all_of_lane);
    barrier();
    // Most tiles of a solid are empty or full: there is nothing to count in them.
    bool has_surface = any_inside != 0u && all_inside != (1u << uint(kMeshNodes)) - 1u;
    int cell_columns = has_surface ? kCellColumns : 0;
    int edge_columns = has_surface ? kEdgeColumns : 0;
    for (int c = lane; c < cell_columns; c += kMeshGroup) {
        uint bits = needed_cells(c % kMeshCells - 1, c / kMeshCells - 1);
        needed[c] = bits;
        jobs[slot].cell_bits[c] = bits;
    }
    barrier();
    // Each lane counts neighbouring columns, so that the lists are in the order of the columns.
    const int kCellShare = (kCellColumns + kMeshGroup - 1) / kMeshGroup;
    const int kEdgeShare = (kEdgeColumns + kMeshGroup - 1) / kMeshGroup;
    int cells_from = lane * kCellShare;
    int cells_to = min(cells_from + kCellShare, cell_columns);
    int edges_from = lane * kEdgeShare;
    int edges_to = min(edges_from + kEdgeShare, edge_columns);
    uint cell_sum = 0u;
    uint edge_sum = 0u;
    uint quad_sum = 0u;
    for (int c = cells_from; c < cells_to; ++c) cell_sum += uint(bitCount(needed[c]));
    for (int c = edges_from; c < edges_to; ++c) {
        int column = c % kNodeColumns;
        int x = column % kMeshNodes - 1;
        int y = column / kMeshNodes - 1;
        uint bits = needed_edges(c / kNodeColumns, x, y);
        jobs[slot].edge_bits[c] = bits;
        edge_sum += uint(bitCount(bits));
        quad_sum += own(x, y) ? uint(bitCount(bits & kOwn)) : 0u;
    }
    cell_sums[lane] = cell_sum;
    edge_sums[lane] = edge_sum;
    quad_sums[lane] = quad_sum;
    barrier();
    if (lane == 0) {
        uint all_cells = 0u;
        uint all_edges = 0u;
        uint all_quads = 0u;
        for (int i = 0; i < kMeshGroup; ++i) {
            uint c = cell_sums[i];
            uint e = edge_sums[i];
            uint q = quad_sums[i];
            cell_sums[i] = all_cells;
            edge_sums[i] = all_edges;
            quad_sums[i] = all_quads;
            all_cells += c;
            all_edges += e;
            all_quads += q;
        }
        first_cell = atomicAdd(counters.cells, all_cells);
        first_edge = atomicAdd(counters.edges, all_edges);
        fits = first_cell + all_cells <= parameters.most_cells && first_edge + all_edges <= parameters.most_edges ? 1u : 0u;
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
    if (fits == 0u) {  // what it asked for in vain may lie between what others got, and holds an older frame's entries
        uint end_of_cells = min(first_cell + cells_asked, parameters.most_cells);
        uint end_of_edges = min(first_edge + edges_asked, parameters.most_edges);
        for (uint i = first_cell + uint(lane); i < end_of_cells; i += uint(kMeshGroup)) cells[i].slot = kNoSlot;
        for (uint i = first_edge + uint(lane); i < end_of_edges; i += uint(kMeshGroup)) edges[i].slot = kNoSlot;
    }
    uint at = cell_sums[lane];
    for (int c = fits == 1u ? cells_from : cells_to; c < cells_to; ++c) {
        jobs[slot].cells_before[c] = at;
        for (uint bits = needed[c]; bits != 0u; bits &= bits - 1u) {
            cells[first_cell + at].slot = slot;
            cells[first_cell + at].cell = uint(c * kMeshCells + findLSB(bits));
            ++at;
        }
    }
    at = edge_sums[lane];
    uint quad = quad_sums[lane];
    for (int c = fits == 1u ? edges_from : edges_to; c < edges_to; ++c) {
        int axis = c / kNodeColumns;
        int x = c % kNodeColumns % kMeshNodes - 1;
        int y = c % kNodeColumns / kMeshNodes - 1;
        jobs[slot].edges_before[c] = at;
        for (uint bits = jobs[slot].edge_bits[c]; bits != 0u; bits &= bits - 1u) {
            int z = findLSB(bits) - 1;
            bool is_own = own(x, y) && z >= 0 && z < kMeshTile;
            edges[first_edge + at].slot = slot;
            edges[first_edge + at].place = edge_place(axis, ivec3(x, y, z));
            edges[first_edge + at].quad = is_own ? quad : kNotOwn;
            quad += is_own ? 1u : 0u;
            ++at;
        }
    }
}
