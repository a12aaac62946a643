// SPDX-License-Identifier: MIT
// The exact intersection of a capsule (a ball swept along a segment) with a ray of the lattice.
//
// The result is defined by an integer predicate and not by floating-point roots: the ray loses the whole depths s at
// which the point lies inside the closed capsule, where inside is decided without rounding on integer coordinates. So
// every engine, compiler and GPU gives the same depths, however its square roots and divisions are rounded; these only
// provide the first guess of the search. Grazing rays lose no digits. The capsule is convex, so the depths form one
// span.
//
// With q = point - start, e the segment, E = e.e, t = q.e, r the radius:
//   t <= 0: |q|^2 <= r^2;   t >= E: |q - e|^2 <= r^2;   else (|q|^2 - r^2) E <= t^2, both sides products of 64-bit
//   numbers.
// Coordinates must stay within +-2^26 units (the caller clips a segment that leaves the lattice by more than a radius).
#ifndef BURIN_SHARED_CAPSULE_H
#define BURIN_SHARED_CAPSULE_H
#include "shaders/shared/dexel.h"
#include "shaders/shared/octahedral.h"

BURIN_SHARED_BEGIN

// A stroke segment in lattice units: 40 bytes, 8-byte aligned.
struct Capsule {
    int64_t radius2;  // radius squared, rounded: keeps the fraction of a unit that a whole radius would lose
    int start_x, start_y, start_z;
    int along_x, along_y, along_z;  // end - start
    int reach;                      // the radius rounded up: bounds the footprint
    uint work;                      // make_work
};

// The operations within a capsule. A work word packs the operation and the material of the surface that it leaves.
const int kCut = 0;
const int kFill = 1;
const int kPaint = 2;
BURIN_FN uint make_work(int operation, uint material) { return uint(operation) << 8 | material; }
BURIN_FN int operation_of(Capsule c) { return int(c.work >> 8); }
BURIN_FN uint material_of_work(Capsule c) { return c.work & uint(0xff); }

// A capsule in the coordinates of one ray. Depths here are relative to the start's.
struct CapsuleRay {
    int64_t u;  // position of the ray, relative to the start
    int64_t v;
    int64_t along_u;  // the segment in (u, v, s)
    int64_t along_v;
    int64_t along_s;
    int64_t length2;  // E
    int64_t radius2;
    int64_t distance2;  // u^2 + v^2
    int64_t dot_uv;     // (u, v).(along_u, along_v)
    int start_s;
};

BURIN_FN int pick(int axis, int x, int y, int z) { return axis == 0 ? x : (axis == 1 ? y : z); }

// Transforms a capsule to the coordinates of a ray; ray_u and ray_v are in lattice units.
BURIN_FN CapsuleRay capsule_from_ray(Capsule c, int axis, int ray_u, int ray_v) {
    CapsuleRay k;
    k.start_s = pick(axis, c.start_x, c.start_y, c.start_z);
    k.along_s = int64_t(pick(axis, c.along_x, c.along_y, c.along_z));
    k.u = int64_t(ray_u - pick(axis, c.start_y, c.start_z, c.start_x));
    k.along_u = int64_t(pick(axis, c.along_y, c.along_z, c.along_x));
    k.v = int64_t(ray_v - pick(axis, c.start_z, c.start_x, c.start_y));
    k.along_v = int64_t(pick(axis, c.along_z, c.along_x, c.along_y));
    k.length2 = k.along_u * k.along_u + k.along_v * k.along_v + k.along_s * k.along_s;
    k.radius2 = c.radius2;
    k.distance2 = k.u * k.u + k.v * k.v;
    k.dot_uv = k.u * k.along_u + k.v * k.along_v;
    return k;
}

struct Wide {
    uint64_t high;
    uint64_t low;
};

BURIN_FN Wide multiply_wide(uint64_t a, uint64_t b) {
    uint64_t mask = uint64_t(0xffffffffu);
    uint64_t a0 = a & mask;
    uint64_t a1 = a >> 32;
    uint64_t b0 = b & mask;
    uint64_t b1 = b >> 32;
    uint64_t low = a0 * b0;
    uint64_t middle = a1 * b0 + (low >> 32);
    uint64_t middle2 = a0 * b1 + (middle & mask);
    Wide w;
    w.high = a1 * b1 + (middle >> 32) + (middle2 >> 32);
    w.low = (middle2 << 32) | (low & mask);
    return w;
}

// Tells whether a * b <= c * c, without overflow; a, b >= 0.
BURIN_FN bool product_within_square(int64_t a, int64_t b, int64_t c) {
    uint64_t c_size = uint64_t(absolute(c));
    Wide left = multiply_wide(uint64_t(a), uint64_t(b));
    Wide right = multiply_wide(c_size, c_size);
    return left.high < right.high || (left.high == right.high && left.low <= right.low);
}

