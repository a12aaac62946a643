// SPDX-License-Identifier: MIT
// The arithmetic of the field whose zero level is the smoothed surface (compute/tools/smooth_field.hpp says what it is
// and why), for C++ and GLSL. Lengths in cells. The order in which points are added fixes every bit of the sums.
#ifndef BURIN_SHARED_SMOOTH_FIELD_H
#define BURIN_SHARED_SMOOTH_FIELD_H
#include "shaders/shared/doubles.h"

BURIN_SHARED_BEGIN

// The shares of the two terms of the field.
const double kOfPlanes = 0.25;
const double kOfMiddle = 0.75;
// A level is used for widths of at least this many of its merged boxes.
const double kBoxesAWidth = 3.0;

// The share with which a point counts whose normal has this cosine with the mean normal.
BURIN_HOT_FN double facing_weight(double cosine) {
    double t = clamp((cosine + 0.5) / 0.5, 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
}

// A point near a place.
struct NearPoint {
    Double3 normal;
    Double3 off;   // from the place to the point
    double ratio;  // squared distance over squared width
    double area;
    double offset;  // SurfacePoint::offset
};

// The width of the kernel at a place.
struct KernelWidth {
    double value;
    Double3 gradient;  // how it changes with the place
};

BURIN_HOT_FN Double3 with_mean_normal(Double3 mean, Double3 normal, double area, double ratio) {
    double u = 1.0 - ratio;
    return mean + area * u * u * u * normal;
}

// Sums of the points near a place, each with its weight.
struct KernelSums {
    double weight;
    double height;
    Double3 normal;
    Double3 off;
};
// Their gradients by the place; of the sums of vectors, component by component.
struct KernelSlopes {
    Double3 weight;
    Double3 height;
    Double3 normal_x;
    Double3 normal_y;
    Double3 normal_z;
    Double3 off_x;
    Double3 off_y;
    Double3 off_z;
};

BURIN_HOT_FN KernelSums no_sums() {
    KernelSums sums;
    sums.weight = 0.0;
    sums.height = 0.0;
    sums.normal = Double3(0.0);
    sums.off = Double3(0.0);
    return sums;
}
BURIN_HOT_FN KernelSlopes no_slopes() {
    KernelSlopes slopes;
    slopes.weight = Double3(0.0);
    slopes.height = Double3(0.0);
    slopes.normal_x = Double3(0.0);
    slopes.normal_y = Double3(0.0);
    slopes.normal_z = Double3(0.0);
    slopes.off_x = Double3(0.0);
    slopes.off_y = Double3(0.0);
    slopes.off_z = Double3(0.0);
    return slopes;
}

BURIN_HOT_FN KernelSums with_point(KernelSums sums, NearPoint near, double facing) {
    double u = 1.0 - near.ratio;
    double g = near.area * facing * u * u * u;
    sums.weight += g;
    sums.height += g * (dot3(near.normal, near.off) + near.offset);
    sums.normal += g * near.normal;
    sums.off += g * near.off;
    return sums;
}
BURIN_HOT_FN KernelSlopes with_slope(KernelSlopes slopes, NearPoint near, double facing, KernelWidth width) {
    double u = 1.0 - near.ratio;
    Double3 by_place = near.area * facing * 6.0 * u * u *
                       (near.off / (width.value * width.value) + near.ratio / width.value * width.gradient);
    slopes.weight += by_place;
    slopes.height += (dot3(near.normal, near.off) + near.offset) * by_place;
    slopes.normal_x += near.normal[0] * by_place;
    slopes.normal_y += near.normal[1] * by_place;
    slopes.normal_z += near.normal[2] * by_place;
    slopes.off_x += near.off[0] * by_place;
    slopes.off_y += near.off[1] * by_place;
    slopes.off_z += near.off[2] * by_place;
    return slopes;
}

BURIN_HOT_FN bool are_known(KernelSums sums) { return sums.weight > 0.0 && length3(sums.normal) > 0.0; }
// Returns the field; the sums must be known.
BURIN_HOT_FN double distance_of(KernelSums sums) {
    return -(kOfPlanes * sums.height + kOfMiddle * dot3(sums.normal, sums.off) / length3(sums.normal)) / sums.weight;
}
// Returns the field's gradient.
BURIN_HOT_FN Double3 gradient_of(KernelSums sums, KernelSlopes slopes) {
    double length = length3(sums.normal);
    Double3 m = sums.normal / length;
    double along = dot3(m, sums.off);
    Double3 m_by_normal =
        Double3(0.0) + m[0] * slopes.normal_x + m[1] * slopes.normal_y + m[2] * slopes.normal_z;
    Double3 moving = -sums.weight * m + m[0] * slopes.off_x + m[1] * slopes.off_y + m[2] * slopes.off_z;
    Double3 turning = Double3(0.0) + sums.off[0] / length * (slopes.normal_x - m[0] * m_by_normal) +
                      sums.off[1] / length * (slopes.normal_y - m[1] * m_by_normal) +
                      sums.off[2] / length * (slopes.normal_z - m[2] * m_by_normal);
    return -(kOfPlanes * (slopes.height - sums.normal) + kOfMiddle * (turning + moving)) / sums.weight +
           (kOfPlanes * sums.height + kOfMiddle * along) / (sums.weight * sums.weight) * slopes.weight;
}

// The direction of the lattice that a normal faces most: twice the axis, and one more for the negative direction.
// Points merge where it is the same.
BURIN_HOT_FN int facing_of(Double3 normal) {
    int axis = 0;
    if (abs(normal[1]) > abs(normal[axis])) axis = 1;
    if (abs(normal[2]) > abs(normal[axis])) axis = 2;
    return 2 * axis + (normal[axis] < 0.0 ? 1 : 0);
}

// Sums of points that merge; heights count from the first one's place.
struct MergedSums {
    Double3 place;
    Double3 normal;
    double area;
    double height;
};
BURIN_HOT_FN MergedSums nothing_merged() {
    MergedSums sums;
    sums.place = Double3(0.0);
    sums.normal = Double3(0.0);
    sums.area = 0.0;
    sums.height = 0.0;
    return sums;
}
BURIN_HOT_FN MergedSums with_merged(MergedSums sums, Double3 place, Double3 normal, double area, double offset,
                                    Double3 first) {
    sums.place += area * place;
    sums.normal += area * normal;
    sums.area += area;
    sums.height += area * (dot3(normal, place - first) + offset);
    return sums;
}
// Returns the means of sums whose area is above zero; the height is that of a point's offset.
BURIN_HOT_FN MergedSums means_of(MergedSums sums, Double3 first) {
    sums.place = sums.place / sums.area;
    sums.normal = sums.normal / sums.area;
    sums.height = sums.height / sums.area - dot3(sums.normal, sums.place - first);
    return sums;
}

BURIN_SHARED_END
#endif
