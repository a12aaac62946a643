// SPDX-License-Identifier: MIT
// What the host and shaders/cut_rays.comp tell each other: which rays to cut by which capsules, which of them changed, and
// which have to wait for another pass. All fields are 32-bit words, so the layout is the same everywhere.
#ifndef BURIN_SHARED_CUT_JOB_H
#define BURIN_SHARED_CUT_JOB_H
#include "shaders/shared/capsule.h"

BURIN_SHARED_BEGIN

const int kCutGroup = 64;  // invocations in a work group, one ray each

// One work group's rays: numbers offset .. offset + 63 of a rectangle of rays, row by row. They take the capsules that
// order[first .. end) names.
struct CutTask {
    int axis;
    int u;  // the rectangle's lowest ray
    int v;
    int width;
    int height;
    int offset;
    uint first;
    uint end;
};

// A ray in one word; u and v take 12 bits each (kMaxCells).
BURIN_FN uint ray_code(int axis, int u, int v) { return uint(axis) | (uint(u) << 2) | (uint(v) << 14); }
BURIN_FN int axis_of(uint code) { return int(code & uint(3)); }
BURIN_FN int u_of(uint code) { return int((code >> 2) & uint(0xfff)); }
BURIN_FN int v_of(uint code) { return int(code >> 14); }

// A ray that is done with and differs from before: its ends are exported[first .. first + count).
struct ChangedRay {
    uint ray;
    uint first;
    uint count;
    int changed_lo;  // the depths between which it changed
    int changed_hi;
};

// A ray that is not done with; it holds what the capsules before order[next] left. It waits for room in the store, for
// space among the exported ends (then next == end), or because it had its share of one pass.
struct PendingRay {
    uint ray;
    uint next;
    uint end;
    int changed_lo;  // changed so far; nothing when lo > hi
    int changed_hi;
    uint touched;  // 1: has been counted as touched
};

struct CutCounters {
    uint used;         // ends of the store that are taken, or more than it has when room was asked for in vain
    uint touched;      // rays in a capsule's footprint, counted when that is first seen
    uint changed;      // length of the list of ChangedRay
    uint exported;     // ends exported, or more than there is space when some found none
    uint pending;      // length of the list of PendingRay
    uint room_wanted;  // ends that pending rays asked the store for in vain
    uint longest;      // most ends of a ray that changed or is pending
    uint stale;        // length of the list of rays that the host does not know yet
};

// A ray that the host gives other ends: patch_ends[first .. first + count).
struct PatchRay {
    uint ray;
    uint first;
    uint count;
};

struct CutParameters {
    uint64_t store_address;
    int rays_u[3];
    int rays_v[3];
    uint first_ray[3];  // of each axis in the table of all rays
    uint store_size;    // ends
    uint export_size;   // ends
    uint cuts;          // capsules that a ray may take in one pass
    uint looks;         // capsules that it may look at, near or far
    uint pending;       // 0: the tasks are new; else so many pending rays are continued instead
    uint deferred;      // 1: the ends of changed rays are not exported; the rays go on the list of stale ones
    uint first_stale;   // where in the list of stale rays to begin
};

BURIN_SHARED_END

#ifdef __cplusplus
static_assert(sizeof(burin::shared::Capsule) == 40 && sizeof(burin::shared::CutTask) == 32 &&
              sizeof(burin::shared::ChangedRay) == 20 && sizeof(burin::shared::PendingRay) == 24 &&
              sizeof(burin::shared::CutCounters) == 32 && sizeof(burin::shared::PatchRay) == 12 &&
              sizeof(burin::shared::CutParameters) == 72);
#endif
#endif