// Evaluates the predicate that defines the capsule; s is relative to the start.
BURIN_FN bool inside_capsule(CapsuleRay k, int64_t s) {
    int64_t excess = k.distance2 + s * s - k.radius2;
    if (excess <= int64_t(0)) return true;
    int64_t t = k.dot_uv + s * k.along_s;
    if (t <= int64_t(0)) return false;
    if (t >= k.length2) {
        int64_t du = k.u - k.along_u;
        int64_t dv = k.v - k.along_v;
        int64_t ds = s - k.along_s;
        return du * du + dv * dv + ds * ds <= k.radius2;
    }
    return product_within_square(excess, k.length2, t);
}

// Returns floor(sqrt(k)), 0 <= k < 2^62.
BURIN_FN int64_t whole_sqrt(int64_t k) {
    int64_t root = int64_t(sqrt(double(k)));
    while (root * root > k) root = root - int64_t(1);
    while ((root + int64_t(1)) * (root + int64_t(1)) <= k) root = root + int64_t(1);
    return root;
}

// Returns the depth farthest from `within` in the direction of step (+1 or -1) that is still inside. `within` must be
// inside; `guess` is the floating-point estimate. A good guess costs two evaluations, a bad one a logarithmic number.
BURIN_FN int64_t last_inside(CapsuleRay k, int64_t within, int64_t guess, int64_t step) {
    if ((guess - within) * step < int64_t(0)) guess = within;
    int64_t inner = within;
    int64_t outer = guess;
    int64_t stride = step;
    if (inside_capsule(k, guess)) {
        inner = guess;
        outer = guess + stride;
        while (inside_capsule(k, outer)) {
            inner = outer;
            stride = stride * int64_t(2);
            outer = outer + stride;
        }
    } else {
        int64_t probe = guess - stride;
        while ((probe - within) * step > int64_t(0) && !inside_capsule(k, probe)) {
            outer = probe;
            stride = stride * int64_t(2);
            probe = probe - stride;
        }
        if ((probe - within) * step > int64_t(0)) inner = probe;
    }
    while ((outer - inner) * step > int64_t(1)) {
        int64_t middle = inner + (outer - inner) / int64_t(2);
        if (inside_capsule(k, middle)) {
            inner = middle;
        } else {
            outer = middle;
        }
    }
    return inner;
}

BURIN_FN int64_t clamp_whole(int64_t a, int64_t lo, int64_t hi) { return a < lo ? lo : (a > hi ? hi : a); }

// Returns a / b rounded down; b != 0.
BURIN_FN int64_t divide_down(int64_t a, int64_t b) {
    int64_t q = a / b;
    return (q * b != a && ((a < int64_t(0)) != (b < int64_t(0)))) ? q - int64_t(1) : q;
}

// Returns the depths that the capsule covers on the ray, in lattice units.
BURIN_FN RaySpan capsule_span(CapsuleRay k) {
    int64_t far = int64_t(1) << 27;
    int64_t lo = far;
    int64_t hi = -far;

    // The two end balls, exact by integer square roots.
    int64_t ball0 = k.radius2 - k.distance2;
    if (ball0 >= int64_t(0)) {
        int64_t half_width = whole_sqrt(ball0);
        lo = -half_width;
        hi = half_width;
    }
    int64_t du = k.u - k.along_u;
    int64_t dv = k.v - k.along_v;
    int64_t ball1 = k.radius2 - du * du - dv * dv;
    if (ball1 >= int64_t(0)) {
        int64_t half_width = whole_sqrt(ball1);
        lo = k.along_s - half_width < lo ? k.along_s - half_width : lo;
        hi = k.along_s + half_width > hi ? k.along_s + half_width : hi;
    }

    // The cylinder between them, where the ray crosses it between its two end planes 0 <= t <= E.
    // (A segment parallel to the ray has across2 = 0: the balls' hull is the whole span.)
    int64_t across2 = k.along_u * k.along_u + k.along_v * k.along_v;
    if (across2 > int64_t(0)) {
        double moment = double(k.u) * double(k.along_v) - double(k.v) * double(k.along_u);
        double reach = double(k.radius2) * double(across2);
        double margin = reach - moment * moment;
        int64_t slab_lo = -far;
        int64_t slab_hi = far;
        // Compared in 32 bits: llvmpipe of Mesa 22.3 gets the sign of a number wrong that was just widened to 64.
        int along_s = int(k.along_s);
        if (along_s > 0) {
            slab_lo = -divide_down(k.dot_uv, k.along_s);
            slab_hi = divide_down(k.length2 - k.dot_uv, k.along_s);
        } else if (along_s < 0) {
            slab_lo = -divide_down(k.length2 - k.dot_uv, -k.along_s);
            slab_hi = divide_down(k.dot_uv, -k.along_s);
        } else if (k.dot_uv < int64_t(0) || k.dot_uv > k.length2) {
            slab_hi = -far - int64_t(1);
        }
        // A segment almost across the ray has end planes that meet the ray far away, where squares would overflow.
        slab_lo = slab_lo < -far ? -far : slab_lo;
        slab_hi = slab_hi > far ? far : slab_hi;
        // 1e-12 is far above the rounding of `margin` relative to `reach`: no true crossing is dropped here.
        if (slab_lo <= slab_hi && margin >= -1e-12 * reach) {
            double middle = double(k.dot_uv) * double(k.along_s) / double(across2);
            double half_width = sqrt((margin > 0.0 ? margin : 0.0) * double(k.length2)) / double(across2);
            double limit = double(far);
            double from = middle - half_width;
            double to = middle + half_width;
            from = from < -limit ? -limit : (from > limit ? limit : from);
            to = to < -limit ? -limit : (to > limit ? limit : to);
            middle = middle < -limit ? -limit : (middle > limit ? limit : middle);
            // The covered depths are symmetric about `middle`, so if there are any, one of these three is among them.
            int64_t center = int64_t(floor(middle + 0.5));
            int64_t within = clamp_whole(center, slab_lo, slab_hi);
            bool found = inside_capsule(k, within);
            if (!found) {
                within = clamp_whole(center - int64_t(1), slab_lo, slab_hi);
                found = inside_capsule(k, within);
            }
            if (!found) {
                within = clamp_whole(center + int64_t(1), slab_lo, slab_hi);
                found = inside_capsule(k, within);
            }
            if (found) {
                int64_t guess_lo = clamp_whole(int64_t(ceil(from)), slab_lo, slab_hi);
                int64_t guess_hi = clamp_whole(int64_t(floor(to)), slab_lo, slab_hi);
                // Where the cylinder reaches a slab border, a ball covers the depths just beyond it; the search
                // continues there.
                lo = last_inside(k, within, guess_lo < lo ? guess_lo : lo, int64_t(-1));
                hi = last_inside(k, within, guess_hi > hi ? guess_hi : hi, int64_t(1));
            }
        }
    }
    RaySpan span;
    span.lo = lo > hi ? 1 : k.start_s + int(lo);
    span.hi = lo > hi ? 0 : k.start_s + int(hi);
    return span;
}

