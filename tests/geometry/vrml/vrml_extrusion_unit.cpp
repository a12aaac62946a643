// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>

#include "base/text.hpp"
#include "tests/geometry/vrml/vrml_samples.hpp"

namespace burin::geometry::test {
namespace {

constexpr double kTiny = 1e-12;
// An arrowhead of area 1, counter-clockwise seen from +Y (z grows towards the viewer of that drawing).
const std::string kArrowhead = "convex FALSE crossSection [ 0 0, 2 0, 0.5 -0.5, 0 -2, 0 0 ] ";

std::string extrusion(const std::string& fields) { return "Extrusion { " + fields + " }"; }

// A closed regular polygon of spine points about the Y axis.
std::string ring_spine(int corners, double radius) {
    std::string text = "spine [";
    for (int i = 0; i <= corners; ++i) {
        const double a = 2.0 * std::numbers::pi * (i % corners) / corners;
        text += formatted(" %.17g 0 %.17g", radius * std::cos(a), radius * std::sin(a));
    }
    return text + " ] ";
}

}  // namespace

TEST(VrmlExtrusion, TheDefaultIsASquarePrism) {
    const VrmlSurface prism = vrml_surface("Extrusion { }");
    EXPECT_NEAR(closed_volume(prism), 4.0, kTiny);
    EXPECT_EQ(examine(prism.mesh).bounds_m.lo, Vec3(-1, 0, -1));
    EXPECT_EQ(examine(prism.mesh).bounds_m.hi, Vec3(1, 1, 1));
}

TEST(VrmlExtrusion, AConcaveSectionIsCappedExactly) {
    EXPECT_NEAR(closed_volume(vrml_surface(extrusion(kArrowhead + "spine [ 0 0 0 0 5 0 ]"))), 5.0 * 1.0, kTiny);
}

TEST(VrmlExtrusion, AStraightSpineInAnyDirectionGivesThePrism) {
    for (const char* end : {"3 0 0", "-3 0 0", "0 -3 0", "0 0 3", "1 2 2", "0 3 0"}) {
        const VrmlSurface prism = vrml_surface(extrusion(kArrowhead + "spine [ 0 0 0 " + end + " ]"));
        const VrmlSurface longer =
            vrml_surface(extrusion(kArrowhead + "spine [ 0 0 0, 0 0 0, " + end + ", " + end + " ]"));
        EXPECT_NEAR(closed_volume(prism), 3.0 * 1.0, kTiny) << end;
        EXPECT_NEAR(examine(longer.mesh).signed_volume_m3, 3.0 * 1.0, kTiny) << end;
        EXPECT_EQ(examine(longer.mesh).degenerate_triangles, 0u);
    }
}

TEST(VrmlExtrusion, TheFrameOfABendIsThatOfTheStandard) {
    // 6.18: Y along the spine, Z the normal of the bend, X = Y x Z. At the corner of an L from -X over the origin to
    // +Y, Y is (1, 1, 0) / sqrt 2 and Z is +Z x ... = (after - here) x (before - here) = (0,1,0) x (-1,0,0) = +Z.
    const VrmlSurface l =
        vrml_surface(extrusion("beginCap FALSE endCap FALSE crossSection [ 1 0, 0 1 ] spine [ -5 0 0, 0 0 0, 0 5 0 ]"));
    const auto& p = l.mesh.positions_m;
    ASSERT_EQ(p.size(), 6u);
    const double half = std::sqrt(0.5);
    EXPECT_NEAR(glm::length(p[0] - Vec3(-5, -1, 0)), 0.0, kTiny);       // X = (1,0,0) x Z = -Y
    EXPECT_NEAR(glm::length(p[1] - Vec3(-5, 0, 1)), 0.0, kTiny);        // Z
    EXPECT_NEAR(glm::length(p[2] - Vec3(half, -half, 0)), 0.0, kTiny);  // X = Y x Z
    EXPECT_NEAR(glm::length(p[4] - Vec3(1, 5, 0)), 0.0, kTiny);
}

TEST(VrmlExtrusion, AClosedSpineIsARingWithoutCaps) {
    const int corners = 24;
    const double radius = 2.0, half = 0.25;
    const VrmlSurface ring = vrml_surface(extrusion(
        ring_spine(corners, radius) + "crossSection [ 0.25 0.25, 0.25 -0.25, -0.25 -0.25, -0.25 0.25, 0.25 0.25 ]"));
    // Seen from above the ring lies between two regular polygons.
    const double polygon = 0.5 * corners * std::sin(2.0 * std::numbers::pi / corners);
    const double area = polygon * ((radius + half) * (radius + half) - (radius - half) * (radius - half));
    EXPECT_NEAR(std::abs(closed_volume(ring)), area * 2.0 * half, kTiny);
    EXPECT_EQ(ring.mesh.triangles.size(), static_cast<std::size_t>(corners) * 8);
}

TEST(VrmlExtrusion, ARepeatedSpinePointChangesNothing) {
    const std::string start = "spine [ 0 0 0, 0 1 0, ", end = "1 2 0, 1 3 1 ]";
    const double once = closed_volume(vrml_surface(extrusion(start + end)));
    const VrmlSurface twice = vrml_surface(extrusion(start + "0 1 0, 0 1 0, " + end));
    EXPECT_NEAR(examine(twice.mesh).signed_volume_m3, once, kTiny);
    EXPECT_EQ(examine(twice.mesh).degenerate_triangles, 0u);
}

TEST(VrmlExtrusion, ASpineOfEqualPointsIsAFlatFigure) {
    const VrmlSurface flat = vrml_surface(extrusion("spine [ 1 1 1, 1 1 1 ]"));
    const Box bounds = examine(flat.mesh).bounds_m;
    EXPECT_EQ(bounds.lo, Vec3(0, 1, 0));
    EXPECT_EQ(bounds.hi, Vec3(2, 1, 2));
}

TEST(VrmlExtrusion, ASpineThatTurnsBackStaysFinite) {
    const VrmlSurface back = vrml_surface(extrusion("spine [ 0 0 0, 0 2 0, 0 1 0, 1 1 0, 0 1 0 ]"));
    for (const Vec3& p : back.mesh.positions_m) EXPECT_TRUE(finite(p));
    EXPECT_FALSE(back.mesh.triangles.empty());
}

TEST(VrmlExtrusion, AScaleOfZeroMakesATipWithoutEmptyTriangles) {
    const VrmlSurface pyramid = vrml_surface(extrusion("spine [ 0 0 0, 0 3 0 ] scale [ 1 1, 0 0 ]"));
    const MeshHealth health = examine(pyramid.mesh);
    EXPECT_EQ(health.degenerate_triangles, 0u);
    EXPECT_NEAR(health.signed_volume_m3, 4.0 * 3.0 / 3.0, kTiny);
    EXPECT_EQ(pyramid.mesh.triangles.size(), 4u + 2u);
}

TEST(VrmlExtrusion, ScaleAndOrientationApplyToAllPointsOrToEach) {
    EXPECT_NEAR(closed_volume(vrml_surface(extrusion("scale 2 0.5"))), 4.0, kTiny);
    // A frustum: (a^2 + a b + b^2) h / 3.
    EXPECT_NEAR(closed_volume(vrml_surface(extrusion("scale [ 1 1, 0.5 0.5 ]"))), (4.0 + 2.0 + 1.0) / 3.0, kTiny);
    EXPECT_NEAR(closed_volume(vrml_surface(extrusion("scale [ 1 1, 0.5 0.5, 7 7 ]"))), (4.0 + 2.0 + 1.0) / 3.0, kTiny);
    const VrmlSurface turned = vrml_surface(extrusion("orientation 0 1 0 0.785398163397448310"));
    EXPECT_NEAR(closed_volume(turned), 4.0, kTiny);
    EXPECT_NEAR(examine(turned.mesh).bounds_m.hi.x, std::sqrt(2.0), kTiny);
}

TEST(VrmlExtrusion, CapsSidesAndWindingFollowTheFields) {
    const auto health = [](const std::string& fields) { return examine(vrml_surface(extrusion(fields)).mesh); };
    EXPECT_EQ(health("beginCap FALSE endCap FALSE").boundary_edges, 8u);
    EXPECT_EQ(health("beginCap FALSE").boundary_edges, 4u);
    EXPECT_NEAR(health("beginCap FALSE").bounds_m.lo.y, 0.0, kTiny);
    EXPECT_NEAR(health("endCap FALSE").area_m2, 4.0 + 8.0, kTiny);
    EXPECT_NEAR(health("ccw FALSE").signed_volume_m3, -4.0, kTiny);
    EXPECT_TRUE(vrml_surface(extrusion("solid FALSE")).two_sided);
}

TEST(VrmlExtrusion, OneOfAnOpenSectionIsASheet) {
    const VrmlSurface sheet = vrml_surface(extrusion("crossSection [ -1 0, 1 0 ] solid FALSE"));
    EXPECT_EQ(sheet.mesh.triangles.size(), 2u);
    EXPECT_NEAR(examine(sheet.mesh).area_m2, 2.0, kTiny);
    EXPECT_EQ(vrml_world("Shape { geometry Extrusion { spine [ ] } }").remarks.size(), 1u);
}

}  // namespace burin::geometry::test
