// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/geometry/vrml/vrml_samples.hpp"

namespace burin::geometry::test {
namespace {

// Sums of a few hundred products: a few units in the last place.
constexpr double kRounding = 1e-13;

// A regular polygon's area over the square of its circumradius.
const double kDiscArea = 0.5 * kVrmlSlices * std::sin(2.0 * std::numbers::pi / kVrmlSlices);
const double kDiscEdge = 2.0 * std::sin(std::numbers::pi / kVrmlSlices);

void expect_extent(const VrmlSurface& surface, const Vec3& lowest, const Vec3& highest) {
    const Box bounds = examine(surface.mesh).bounds_m;
    EXPECT_EQ(bounds.lo, lowest);
    EXPECT_EQ(bounds.hi, highest);
}

}  // namespace

TEST(VrmlSolids, ABoxHasItsSizes) {
    const VrmlSurface box = vrml_surface("Box { size 2 3 4 }");
    EXPECT_EQ(box.mesh.triangles.size(), 12u);
    EXPECT_DOUBLE_EQ(closed_volume(box), 24.0);
    EXPECT_DOUBLE_EQ(examine(box.mesh).area_m2, 2.0 * (6.0 + 8.0 + 12.0));
    expect_extent(box, Vec3(-1, -1.5, -2), Vec3(1, 1.5, 2));
    expect_extent(vrml_surface("Box { }"), Vec3(-1), Vec3(1));
}

TEST(VrmlSolids, ACylinderIsAPrismOverARegularPolygon) {
    const VrmlSurface cylinder = vrml_surface("Cylinder { radius 0.5 height 3 }");
    EXPECT_NEAR(closed_volume(cylinder), 3.0 * 0.25 * kDiscArea, kRounding);
    EXPECT_NEAR(examine(cylinder.mesh).area_m2, 2.0 * 0.25 * kDiscArea + 3.0 * 0.5 * kDiscEdge * kVrmlSlices,
                10 * kRounding);
    expect_extent(cylinder, Vec3(-0.5, -1.5, -0.5), Vec3(0.5, 1.5, 0.5));
}

TEST(VrmlSolids, ACylinderLacksThePartsThatAreSwitchedOff) {
    const double cap = 0.25 * kDiscArea, side = 3.0 * 0.5 * kDiscEdge * kVrmlSlices;
    const auto area = [](const std::string& parts) {
        return examine(vrml_surface("Cylinder { radius 0.5 height 3 " + parts + " }").mesh).area_m2;
    };
    EXPECT_NEAR(area("top FALSE bottom FALSE"), side, 10 * kRounding);
    EXPECT_NEAR(area("side FALSE"), 2.0 * cap, 10 * kRounding);
    EXPECT_NEAR(area("side FALSE bottom FALSE"), cap, 10 * kRounding);
    const VrmlSurface top = vrml_surface("Cylinder { side FALSE bottom FALSE }");
    for (const auto& [a, b, c] : top.mesh.triangles) {
        const auto& p = top.mesh.positions_m;
        EXPECT_GT(glm::cross(p[b] - p[a], p[c] - p[a]).y, 0.0);
        EXPECT_EQ(p[a].y, 1.0);
    }
    EXPECT_TRUE(vrml_world("Shape { geometry Cylinder { side FALSE bottom FALSE top FALSE } }").shapes.empty());
}

TEST(VrmlSolids, AConeIsAPyramidOverARegularPolygon) {
    const VrmlSurface cone = vrml_surface("Cone { bottomRadius 2 height 5 }");
    EXPECT_NEAR(closed_volume(cone), 5.0 * 4.0 * kDiscArea / 3.0, 100 * kRounding);
    expect_extent(cone, Vec3(-2, -2.5, -2), Vec3(2, 2.5, 2));
    EXPECT_NEAR(examine(vrml_surface("Cone { bottomRadius 2 height 5 side FALSE }").mesh).area_m2, 4.0 * kDiscArea,
                100 * kRounding);
    const auto side_alone = examine(vrml_surface("Cone { bottom FALSE }").mesh);
    EXPECT_EQ(side_alone.boundary_edges, static_cast<std::size_t>(kVrmlSlices));
}

TEST(VrmlSolids, ASpheresCornersLieOnItAndItsSidesWithinHalfAPercent) {
    const VrmlSurface sphere = vrml_surface("Sphere { radius 0.1 }");
    EXPECT_GT(closed_volume(sphere), 0.0);
    for (const Vec3& p : sphere.mesh.positions_m) EXPECT_NEAR(glm::length(p), 0.1, 1e-16 * 2);
    for (const auto& [a, b, c] : sphere.mesh.triangles) {
        const auto& p = sphere.mesh.positions_m;
        const Vec3 normal = glm::normalize(glm::cross(p[b] - p[a], p[c] - p[a]));
        EXPECT_GT(glm::dot(normal, p[a]), 0.1 * 0.99);  // two chords, each within 0.5 %
    }
    expect_extent(sphere, Vec3(-0.1), Vec3(0.1));
}

}  // namespace burin::geometry::test
