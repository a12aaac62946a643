// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <memory>
#include <numeric>
#include <set>

#include "compute/surface.hpp"
#include "tests/compute/random_solids.hpp"

namespace burin::test {
namespace {

using Corners = std::array<Vec3, 3>;

Surface meshed(const Solid& solid, WorkerPool& pool) {
    Surface surface(solid.lattice);
    surface.mesh_all(solid, pool);
    return surface;
}

std::vector<Corners> all_triangles(const Surface& surface) {
    std::vector<Corners> result;
    for (std::uint32_t t = 0; t < surface.tile_count(); ++t) {
        const TileMesh& tile = surface.tile(t);
        for (std::size_t i = 0; i < tile.indices.size(); i += 3) {
            Corners c;
            for (std::size_t k = 0; k < 3; ++k) {
                const shared::SurfaceVertex& v = tile.vertices[tile.indices[i + k]];
                c[k] = surface.lattice().origin_object + Vec3(v.x, v.y, v.z);
            }
            result.push_back(c);
        }
    }
    return result;
}

double distance_to_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
    const Vec3 e = b - a;
    const double length2 = glm::dot(e, e);
    const double t = length2 > 0 ? glm::clamp(glm::dot(p - a, e) / length2, 0.0, 1.0) : 0.0;
    return glm::length(p - a - e * t);
}

double distance_to_triangle(const Vec3& p, const Corners& c) {
    const Vec3 n = glm::cross(c[1] - c[0], c[2] - c[0]);
    bool above = glm::length(n) > 0;
    for (std::size_t k = 0; k < 3 && above; ++k) {
        above = glm::dot(glm::cross(c[(k + 1) % 3] - c[k], p - c[k]), n) >= 0;
    }
    if (above) return std::abs(glm::dot(p - c[0], n)) / glm::length(n);
    return std::min(
        {distance_to_segment(p, c[0], c[1]), distance_to_segment(p, c[1], c[2]), distance_to_segment(p, c[2], c[0])});
}

// Corners rounded to a millionth of the cell, as names to compare by.
std::array<std::int64_t, 9> name_of(const Corners& c, double spacing_m) {
    std::array<std::int64_t, 9> name{};
    for (std::size_t k = 0; k < 3; ++k)
        for (int a = 0; a < 3; ++a) name[k * 3 + static_cast<std::size_t>(a)] = std::llround(c[k][a] / spacing_m * 1e3);
    return name;
}

Corners corners(const LocalSurface& local, std::size_t triangle) {
    Corners c;
    for (std::size_t k = 0; k < 3; ++k) {
        c[k] = local.origin_object + Vec3(local.positions_m[local.triangles[triangle][k]]);
    }
    return c;
}

void expect_complete(const Surface& surface, const LocalSurface& local, const std::string& what) {
    std::set<std::array<std::int64_t, 9>> held;
    for (std::size_t t = 0; t < local.triangle_count; ++t) {
        for (const std::uint32_t i : local.triangles[t]) ASSERT_LT(i, local.vertex_count);
        held.insert(name_of(corners(local, t), surface.lattice().spacing_m));
    }
    for (const Corners& c : all_triangles(surface)) {
        // Float positions are good to a millionth of the lattice.
        const double tolerance = 1e-6 * surface.lattice().spacing_m * surface.lattice().cells[0];
        if (distance_to_triangle(local.center_object, c) > local.radius_m - tolerance) continue;
        // Rounding of a name may fall either way: look at the neighbours too.
        const auto name = name_of(c, surface.lattice().spacing_m);
        const bool found = held.contains(name) || std::ranges::any_of(held, [&](const auto& other) {
                               for (std::size_t i = 0; i < 9; ++i) {
                                   if (std::abs(other[i] - name[i]) > 1) return false;
                               }
                               return true;
                           });
        ASSERT_TRUE(found) << what;
    }
}

}  // namespace

