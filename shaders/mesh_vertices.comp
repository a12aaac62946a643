// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_EXT_buffer_reference : require
// The vertices of each cell, one invocation a cell: the rule of compute/feature_point.cpp and cell_vertices.cpp, in the same
// order of operations, so that where a device rounds as the host does the result is the same bit for bit.
#include "shaders/mesh_buffers.glsl"
#include "shaders/mesh_vertex.glsl"
#include "shaders/shared/feature_constants.h"

layout(local_size_x = 64) in;

// 0: cells whose planes determine a point in closed form; the others are listed. 1: those on that list. Software drivers run
// both sides of every branch, so what is rare and long must not stand beside what is not.
layout(constant_id = 0) const uint kListed = 0u;

bool closed_form = true;  // of the point that was found last
uint crossings = 0u;
vec3 at[12];
vec3 normal[12];
uint sampled[12];  // number in edges
uint vertex[12];   // of the cell

// The pseudo-inverse of the planes' normal equations, for any planes at all.
vec3 offset_by_eigenvalues(vec3 mean) {
    float a[3][3];
    mat3 vectors = mat3(1.0);
    vec3 atb = vec3(0.0);
    float xx = 0.0;
    float xy = 0.0;
    float xz = 0.0;
    float yy = 0.0;
    float yz = 0.0;
    float zz = 0.0;
    for (uint i = 0u; i < crossings; ++i) {
        vec3 n = normal[i];
        float d = dot3(n, at[i] - mean);
        precise float sum_xx = xx + n.x * n.x;
        precise float sum_xy = xy + n.x * n.y;
        precise float sum_xz = xz + n.x * n.z;
        precise float sum_yy = yy + n.y * n.y;
        precise float sum_yz = yz + n.y * n.z;
        precise float sum_zz = zz + n.z * n.z;
        precise vec3 sum_b = atb + n * d;
        xx = sum_xx;
        xy = sum_xy;
        xz = sum_xz;
        yy = sum_yy;
        yz = sum_yz;
        zz = sum_zz;
        atb = sum_b;
    }
    a[0][0] = xx;
    a[0][1] = xy;
    a[1][0] = xy;
    a[0][2] = xz;
    a[2][0] = xz;
    a[1][1] = yy;
    a[1][2] = yz;
    a[2][1] = yz;
    a[2][2] = zz;
    for (int turn = 0; turn < 15; ++turn) {  // five sweeps of cyclic Jacobi rotations
        int p = turn % 3 == 2 ? 1 : 0;
        int q = turn % 3 == 0 ? 1 : 2;
        if (abs(a[p][q]) < 1e-12) continue;
        precise float theta = (a[q][q] - a[p][p]) / (2.0 * a[p][q]);
        precise float t = (theta >= 0.0 ? 1.0 : -1.0) / (abs(theta) + sqrt(theta * theta + 1.0));
        precise float c = 1.0 / sqrt(t * t + 1.0);
        precise float s = t * c;
        for (int k = 0; k < 3; ++k) {
            float kp = a[k][p];
            float kq = a[k][q];
            precise float new_p = c * kp - s * kq;
            precise float new_q = s * kp + c * kq;
            a[k][p] = new_p;
            a[k][q] = new_q;
        }
        for (int k = 0; k < 3; ++k) {
            float pk = a[p][k];
            float qk = a[q][k];
            precise float new_p = c * pk - s * qk;
            precise float new_q = s * pk + c * qk;
            a[p][k] = new_p;
            a[q][k] = new_q;
        }
        vec3 vp = vectors[p];
        vec3 vq = vectors[q];
        precise vec3 new_vp = c * vp - s * vq;
        precise vec3 new_vq = s * vp + c * vq;
        vectors[p] = new_vp;
        vectors[q] = new_vq;
    }
    float largest = max(max(a[0][0], a[1][1]), a[2][2]);
    precise vec3 offset = vec3(0.0);
    for (int k = 0; k < 3; ++k) {
        float value = a[k][k];
        if (value > kEigenvalueCutoff * largest) offset += vectors[k] * (dot3(vectors[k], atb) / value);
    }
    return offset;
}

