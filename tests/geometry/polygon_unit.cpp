// SPDX-License-Identifier: MIT
#include "geometry/mesh/polygon.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "geometry/mesh/mesh_health.hpp"
#include "tests/geometry/mesh_samples.hpp"
#include "tests/geometry/polygon_samples.hpp"

namespace burin::geometry::test {
namespace {

// An OBJ of the polygon as one face, in the plane z = 0.
std::string obj_of(const LatticePolygon& polygon) {
    std::string text, face = "f";
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        text += "v " + std::to_string(polygon[i].x) + " " + std::to_string(polygon[i].y) + " 0\n";
        face += " " + std::to_string(i + 1);
    }
    return text + face + "\n";
}

double area_after_import(const LatticePolygon& polygon) {
    const auto read = import_text(obj_of(polygon), MeshFormat::obj, LengthUnit::m);
    if (!read) return -1.0;
    EXPECT_TRUE(read->report.remarks.empty()) << read->report.remarks[0];
    return examine(read->mesh).area_m2;
}

double area_of(const LatticePolygon& polygon) { return static_cast<double>(twice_area(polygon)) / 2.0; }

std::string split_fault(const LatticePolygon& polygon) { return fault_of(split_polygon(in_space(polygon)), polygon); }

TEST(PolygonImport, ALetterOfHundredsOfCornersKeepsItsArea) {
    const LatticePolygon letter = letter_c(200);
    EXPECT_NEAR(area_after_import(letter), area_of(letter), 1e-12 * area_of(letter));
}

TEST(PolygonImport, AGearKeepsItsArea) {
    for (const std::size_t teeth : {20u, 64u, 65u, 400u}) {
        const LatticePolygon wheel = gear(teeth);
        EXPECT_NEAR(area_after_import(wheel), area_of(wheel), 1e-12 * area_of(wheel)) << teeth;
    }
}

TEST(PolygonImport, SaysWhichPolygonsCrossOrTouchThemselves) {
    const auto read = import_text(
        "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nv 1 0 0\n"
        "f 1 2 3 4\n"
        "f 1 3 2 4\n"     // a bow tie
        "f 1 5 2 5\n"     // a line
        "f 1 3 4 2\n"     // another bow tie
        "f 1 2 3 5 4\n",  // its fourth corner lies on its first edge
        MeshFormat::obj);
    ASSERT_TRUE(read) << read.error().line();
    EXPECT_EQ(read->report.polygons_fanned, 1u);
    EXPECT_EQ(read->report.polygons_crossing, 3u);
    EXPECT_EQ(read->report.polygons_touching, 1u);
    ASSERT_EQ(read->report.remarks.size(), 2u);
    EXPECT_EQ(read->report.remarks[0],
              "1 polygons touch themselves, the first is face 5; they were split without overlaps");
    EXPECT_EQ(read->report.remarks[1],
              "3 polygons cross themselves or have no area, the first is face 2; their triangles may overlap");
    EXPECT_EQ(read->mesh.triangles.size(), 2u + 2u + 2u + 2u + 3u);
}

TEST(SplitPolygon, ConvexOnesAreFansAndNoneThatWindsTwiceIs) {
    const auto how = [](const std::vector<Vec3>& corners) { return split_polygon(corners).how; };
    EXPECT_EQ(how({{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 2, 0}, {0, 1, 0}}), PolygonSplit::fan);
    // Every corner turns left, and from the first one all triangles of a fan face up; but they overlap.
    EXPECT_EQ(how({{0, 0, 0}, {10, -1, 0}, {10, 10, 0}, {-10, 10, 0}, {-10, -10, 0}, {12, -10, 0}, {12, 12, 0}}),
              PolygonSplit::crossing);
    EXPECT_EQ(how({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 2, 0}}), PolygonSplit::sweep) << "a corner on an edge";
}

TEST(SplitPolygon, CornersOnALineMakeNoEmptyTriangle) {
    const std::int64_t u = kLattice;
    for (const bool upright : {false, true}) {
        LatticePolygon square;
        for (std::int64_t i = 0; i < 4; ++i) square.push_back({i * u, 0});
        for (std::int64_t i = 0; i < 4; ++i) square.push_back({4 * u, i * u});
        for (std::int64_t i = 0; i < 4; ++i) square.push_back({(4 - i) * u, 4 * u});
        for (std::int64_t i = 0; i < 4; ++i) square.push_back({0, (4 - i) * u});
        if (!upright) {
            for (LatticePoint& p : square) p = {p.x - p.y, p.x + p.y};
        }
        for (std::size_t turned = 0; turned < square.size(); ++turned) {
            std::ranges::rotate(square, square.begin() + 1);
            EXPECT_EQ(split_fault(square), "") << turned;
        }
    }
}

