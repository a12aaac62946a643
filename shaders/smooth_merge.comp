// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_EXT_buffer_reference : require
// Merges points of a level to those of the next: one invocation a box of the next, which adds up those of its eight
// boxes whose normals face the same way, in their order. A merged point's key is its box and the way that it faces.
#include "shaders/smooth_buffers.glsl"
#include "shaders/smooth_boxes.glsl"

uint part_first[4];  // the points of two boxes that are neighbours along x, in the order of rows
uint part_end[4];

// Finds the points of the boxes that make up a box of the next level. Returns their number.
uint find_parts(SmoothBoxes fine, int x, int y, int z) {
    uint count = 0u;
    for (int part = 0; part < 4; ++part) {
        uint row = uint((2 * z + part / 2) * fine.y + 2 * y + part % 2);
        part_first[part] = 0u;
        part_end[part] = 0u;
        if (boxes[fine.rows + row] > 0u) {
            uint box = fine.firsts + row * uint(fine.x + 1) + uint(2 * x);
            part_first[part] = boxes[box];
            part_end[part] = boxes[box + 2u];
        }
        count += part_end[part] - part_first[part];
    }
    return count;
}

// Adds up the points that face a way, and appends what they merge to.
void merge_facing(SmoothTask task, int facing, uint key) {
    MergedSums sums = nothing_merged();
    dvec3 first = dvec3(0.0);
    uint material = 0u;
    bool is_first = true;
    for (int part = 0; part < 4; ++part) {
        for (uint i = part_first[part]; i < part_end[part]; ++i) {
            dvec4 normal_offset = sorted[i].normal_offset;
            if (facing_of(normal_offset.xyz) == facing) {
                dvec4 place_area = sorted[i].place_area;
                if (is_first) {
                    first = place_area.xyz;
                    material = sorted[i].key_box.w;
                    is_first = false;
                }
                sums = with_merged(sums, place_area.xyz, normal_offset.xyz, place_area.w, normal_offset.w, first);
            }
        }
    }
    if (!(sums.area > 0.0)) return;
    MergedSums means = means_of(sums, first);
    int level = int(parameters.step);
    uint number = atomicAdd(smooth_counts.points[level], 1u);
    if (number >= parameters.points) {
        stop(kShortOfSpace);
        return;
    }
    atomicMax(smooth_counts.of_points[level].x, groups_for(number + 1u));
    put_into_box(point_of(means.place, means.normal, means.area, means.height, key, material), task, level, number);
}

void main() {
    if (is_stopped()) return;
    SmoothTask task = tasks[parameters.ball];
    int level = int(parameters.step);
    SmoothBoxes grid = boxes_of_level(task, level, behind_counts());
    uint number = gl_GlobalInvocationID.x;
    if (number >= uint(grid.x) * uint(grid.y) * uint(grid.z)) return;
    int row = int(number) / grid.x;
    SmoothBoxes fine = boxes_of_level(task, level - 1, behind_counts());
    uint count = find_parts(fine, int(number) % grid.x, row % grid.y, row / grid.y);
    if (count == 0u) return;
    if (count > 8u * kMostInBox) {
        stop(kBeyondDevice);
        return;
    }
    uint ways = 0u;
    for (int part = 0; part < 4; ++part) {
        for (uint i = part_first[part]; i < part_end[part]; ++i) ways |= 1u << facing_of(sorted[i].normal_offset.xyz);
    }
    for (int facing = 0; facing < 6; ++facing) {
        if ((ways & (1u << facing)) != 0u) merge_facing(task, facing, 6u * number + uint(facing));
    }
}
