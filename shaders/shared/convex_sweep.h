// SPDX-License-Identifier: MIT
// The section of a lattice ray with a frustum or a box that moves along a segment without turning, in closed form.
//
// For a ray o + s e and a tool K that moves by t d, the set {(s, t): o + s e - t d in K, 0 <= t <= T} is convex, so the
// ray runs through the swept tool in one interval of s.
//   Frustum (cylinder, cone): the set is bounded by a conic (the side), two parallel lines (the caps) and two more
//   (start and end of the motion). The least and the greatest s of such a set lie where the conic meets one of those
//   lines or the line on which its own derivative by t vanishes, or where two lines meet. That takes a few quadratic
//   equations.
//   Box: swept along a segment it is the sum of four segments, a polytope whose faces are parallel to two of them each:
//   six pairs of parallel planes.
// Lattice axes and units; computed in doubles (doubles.h) with + - * / and roots only, and nothing is divided by zero.
// Rounding moves a border by less than 1e-6 units where the ray does not graze it. A candidate counts as feasible
// within kSweepSlack, so that a corner at which three borders meet is not lost to the rounding of each.
#ifndef BURIN_SHARED_CONVEX_SWEEP_H
#define BURIN_SHARED_CONVEX_SWEEP_H
#include "shaders/shared/doubles.h"

BURIN_SHARED_BEGIN

const double kSweepSlack = 9.5367431640625e-07;  // 2^-20 lattice units; far above rounding at coordinates up to 2^27
const double kFarAway = 1e9;                     // lattice units; farther than any point of a tool
#ifdef __cplusplus
const double kTouchNoise = 1e-13;  // of the discriminant of a line that touches the conic, relative
const double kConicNoise = 4e-15;  // of the conic's value, relative to the squares that it is made of
#else
const double kTouchNoise = 1e-13lf;
const double kConicNoise = 4e-15lf;
#endif

// The part of a ray that lies inside a swept tool.
struct SweepSpan {
    double lo;  // depths, not rounded; empty when lo > hi
    double hi;
    Double3 normal_lo;  // pointing out of the tool, of any length
    Double3 normal_hi;
    // Normals of planes that touch the swept piece at the ends. Those above may be those of another shape (rim_radius).
    Double3 plane_lo;
    Double3 plane_hi;
};
BURIN_HOT_FN bool is_empty(SweepSpan span) { return !(span.lo <= span.hi); }
BURIN_HOT_FN SweepSpan sweep_span(double lo, double hi) {
    SweepSpan span;
    span.lo = lo;
    span.hi = hi;
    span.normal_lo = Double3(0.0);
    span.normal_hi = Double3(0.0);
    span.plane_lo = Double3(0.0);
    span.plane_hi = Double3(0.0);
    return span;
}

// A ray of an axis; u and v in lattice units.
struct SweepRay {
    int axis;
    double u;
    double v;
};
// Returns the point of a ray that has the same depth as `near`.
BURIN_HOT_FN Double3 ray_beside(SweepRay ray, Double3 near) {
    if (ray.axis == 0) return Double3(near[0], ray.u, ray.v);
    if (ray.axis == 1) return Double3(ray.v, near[1], ray.u);
    return Double3(ray.u, ray.v, near[2]);
}

// A cylinder or a frustum of a cone, starting at its tip, and its motion.
struct SweptFrustum {
    double tip_radius;
    double top_radius;
    double height;
    double rim_radius;  // see compute/tools/convex_sweep.hpp; below zero if there is no rounding
    double rim_height;
    double slope;       // change of the radius per length along the axis
    double distance;    // length T of the motion
    Double3 tip;        // where it starts
    Double3 axis;       // of length 1, from the tip into the body
    Double3 direction;  // d, of the motion; of length 1, or zero for a stamp
    Double3 middle;     // of the axis, half-way along the motion
};

// The swept frustum in the (s, t) plane of one ray. With p = o + s e - t d its side is where
// |p|^2 - (p.axis)^2 - (tip_radius + slope p.axis)^2 <= 0.
struct SweepSection {
    double ss;  // coefficients of the conic; s, t and st are halved
    double st;
    double tt;
    double s;
    double t;
    double one;
    double y;  // coefficients of the height above the tip
    double ys;
    double yt;
    double noise;  // bound of the conic's value where it should be zero, from rounding and slack
    double distance;
    double height;
};

const int kSidePart = 0;
const int kRimPart = 1;
const int kCapPart = 2;

// A point of the (s, t) plane on a border, and which part of the tool's surface is there.
struct SweepCandidate {
    double s;
    double t;
    int part;
};

