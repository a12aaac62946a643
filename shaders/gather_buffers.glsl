// SPDX-License-Identifier: MIT
// What gather_ball.comp and gather_corners.comp share.
#include "shaders/shared/mesh_job.h"

layout(push_constant) uniform Push { GatherParameters parameters; };
layout(std430, binding = 0) buffer Counters { MeshCounters counters; };
layout(std430, binding = 1) readonly buffer Ranges { TileRange ranges[]; };
layout(std430, binding = 2) buffer BallPlaces { float ball_places[]; };      // three a vertex
layout(std430, binding = 3) buffer BallTriangles { uint ball_triangles[]; };  // three a triangle

// For each vertex of the pool the ball that it was last in, and its number there.
struct Member {
    uint stamp;
    uint number;
};
layout(buffer_reference, std430, buffer_reference_align = 8) buffer Members { Member at[]; };
layout(buffer_reference, std430, buffer_reference_align = 4) buffer Vertices { SurfaceVertex at[]; };
layout(buffer_reference, std430, buffer_reference_align = 4) buffer Indices { uint at[]; };