// Filling stays clear of the lattice's outermost nodes, so that the solid is closed inside the lattice: it skips the
// rays along the lattice's border, and on the others covers only the depths within.
BURIN_FN bool may_fill_ray(int u, int v, int rays_u, int rays_v) {
    return u > 0 && v > 0 && u < rays_u - 1 && v < rays_v - 1;
}
BURIN_FN RaySpan fill_within(RaySpan span, int cells) {
    int last = cells * kUnitsPerCell - 1;
    RaySpan within;
    within.lo = span.lo < 1 ? 1 : span.lo;
    within.hi = span.hi > last ? last : span.hi;
    return within;
}

// Returns the code of the outward normal of the material that is left at depth s of the ray (lattice units): after a
// cut it points from there to the nearest point of the capsule's axis, after filling away from it. Computed in
// integers, like the depths.
BURIN_FN uint capsule_normal(CapsuleRay k, int axis, int depth, bool filled) {
    int64_t s = int64_t(depth - k.start_s);
    int64_t t = k.dot_uv + s * k.along_s;
    int64_t one = int64_t(1) << 20;
    int64_t share = int64_t(0);  // 2^20 t / E, between 0 and 2^20
    if (t >= k.length2) {
        share = one;
    } else if (t > int64_t(0)) {
        int64_t numerator = t;
        int64_t denominator = k.length2;
        while (denominator >= (int64_t(1) << 40)) {  // leaves headroom for the 20 bits below
            numerator = numerator >> 4;
            denominator = denominator >> 4;
        }
        share = (numerator * one) / denominator;
    }
    int64_t n_u = k.along_u * share - k.u * one;
    int64_t n_v = k.along_v * share - k.v * one;
    int64_t n_s = k.along_s * share - s * one;
    if (filled) {
        n_u = -n_u;
        n_v = -n_v;
        n_s = -n_s;
    }
    IntVector n;
    n.x = axis == 0 ? n_s : (axis == 1 ? n_v : n_u);
    n.y = axis == 0 ? n_u : (axis == 1 ? n_s : n_v);
    n.z = axis == 0 ? n_v : (axis == 1 ? n_u : n_s);
    return encode_normal(n);
}

// Returns the end that a capsule leaves at a depth. Where filling stops at the lattice's border its normal lies along
// the ray.
BURIN_FN DexelEnd capsule_end(CapsuleRay k, int axis, int depth, uint work, int cells) {
    bool filled = int(work >> 8) == kFill;
    uint normal = filled && (depth == 1 || depth == cells * kUnitsPerCell - 1) ? axis_normal(axis, depth != 1)
                                                                               : capsule_normal(k, axis, depth, filled);
    return make_end(depth, work & uint(0xff), normal);
}

BURIN_SHARED_END
#endif