struct SweepExtremes {
    bool is_found;
    SweepCandidate least;  // by s
    SweepCandidate greatest;
};

// A line of the (s, t) plane: (s, t) + a (ds, dt).
struct SectionLine {
    double s;
    double t;
    double ds;
    double dt;
};
BURIN_HOT_FN SectionLine section_line(double s, double t, double ds, double dt) {
    SectionLine line;
    line.s = s;
    line.t = t;
    line.ds = ds;
    line.dt = dt;
    return line;
}

// Returns the line on which r s + w t + k = 0; r and w are not both zero. Its point is chosen near the strip
// 0 <= t <= T; with_line rejects a line that passes far away.
BURIN_HOT_FN SectionLine line_where(double r, double w, double k, double half_distance) {
    if (abs(r) >= abs(w)) return section_line(-(k + w * half_distance) / r, half_distance, -w / r, 1.0);
    return section_line(0.0, -k / w, 1.0, -r / w);
}

BURIN_HOT_FN bool is_within(double x, double length) { return x >= -kSweepSlack && x <= length + kSweepSlack; }
BURIN_HOT_FN double height_at(SweepSection f, double s, double t) { return f.y + f.ys * s + f.yt * t; }
BURIN_HOT_FN double conic_at(SweepSection f, double s, double t) {
    return (f.ss * s + 2.0 * (f.st * t + f.s)) * s + (f.tt * t + 2.0 * f.t) * t + f.one;
}

BURIN_HOT_FN SweepExtremes with_candidate(SweepExtremes found, double s, double t, int part) {
    SweepCandidate candidate;
    candidate.s = s;
    candidate.t = t;
    candidate.part = part;
    if (!found.is_found || s < found.least.s) found.least = candidate;
    if (!found.is_found || s > found.greatest.s) found.greatest = candidate;
    found.is_found = true;
    return found;
}

// Adds the candidate on a line that lies numerator / denominator along it from its point, where that is feasible.
BURIN_HOT_FN SweepExtremes with_root(SweepExtremes found, SweepSection f, SectionLine line, double numerator,
                                     double denominator, int part) {
    if (denominator == 0.0) return found;
    double way = numerator / denominator;
    double s = line.s + way * line.ds;
    double t = line.t + way * line.dt;
    if (is_within(t, f.distance) && is_within(height_at(f, s, t), f.height)) return with_candidate(found, s, t, part);
    return found;
}

// Adds the candidates at which a line meets the side.
BURIN_HOT_FN SweepExtremes with_line(SweepExtremes found, SweepSection f, SectionLine line, int part) {
    if (!(abs(line.s) < kFarAway && abs(line.t) < kFarAway)) return found;
    double a = (f.ss * line.ds + 2.0 * f.st * line.dt) * line.ds + f.tt * line.dt * line.dt;
    double b = (f.ss * line.s + f.st * line.t + f.s) * line.ds + (f.st * line.s + f.tt * line.t + f.t) * line.dt;
    double c = conic_at(f, line.s, line.t);
    double root2 = b * b - a * c;
    if (root2 < 0.0) {
        if (root2 < -kTouchNoise * (b * b + abs(a * c))) return found;
        root2 = 0.0;  // the line touches the conic, but for rounding
    }
    double root = sqrt(root2);
    double q = b < 0.0 ? root - b : -root - b;
    found = with_root(found, f, line, q, a, part);
    return with_root(found, f, line, c, q, part);
}

// Adds those of the line on which r s + w t + k = 0, where there is such a line.
BURIN_HOT_FN SweepExtremes with_line_where(SweepExtremes found, SweepSection f, double r, double w, double k,
                                           int part) {
    if (r == 0.0 && w == 0.0) return found;
    return with_line(found, f, line_where(r, w, k, 0.5 * f.distance), part);
}

// Adds the candidate in the plane of the cap at a height above the tip, at one end of the motion.
BURIN_HOT_FN SweepExtremes with_cap(SweepExtremes found, SweepSection f, double y, double t) {
    if (f.ys == 0.0) return found;
    double s = (y - f.y - f.yt * t) / f.ys;
    if (abs(s) < kFarAway && conic_at(f, s, t) <= f.noise + kConicNoise * s * s) {
        return with_candidate(found, s, t, kCapPart);
    }
    return found;
}

