// SPDX-License-Identifier: MIT
// The vertex of a carved surface, as the mesher writes it and the renderer reads it: 20 bytes, no padding.
// Positions are in metres in the object frame, relative to the solid's lattice origin (float keeps 1e-7 of its extent).
// The normal is octahedral, 16 bits an axis; the colour is sRGB, 8 bits a channel, red in the lowest byte.
#ifndef BURIN_SHARED_SURFACE_VERTEX_H
#define BURIN_SHARED_SURFACE_VERTEX_H
#include "shaders/shared/portable.h"

BURIN_SHARED_BEGIN

struct SurfaceVertex {
    float x;
    float y;
    float z;
    uint normal;  // octahedral.h
    uint colour;
};

BURIN_SHARED_END

#ifdef __cplusplus
static_assert(sizeof(burin::shared::SurfaceVertex) == 20);
#endif
#endif
