// SPDX-License-Identifier: MIT
// The buffers and push constants of gather_ball.comp and gather_corners.comp.
#include "shaders/shared/mesh_job.h"

layout(push_constant) uniform Push { GatherParameters parameters; };
layout(std430, binding = 0) buffer Counters { MeshCounters counters; };
layout(std430, binding = 1) readonly buffer Ranges { TileRange ranges[]; };
layout(scalar, binding = 2) writeonly buffer BallPlaces { vec3 ball_places[]; };
layout(scalar, binding = 3) buffer BallTriangles { uvec3 ball_triangles[]; };

// The pool of vertices again, as far as a binding covers it: software drivers read whole vectors through a binding.
struct PlacedVertex {
    vec3 place;
    uint normal;
    uint colour;
};
layout(scalar, binding = 4) readonly buffer BoundVertices { PlacedVertex bound_vertices[]; };

// For each vertex of the pool, the ball that it was last in and its number there.
struct Member {
    uint stamp;
    uint number;
};
layout(buffer_reference, std430, buffer_reference_align = 8) buffer Members { Member at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Vertices { PlacedVertex at[]; };
struct TrianglePair {
    uint a;
    uint b;
    uint c;
    uint d;
    uint e;
    uint f;
};
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer TrianglePairs { TrianglePair at[]; };