BURIN_HOT_FN SweepSection section_of(SweptFrustum k, Double3 o, Double3 e) {
    Double3 d = k.direction;
    double turned = 1.0 + k.slope * k.slope;
    double pull = k.tip_radius * k.slope;
    double oy = dot3(o, k.axis);
    double ey = dot3(e, k.axis);
    double dy = dot3(d, k.axis);
    SweepSection f;
    f.ss = 1.0 - turned * ey * ey;
    f.st = turned * ey * dy - dot3(e, d);
    f.tt = dot3(d, d) - turned * dy * dy;
    f.s = dot3(o, e) - turned * oy * ey - pull * ey;
    f.t = turned * oy * dy - dot3(o, d) + pull * dy;
    f.one = dot3(o, o) - turned * oy * oy - 2.0 * pull * oy - k.tip_radius * k.tip_radius;
    f.y = oy;
    f.ys = ey;
    f.yt = -dy;
    f.noise = kConicNoise * (dot3(o, o) + k.distance * k.distance) + kSweepSlack * (k.tip_radius + k.top_radius);
    f.distance = k.distance;
    f.height = k.height;
    return f;
}

// Finds the candidates with the least and the greatest s. The first of several with the same s counts.
BURIN_HOT_FN SweepExtremes extremes_of(SweepSection f) {
    SweepExtremes found;
    found.is_found = false;
    found.least.s = 0.0;
    found.least.t = 0.0;
    found.least.part = kSidePart;
    found.greatest = found.least;
    found = with_line(found, f, section_line(0.0, 0.0, 1.0, 0.0), kSidePart);
    if (f.distance > 0.0) {
        found = with_line(found, f, section_line(0.0, f.distance, 1.0, 0.0), kSidePart);
        found = with_line_where(found, f, f.st, f.tt, f.t, kSidePart);
        found = with_line_where(found, f, f.ys, f.yt, f.y, kRimPart);
        found = with_line_where(found, f, f.ys, f.yt, f.y - f.height, kRimPart);
    }
    found = with_cap(found, f, 0.0, 0.0);
    if (f.distance > 0.0) found = with_cap(found, f, 0.0, f.distance);
    found = with_cap(found, f, f.height, 0.0);
    if (f.distance > 0.0) found = with_cap(found, f, f.height, f.distance);
    return found;
}

// The outward normals at a candidate: of the body whose slice the frustum is, and of the slice itself.
struct SweepNormals {
    Double3 body;
    Double3 slice;
};

BURIN_HOT_FN SweepNormals same_normals(Double3 n) {
    SweepNormals normals;
    normals.body = n;
    normals.slice = n;
    return normals;
}

BURIN_HOT_FN SweepNormals normals_at(SweptFrustum k, Double3 o, Double3 e, SweepCandidate at) {
    Double3 p = o + at.s * e - at.t * k.direction;
    double y = dot3(p, k.axis);
    Double3 outward = p - k.axis * y;
    Double3 cap = y < 0.5 * k.height ? -k.axis : k.axis;
    if (at.part == kCapPart) return same_normals(cap);
    bool moving = at.t > kSweepSlack && at.t < k.distance - kSweepSlack;
    Double3 side = outward - k.axis * (k.slope * (k.tip_radius + k.slope * y));
    if (moving && at.part == kRimPart) {
        // At an edge the motion selects a normal n with n.d = 0 between those of the side and the cap.
        Double3 n = cap * abs(dot3(side, k.direction)) + side * abs(dot3(cap, k.direction));
        if (is_zero(n)) n = cap;
        return same_normals(n);
    }
    SweepNormals normals = same_normals(side);
    if (k.rim_radius < 0.0) return normals;
    double out_length = sqrt(dot3(outward, outward));
    Double3 from_rim = Double3(0.0);
    if (out_length > k.rim_radius) from_rim = outward * (1.0 - k.rim_radius / out_length);
    Double3 n = from_rim + k.axis * (y - k.rim_height);
    if (moving) n = n - k.direction * dot3(n, k.direction);
    normals.body = n;
    return normals;
}

BURIN_HOT_FN SweepSpan frustum_span(SweptFrustum k, SweepRay ray) {
    Double3 e = axis_vector(ray.axis);
    Double3 on_ray = ray_beside(ray, k.middle);
    Double3 o = on_ray - k.tip;
    SweepExtremes found = extremes_of(section_of(k, o, e));
    if (!found.is_found) return sweep_span(1.0, 0.0);
    SweepNormals at_least = normals_at(k, o, e, found.least);
    SweepNormals at_greatest = normals_at(k, o, e, found.greatest);
    SweepSpan span;
    span.lo = on_ray[ray.axis] + found.least.s;
    span.hi = on_ray[ray.axis] + found.greatest.s;
    span.normal_lo = at_least.body;
    span.normal_hi = at_greatest.body;
    span.plane_lo = at_least.slice;
    span.plane_hi = at_greatest.slice;
    if (dot3(span.normal_lo, span.normal_lo) == 0.0) span.normal_lo = -e;  // at the tip of a cone
    if (dot3(span.normal_hi, span.normal_hi) == 0.0) span.normal_hi = e;
    return span;
}

