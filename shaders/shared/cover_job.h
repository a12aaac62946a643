// SPDX-License-Identifier: MIT
// The interface between the host and shaders/cover_rays.comp: what a sweep's convex pieces are and which rays to visit.
// What comes of it is in covered_rays.h.
#ifndef BURIN_SHARED_COVER_JOB_H
#define BURIN_SHARED_COVER_JOB_H
#include "shaders/shared/covered_part.h"
#include "shaders/shared/covered_rays.h"

BURIN_SHARED_BEGIN

const int kCoverGroup = 64;  // invocations in a work group, one ray each

// A software driver ends an invocation's loops, silently, after 65535 iterations of all of them. The most here are 17
// for each of 2048 moves of one piece, and fewer than 1000 for the result.
const int kMostCoverPieces = 2048;
const int kMostParts = 16;  // of a ray that do not touch

const int kFrustumNumbers = 19;
const int kFrustumPiece = 0;
const int kBoxPiece = 1;

// One piece of a sweep: 184 bytes.
struct CoverPiece {
    double numbers[kFrustumNumbers];  // packed_frustum, packed_box
    // The nodes along x, y and z between which rays may meet the piece. The ray (u, v) of an axis is looked at where u
    // is within the range of axis + 1 and v within that of axis + 2; nowhere when lo > hi.
    int lo[3];
    int hi[3];
    int kind;
    int ends_move;  // 1: the last piece of its straight move
};

// The rays of one axis that are visited.
struct CoverRectangle {
    int u;  // of the lowest ray
    int v;
    int width;       // rays along u
    uint first_ray;  // number of its first ray among all that are visited
    int deepest;     // the depth at which the lattice ends
};

// Push constants: 76 bytes.
struct CoverParameters {
    CoverRectangle rectangles[3];
    uint rays;  // visited, on all axes
    uint pieces;
    uint spans;      // length of the list of CoveredSpan
    uint first_ray;  // that this dispatch visits
};

BURIN_FN Double3 vector_at(CoverPiece piece, int i) {
    return Double3(piece.numbers[i], piece.numbers[i + 1], piece.numbers[i + 2]);
}
BURIN_FN CoverPiece with_vector(CoverPiece piece, int i, Double3 v) {
    piece.numbers[i] = v[0];
    piece.numbers[i + 1] = v[1];
    piece.numbers[i + 2] = v[2];
    return piece;
}

BURIN_FN SweptFrustum frustum_of(CoverPiece piece) {
    SweptFrustum k;
    k.tip_radius = piece.numbers[0];
    k.top_radius = piece.numbers[1];
    k.height = piece.numbers[2];
    k.rim_radius = piece.numbers[3];
    k.rim_height = piece.numbers[4];
    k.slope = piece.numbers[5];
    k.distance = piece.numbers[6];
    k.tip = vector_at(piece, 7);
    k.axis = vector_at(piece, 10);
    k.direction = vector_at(piece, 13);
    k.middle = vector_at(piece, 16);
    return k;
}
BURIN_FN CoverPiece packed_frustum(CoverPiece piece, SweptFrustum k) {
    piece.kind = kFrustumPiece;
    piece.numbers[0] = k.tip_radius;
    piece.numbers[1] = k.top_radius;
    piece.numbers[2] = k.height;
    piece.numbers[3] = k.rim_radius;
    piece.numbers[4] = k.rim_height;
    piece.numbers[5] = k.slope;
    piece.numbers[6] = k.distance;
    piece = with_vector(piece, 7, k.tip);
    piece = with_vector(piece, 10, k.axis);
    piece = with_vector(piece, 13, k.direction);
    return with_vector(piece, 16, k.middle);
}

BURIN_FN SweptBox box_of(CoverPiece piece) {
    SweptBox k;
    k.half_size = vector_at(piece, 0);
    k.middle = vector_at(piece, 3);
    k.half_along_tool = vector_at(piece, 6);
    k.lattice_from_tool.w = piece.numbers[9];
    k.lattice_from_tool.xyz = vector_at(piece, 10);
    return k;
}
BURIN_FN CoverPiece packed_box(CoverPiece piece, SweptBox k) {
    piece.kind = kBoxPiece;
    piece = with_vector(piece, 0, k.half_size);
    piece = with_vector(piece, 3, k.middle);
    piece = with_vector(piece, 6, k.half_along_tool);
    piece.numbers[9] = k.lattice_from_tool.w;
    return with_vector(piece, 10, k.lattice_from_tool.xyz);
}

BURIN_FN SweepSpan span_of_piece(CoverPiece piece, SweepRay ray) {
    if (piece.kind == kBoxPiece) return box_span(box_of(piece), ray);
    return frustum_span(frustum_of(piece), ray);
}

BURIN_SHARED_END

#ifdef __cplusplus
static_assert(sizeof(burin::shared::CoverPiece) == 184 && sizeof(burin::shared::CoverParameters) == 76);
#endif
#endif
