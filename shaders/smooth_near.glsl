// SPDX-License-Identifier: MIT
// The field at a place, as compute/tools/smooth_field.cpp computes it: the same points in the same order. Include after
// smooth_buffers.glsl; with SMOOTH_GRADIENT defined, the field's gradient is computed too.

// The points near a place are those of some boxes of each of some rows:
//   begin_near(task, level, place, width);
//   while (has_near_row()) {
//       take_near_row();
//       for (; near_next < near_end; ++near_next) ... sorted[near_next] ...;
//   }
// Rows without points are passed by in take_near_row: software drivers run through both sides of every branch, so that
// a turn of a loop costs all that stands in it. Where there are more rows and points than may be looked at, or a
// software driver has ended the loops before they were done, the ball is beyond the device (check_near).
SmoothBoxes near_grid;
ivec3 near_from;
ivec3 near_to;
int near_y;
int near_z;
uint near_next;
uint near_end;
int near_left;  // rows and points that may still be looked at

void begin_near(SmoothTask task, int level, dvec3 place, double width) {
    near_grid = boxes_of_level(task, level, behind_counts());
    double box = double(1 << level);
    ivec3 size = ivec3(near_grid.x, near_grid.y, near_grid.z);
    for (int a = 0; a < 3; ++a) {
        double last = double(size[a]) - 1.0;
        double lo = double(task.box_lo[a]);
        near_from[a] = int(clamp(floor((place[a] - width - lo) / box), 0.0, last + 1.0));
        near_to[a] = int(clamp(floor((place[a] + width - lo) / box), -1.0, last));
    }
    near_y = near_from.y;
    near_z = near_from.z;
    near_next = 0u;
    near_end = 0u;
    if (near_from.x > near_to.x || near_from.y > near_to.y) near_z = near_to.z + 1;
}

bool has_near_row() { return near_z <= near_to.z; }
void take_near_row() {
    near_next = 0u;
    near_end = 0u;
    do {
        uint row = uint(near_z * near_grid.y + near_y);
        if (boxes[near_grid.rows + row] > 0u) {
            uint box = near_grid.firsts + row * uint(near_grid.x + 1);
            near_next = boxes[box + uint(near_from.x)];
            near_end = boxes[box + uint(near_to.x) + 1u];
        }
        ++near_y;
        if (near_y > near_to.y) {
            near_y = near_from.y;
            ++near_z;
        }
        --near_left;
    } while (near_next == near_end && has_near_row());
    near_left -= int(near_end - near_next);
    if (near_left < 0) {
        stop(kBeyondDevice);
        near_next = near_end;
        near_z = near_to.z + 1;
    }
}
void check_near() {
    if (near_next < near_end || has_near_row()) stop(kBeyondDevice);
}

int level_for(SmoothTask task, double width) {
    int level = 0;
    while (level + 1 < task.levels && width >= kBoxesAWidth * double(2 << level)) ++level;
    return level;
}

struct FieldValue {
    bool known;
    double distance;
    dvec3 gradient;
};

// Returns the sum of the normals near a place, each with its weight.
dvec3 mean_normal_near(SmoothTask task, int level, dvec3 place, double width) {
    double width2 = width * width;
    dvec3 mean_normal = dvec3(0.0);
    near_left = kMostNear;
    begin_near(task, level, place, width);
    while (has_near_row()) {
        take_near_row();
        for (; near_next < near_end; ++near_next) {
            dvec4 place_area = sorted[near_next].place_area;
            dvec3 off = place_area.xyz - place;
            double ratio = dot3(off, off) / width2;
            if (ratio < 1.0)
                mean_normal =
                    with_mean_normal(mean_normal, sorted[near_next].normal_offset.xyz, place_area.w, ratio);
        }
    }
    check_near();
    return mean_normal;
}

FieldValue field_at(SmoothTask task, dvec3 place, KernelWidth width) {
    FieldValue value;
    value.known = false;
    value.distance = 0.0;
    value.gradient = dvec3(0.0);
    int level = level_for(task, width.value);
    double width2 = width.value * width.value;
    dvec3 mean_normal = mean_normal_near(task, level, place, width.value);
    double length = length3(mean_normal);
    if (!(length > 0.0)) return value;
    KernelSums sums = no_sums();
#ifdef SMOOTH_GRADIENT
    KernelSlopes slopes = no_slopes();
#endif
    near_left = kMostNear;
    begin_near(task, level, place, width.value);
    while (has_near_row()) {
        take_near_row();
        for (; near_next < near_end; ++near_next) {
            NearPoint near;
            dvec4 place_area = sorted[near_next].place_area;
            near.off = place_area.xyz - place;
            near.ratio = dot3(near.off, near.off) / width2;
            if (near.ratio < 1.0) {
                dvec4 normal_offset = sorted[near_next].normal_offset;
                near.normal = normal_offset.xyz;
                double facing = facing_weight(dot3(near.normal, mean_normal) / length);
                if (facing > 0.0) {
                    near.area = place_area.w;
                    near.offset = normal_offset.w;
                    sums = with_point(sums, near, facing);
#ifdef SMOOTH_GRADIENT
                    slopes = with_slope(slopes, near, facing, width);
#endif
                }
            }
        }
    }
    check_near();
    if (!are_known(sums)) return value;
    value.known = true;
    value.distance = distance_of(sums);
#ifdef SMOOTH_GRADIENT
    value.gradient = gradient_of(sums, slopes);
#endif
    return value;
}
