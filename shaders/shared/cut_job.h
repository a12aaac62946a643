// SPDX-License-Identifier: MIT
// The interface between the host and shaders/cut_rays.comp and cut_covered.comp: which rays to cut by which capsules,
// or by what a tool covers of them, which of them changed, and which have to wait for another pass. All fields but
// those of the push constants are 32-bit words, so the layout is the same everywhere. Passes that smooth (smooth_job.h)
// share the counters and the list of changed rays.
//
// Several passes may follow each other in one submission, each with its number. One that leaves anything undone keeps
// all that come after it from beginning, so that the order of the work stays.
#ifndef BURIN_SHARED_CUT_JOB_H
#define BURIN_SHARED_CUT_JOB_H
#include "shaders/shared/capsule.h"

BURIN_SHARED_BEGIN

const int kCutGroup = 64;  // invocations in a work group, one ray each
const int kMostPasses = 32;  // of one submission
const uint kNotBegun = uint(0x80000000);
const uint kNoRay = uint(0xffffffff);  // in place of a ray's code

// The rays of some work groups that follow each other, row by row of a rectangle. They are cut by the capsules in
// order[first .. end).
struct CutTask {
    int axis;
    int u;  // u and v of the rectangle's lowest ray
    int v;
    int width;
    int height;
    uint first;
    uint end;
    uint first_group;  // its number among those of the pass
};
BURIN_FN uint groups_of(CutTask task) { return uint((task.width * task.height + kCutGroup - 1) / kCutGroup); }

// Packs a ray into one word; u and v take 12 bits each (kMaxCells).
BURIN_FN uint ray_code(int axis, int u, int v) { return uint(axis) | (uint(u) << 2) | (uint(v) << 14); }
BURIN_FN int axis_of(uint code) { return int(code & uint(3)); }
BURIN_FN int u_of(uint code) { return int((code >> 2) & uint(0xfff)); }
BURIN_FN int v_of(uint code) { return int(code >> 14); }

// A ray that is finished and has changed: its ends are exported[first .. first + count).
struct ChangedRay {
    uint ray;
    uint first;
    uint count;
    int changed_lo;  // range of depths in which it changed
    int changed_hi;
};

// A ray that is not finished; it holds the result of the capsules before order[next]. It waits for space in the store,
// for space among the exported ends (then next == end), or because it has used up its share of one pass.
// Of what a tool covers, `next` counts the ray's spans and `end` is its number among the rays that are visited.
struct PendingRay {
    uint ray;
    uint next;
    uint end;
    int changed_lo;  // range of depths changed so far; none when lo > hi
    int changed_hi;
    uint touched;  // 1: already counted in CutCounters::touched
};

struct CutCounters {
    uint used;         // ends of the store that are allocated; exceeds store_size when an allocation failed
    uint touched;      // rays in a capsule's footprint, each counted once
    uint changed;      // length of the list of ChangedRay
    uint exported;     // ends exported; exceeds export_size when there was too little space
    uint pending;      // length of the list of PendingRay
    uint room_wanted;  // ends that pending rays could not allocate in the store
    uint longest;      // largest number of ends of a ray that changed or is pending
    // What a pass before left undone: kNotBegun, or its rays that wait. That of pass i is left[i + 1]; left[0] is what
    // patch_rays.comp found no room for.
    uint left[kMostPasses + 1];
    uint uncovered[kMostPasses];  // 1: what the tool covers in this pass is not known whole
};

// A ray whose ends the host replaces by patch_ends[first .. first + count).
struct PatchRay {
    uint ray;
    uint first;
    uint count;
};

struct CutParameters {
    uint64_t store_address;
    int rays_u[3];
    int rays_v[3];
    uint first_ray[3];  // index of each axis' first ray in the table of all rays
    uint store_size;    // ends
    uint export_size;   // ends
    uint cuts;          // most capsules that are applied to a ray in one pass
    uint looks;         // most capsules that are tested for a ray in one pass, near or far
    uint pending;       // 0: process new tasks; otherwise continue this number of pending rays instead
    uint pass;          // its number in the submission
    uint first_task;    // of cut_rays.comp: its tasks
    uint end_task;
    // Of cut_covered.comp: rays visited, and what the tool does with its spans (capsule.h).
    uint visited;
    uint work;
};

BURIN_SHARED_END

#ifdef __cplusplus
static_assert(sizeof(burin::shared::Capsule) == 40 && sizeof(burin::shared::CutTask) == 32 &&
              sizeof(burin::shared::ChangedRay) == 20 && sizeof(burin::shared::PendingRay) == 24 &&
              sizeof(burin::shared::CutCounters) == 288 && sizeof(burin::shared::PatchRay) == 12 &&
              sizeof(burin::shared::CutParameters) == 88);
#endif
#endif
