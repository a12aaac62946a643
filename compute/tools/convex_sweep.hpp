// SPDX-License-Identifier: MIT
// Convex tools that move along a segment without turning, and their sections with lattice rays: in closed form, by the
// text that the device compiles too (shaders/shared/convex_sweep.h). Lattice axes and units.
#pragma once

#include "base/space.hpp"
#include "shaders/shared/convex_sweep.h"

namespace burin::compute {

// The part of a ray that lies inside a swept tool.
using SweepSpan = shared::SweepSpan;

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
    [[nodiscard]] Frustum shape() const {
        return {swept_.tip_radius, swept_.top_radius, swept_.height, swept_.rim_radius, swept_.rim_height};
    }
    [[nodiscard]] const Vec3& tip() const { return swept_.tip; }
    [[nodiscard]] const Vec3& axis() const { return swept_.axis; }
    [[nodiscard]] const Vec3& along() const { return along_; }
    // Returns what a section takes of it, for the device.
    [[nodiscard]] const shared::SweptFrustum& swept() const { return swept_; }

private:
    shared::SweptFrustum swept_;
    Vec3 along_;
};

class BoxSweep {
public:
    // The centre of the box moves from `center` by `along`.
    BoxSweep(const Vec3& half_size, const Vec3& center, const Quat& orientation, const Vec3& along);
    [[nodiscard]] SweepSpan span(int axis, double ray_u, double ray_v) const;
    [[nodiscard]] Box bounds() const;
    [[nodiscard]] Vec3 start() const { return swept_.middle - 0.5 * along_; }  // of the centre
    [[nodiscard]] const Vec3& along() const { return along_; }
    [[nodiscard]] const Vec3& half_size() const { return swept_.half_size; }
    // Returns the direction of a side, in lattice axes.
    [[nodiscard]] Vec3 side(int side) const;
    // Returns what a section takes of it, for the device.
    [[nodiscard]] const shared::SweptBox& swept() const { return swept_; }

private:
    shared::SweptBox swept_;
    Vec3 along_;
    Quat orientation_;
};

}  // namespace burin::compute
