// SPDX-License-Identifier: MIT
// The rule that joins what the pieces of a sweep cover of one ray to the spans that the tool covers.
//
// A tool on one straight move is convex, so its pieces' sections join to one part: from the least lo to the greatest
// hi, whatever rounding leaves between them. The parts of several moves join where less than one unit of depth is
// between them. Of several sections with the same lo the first decides the normal there; of several with the same hi
// the one with the least lo, and of those the first. So the order in which the parts of the moves join does not matter.
#ifndef BURIN_SHARED_COVERED_PART_H
#define BURIN_SHARED_COVERED_PART_H
#include "shaders/shared/convex_sweep.h"
#include "shaders/shared/covered_rays.h"
#include "shaders/shared/dexel.h"
#include "shaders/shared/normal_code.h"

BURIN_SHARED_BEGIN

// A part's normal. In C++ it is that of a section which outlives the part, so that less is copied.
#ifdef __cplusplus
using PartNormal = const Double3*;
using KeptSpan = const SweepSpan&;
BURIN_HOT_FN PartNormal part_normal(const Double3& kept) { return &kept; }
BURIN_HOT_FN Double3 vector_of(PartNormal normal) { return *normal; }
#else
#define PartNormal dvec3
#define KeptSpan SweepSpan
dvec3 part_normal(dvec3 vector) { return vector; }
dvec3 vector_of(dvec3 normal) { return normal; }
#endif

// Sections that are joined; lattice units.
struct CoveredPart {
    double lo;
    double hi;
    double lo_of_hi;  // where the section that ends at hi begins
    PartNormal normal_lo;
    PartNormal normal_hi;
};

BURIN_HOT_FN CoveredPart part_of(KeptSpan span) {
    CoveredPart part;
    part.lo = span.lo;
    part.hi = span.hi;
    part.lo_of_hi = span.lo;
    part.normal_lo = part_normal(span.normal_lo);
    part.normal_hi = part_normal(span.normal_hi);
    return part;
}

// Tells whether parts of two moves join: no whole depth is between them that neither holds. Of parts that overlap this
// is always true, and known at less cost.
BURIN_HOT_FN bool touch(CoveredPart a, CoveredPart b) {
    if (a.lo <= b.hi && b.lo <= a.hi) return true;
    return ceil(a.lo) <= floor(b.hi) + 1.0 && ceil(b.lo) <= floor(a.hi) + 1.0;
}

// Returns the part from the lesser lo to the greater hi. `first` comes before `second` in the order of moves and
// pieces.
BURIN_HOT_FN CoveredPart joined(CoveredPart first, CoveredPart second) {
    if (second.lo < first.lo) {
        first.lo = second.lo;
        first.normal_lo = second.normal_lo;
    }
    if (second.hi > first.hi || (second.hi == first.hi && second.lo_of_hi < first.lo_of_hi)) {
        first.hi = second.hi;
        first.lo_of_hi = second.lo_of_hi;
        first.normal_hi = second.normal_hi;
    }
    return first;
}

// Returns the whole depths of a part within the lattice, whose last depth on this axis is `deepest`; nothing is covered
// where lo >= hi.
BURIN_HOT_FN RaySpan depths_of(CoveredPart part, int deepest) {
    RaySpan depths;
    depths.lo = 0;
    depths.hi = 0;
    double from = max(part.lo, 0.0);
    double to = min(part.hi, double(deepest));
    if (from < to) {
        depths.lo = int(ceil(from));
        depths.hi = int(floor(to));
    }
    return depths;
}

// Returns the same with normals. Where the part leaves the lattice, the normal lies along the ray.
BURIN_HOT_FN CoveredSpan span_of_part(CoveredPart part, int axis, int deepest) {
    RaySpan depths = depths_of(part, deepest);
    Double3 e = axis_vector(axis);
    CoveredSpan span;
    span.lo = depths.lo;
    span.hi = depths.hi;
    span.normal_lo = normal_code(part.lo < 0.0 ? -e : vector_of(part.normal_lo));
    span.normal_hi = normal_code(part.hi > double(deepest) ? e : vector_of(part.normal_hi));
    return span;
}

BURIN_SHARED_END

#endif
