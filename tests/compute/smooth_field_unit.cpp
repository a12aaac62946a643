// SPDX-License-Identifier: MIT
// The smoothed surface's field against the formula of its header, summed over all points one by one: whatever the boxes
// merge, both sides of a thin wall, the faces of an edge and points of different materials stay apart. On each axis.
#include "compute/tools/smooth_field.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "tests/compute/effort.hpp"
#include "tests/support/uneven_poses.hpp"

namespace burin::compute::test {
namespace {

using Points = std::vector<SurfacePoint>;

constexpr double kPointApart = 0.5, kWidestField = 24.0;

// Two axes across a unit vector.
std::array<Vec3, 2> across(const Vec3& normal) {
    const Vec3 other = std::abs(normal.x) < 0.6 ? Vec3(1.0, 0.0, 0.0) : Vec3(0.0, 1.0, 0.0);
    const Vec3 u = glm::normalize(glm::cross(normal, other));
    return {u, glm::cross(normal, u)};
}

// A square sheet of points around a middle.
void add_sheet(Points& points, const Vec3& middle, const Vec3& normal, double half, std::uint8_t material = 0) {
    const auto [u, v] = across(normal);
    const int n = static_cast<int>(half / kPointApart);
    for (int j = -n; j <= n; ++j)
        for (int i = -n; i <= n; ++i)
            points.push_back({middle + kPointApart * (double(i) * u + double(j) * v), normal, kPointApart * kPointApart,
                              0.0, material});
}

// The formula of smooth_field.hpp: mean(n . (x - p)) and m . (x - mean(p)), weighted by area (1 - |p - x|^2 / w^2)^3,
// without the points whose normals are turned by more than 120 degrees from m, and fully with those by 90 or less.
double field_by_formula(const Points& points, const Vec3& place, double width) {
    const auto kernel = [&](const SurfacePoint& p) {
        const double ratio = glm::dot(p.place - place, p.place - place) / (width * width);
        return ratio < 1.0 ? p.area * std::pow(1.0 - ratio, 3.0) : 0.0;
    };
    Vec3 mean(0.0);
    for (const SurfacePoint& p : points) mean += kernel(p) * p.normal;
    mean = glm::normalize(mean);
    double weights = 0.0, heights = 0.0;
    Vec3 normals(0.0), places(0.0);
    for (const SurfacePoint& p : points) {
        const double cosine = glm::dot(p.normal, mean), rising = std::clamp(2.0 * (cosine + 0.5), 0.0, 1.0);
        const double weight = kernel(p) * rising * rising * (3.0 - 2.0 * rising);
        weights += weight;
        heights += weight * glm::dot(p.normal, place - p.place);
        normals += weight * p.normal;
        places += weight * p.place;
    }
    return 0.25 * heights / weights + 0.75 * glm::dot(glm::normalize(normals), place - places / weights);
}

Vec3 axis_vector(int axis, double length) {
    Vec3 v(0.0);
    v[axis] = length;
    return v;
}

}  // namespace

// A wall 0.6 cells thin, both faces of which lie in one box of every level. From either side its near face alone is
// seen, where it is, at every width.
TEST(SmoothField, BothFacesOfAThinWallStayWhereTheyAreUnderAWideTool) {
    for (int axis = 0; axis < 3; ++axis)
        for (const double low : {3.1, -6.9}) {
            Points points;
            add_sheet(points, axis_vector(axis, low), axis_vector(axis, -1.0), 30.0);
            add_sheet(points, axis_vector(axis, low + 0.6), axis_vector(axis, 1.0), 30.0);
            const SmoothField field(points, kWidestField);
            for (const double width : {2.0, 5.0, 7.0, 13.0, kWidestField})
                for (const double off : {0.3, 0.9}) {
                    const Vec3 beside(axis_vector((axis + 1) % 3, 0.37) + axis_vector((axis + 2) % 3, -0.21));
                    for (const bool above : {true, false}) {
                        const Vec3 place = beside + axis_vector(axis, above ? low + 0.6 + off : low - off);
                        const SmoothField::Value value = field.at(place, {width, Vec3(0.0)}, true);
                        ASSERT_TRUE(value.known);
                        EXPECT_NEAR(value.distance, off, 1e-9)
                            << "axis " << axis << ", width " << width << (above ? ", above" : ", below");
                        for (int k = 0; k < 3; ++k)
                            EXPECT_NEAR(value.gradient[k], k == axis ? (above ? 1.0 : -1.0) : 0.0, 1e-6)
                                << "axis " << axis << ", width " << width;
                    }
                }
        }
}

TEST(SmoothField, BothFacesOfASlantedThinWallStayWhereTheyAreUnderAWideTool) {
    for (std::size_t i = 0; i < kUnevenPoses; ++i) {
        const Vec3 normal = uneven_direction(i), middle = 100.0 * uneven_offset(i + 1);
        Points points;
        add_sheet(points, middle, -normal, 28.0);
        add_sheet(points, middle + 0.5 * normal, normal, 28.0);
        const SmoothField field(points, kWidestField);
        for (const double width : {2.5, 6.5, 12.5, 23.5})
            for (const bool above : {true, false}) {
                const Vec3 place = middle + (above ? 1.2 : -0.7) * normal;
                EXPECT_NEAR(field.at(place, {width, Vec3(0.0)}, false).distance, 0.7, 1e-9)
                    << i << ", width " << width << (above ? ", above" : ", below");
            }
    }
}

// Edges of a right angle between each two faces of a cube, near and far from the edge: what is merged is off from the
// sum over all points by a hundredth of the width.
TEST(SmoothField, IsTheFormulaOfItsPointsAtEdgesOfEveryTwoFaces) {
    for (int one = 0; one < 3; ++one)
        for (int other = 0; other < 3; ++other)
            for (const double side_one : {1.0, -1.0})
                for (const double side_other : {1.0, -1.0}) {
                    if (one == other) continue;
                    Points points;
                    const Vec3 out = axis_vector(one, side_one), way = axis_vector(other, side_other);
                    // Each face begins at the edge, whose two faces look out and along `way`.
                    add_sheet(points, -12.25 * way, out, 12.0);
                    add_sheet(points, -12.25 * out, way, 12.0);
                    const SmoothField field(points, kWidestField);
                    for (const double width : {2.0, 6.0, 12.0, 24.0})
                        for (const double along : {-0.6, 0.0, 0.4}) {
                            const Vec3 place =
                                0.3 * out + along * 0.5 * width * way + axis_vector(3 - one - other, 0.2);
                            const double found = field.at(place, {width, Vec3(0.0)}, false).distance;
                            EXPECT_NEAR(found, field_by_formula(points, place, width), 0.012 * width)
                                << one << (side_one > 0 ? "+ " : "- ") << other << (side_other > 0 ? "+" : "-")
                                << ", width " << width << ", along " << along;
                        }
                }
}

// On a ball every normal is another: what is merged keeps the heights of its points over their mean.
TEST(SmoothField, IsTheFormulaOfItsPointsOnABallAtEveryWidth) {
    constexpr double kRadius = 15.0;
    constexpr int kOnBall = 12'000;
    for (const Vec3& middle : {Vec3(0.0), Vec3(3.3, -7.1, 5.7)}) {
        Points points;
        for (int i = 0; i < kOnBall; ++i) {  // evenly, on a spiral
            const double height = 1.0 - 2.0 * (i + 0.5) / kOnBall, around = std::sqrt(1.0 - height * height);
            const double angle = i * std::numbers::pi * (3.0 - std::sqrt(5.0));
            const Vec3 normal(around * std::cos(angle), height, around * std::sin(angle));
            points.push_back(
                {middle + kRadius * normal, normal, 4.0 * std::numbers::pi * kRadius * kRadius / kOnBall, 0.0, 0});
        }
        const SmoothField field(points, kWidestField);
        // Of the width; boxes are between a fifth and a third of it wide.
        for (const auto& [width, within] : {std::pair{6.0, 0.003}, {12.0, 0.005}, {20.0, 0.003}, {24.0, 0.01}})
            for (std::size_t i = 0; i < kUnevenPoses; ++i) {
                const Vec3 place = middle + (kRadius + 0.4) * uneven_direction(i);
                const double found = field.at(place, {width, Vec3(0.0)}, false).distance;
                EXPECT_NEAR(found, field_by_formula(points, place, width), within * width) << i << ", width " << width;
            }
    }
}

TEST(SmoothField, ItsGradientIsHowItChangesAlsoWhereTheWidthDoes) {
    Points points;
    add_sheet(points, Vec3(-12.25, 0.1, 0.2), Vec3(0.0, 0.0, 1.0), 12.0);
    add_sheet(points, Vec3(0.1, 0.2, -12.25), Vec3(1.0, 0.0, 0.0), 12.0);
    const SmoothField field(points, kWidestField);
    const Vec3 width_by_place(0.11, -0.07, 0.23);
    for (const double width : {4.0, 9.0, 16.0})
        for (std::size_t i = 0; i < kUnevenPoses; ++i) {
            const Vec3 place = 20.0 * uneven_offset(i);
            const Vec3 gradient = field.at(place, {width, width_by_place}, true).gradient;
            for (int k = 0; k < 3; ++k) {
                const Vec3 step = axis_vector(k, 1e-4);
                const auto at = [&](double sign) {
                    const double there = width + sign * glm::dot(width_by_place, step);
                    return field.at(place + sign * step, {there, width_by_place}, false).distance;
                };
                // The mean normal turns as well, which the gradient leaves out.
                EXPECT_NEAR(gradient[k], (at(1.0) - at(-1.0)) / 2e-4, 0.05) << i << ", width " << width << ", " << k;
            }
        }
}

// In any order of the points, near the faces of boxes and within several materials.
TEST(SmoothField, TheMaterialIsThatOfTheNearestPointWithinTheWidthAndOfNoOther) {
    Random random(17);
    for (int run = 0; run < 40; ++run) {
        Points points;
        for (int i = 0; i < 60; ++i)
            points.push_back({Vec3(random.between(-6, 6), random.between(-6, 6), random.between(-6, 6)),
                              uneven_direction(static_cast<std::size_t>(i)), 0.3, 0.0,
                              static_cast<std::uint8_t>(1 + i % 7)});
        const SmoothField field(points, kWidestField);
        for (int i = 0; i < 50; ++i) {
            const Vec3 place(random.between(-8, 8), random.between(-8, 8), random.between(-8, 8));
            const double width = random.between(0.3, 6.0);
            double least = width;
            std::uint8_t expected = 200;
            for (const SurfacePoint& p : points)
                if (glm::length(p.place - place) < least) least = glm::length(p.place - place), expected = p.material;
            ASSERT_EQ(int{field.material_near(place, width, 200)}, int{expected}) << run << " " << i;
        }
    }
}

TEST(SmoothField, OfTwoMaterialsWithinTheWidthTheNearerCountsOnEveryAxisAndInEitherOrder) {
    for (int axis = 0; axis < 3; ++axis)
        for (const double side : {1.0, -1.0})
            for (const bool near_first : {true, false}) {
                const SurfacePoint near{axis_vector(axis, side * 1.3), axis_vector(axis, side), 0.1, 0.0, 3};
                const SurfacePoint far{axis_vector(axis, -side * 2.1), axis_vector(axis, -side), 9.0, 0.0, 5};
                const SmoothField field(near_first ? Points{near, far} : Points{far, near}, 8.0);
                EXPECT_EQ(field.material_near(Vec3(0.0), 8.0, 7), 3) << axis << " " << side;
                EXPECT_EQ(field.material_near(axis_vector(axis, -side), 8.0, 7), 5) << axis << " " << side;
                EXPECT_EQ(field.material_near(Vec3(0.0), 1.2, 7), 7) << "none is near enough";
            }
}

}  // namespace burin::compute::test
