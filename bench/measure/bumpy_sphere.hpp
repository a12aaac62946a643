// SPDX-License-Identifier: MIT
// The surface that bench haptics touches: a sphere with smooth bumps, whose true form is known, meshed at any
// resolution, and a path over it.
//
// Definition: p = r(n) n for each direction n, r(n) = R (1 + b sin(w n_x) sin(w n_y) sin(w n_z)), with R = 50 mm,
// b = 0.02 and w = 12 unless stated otherwise: hills and hollows of 1 mm, 26 mm from one to the next. Vertices lie on
// it exactly, to double precision.
// The mesh is that of a cube whose faces have n by n squares at equal
// angles, projected onto the surface: 12 n^2 triangles, closed.
#pragma once

#include "geometry/mesh/triangle_mesh.hpp"

namespace burin::bench {

struct BumpySphere {
    double radius_m = 0.05;
    double bumps = 0.02;  // of the radius
    double waves = 12.0;

    [[nodiscard]] double radius_at_m(const Vec3& direction) const;
    // Returns |p| - r(p / |p|), negative inside; and its gradient.
    [[nodiscard]] double value_m(const Vec3& p) const;
    [[nodiscard]] Vec3 gradient(const Vec3& p) const;
    // Returns the distance from the surface of a point near it: value over slope.
    [[nodiscard]] double distance_m(const Vec3& p) const;
    // Finds the surface's point nearest to `from`, by Newton's
    // method on its Lagrange conditions, started at a point near it.
    struct Nearest {
        Vec3 point{0.0};
        bool found = false;
    };
    [[nodiscard]] Nearest nearest(const Vec3& from, const Vec3& begin) const;
};

[[nodiscard]] geometry::TriangleMesh mesh_of(const BumpySphere& shape, int squares_a_side);
// Returns the number of squares a side that gives about so many triangles.
[[nodiscard]] int squares_for(std::size_t triangles);

// A point that moves over the unit sphere at constant speed on a bending path that covers all of it in time.
class SphereWalk {
public:
    // Advances by an angle.
    void step(double angle_rad);
    [[nodiscard]] const Vec3& outward() const { return outward_; }
    // Returns the frame whose columns are along, outward, across: its y axis points away from the surface.
    [[nodiscard]] Quat orientation() const;

private:
    Vec3 outward_{0.0, 1.0, 0.0}, along_{1.0, 0.0, 0.0};
};

}  // namespace burin::bench
