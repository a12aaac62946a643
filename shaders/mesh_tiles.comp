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
shared uint edge_sums[3 * kMeshGroup];  // axis by axis
shared uint quad_sums[3 * kMeshGroup];
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

bool own(int x, int y) { return x >= 0 && y >= 0 && x < kMeshTile && y < kMeshTile; }
uint both_cells(uint edge_bits) { return edge_bits | edge_bits >> 1; }  // an edge along x or y touches z and z - 1
uint both_nodes(uint cell_bits) { return cell_bits | cell_bits << 1; }
uint along_z(uint column) { return (column ^ (column >> 1)) & ((1u << uint(kMeshNodes - 1)) - 1u); }

// The cells of a column that own crossed edges touch. An edge is own when it starts at an own node.
uint needed_cells(int x, int y) {
    int column = node_column(x, y);
    uint low = signs[column];
    uint right = signs[column + 1];
    uint upper = signs[column + kMeshNodes];
    uint across = signs[column + kMeshNodes + 1];
    uint at_low = own(x, y) ? kOwn : 0u;
    uint at_right = own(x + 1, y) ? kOwn : 0u;
    uint at_upper = own(x, y + 1) ? kOwn : 0u;
    uint at_across = own(x + 1, y + 1) ? kOwn : 0u;
    uint sideways = ((low ^ right) | (low ^ upper)) & at_low;
    sideways |= (upper ^ across) & at_upper;
    sideways |= (right ^ across) & at_right;
    return both_cells(sideways) | (along_z(low) & at_low) | (along_z(right) & at_right) | (along_z(upper) & at_upper) |
           (along_z(across) & at_across);
}
uint cells_at(int x, int y) { return x >= -1 && y >= -1 && x < kMeshTile && y < kMeshTile ? needed[cell_column(x, y)] : 0u; }

// The crossed edges of these cells that start in a column of nodes, along each axis.
uvec3 needed_edges(int x, int y) {
    uint here = cells_at(x, y);
    uint left = cells_at(x - 1, y);
    uint low = cells_at(x, y - 1);
    uint across = cells_at(x - 1, y - 1);
    uint bits = signs[node_column(x, y)];
    uint along_x = x < kMeshTile ? bits ^ signs[node_column(x + 1, y)] : 0u;
    uint along_y = y < kMeshTile ? bits ^ signs[node_column(x, y + 1)] : 0u;
    return uvec3(along_x & both_nodes(here | low), along_y & both_nodes(here | left),
                 along_z(bits) & (here | left | low | across));
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
    int node_columns = has_surface ? kNodeColumns : 0;
    for (int c = lane; c < cell_columns; c += kMeshGroup) {
        needed[c] = needed_cells(c % kMeshCells - 1, c / kMeshCells - 1);
    }
    barrier();
    // Each lane counts neighbouring columns, so that the lists are in the order of the columns.
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
        quad_sum += own(x, y) ? uvec3(bitCount(edge_bits[i] & kOwn)) : uvec3(0u);
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
            uint lower = (p00 >> bit & 1u) | (p10 >> bit & 1u) << 1 | (p01 >> bit & 1u) << 2 | (p11 >> bit & 1u) << 3;
            int next = bit + 1;
            uint upper = (p00 >> next & 1u) | (p10 >> next & 1u) << 1 | (p01 >> next & 1u) << 2 | (p11 >> next & 1u) << 3;
            cells[at].what = uvec4(slot, uint(c * kMeshCells + bit) | (lower | upper << 4) << 16, 0u, 0u);
            ++at;
        }
    }
    for (int axis = 0; axis < 3; ++axis) {
        at = first_edge + edge_sums[axis * kMeshGroup + lane];
        uint quad = quad_sums[axis * kMeshGroup + lane];
        for (int i = 0; i < kNodeShare; ++i) {
            uint bits = fits == 1u ? edge_bits[i][axis] : 0u;
            if (bits == 0u) continue;  // nobody asks where these begin
            int c = nodes_from + i;
            int x = c % kMeshNodes - 1;
            int y = c / kMeshNodes - 1;
            uint inside = signs[c];
            jobs[slot].edge_columns[axis * kNodeColumns + c] = uvec2(bits, at);
            do {
                int bit = findLSB(bits);
                bool is_own = own(x, y) && (kOwn >> bit & 1u) != 0u;
                edges[at].what = uvec4(slot, edge_place(axis, ivec3(x, y, bit - 1), inside >> bit & 1u), is_own ? quad : kNotOwn, 0u);
                quad += is_own ? 1u : 0u;
                ++at;
                bits &= bits - 1u;
            } while (bits != 0u);
        }
    }
}