TEST(LocalSurface, HoldsEveryTriangleWithinTheBall) {
    WorkerPool pool(2);
    const auto ball = make_ball(0.4, 40, {"ball", {}});
    ASSERT_TRUE(ball.has_value());
    const Surface surface = meshed(*ball, pool);
    const auto local = std::make_unique<LocalSurface>();
    Random random(1);
    std::size_t gathered = 0;
    for (int i = 0; i < repeated(60); ++i) {
        const Vec3 center(random.between(-0.5, 0.5), random.between(-0.5, 0.5), random.between(-0.5, 0.5));
        const double radius = random.between(0.001, 0.2);
        gather_local_surface(surface, center, radius, *local);
        EXPECT_EQ(local->radius_m, radius);
        EXPECT_EQ(local->center_object, center);
        EXPECT_EQ(local->dropped_triangles, 0u);
        ASSERT_NO_FATAL_FAILURE(expect_complete(surface, *local, std::to_string(i)));
        gathered += local->triangle_count;
    }
    EXPECT_GT(gathered, 100u);
    gather_local_surface(surface, Vec3(100), 1, *local);
    EXPECT_EQ(local->triangle_count, 0u);
}

TEST(LocalSurface, PositionsLieWhereTheSurfacesDo) {
    WorkerPool pool(1);
    const auto ball = make_ball(0.4, 32, {"ball", {}});
    const Surface surface = meshed(*ball, pool);
    const auto local = std::make_unique<LocalSurface>();
    const Vec3 center(0.123456789, 0.3, 0.2);
    gather_local_surface(surface, center, 0.05, *local);
    ASSERT_GT(local->triangle_count, 0u);
    constexpr double kRounding = 0.1 * 0x1p-24;  // of a float that is at most the neighbourhood's size
    const Vec3 shift = local->origin_object - surface.lattice().origin_object;
    std::set<std::array<double, 3>> places;
    for (std::uint32_t t = 0; t < surface.tile_count(); ++t) {
        for (const auto& v : surface.tile(t).vertices) places.insert({v.x, v.y, v.z});
    }
    for (std::uint32_t i = 0; i < local->vertex_count; ++i) {
        const Vec3 p = Vec3(local->positions_m[i]) + shift;
        const auto near = places.lower_bound({p.x - kRounding, -1e9, -1e9});
        bool found = false;
        for (auto it = near; it != places.end() && (*it)[0] <= p.x + kRounding; ++it) {
            found = found || (std::abs((*it)[1] - p.y) <= kRounding && std::abs((*it)[2] - p.z) <= kRounding);
        }
        ASSERT_TRUE(found) << i;
    }
}

// More than 65 536 triangles within reach: the ball shrinks, says how many it left out, and is complete again.
TEST(LocalSurface, TooManyTrianglesShrinkTheBall) {
    WorkerPool pool(2);
    const Solid solid = noise_solid({40, 40, 40}, 0.5, Rays::agree, 1);
    const Surface surface = meshed(solid, pool);
    ASSERT_GT(surface.triangles(), LocalSurface::kMaxTriangles);
    const auto local = std::make_unique<LocalSurface>();
    const Vec3 center = solid.lattice.object_from_units(Vec3(20.3, 19.6, 20.1) * 4096.0);
    gather_local_surface(surface, center, 1.0, *local);
    EXPECT_LT(local->radius_m, 1.0);
    EXPECT_GT(local->triangle_count, 1000u);
    EXPECT_EQ(local->dropped_triangles + local->triangle_count, surface.triangles());
    std::size_t within = 0;
    for (const Corners& c : all_triangles(surface)) {
        within += distance_to_triangle(center, c) <= local->radius_m * (1 - 1e-5) ? 1u : 0u;
    }
    EXPECT_GE(local->triangle_count, within);
    EXPECT_GT(within, 500u);
    // A ball that fits is left alone.
    gather_local_surface(surface, center, local->radius_m, *local);
    EXPECT_EQ(local->dropped_triangles, 0u);
}

}  // namespace burin::test
