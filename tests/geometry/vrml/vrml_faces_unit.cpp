// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "tests/geometry/vrml/vrml_samples.hpp"

namespace burin::geometry::test {
namespace {

const std::string kLShape =
    "coord Coordinate { point [ 0 0 0, 2 0 0, 2 1 0, 1 1 0, 1 2 0, 0 2 0 ] } coordIndex [ 0 1 2 3 4 5 -1 ]";

// The sum of the triangles' area vectors: of a flat surface whose triangles face one way, its area along its normal.
Vec3 area_vector(const VrmlSurface& surface) {
    Vec3 sum(0.0);
    for (const auto& [a, b, c] : surface.mesh.triangles) {
        const auto& p = surface.mesh.positions_m;
        sum += 0.5 * glm::cross(p[b] - p[a], p[c] - p[a]);
    }
    return sum;
}

using Colours = std::array<VrmlColour, 3>;
constexpr VrmlColour kRed{255, 0, 0}, kGreen{0, 255, 0}, kBlue{0, 0, 255};

const std::string kThreeColours = "color Color { color [ 1 0 0, 0 1 0, 0 0 1 ] }";
const std::string kOneTriangle = "coord Coordinate { point [ 0 0 0, 1 0 0, 0 1 0 ] } coordIndex [ 0 1 2 ]";

}  // namespace

TEST(VrmlFaces, AConcaveFaceIsCoveredOnce) {
    const VrmlSurface l = vrml_surface("IndexedFaceSet { convex FALSE " + kLShape + " }");
    EXPECT_EQ(l.mesh.triangles.size(), 4u);
    EXPECT_DOUBLE_EQ(examine(l.mesh).area_m2, 3.0);
    EXPECT_DOUBLE_EQ(area_vector(l).z, 3.0);  // no triangle is turned over
}

TEST(VrmlFaces, ClockwiseFacesAreTurnedAndOthersAreNot) {
    EXPECT_DOUBLE_EQ(area_vector(vrml_surface("IndexedFaceSet { ccw FALSE " + kLShape + " }")).z, -3.0);
    EXPECT_DOUBLE_EQ(area_vector(vrml_surface("IndexedFaceSet { ccw TRUE " + kLShape + " }")).z, 3.0);
}

TEST(VrmlFaces, SidesAndCreaseAngleAreKept) {
    const VrmlSurface one = vrml_surface("IndexedFaceSet { " + kLShape + " }");
    EXPECT_FALSE(one.two_sided);
    EXPECT_EQ(one.crease_angle_rad, 0.0);
    const VrmlSurface two = vrml_surface("IndexedFaceSet { solid FALSE creaseAngle 0.5 " + kLShape + " }");
    EXPECT_TRUE(two.two_sided);
    EXPECT_EQ(two.crease_angle_rad, 0.5);
}

TEST(VrmlFaces, TheLastFaceNeedsNoEndAndEmptyOnesCountForNothing) {
    const VrmlWorld world = vrml_world(
        "Shape { geometry IndexedFaceSet { coord Coordinate { point [ 0 0 0 1 0 0 0 1 0 0 0 1 ] }\n"
        "coordIndex [ -1 0 1 2 -1 -1 0 1 -1 1 2 3 ] } }");
    ASSERT_EQ(world.shapes.size(), 1u);
    EXPECT_EQ(world.shapes[0].surface->mesh.triangles,
              (std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}, {1, 2, 3}}));
    ASSERT_EQ(world.remarks.size(), 1u);  // the face of two corners
    EXPECT_EQ(world.remarks[0].where, "test.wrl:2:18");
}

TEST(VrmlFaces, ColoursComeByCornerByFaceAndByIndex) {
    const auto colours = [](const std::string& rest) {
        return vrml_surface("IndexedFaceSet { " + kThreeColours + kOneTriangle + rest + " }").corner_colours;
    };
    EXPECT_EQ(colours(""), (std::vector<Colours>{{kRed, kGreen, kBlue}}));
    EXPECT_EQ(colours(" colorIndex [ 2 2 1 ]"), (std::vector<Colours>{{kBlue, kBlue, kGreen}}));
    EXPECT_EQ(colours(" colorPerVertex FALSE"), (std::vector<Colours>{{kRed, kRed, kRed}}));
    EXPECT_EQ(colours(" colorPerVertex FALSE colorIndex [ 1 ]"), (std::vector<Colours>{{kGreen, kGreen, kGreen}}));
    EXPECT_EQ(colours(" ccw FALSE"), (std::vector<Colours>{{kRed, kBlue, kGreen}}));
    EXPECT_TRUE(vrml_surface("IndexedFaceSet { " + kOneTriangle + " }").corner_colours.empty());
}

TEST(VrmlFaces, AGridFollowsItsHeightsAndFacesUp) {
    // y = x / 2 + z over 3 by 2 cells of 0.5 by 2 m.
    const VrmlSurface grid = vrml_surface(
        "ElevationGrid { xDimension 4 zDimension 3 xSpacing 0.5 zSpacing 2\n"
        "height [ 0 0.25 0.5 0.75, 2 2.25 2.5 2.75, 4 4.25 4.5 4.75 ] }");
    EXPECT_EQ(grid.mesh.triangles.size(), 12u);
    const Box bounds = examine(grid.mesh).bounds_m;
    EXPECT_EQ(bounds.lo, Vec3(0, 0, 0));
    EXPECT_EQ(bounds.hi, Vec3(1.5, 4.75, 4));
    const Vec3 area = area_vector(grid);
    EXPECT_DOUBLE_EQ(area.y, 1.5 * 4.0);  // its shadow
    EXPECT_DOUBLE_EQ(area.x, -0.5 * 6.0);
    EXPECT_DOUBLE_EQ(area.z, -1.0 * 6.0);
    EXPECT_NEAR(examine(grid.mesh).area_m2, 6.0 * std::sqrt(1.0 + 0.25 + 1.0), 1e-14);
}

TEST(VrmlFaces, AGridIsColouredByHeightOrByCell) {
    const std::string head = "ElevationGrid { xDimension 3 zDimension 2 height [ 0 0 0 0 0 0 ] ";
    const VrmlSurface cells = vrml_surface(head + "colorPerVertex FALSE " + kThreeColours + " }");
    ASSERT_EQ(cells.corner_colours.size(), 4u);
    EXPECT_EQ(cells.corner_colours[0], (Colours{kRed, kRed, kRed}));
    EXPECT_EQ(cells.corner_colours[3], (Colours{kGreen, kGreen, kGreen}));
    const VrmlSurface corners =
        vrml_surface(head + "color Color { color [ 1 0 0, 1 0 0, 1 0 0, 0 0 1, 0 0 1, 0 0 1 ] } }");
    for (std::size_t t = 0; t < corners.corner_colours.size(); ++t) {
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3& p = corners.mesh.positions_m[corners.mesh.triangles[t][k]];
            EXPECT_EQ(corners.corner_colours[t][k], p.z == 0.0 ? kRed : kBlue);
        }
    }
}

TEST(VrmlFaces, AGridOfOneRowHasNoSurface) {
    EXPECT_TRUE(
        vrml_world("Shape { geometry ElevationGrid { xDimension 3 zDimension 1 height [ 1 2 3 ] } }").shapes.empty());
    EXPECT_TRUE(vrml_world("Shape { geometry ElevationGrid { } }").shapes.empty());
}

}  // namespace burin::geometry::test
