// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
// Computes which spans of rays a convex tool covers: one invocation a ray of the sweep's footprint, which takes the
// section with each of the sweep's pieces and joins them. Sections and the rule that joins them are texts that the host
// compiles too (shaders/shared/convex_sweep.h, covered_part.h), so that both give the same bits.
//
// The spans of a ray are added to the list at once and in order; the order of the rays in it is any. Where the list is
// too small, or a ray has too many parts, the counters say so and nothing is added for that ray.
#include "shaders/shared/cover_job.h"
#include "shaders/shared/cut_job.h"

layout(local_size_x = 64) in;
layout(push_constant) uniform Push { CoverParameters parameters; };
layout(std430, binding = 0) readonly buffer Pieces { CoverPiece pieces[]; };
layout(std430, binding = 1) writeonly buffer Rays { CoveredRay rays[]; };
layout(std430, binding = 2) writeonly buffer Spans { CoveredSpan spans[]; };
layout(std430, binding = 3) buffer Counters { CoverCounters counters; };

int part_count = 0;
CoveredPart parts[kMostParts];
CoveredPart load_part(int i) { return parts[i]; }
void store_part(int i, CoveredPart part) { parts[i] = part; }
bool has_room_for_part() { return part_count < kMostParts; }
#include "shaders/shared/join_parts.h"

bool is_near(uint piece, int axis, int u, int v) {
    int along_u = (axis + 1) % 3;
    int along_v = (axis + 2) % 3;
    return u >= pieces[piece].lo[along_u] && u <= pieces[piece].hi[along_u] &&  //
           v >= pieces[piece].lo[along_v] && v <= pieces[piece].hi[along_v];
}

// Collects the parts that the moves cover. Returns false if there are too many.
bool collect_parts(int axis, int u, int v) {
    SweepRay ray;
    ray.axis = axis;
    ray.u = double(u * kUnitsPerCell);
    ray.v = double(v * kUnitsPerCell);
    CoveredPart of_move;
    bool is_covered = false;
    for (uint i = 0u; i < parameters.pieces; ++i) {
        if (is_near(i, axis, u, v)) {
            SweepSpan span = span_of_piece(pieces[i], ray);
            if (!is_empty(span)) {
                CoveredPart part = part_of(span);
                if (is_covered) part = joined(of_move, part);
                of_move = part;
                is_covered = true;
            }
        }
        if (pieces[i].ends_move == 1 && is_covered) {
            if (!add_part(of_move)) return false;
            is_covered = false;
        }
    }
    return true;
}

// Returns the number of parts that hold a whole depth of the lattice.
uint span_count(int deepest) {
    uint count = 0u;
    for (int i = 0; i < part_count; ++i) {
        RaySpan depths = depths_of(parts[i], deepest);
        if (depths.lo < depths.hi) count += 1u;
    }
    return count;
}

// Removes the part with the least lo and returns it.
CoveredPart take_lowest_part() {
    int lowest = 0;
    for (int i = 1; i < part_count; ++i) {
        if (parts[i].lo < parts[lowest].lo) lowest = i;
    }
    CoveredPart part = parts[lowest];
    part_count -= 1;
    parts[lowest] = parts[part_count];
    return part;
}

void main() {
    uint number = parameters.first_ray + gl_GlobalInvocationID.x;
    if (number >= parameters.rays) return;
    int axis = 0;
    if (number >= parameters.rectangles[1].first_ray) axis = 1;
    if (number >= parameters.rectangles[2].first_ray) axis = 2;
    CoverRectangle rectangle = parameters.rectangles[axis];
    int place = int(number - rectangle.first_ray);
    int u = rectangle.u + place % rectangle.width;
    int v = rectangle.v + place / rectangle.width;
    CoveredRay ray = CoveredRay(ray_code(axis, u, v), 0u, 0u);
    if (!collect_parts(axis, u, v)) {
        atomicAdd(counters.overfull, 1u);
        rays[number] = ray;
        return;
    }
    uint count = span_count(rectangle.deepest);
    if (count > 0u) {
        uint first = atomicAdd(counters.spans, count);
        if (first + count <= parameters.spans) {
            ray.first = first;
            ray.count = count;
        } else {
            atomicAdd(counters.unplaced, count);
        }
    }
    rays[number] = ray;
    uint next = ray.first;
    while (next < ray.first + ray.count) {
        CoveredSpan span = span_of_part(take_lowest_part(), axis, rectangle.deepest);
        if (span.lo < span.hi) {
            spans[next] = span;
            next += 1u;
        }
    }
}
