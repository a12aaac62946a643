// SPDX-License-Identifier: MIT
// What shaders/cover_rays.comp hands to the kernel that consumes it: which spans of which rays a tool covers. All
// fields are 32-bit words, so the layout is the same everywhere.
#ifndef BURIN_SHARED_COVERED_RAYS_H
#define BURIN_SHARED_COVERED_RAYS_H
#include "shaders/shared/portable.h"

BURIN_SHARED_BEGIN

// A ray that was visited. The tool covers spans[first .. first + count) of it, ascending; no two of them touch.
struct CoveredRay {
    uint ray;  // ray_code (cut_job.h)
    uint first;
    uint count;
};

// A span of a ray that a tool covers, lo <= d < hi, within the lattice. Normals are codes (octahedral.h) and point out
// of the tool.
struct CoveredSpan {
    int lo;
    int hi;
    uint normal_lo;
    uint normal_hi;
};

// Where one of `unplaced` and `overfull` is above zero, some rays that the tool covers have a count of zero.
struct CoverCounters {
    uint spans;     // that the tool covers, those included that found no space in the list
    uint unplaced;  // of them, those that found no space
    uint overfull;  // rays covered in more than kMostParts parts (cover_job.h); their spans are not in `spans`
};
BURIN_FN bool is_complete(CoverCounters counters) {
    return counters.unplaced == uint(0) && counters.overfull == uint(0);
}

BURIN_SHARED_END

#ifdef __cplusplus
static_assert(sizeof(burin::shared::CoveredRay) == 12 && sizeof(burin::shared::CoveredSpan) == 16 &&
              sizeof(burin::shared::CoverCounters) == 12);
#endif
#endif