// A box and its motion.
struct SweptBox {
    Double3 half_size;
    Double3 middle;           // of the box, half-way along the motion
    Double3 half_along_tool;  // half the motion, in the box's axes
    Rotation lattice_from_tool;
};

// A ray in a box's axes: o + s e, where o is at the depth of the swept box's middle.
struct RayOfBox {
    Double3 o;
    Double3 e;
};

// Which part of a ray lies between pairs of planes, and which pairs bound it; -1: none.
struct BoxCut {
    double lo;
    double hi;
    int planes_lo;
    int planes_hi;
};

// Returns the normal of one of the six pairs of planes, in the box's axes. They are parallel to two sides of the box,
// or to one side and the motion.
BURIN_HOT_FN Double3 normal_of_planes(SweptBox k, int planes) {
    if (planes < 3) return axis_vector(planes);
    Double3 d = k.half_along_tool;
    if (planes == 3) return Double3(0.0, d[2], -d[1]);
    if (planes == 4) return Double3(-d[2], 0.0, d[0]);
    return Double3(d[1], -d[0], 0.0);
}

// Cuts off what lies beyond a pair of planes that touch the swept box.
BURIN_HOT_FN BoxCut between_planes(BoxCut cut, SweptBox k, RayOfBox ray, int planes) {
    Double3 n = normal_of_planes(k, planes);
    double reach = abs(n[0]) * k.half_size[0] + abs(n[1]) * k.half_size[1] + abs(n[2]) * k.half_size[2] +
                   abs(dot3(n, k.half_along_tool));
    double rise = dot3(n, ray.e);
    double at = dot3(n, ray.o);
    if (rise == 0.0) {
        if (abs(at) > reach) {  // empty, whatever the other planes are
            cut.lo = kFarAway;
            cut.hi = -kFarAway;
        }
        return cut;
    }
    double one = (-reach - at) / rise;
    double other = (reach - at) / rise;
    double lo = min(one, other);
    double hi = max(one, other);
    if (lo > cut.lo) {
        cut.lo = lo;
        cut.planes_lo = planes;
    }
    if (hi < cut.hi) {
        cut.hi = hi;
        cut.planes_hi = planes;
    }
    return cut;
}

// Returns the outward normal, in lattice axes, where the ray enters (`is_hi` false) or leaves between a pair of planes.
BURIN_HOT_FN Double3 box_normal(SweptBox k, RayOfBox ray, int planes, bool is_hi) {
    if (planes < 0) return Double3(0.0);
    Double3 n = normal_of_planes(k, planes);
    return rotated(k.lattice_from_tool, (dot3(n, ray.e) > 0.0) == is_hi ? n : -n);
}

BURIN_HOT_FN SweepSpan box_span(SweptBox k, SweepRay ray) {
    Rotation tool_from_lattice = opposite_rotation(k.lattice_from_tool);
    Double3 on_ray = ray_beside(ray, k.middle);
    RayOfBox of_box;
    of_box.o = rotated(tool_from_lattice, on_ray - k.middle);
    of_box.e = rotated(tool_from_lattice, axis_vector(ray.axis));
    BoxCut cut;
    cut.lo = -kFarAway;
    cut.hi = kFarAway;
    cut.planes_lo = -1;
    cut.planes_hi = -1;
    cut = between_planes(cut, k, of_box, 0);
    cut = between_planes(cut, k, of_box, 1);
    cut = between_planes(cut, k, of_box, 2);
    if (!is_zero(k.half_along_tool)) {  // a stamp has no more
        cut = between_planes(cut, k, of_box, 3);
        cut = between_planes(cut, k, of_box, 4);
        cut = between_planes(cut, k, of_box, 5);
    }
    if (!(cut.lo <= cut.hi)) return sweep_span(1.0, 0.0);
    SweepSpan span = sweep_span(cut.lo + on_ray[ray.axis], cut.hi + on_ray[ray.axis]);
    span.normal_lo = box_normal(k, of_box, cut.planes_lo, false);
    span.normal_hi = box_normal(k, of_box, cut.planes_hi, true);
    span.plane_lo = span.normal_lo;
    span.plane_hi = span.normal_hi;
    return span;
}

BURIN_SHARED_END
#endif
