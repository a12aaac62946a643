// SPDX-License-Identifier: MIT
// The interface between the host and the shaders that smooth within a ball (compute/vulkan/smooth_passes.hpp), and what
// they hand to each other.
#ifndef BURIN_SHARED_SMOOTH_JOB_H
#define BURIN_SHARED_SMOOTH_JOB_H
#include "shaders/shared/cut_job.h"
#include "shaders/shared/smooth_ball.h"

BURIN_SHARED_BEGIN

const int kSmoothGroup = 64;  // invocations in a work group
const int kMostLevels = 6;    // of merged points

// A software driver ends the loops of some invocations that it runs together, silently, after 65535 iterations of all
// of them. The field is evaluated up to four times, each time in two loops over kMostNear rows and points at most, and
// a material looked for among kMostNearest. Invocations that run together may still take more turns than one of them,
// so each looks whether its loops came to their end.
const int kMostNear = 4000;
const int kMostNearest = 6000;
const uint kMostSmoothEnds = uint(512);  // of a ray near the ball
const uint kMostInBox = uint(1024);      // points of one box

// Why a pass that smooths stops: space for a list (then its count says how much), or what is beyond the device.
const uint kShortOfSpace = uint(1);
const uint kBeyondDevice = uint(2);

// A ball that smooths: 152 bytes. Ranges of nodes and boxes are per axis.
struct SmoothTask {
    double start[3];  // the path of its middle, in cells
    double along[3];
    double radius;
    double most_width2;
    double reach;  // how far from the path ends count
    uint material;
    int levels;
    int lo[3];  // nodes that the tool may reach
    int hi[3];
    int ray_lo[3];  // nodes between which rays have ends that count
    int ray_hi[3];
    // The boxes of the first level, a cell wide: those of level i are 2^i as wide, and as many times fewer.
    int box_lo[3];
    int boxes[3];
};

// A point of the surface: 96 bytes. Software drivers load a vector in the time of one number.
#ifdef __cplusplus
using Double4 = glm::dvec4;
using Uint4 = glm::uvec4;
#else
#define Double4 dvec4
#define Uint4 uvec4
#endif
struct SmoothPoint {
    Double4 place_area;
    Double4 normal_offset;
    // x: its rank among the points as the host lists them; equal for those of one ray, which are in order. y: its box's
    // place in the list of boxes; z: its number in the box as it came; w: its material.
    Uint4 key_box;
    Uint4 unused;
};

const uint kWasInside = uint(1);
const uint kIsInside = uint(2);
const uint kWeighs = uint(4);  // the tool reaches it
const uint kIsKnown = uint(8);  // its field is known, or will be

struct SmoothNode {
    double field;
    uint flags;
    uint unused;
};

// An end to be moved, or to be made on an edge, and what comes of it.
const uint kIsMade = uint(1);
const uint kLowInside = uint(2);
const uint kInsideBetween = uint(4);  // material is between this end and the next
const uint kHasNext = uint(8);        // the next end is on the same edge
struct SmoothEnd {
    uint ray;  // ray_code
    int low;   // the node below
    uint number;  // of the end in its ray, where it is moved
    uint flags;
    DexelEnd result;
    uint is_gone;  // 1: it and the next one have met
    uint unused;
};

// A ray on which an edge may change: its ends in the list of SmoothEnd, and the new ones in the list of fresh ends.
struct SmoothRay {
    uint ray;
    uint first_end;
    uint first_fresh;
    uint count;
    int changed_lo;  // nothing changes where lo > hi
    int changed_hi;
    uint exported;  // place of its first end among those that are exported
};

struct SmoothGroups {
    uint x;
    uint y;
    uint z;
};

struct SmoothCounters {
    uint stopped;  // 1: this pass does nothing more
    uint why;      // kShortOfSpace, kBeyondDevice
    uint unstored;  // rays without room in the store, or among the exported ends
    uint points[kMostLevels];  // of each level
    uint placed[kMostLevels];
    uint waves[kMostWaves + 1];  // nodes of each wave
    uint ends;
    uint rays;
    uint fresh;
    // Work groups over the points of a level, the nodes of a wave, the ends, the rays.
    SmoothGroups of_points[kMostLevels];
    SmoothGroups of_waves[kMostWaves + 1];
    SmoothGroups of_ends;
    SmoothGroups of_rays;
};

// Push constants: 104 bytes.
struct SmoothParameters {
    uint64_t store_address;
    int rays_u[3];
    int rays_v[3];
    uint first_ray[3];
    uint store_size;
    uint export_size;
    uint pass;       // its number in the submission
    uint ball;       // its task
    uint step;       // the level, or the wave
    uint most_ends;  // of a ray, for which the passes behind are made
    // Lengths of the lists.
    uint points;
    uint sorted;
    uint boxes;  // counts of boxes, then of rows, are at the front of the list of boxes, zero between passes
    uint rows;
    uint waves;
    uint ends;
    uint rays;
    uint fresh;
};

// The boxes of a level: their counts along x, y and z, and the places in the list of boxes where each row's points are
// counted, and where each row's first points are. A row has a place more than boxes, for the end of the last.
struct SmoothBoxes {
    int x;
    int y;
    int z;
    uint rows;
    uint firsts;
};
BURIN_FN SmoothBoxes boxes_of_level(SmoothTask task, int level, uint behind_counts) {
    SmoothBoxes boxes;
    boxes.firsts = behind_counts;
    for (int i = 0; i <= level; ++i) {
        boxes.x = task.boxes[0] >> i;
        boxes.y = task.boxes[1] >> i;
        boxes.z = task.boxes[2] >> i;
        boxes.rows = boxes.firsts;
        boxes.firsts = boxes.rows + uint(boxes.y) * uint(boxes.z);
        if (i < level) boxes.firsts += uint(boxes.y) * uint(boxes.z) * uint(boxes.x + 1);
    }
    return boxes;
}

BURIN_FN SmoothPath path_of(SmoothTask task) {
    SmoothPath path;
    path.start = Double3(task.start[0], task.start[1], task.start[2]);
    path.along = Double3(task.along[0], task.along[1], task.along[2]);
    path.radius = task.radius;
    path.most_width2 = task.most_width2;
    return path;
}

BURIN_SHARED_END

#ifdef __cplusplus
static_assert(sizeof(burin::shared::SmoothTask) == 152 && sizeof(burin::shared::SmoothPoint) == 96 &&
              sizeof(burin::shared::SmoothNode) == 16 && sizeof(burin::shared::SmoothEnd) == 32 &&
              sizeof(burin::shared::SmoothRay) == 28 && sizeof(burin::shared::SmoothParameters) == 104);
#endif
#endif
