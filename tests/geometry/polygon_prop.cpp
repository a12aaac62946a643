// SPDX-License-Identifier: MIT
#include "geometry/mesh/polygon.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>

#include "tests/geometry/polygon_samples.hpp"

namespace burin::geometry::test {
namespace {

std::mt19937_64 any_randomness() { return std::mt19937_64(*rc::gen::arbitrary<std::uint64_t>()); }

// Any outline, from any of its corners on, in either direction.
LatticePolygon any_polygon(std::mt19937_64& random) {
    LatticePolygon p = with_corners_on_edges(random, any_outline(random));
    std::ranges::rotate(p, p.begin() + static_cast<std::ptrdiff_t>(random() % p.size()));
    if (random() % 2 == 0) std::ranges::reverse(p);
    return p;
}

double between(std::mt19937_64& random, double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
}

TEST(SplitPolygon, CoversEverySimplePolygonExactlyOnce) {
    EXPECT_TRUE(rc::check([] {
        auto random = any_randomness();
        const LatticePolygon polygon = any_polygon(random);
        const SplitPolygon split = split_polygon(in_space(polygon));
        RC_ASSERT(fault_of(split, polygon) == "");
        RC_ASSERT((split.how == PolygonSplit::fan || split.how == PolygonSplit::sweep));
    }));
}

TEST(SplitPolygon, CoversAPolygonInAnyPlaneAtAnyScaleFarFromTheOriginAndBentALittle) {
    EXPECT_TRUE(rc::check([] {
        auto random = any_randomness();
        const LatticePolygon polygon = any_polygon(random);
        const Quat turned = glm::normalize(
            Quat(between(random, -1, 1), between(random, -1, 1), between(random, -1, 1), between(random, -1, 1)));
        const double size_m = std::pow(10.0, between(random, -6, 3)), scale = size_m / 1e8;
        // The narrowest gap of an outline is some 1e-4 of its size; the corners are off by less.
        const double bent_m = random() % 2 == 0 ? 0.0 : 1e-6 * size_m;
        const auto far = [&] { return size_m * between(random, -1e5, 1e5); };
        const Vec3 far_m(far(), far(), far());
        std::vector<Vec3> corners_m;
        for (Vec3 corner : in_space(polygon)) {
            corner *= scale;
            corner.z = between(random, -bent_m, bent_m);
            corners_m.push_back(far_m + turned * corner);
        }
        const SplitPolygon split = split_polygon(corners_m);
        RC_ASSERT(fault_of_edges(split, polygon.size()) == "");
        RC_ASSERT((split.how == PolygonSplit::fan || split.how == PolygonSplit::sweep));
        const Vec3 normal = turned * Vec3(0, 0, 1);
        double area_m2 = 0.0, unsigned_m2 = 0.0;
        for (const auto& [a, b, c] : split.triangles) {
            const Vec3 area = glm::cross(corners_m[b] - corners_m[a], corners_m[c] - corners_m[a]) / 2.0;
            area_m2 += glm::dot(area, normal);
            unsigned_m2 += glm::length(area);
        }
        const double expected_m2 = static_cast<double>(twice_area(polygon)) / 2.0 * scale * scale;
        // A triangle of sides below 4 sizes, each corner off by `off_m`, is off by at most 8 sizes times that.
        const double off_m = 2.0 * bent_m + 1e5 * size_m * 0x1p-50;
        const double tolerance_m2 = 8.0 * size_m * off_m * static_cast<double>(polygon.size());
        RC_ASSERT(std::abs(area_m2 - expected_m2) <= tolerance_m2);
        RC_ASSERT(std::abs(unsigned_m2 - std::abs(expected_m2)) <= tolerance_m2);
    }));
}

TEST(SplitPolygon, GivesTheSameForAnyCornersWhatsoeverAndKeepsEveryEdge) {
    EXPECT_TRUE(rc::check([] {
        auto random = any_randomness();
        const std::uint64_t places = 1 + random() % 12;  // few: corners meet, edges overlap and cross
        std::vector<Vec3> corners(4 + random() % 40);
        for (Vec3& corner : corners) {
            corner = {static_cast<double>(random() % places), static_cast<double>(random() % places), 0.0};
        }
        const SplitPolygon split = split_polygon(corners);
        RC_ASSERT(fault_of_edges(split, corners.size()) == "");
        RC_ASSERT(split.triangles == split_polygon(corners).triangles);
        double area = 0.0, turned_area = 0.0, shoelace = 0.0;
        for (const auto& [a, b, c] : split.triangles) {
            const double part = glm::cross(corners[b] - corners[a], corners[c] - corners[a]).z;
            area += part;
            turned_area += std::abs(part);
        }
        for (std::size_t i = 0; i < corners.size(); ++i) {
            shoelace += glm::cross(corners[i], corners[(i + 1) % corners.size()]).z;
        }
        RC_ASSERT(area == shoelace);
        if (split.how != PolygonSplit::crossing) RC_ASSERT(turned_area == std::abs(shoelace));
    }));
}

}  // namespace
}  // namespace burin::geometry::test
