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
uvec4 row;                // of the cell's pattern (mesh_buffers.glsl)
uint first;               // of the edges of a loop in it
uint last;
float along[12];
vec3 normal[12];
uint colour[12];

// In cells from the cell's lowest corner.
vec3 place_of_crossing(uint i) {
    uint edge = listed_edge(row, i);
    float u = float(edge & 1u);
    float v = float(edge >> 1 & 1u);
    return edge < 4u ? vec3(along[i], u, v) : (edge < 8u ? vec3(v, along[i], u) : vec3(u, v, along[i]));
}

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
    for (uint i = first; i < last; ++i) {
        vec3 n = normal[i];
        float d = dot3(n, place_of_crossing(i) - mean);
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

// A plane that several crossings share. (Three by name, not an array: software drivers reach into arrays one invocation after the
// other.)
struct Cluster {
    vec3 first_normal;
    vec3 normal_sum;
    float offset_sum;
    float count;
};
bool takes(Cluster cluster, vec3 n) { return !(dot3(cluster.first_normal, n) < kSameCluster); }
Cluster with(Cluster old, bool opened, bool joined, vec3 n, float d) {
    precise vec3 more_normal = old.normal_sum + n;
    precise float more_offset = old.offset_sum + d;
    Cluster now;
    now.first_normal = opened ? n : old.first_normal;
    now.normal_sum = opened ? n : (joined ? more_normal : old.normal_sum);
    now.offset_sum = opened ? d : (joined ? more_offset : old.offset_sum);
    now.count = opened ? 1.0 : (joined ? old.count + 1.0 : old.count);
    return now;
}
vec3 mean_normal(Cluster cluster) {
    precise vec3 mean = cluster.normal_sum / sqrt(dot3(cluster.normal_sum, cluster.normal_sum));
    return mean;
}
float mean_offset(Cluster cluster) {
    precise float mean = cluster.offset_sum / cluster.count;
    return mean;
}

// In cells from the cell's lowest corner; `sum` is that of the crossings' places.
vec3 feature_point(vec3 sum) {
    precise vec3 mean = sum / float(last - first);
    Cluster c0 = Cluster(vec3(0.0), vec3(0.0), 0.0, 0.0);
    Cluster c1 = c0;
    Cluster c2 = c0;
    int clusters = 0;  // 4: there are more than three
    for (uint i = first; i < last && clusters < 4; ++i) {
        vec3 n = normal[i];
        float d = dot3(n, place_of_crossing(i) - mean);
        bool in_0 = clusters > 0 && takes(c0, n);
        bool in_1 = clusters > 1 && !in_0 && takes(c1, n);
        bool in_2 = clusters > 2 && !in_0 && !in_1 && takes(c2, n);
        bool opens = !in_0 && !in_1 && !in_2;
        c0 = with(c0, opens && clusters == 0, in_0, n, d);
        c1 = with(c1, opens && clusters == 1, in_1, n, d);
        c2 = with(c2, opens && clusters == 2, in_2, n, d);
        clusters += opens ? 1 : 0;
    }
    vec3 n0 = mean_normal(c0);
    vec3 n1 = mean_normal(c1);
    vec3 n2 = mean_normal(c2);
    float d0 = mean_offset(c0);
    float d1 = mean_offset(c1);
    float d2 = mean_offset(c2);
    precise vec3 offset = vec3(0.0);
    bool found = false;
    if (clusters == 1) {
        offset = n0 * (kTowardsTangents * d0);
        found = true;
    }
    if (clusters == 2) {
        float cosine = dot3(n0, n1);
        precise float sine2 = 1.0 - cosine * cosine;
        found = sine2 >= kLeastSine2;
        precise vec3 between = (n0 * (d0 - cosine * d1) + n1 * (d1 - cosine * d0)) / sine2;
        offset = between;
    }
    if (clusters == 3) {
        vec3 across = cross3(n1, n2);
        float volume = dot3(n0, across);
        found = abs(volume) >= kLeastVolume;
        precise vec3 corner = (across * d0 + cross3(n2, n0) * d1 + cross3(n0, n1) * d2) / volume;
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
    if (kListed == 1u) number = cells[number].what.z;
    uvec4 what = cells[number].what;
    uint slot = what.x;
    if (slot == kNoSlot) return;
    if (jobs[slot].waits != 0u) return;
    uint tile = jobs[slot].tile;
    ivec3 cell = cell_place(what.y);
    ivec3 cell_in_lattice = cell + first_node(tile);
    uvec4 made = cells[number].made;
    uint first_place = uint(ranges[tile].first_vertex) + made.z;
    row = tables[pattern_of(what.y)];
    uint loops = loops_of(row);
    uint next_vertex = 0u;
    bool is_hard = false;
    for (uint loop = 0u; loop < loops; ++loop) {
        first = first_listed(row, loop);
        last = first_listed(row, loop + 1u);
        uint end_vertex = loop + 1u < loops ? made.y >> (20u + 4u * loop) & 0xfu : made.w & 0xffffu;
        precise vec3 place_sum = vec3(0.0);
        for (uint i = first; i < last; ++i) {
            uint crossing = sample_of(slot, cell, listed_edge(row, i));
            vec4 normal_along = edges[crossing].crossing;
            normal[i] = normal_along.xyz;
            along[i] = normal_along.w;
            colour[i] = edges[crossing].what.w;
            place_sum += place_of_crossing(i);
        }
        vec3 in_cell = feature_point(place_sum);
        is_hard = is_hard || !closed_form;
        while (next_vertex < end_vertex) {
            precise vec3 normal_sum = vec3(0.0);
            uvec3 colour_sum = uvec3(0u);
            uint count = 0u;
            for (uint i = first; i < last; ++i) {
                uint edge = listed_edge(row, i);
                if (((edge < 8u ? made.x : made.y) >> (4u * (edge & 7u)) & 0xfu) != next_vertex) continue;
                normal_sum += normal[i];
                colour_sum += channels(colour[i]);
                ++count;
            }
            write_vertex(first_place + next_vertex, cell_in_lattice, in_cell, normal_sum, mean_colour(colour_sum, max(count, 1u)));
            ++next_vertex;
        }
    }
    if (kListed == 0u && is_hard) {
        uint place = atomicAdd(counters.hard_cells, 1u);
        cells[place].what.z = number;
        atomicMax(counters.hard_groups[0], (place + 64u) / 64u);
    }
}
