// SPDX-License-Identifier: MIT
// Bodies of tetrahedra: closed, upright, alike in size, with the volume of what they stand for; and the surface in
// them.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <vector>

#include "bodies/mesh/embedded_surface.hpp"
#include "bodies/mesh/tetrahedra.hpp"

namespace burin::bodies {
namespace {

using Face = std::array<std::uint32_t, 3>;

// How often each face occurs.
std::map<Face, int> faces_of(const Tetrahedra& body) {
    std::map<Face, int> faces;
    for (const auto& cell : body.cells)
        for (std::size_t left_out = 0; left_out < 4; ++left_out) {
            Face face{};
            for (std::size_t i = 0, k = 0; i < 4; ++i)
                if (i != left_out) face[k++] = cell[i];
            std::ranges::sort(face);
            ++faces[face];
        }
    return faces;
}

struct Shape {
    Vec3 half_axes_m;
    double spacing_m;
};
const std::array kShapes{Shape{Vec3(0.03), 0.0099}, Shape{Vec3(0.032), 0.00727}, Shape{Vec3(0.032), 0.0053},
                         Shape{{0.045, 0.03, 0.025}, 0.0061}, Shape{{0.02, 0.02, 0.06}, 0.0051}};

}  // namespace

TEST(Tetrahedra, FillBallsAndEllipsoidsWithoutHoleOrFold) {
    for (const auto& [half, spacing_m] : kShapes) {
        const auto body = ellipsoid(half, spacing_m);
        ASSERT_TRUE(body) << body.error().line();
        const std::map<Face, int> faces = faces_of(*body);
        EXPECT_LE(std::ranges::max_element(faces, {}, [](const auto& face) { return face.second; })->second, 2);
        // The faces that occur once are a closed surface of one piece without a handle: V - E + F = 2, 2 E = 3 F.
        std::map<std::uint32_t, int> outside;
        std::size_t once = 0;
        for (const auto& [face, count] : faces) {
            if (count > 1) continue;
            ++once;
            for (const std::uint32_t corner : face) ++outside[corner];
        }
        EXPECT_EQ(2 * outside.size(), once + 4);
        EXPECT_GT(worst_quality(*body), 0.3);
        EXPECT_NEAR(volume_m3(*body) / (4.0 / 3.0 * std::numbers::pi * half.x * half.y * half.z), 1.0, 1e-12);
        double least = HUGE_VAL, most = 0.0;
        for (const auto& c : body->cells) {
            const auto& p = body->places_m;
            const double v = volume_m3(p[c[0]], p[c[1]], p[c[2]], p[c[3]]);
            least = std::min(least, v);
            most = std::max(most, v);
        }
        EXPECT_GT(least, 0.0);
        EXPECT_LT(most, 4.0 * std::pow(spacing_m, 3) / 12.0) << "no element is much larger than the lattice's";
        for (const auto& [corner, count] : outside)
            EXPECT_NEAR(glm::length(body->places_m[corner] / half), 1.0, 0.04) << "the surface is the shape's";
    }
}

TEST(Tetrahedra, RefuseWhatCannotBeMeshed) {
    for (const auto& [half, spacing_m] :
         {Shape{{0.03, 0.0, 0.03}, 0.005}, Shape{Vec3(0.03), 0.0}, Shape{Vec3(0.03), -0.005}, Shape{Vec3(0.03), 0.02},
          Shape{Vec3(0.03), 1e-5}, Shape{{0.03, 0.03, std::nan("")}, 0.005}}) {
        const auto body = ellipsoid(half, spacing_m);
        ASSERT_FALSE(body);
        EXPECT_TRUE(body.error().line().contains("3 to 40 elements")) << body.error().line();
    }
}

TEST(EmbeddedSurface, LiesOnTheShapeAndMovesWithTheBody) {
    const Vec3 half(0.045, 0.03, 0.025);
    const Tetrahedra body = ellipsoid(half, 0.006).value();
    const EmbeddedSurface surface = ellipsoid_surface(body, half, 3);
    ASSERT_EQ(surface.points.size(), 642u);
    ASSERT_EQ(surface.triangles.size(), 1280u);
    for (const Vec3& place : places_of(surface, body.places_m)) EXPECT_NEAR(glm::length(place / half), 1.0, 1e-12);
    // Any affine motion of the corners is the surface's too.
    const glm::dmat3 map(1.1, 0.2, 0.0, -0.1, 0.9, 0.3, 0.05, 0.0, 1.2);
    std::vector<Vec3> moved = body.places_m;
    for (Vec3& place : moved) place = map * place + Vec3(1.0, 2.0, 3.0);
    const std::vector<Vec3> at_rest = places_of(surface, body.places_m), then = places_of(surface, moved);
    for (std::size_t i = 0; i < then.size(); ++i)
        EXPECT_LT(glm::length(then[i] - (map * at_rest[i] + Vec3(1.0, 2.0, 3.0))), 1e-12);
    double area_m2 = 0.0, enclosed_m3 = 0.0;
    for (const double area : surface.areas_m2) area_m2 += area;
    for (const auto& [a, b, c] : surface.triangles)
        enclosed_m3 += volume_m3(Vec3(0.0), at_rest[a], at_rest[b], at_rest[c]);
    const double volume = 4.0 / 3.0 * std::numbers::pi * half.x * half.y * half.z;
    EXPECT_NEAR(enclosed_m3 / volume, 1.0, 0.02) << "its triangles face outwards";
    // Thomsen's formula for the area of an ellipsoid, within 1.061 %.
    const double p = 1.6075, ab = std::pow(half.x * half.y, p), bc = std::pow(half.y * half.z, p),
                 ca = std::pow(half.z * half.x, p);
    EXPECT_NEAR(area_m2 / (4.0 * std::numbers::pi * std::pow((ab + bc + ca) / 3.0, 1.0 / p)), 1.0, 0.025);
}

}  // namespace burin::bodies