// In cells from the cell's lowest corner.
vec3 feature_point() {
    precise vec3 sum = vec3(0.0);
    for (uint i = 0u; i < crossings; ++i) sum += at[i];
    precise vec3 mean = sum / float(crossings);

    vec3 first_normal[3];
    vec3 normal_sum[3];
    float offset_sum[3];
    float count[3];
    int clusters = 0;  // 4: there are more than three
    for (uint i = 0u; i < crossings && clusters < 4; ++i) {
        float d = dot3(normal[i], at[i] - mean);
        int k = 0;
        while (k < clusters && dot3(first_normal[k], normal[i]) < kSameCluster) ++k;
        if (k == 3) {
            clusters = 4;
        } else if (k == clusters) {
            ++clusters;
            first_normal[k] = normal[i];
            normal_sum[k] = normal[i];
            offset_sum[k] = d;
            count[k] = 1.0;
        } else {
            precise vec3 more_normal = normal_sum[k] + normal[i];
            precise float more_offset = offset_sum[k] + d;
            normal_sum[k] = more_normal;
            offset_sum[k] = more_offset;
            count[k] += 1.0;
        }
    }
    vec3 n[3];
    float d[3];
    for (int k = 0; k < min(clusters, 3); ++k) {
        precise vec3 mean_normal = normal_sum[k] / sqrt(dot3(normal_sum[k], normal_sum[k]));
        precise float mean_offset = offset_sum[k] / count[k];
        n[k] = mean_normal;
        d[k] = mean_offset;
    }
    precise vec3 offset = vec3(0.0);
    bool found = false;
    if (clusters == 1) {
        offset = n[0] * (kTowardsTangents * d[0]);
        found = true;
    }
    if (clusters == 2) {
        float cosine = dot3(n[0], n[1]);
        precise float sine2 = 1.0 - cosine * cosine;
        found = sine2 >= kLeastSine2;
        precise vec3 between = (n[0] * (d[0] - cosine * d[1]) + n[1] * (d[1] - cosine * d[0])) / sine2;
        offset = between;
    }
    if (clusters == 3) {
        vec3 across = cross3(n[1], n[2]);
        float volume = dot3(n[0], across);
        found = abs(volume) >= kLeastVolume;
        precise vec3 corner = (across * d[0] + cross3(n[2], n[0]) * d[1] + cross3(n[0], n[1]) * d[2]) / volume;
        offset = corner;
    }
    closed_form = found;
    if (kListed == 1u && !found) offset = offset_by_eigenvalues(mean);
    precise vec3 point = mean + offset;
    return clamp(point, vec3(-kOutside), vec3(1.0 + kOutside));
}

void main() {
    uint number = gl_GlobalInvocationID.x;
    if (number >= (kListed == 1u ? counters.hard_cells : min(counters.cells, parameters.most_cells))) return;
    if (kListed == 1u) number = cells[number].hard;
    uint slot = cells[number].slot;
    if (slot == kNoSlot) return;
    if (jobs[slot].waits != 0u) return;
    uint tile = jobs[slot].tile;
    ivec3 cell = cell_place(cells[number].cell);
    ivec3 cell_in_lattice = cell + first_node(tile);
    uint first_place = uint(ranges[tile].first_vertex) + cells[number].first_vertex;
    uint low = cells[number].used_low;
    uint high = cells[number].used_high;
    uint pattern = cell_pattern(slot, cell);
    uint loops = loops_of(pattern);
    uint next_vertex = 0u;
    bool is_hard = false;
    for (uint loop = 0u; loop < loops; ++loop) {
        uint last = first_listed(pattern, loop + 1u);
        uint end_vertex = loop + 1u < loops ? high >> (20u + 4u * loop) & 0xfu : cells[number].vertices;
        crossings = 0u;
        for (uint i = first_listed(pattern, loop); i < last; ++i) {
            uint edge = listed_edge(pattern, i);
            uint crossing = sample_of(slot, cell, edge);
            vec3 place = vec3(edge_offset(edge));
            place[edge >> 2] += edges[crossing].along;
            at[crossings] = place;
            normal[crossings] = normal_of(crossing);
            sampled[crossings] = crossing;
            vertex[crossings] = (edge < 8u ? low : high) >> (4u * (edge & 7u)) & 0xfu;
            ++crossings;
        }
        vec3 in_cell = feature_point();
        is_hard = is_hard || !closed_form;
        while (next_vertex < end_vertex) {
            precise vec3 normal_sum = vec3(0.0);
            uvec3 colour = uvec3(0u);
            uint count = 0u;
            for (uint i = 0u; i < crossings; ++i) {
                if (vertex[i] != next_vertex) continue;
                normal_sum += normal[i];
                colour += colour_of(sampled[i]);
                ++count;
            }
            write_vertex(first_place + next_vertex, cell_in_lattice, in_cell, normal_sum, mean_colour(colour, max(count, 1u)));
            ++next_vertex;
        }
    }
    if (kListed == 0u && is_hard) {
        uint place = atomicAdd(counters.hard_cells, 1u);
        cells[place].hard = number;
        atomicMax(counters.hard_groups[0], (place + 64u) / 64u);
    }
}