TEST(SplitPolygon, OfTwentyThousandCornersIsSplitLikeASmallOne) {
    std::mt19937_64 random(7);
    EXPECT_EQ(split_fault(letter_c(10000)), "");
    EXPECT_EQ(split_fault(gear(5000)), "");
    EXPECT_EQ(split_fault(comb(random, 5000)), "");
    EXPECT_EQ(split_fault(spiral(10000, 20.0)), "");
    EXPECT_EQ(split_fault(skyline(random, 10000)), "");
    EXPECT_EQ(split_fault(slit_ring(10000)), "");
}

// The worst for ears: all corners of a crossing polygon; all on a line, which exact arithmetic has to tell.
TEST(SplitPolygon, OfTwentyThousandCornersThatCrossComesToAnEnd) {
    std::mt19937_64 random(8);
    std::vector<Vec3> tangle, line;
    for (int i = 0; i < 20000; ++i) {
        const auto part = [&] { return static_cast<double>(random() % 1000000) / 1e6; };
        tangle.emplace_back(part(), part(), part());
        line.push_back(part() * Vec3(0.1, 0.3, 0.7));
    }
    for (const auto& corners : {tangle, line}) {
        const SplitPolygon split = split_polygon(corners);
        EXPECT_EQ(split.how, PolygonSplit::crossing);
        EXPECT_EQ(fault_of_edges(split, corners.size()), "");
    }
}

TEST(SplitPolygon, AHoleBehindASlitStaysAHole) {
    for (const std::size_t side : {4u, 5u, 100u}) {
        LatticePolygon ring = slit_ring(side);
        for (std::size_t turned = 0; turned < ring.size(); ++turned) {
            std::ranges::rotate(ring, ring.begin() + 1);
            const SplitPolygon split = split_polygon(in_space(ring));
            EXPECT_EQ(split.how, PolygonSplit::touching);
            EXPECT_EQ(fault_of(split, ring), "");
        }
    }
}

TEST(SplitPolygon, ACornerThatRepeatsThePlaceBeforeKeepsItsEdges) {
    const std::vector<Vec3> corners{{0, 0, 0}, {2, 0, 0}, {2, 0, 0}, {2, 0, 0}, {2, 2, 0},
                                    {1, 1, 0}, {0, 2, 0}, {0, 2, 0}, {0, 0, 0}};
    const SplitPolygon split = split_polygon(corners);
    EXPECT_EQ(split.how, PolygonSplit::sweep);
    EXPECT_EQ(fault_of_edges(split, corners.size()), "");
    double area = 0.0;
    for (const auto& [a, b, c] : split.triangles) {
        const double part = glm::cross(corners[b] - corners[a], corners[c] - corners[a]).z / 2;
        EXPECT_GE(part, 0.0);
        area += part;
    }
    EXPECT_DOUBLE_EQ(area, 3.0);
    const std::vector<Vec3> nowhere(5, Vec3(1.0));
    EXPECT_EQ(split_polygon(nowhere).how, PolygonSplit::crossing);
    EXPECT_EQ(fault_of_edges(split_polygon(nowhere), 5), "");
}

// Seen along z, the two arms meet: the far one leans over the near one. In its mean plane they lie apart.
TEST(SplitPolygon, IsSeenInItsMeanPlaneWhenItCrossesItselfAlongTheAxis) {
    const Quat leaning = glm::angleAxis(0.7, glm::normalize(Vec3(1, 0.2, 0)));
    std::vector<Vec3> corners;
    for (const Vec3& p : {Vec3(0, 0, 0), Vec3(4, 0, 0), Vec3(4, 1, 0), Vec3(1, 1, -0.02), Vec3(1, 1.01, 0.02),
                          Vec3(4, 1.01, 0), Vec3(4, 2, 0), Vec3(0, 2, 0)}) {
        corners.push_back(leaning * p);
    }
    const SplitPolygon split = split_polygon(corners);
    EXPECT_EQ(split.how, PolygonSplit::sweep);
    EXPECT_EQ(fault_of_edges(split, corners.size()), "");
    const Vec3 normal = leaning * Vec3(0, 0, 1);
    for (const auto& [a, b, c] : split.triangles)
        EXPECT_GT(glm::dot(glm::cross(corners[b] - corners[a], corners[c] - corners[a]), normal), 0.0);
}

}  // namespace
}  // namespace burin::geometry::test
