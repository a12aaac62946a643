// SPDX-License-Identifier: MIT
// The smoothed surface near a tool as the zero level of a function of places, made of points of the surface with their
// normals and areas.
//
// At a place x all points p with normal n nearer than a width w count with the weight area (1 - |p - x|^2 / w^2)^3.
// With means weighted so, and m the direction of the mean normal, the function is
//
//   F(x) = 1/4 mean(n . (x - p)) + 3/4 m . (x - mean(p)).
//
// The first term alone (Kolluri 2008, implicit moving least squares) bulges over an edge, the second alone (Adamson and
// Alexa 2003) sinks below it; on a sphere of radius r they are off by -s^2 / r and s^2 / r, with s = w / sqrt(10)
// the kernel's standard deviation on a plane. So planes are kept exactly, an edge of 90 degrees sinks by 0.55 s, and a
// sphere by s^2 / 2r: the surface moves by its curvature, at half the pace of a mean over the surface. Equal shares
// would leave spheres where they are, but then grooves of about the tool's width do not fill, and what little the sums
// depend on the lattice is not smoothed away by the passes that follow.
//
// Points whose normals are turned by more than 120 degrees from m belong to another side of the material and count
// nothing, those turned by 90 degrees or less count fully: a thin wall keeps its thickness.
// The arithmetic is a text that the device compiles too (shaders/shared/smooth_field.h); the order of the points fixes
// every bit of the result. Lengths in cells. Immutable after it is made; any thread.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/space.hpp"
#include "shaders/shared/smooth_field.h"

namespace burin::compute {

struct SurfacePoint {
    Vec3 place, normal;
    double area = 0.0;
    // Mean of normal . (place of a point - this place), where this stands for several points.
    double offset = 0.0;
    std::uint8_t material = 0;
};

class SmoothField {
public:
    // `most_width` is the largest width that will be asked for.
    SmoothField(std::vector<SurfacePoint> points, double most_width);

    using Width = shared::KernelWidth;
    struct Value {
        bool known = false;  // false where no point is near enough
        double distance = 0.0;
        Vec3 gradient{0.0};  // zero unless asked for
    };
    [[nodiscard]] Value at(const Vec3& place, const Width& width, bool with_gradient) const;
    // Returns the material of the nearest point within `width`, or `otherwise`.
    [[nodiscard]] std::uint8_t material_near(const Vec3& place, double width, std::uint8_t otherwise) const;

private:
    // The points, sorted into boxes. Each level merges points of the one before in boxes twice as wide, for widths
    // twice as large, so that a value costs about the same at any width.
    struct Level {
        Vec3 lo{0.0};
        double box = 1.0;
        std::array<int, 3> boxes{1, 1, 1};
        std::vector<std::uint32_t> first;
        std::vector<SurfacePoint> points;
        template <typename F>
        void for_near(const Vec3& place, double width, F f) const;
    };
    [[nodiscard]] static Level sorted(std::vector<SurfacePoint> points, double box);
    [[nodiscard]] static std::vector<SurfacePoint> merged(const std::vector<SurfacePoint>& points, double box);
    [[nodiscard]] const Level& level_for(double width) const;

    std::vector<Level> levels_;
};

}  // namespace burin::compute
