// SPDX-License-Identifier: MIT
// Closed forms for the section of a lattice ray with a convex tool that moves along a segment without turning.
//
// For a ray o + s e and a tool K that moves by t d, the set {(s, t): o + s e - t d in K, 0 <= t <= T} is convex, so the
// ray runs through the swept tool in one interval of s.
//   Frustum (cylinder, cone): the set is bounded by a conic (the side), two parallel lines (the caps) and two more
//   (start and end of the motion). The least and the greatest s of such a set lie where the conic meets one of those
//   lines or the line on which its own derivative by t vanishes, or where two lines meet. That takes a few quadratic
//   equations.
//   Box: swept along a segment it is the sum of four segments, a polytope whose faces are parallel to two of them each:
//   six pairs of parallel planes.
// Lattice axes and units; computed in doubles with + - * / and roots only. Rounding moves a border by less than 1e-6
// units where the ray does not graze it. A candidate counts as feasible within kSweepSlack, so that a corner at which
// three borders meet is not lost to the rounding of each.
#pragma once

#include "base/space.hpp"

namespace burin::compute {

// The part of a ray that lies inside a swept tool.
struct SweepSpan {
    double lo = 1.0, hi = 0.0;            // depths, not rounded; empty when lo > hi
    Vec3 normal_lo{0.0}, normal_hi{0.0};  // pointing out of the tool, of any length
    // Normals of planes that touch the swept piece at the ends. Those above may be those of another shape (rim_radius).
    Vec3 plane_lo{0.0}, plane_hi{0.0};
    [[nodiscard]] bool empty() const { return !(lo <= hi); }
};

// A cylinder or a frustum of a cone along an axis, starting at its tip.
struct Frustum {
    double tip_radius = 0.0, top_radius = 0.0, length = 0.0;
    // For a slice of a rounded rim, whose normals are those of a torus: the radius of the circle at the middle of its
    // tube, and the height of that circle above the tip. rim_radius is below zero if there is no rounding.
    double rim_radius = -1.0, rim_height = 0.0;
};

class FrustumSweep {
public:
    // `axis` has length 1 and points from the tip into the body; the tip moves from `tip` by `along`.
    FrustumSweep(const Frustum& shape, const Vec3& tip, const Vec3& axis, const Vec3& along);
    [[nodiscard]] SweepSpan span(int axis, double ray_u, double ray_v) const;
    [[nodiscard]] Box bounds() const;
    [[nodiscard]] const Frustum& shape() const { return shape_; }
    [[nodiscard]] const Vec3& tip() const { return tip_; }
    [[nodiscard]] const Vec3& axis() const { return axis_; }
    [[nodiscard]] const Vec3& along() const { return along_; }

private:
    Frustum shape_;
    Vec3 tip_, axis_, along_;
    Vec3 direction_{0.0};  // of the motion; of length 1, or zero for a stamp
    double distance_;      // length T of the motion
    double slope_;         // change of the radius per length along the axis
};

class BoxSweep {
public:
    // The centre of the box moves from `center` by `along`.
    BoxSweep(const Vec3& half_size, const Vec3& center, const Quat& orientation, const Vec3& along);
    [[nodiscard]] SweepSpan span(int axis, double ray_u, double ray_v) const;
    [[nodiscard]] Box bounds() const;
    [[nodiscard]] Vec3 start() const { return middle_ - 0.5 * along_; }  // of the centre
    [[nodiscard]] const Vec3& along() const { return along_; }
    [[nodiscard]] const Vec3& half_size() const { return half_size_; }
    // Returns the direction of a side, in lattice axes.
    [[nodiscard]] Vec3 side(int side) const;

private:
    Vec3 half_size_, middle_, along_;
    Quat orientation_;
    Vec3 half_along_tool_;  // half the motion, in the box's axes
};

}  // namespace burin::compute
