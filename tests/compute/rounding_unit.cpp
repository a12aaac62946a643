// SPDX-License-Identifier: MIT
#include "compute/repair/rounding.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "compute/repair/near_pairs.hpp"
#include "compute/repair/self_intersections.hpp"
#include "geometry/mesh/triangle_contact.hpp"

namespace burin::compute {
namespace {

using geometry::TriangleMesh;

// A rod of n sides, 1 x 300 mm along (1,1,1), in millimetres: all boxes along the axes meet, and its ends are fans of
// n.
TriangleMesh rod(std::uint32_t n) {
    const Vec3 along = glm::normalize(Vec3(1, 1, 1)), u = glm::normalize(Vec3(1, -1, 0)), w = glm::cross(along, u);
    TriangleMesh mesh;
    for (const double at : {0.0, 300.0})
        for (std::uint32_t i = 0; i < n; ++i) {
            const double angle = 2.0 * std::numbers::pi * i / n;
            mesh.positions_m.push_back(std::cos(angle) * u + std::sin(angle) * w + at * along);
        }
    for (std::uint32_t i = 0; i < n; ++i) {
        const std::uint32_t next = (i + 1) % n;
        mesh.triangles.push_back({i, next, n + next});
        mesh.triangles.push_back({i, n + next, n + i});
    }
    for (std::uint32_t i = 1; i + 1 < n; ++i) {
        mesh.triangles.push_back({0, i + 1, i});
        mesh.triangles.push_back({n, n + i, n + i + 1});
    }
    return mesh;
}

TriangleMesh rounded(TriangleMesh mesh) {
    for (Vec3& p : mesh.positions_m) p = Vec3(Vec3f(p));
    return mesh;
}

// Triangles at random places, every third of them narrow, and every fourth at a vertex that it shares with others.
TriangleMesh random_triangles(unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> place(-1.0, 1.0), size(0.01, 0.4);
    const auto anywhere = [&] { return Vec3(place(random), place(random), place(random)); };
    TriangleMesh mesh;
    mesh.positions_m = {anywhere(), anywhere()};
    for (std::uint32_t t = 0; t < 400; ++t) {
        const auto first = static_cast<std::uint32_t>(mesh.positions_m.size());
        const Vec3 corner = anywhere(), narrow = t % 3 == 0 ? Vec3(1e-5) : Vec3(1.0);
        const double extent = t % 3 == 0 ? 1.5 : size(random);
        mesh.positions_m.push_back(corner);
        mesh.positions_m.push_back(corner + extent * anywhere());
        mesh.positions_m.push_back(corner + narrow * size(random) * anywhere());
        mesh.triangles.push_back({t % 4 == 0 ? t % 8 / 4 : first, first + 1, first + 2});
    }
    return mesh;
}

std::vector<TrianglePair> those_that_meet(const TriangleMesh& mesh, const std::vector<TrianglePair>& pairs) {
    std::vector<TrianglePair> meeting;
    std::ranges::copy_if(pairs, std::back_inserter(meeting), [&](const TrianglePair& pair) {
        return geometry::meet_beyond_shared(mesh.positions_m, mesh.triangles[pair[0]], mesh.triangles[pair[1]]);
    });
    return meeting;
}

TEST(NearPairs, HoldAllThatMeet) {
    WorkerPool pool(2);
    std::vector<TriangleMesh> meshes{rounded(rod(7)), rounded(rod(300))};
    for (unsigned seed = 1; seed <= 4; ++seed) meshes.push_back(random_triangles(seed));
    for (const double far : {1e4, 1e6}) {  // so far out that rounding tangles the rod
        TriangleMesh mesh = rod(200);
        for (Vec3& p : mesh.positions_m) p += Vec3(far, -far, 0.3 * far);
        meshes.push_back(rounded(mesh));
    }
    for (const TriangleMesh& mesh : meshes) {
        const std::vector<double> nowhere(mesh.positions_m.size(), 0.0);
        const NearPairs near = near_pairs(mesh, {.reach = nowhere}, pool);
        EXPECT_TRUE(near.complete);
        EXPECT_EQ(those_that_meet(mesh, near.pairs), self_intersections(mesh, pool)) << mesh.triangles.size();
    }
}

TEST(NearPairs, HoldAllThatCouldMeetAndNoneThatIsNotWanted) {
    WorkerPool pool(2);
    std::mt19937 random(5);
    std::uniform_real_distribution<double> way(-1.0, 1.0);
    for (TriangleMesh mesh : {random_triangles(9), rounded(rod(60))}) {
        std::vector<double> reach;
        for (std::size_t v = 0; v < mesh.positions_m.size(); ++v) reach.push_back(v % 3 == 0 ? 0.02 : 0.0);
        std::vector<std::uint8_t> wanted;
        for (std::size_t t = 0; t < mesh.triangles.size(); ++t) wanted.push_back(t % 5 == 0 ? 1 : 0);
        const auto all = near_pairs(mesh, {.reach = reach}, pool).pairs;
        const auto some = near_pairs(mesh, {.reach = reach, .wanted = wanted}, pool).pairs;
        for (int time = 0; time < 8; ++time) {
            TriangleMesh moved = mesh;
            for (std::size_t v = 0; v < reach.size(); ++v)
                moved.positions_m[v] += reach[v] / std::sqrt(3.0) * Vec3(way(random), way(random), way(random));
            for (const TrianglePair& pair : self_intersections(moved, pool)) {
                EXPECT_TRUE(std::ranges::binary_search(all, pair)) << pair[0] << " " << pair[1];
                const bool is_wanted = wanted[pair[0]] != 0 || wanted[pair[1]] != 0;
                EXPECT_EQ(std::ranges::binary_search(some, pair), is_wanted) << pair[0] << " " << pair[1];
            }
        }
        for (const TrianglePair& pair : some) EXPECT_TRUE(wanted[pair[0]] != 0 || wanted[pair[1]] != 0);
    }
}

TEST(RepairRounding, TakesWorkInProportionToTheTrianglesOfALongRod) {
    WorkerPool pool(2);
    for (const std::uint32_t n : {1000u, 4000u, 20'000u}) {
        const TriangleMesh exact = rod(n);
        TriangleMesh mesh = rounded(exact);
        const RoundingReport report = repair_rounding(exact, mesh, pool);
        EXPECT_LE(report.tests, kMostRepairTests + 40 * exact.triangles.size()) << n << " sides";
        if (n > 1000) continue;
        EXPECT_EQ(report.found, 0u);
        EXPECT_TRUE(report.complete);
        EXPECT_LE(report.tests, 25 * exact.triangles.size()) << "nothing turns over, and nothing is repaired";
    }
}

TEST(RepairRounding, EndsWhatRoundingHasTurnedOverAndCountsTheRest) {
    WorkerPool pool(2);
    const TriangleMesh exact = rod(4000);
    TriangleMesh mesh = rounded(exact);
    const std::size_t before = self_intersections(mesh, pool).size();
    ASSERT_GT(before, 0u);
    const RoundingReport report = repair_rounding(exact, mesh, pool);
    EXPECT_EQ(report.found, before);
    EXPECT_EQ(report.left, self_intersections(mesh, pool).size());
    EXPECT_EQ(report.left, 0u);
    EXPECT_TRUE(report.complete);
    for (std::size_t v = 0; v < mesh.positions_m.size(); ++v) {
        EXPECT_EQ(mesh.positions_m[v], Vec3(Vec3f(mesh.positions_m[v])));
        EXPECT_LT(glm::distance(mesh.positions_m[v], exact.positions_m[v]), 1e-4);
    }
}

TEST(RepairRounding, MeetsItsBoundWhereThousandsOfTrianglesAreNarrowerThanAStepAndSaysSo) {
    WorkerPool pool(2);
    const TriangleMesh exact = rod(20'000);
    TriangleMesh mesh = rounded(exact);
    const RoundingReport report = repair_rounding(exact, mesh, pool);
    EXPECT_GT(report.found, 0u);
    EXPECT_GT(report.left, 0u);
    EXPECT_LE(report.left, report.found);
}

TEST(RepairRounding, LeavesWhatMetBeforeAsItIs) {
    WorkerPool pool(2);
    TriangleMesh exact;
    exact.positions_m = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.2, 0.2, -0.5}, {0.3, 0.2, 0.5}, {0.2, 0.3, 0.5}};
    exact.triangles = {{0, 1, 2}, {3, 4, 5}};
    TriangleMesh mesh = rounded(exact);
    const RoundingReport report = repair_rounding(exact, mesh, pool);
    EXPECT_EQ(report.found, 0u);
    EXPECT_EQ(mesh.positions_m, rounded(exact).positions_m);
}

}  // namespace
}  // namespace burin::compute
