// SPDX-License-Identifier: MIT
// The triangles gathered for a tick, against a look at all of them.
#include <gtest/gtest.h>

#include <set>

#include "bench/measure/bumpy_sphere.hpp"
#include "compute/mesher/surface.hpp"
#include "geometry/contact/touch_mesh.hpp"
#include "haptics/contact/candidates.hpp"
#include "haptics/contact/triangle_contact.hpp"
#include "tests/compute/effort.hpp"
#include "tests/compute/random_solids.hpp"

namespace burin::haptics {
namespace {

constexpr double kCell_m = 0.01;

geometry::LocalSurface noise() {
    static WorkerPool pool(2);
    const compute::Solid solid = compute::test::noise_solid({14, 14, 14}, 0.4, compute::test::Rays::agree, 9);
    compute::Surface surface(solid.lattice);
    surface.mesh_all(solid, pool);
    geometry::LocalSurface local;
    compute::gather_local_surface(surface, solid.lattice.origin_object + 7.0 * solid.lattice.spacing_m, 1e3, local);
    local.sequence = 1;
    return local;
}

geometry::LocalSurface mesh(std::size_t triangles) {
    bench::BumpySphere shape;
    geometry::TriangleMesh scaled = bench::mesh_of(shape, bench::squares_for(triangles));
    for (Vec3& p : scaled.positions_m) p *= 7.0 * kCell_m / shape.radius_m;
    geometry::LocalSurface local;
    local.sequence = 1;
    local.radius_m = 1e3;
    local.meshes.push_back({geometry::TouchMesh::create(scaled)->snapshot(), 0});
    return local;
}

std::set<std::uint32_t> within(const geometry::LocalSurface& surface, const Vec3& center, double reach) {
    std::set<std::uint32_t> ids;
    for (std::uint32_t id = 0; id < surface.triangles(); ++id) {
        const geometry::Triangle t = surface.triangle(id);
        if (geometry::is_degenerate(t)) continue;
        if (glm::length(center - nearest_on_triangle(center, t).point) <= reach) ids.insert(id);
    }
    return ids;
}

struct Found {
    std::set<std::uint32_t> ids;
    std::uint32_t looked_at = 0;
};

// Asked of balls far smaller than the triangles, as large, and far larger.
void expect_nothing_missed(const geometry::LocalSurface& surface, const Vec3& middle, double size, std::uint64_t seed) {
    compute::test::Random random(seed);
    const auto around = [&](double most) {
        return most * Vec3(random.between(-1, 1), random.between(-1, 1), random.between(-1, 1));
    };
    const double edge = surface.mean_edge_m();
    const auto candidates = std::make_unique<Candidates>();
    std::size_t touched = 0, met = 0;
    for (int i = 0; i < compute::test::repeated(120); ++i) {
        const double radius = edge * std::pow(10.0, random.between(-3.0, 0.8));
        // Half of the ways begin beside a triangle.
        const geometry::Triangle some =
            surface.triangle(static_cast<std::uint32_t>(random.between(0, surface.triangles())));
        const Vec3 from = i % 2 == 0 ? middle + around(size) : some.a + around(2.0 * radius);
        const Way way{from, from + around(i % 3 == 0 ? 0.0 : edge)};
        const double slack = random.between(0.0, 0.5) * (radius + glm::length(way.to - way.from));
        std::uint32_t looks = 1'000'000;
        if (candidates->gather(surface, {way, radius, slack, {}}, looks) != Candidates::Gathered::all) continue;
        for (int k = 0; k < 8; ++k) {
            const auto place = [&] {
                return from + random.between(0, 1) * (way.to - from) + around(slack / std::sqrt(3.0));
            };
            const Vec3 at = place(), to = place();
            ASSERT_TRUE(candidates->covers(at));
            std::set<std::uint32_t> found, on_way;
            // Asked a few times at other places, for what lies near is remembered.
            candidates->for_each_at(place(), radius, [](std::uint32_t) { return true; });
            candidates->for_each_on_way({place(), place()}, radius, [](std::uint32_t) { return true; });
            candidates->for_each_at(at, radius,
                                    [&](std::uint32_t c) { return found.insert(candidates->id(c)).second; });
            for (const std::uint32_t id : within(surface, at, radius)) {
                ASSERT_TRUE(found.contains(id)) << "run " << i << ", triangle " << id;
                ++touched;
            }
            candidates->for_each_on_way({at, to}, radius,
                                        [&](std::uint32_t c) { return on_way.insert(candidates->id(c)).second; });
            for (std::uint32_t id = 0; id < surface.triangles(); ++id) {
                const geometry::Triangle t = surface.triangle(id);
                if (geometry::is_degenerate(t) || fraction_until_touch(at, to - at, radius, t) > 1.0) continue;
                ASSERT_TRUE(on_way.contains(id)) << "run " << i << ", triangle " << id;
                ++met;
            }
        }
    }
    const auto runs = static_cast<std::size_t>(compute::test::repeated(120));
    EXPECT_GE(touched, runs / 2);
    EXPECT_GE(met, runs / 4);
}

}  // namespace

TEST(Candidates, HoldAllThatABallMayTouchOnCarvedTiles) {
    const geometry::LocalSurface tiles = noise();
    const Vec3 middle = tiles.center_object - tiles.origin_object;
    expect_nothing_missed(tiles, middle, 7.0 * kCell_m, 1);
}

TEST(Candidates, HoldAllThatABallMayTouchOnAMesh) {
    const geometry::LocalSurface coarse = mesh(600), fine = mesh(4000);
    expect_nothing_missed(coarse, Vec3(0.0), 8.0 * kCell_m, 2);
    expect_nothing_missed(fine, Vec3(0.0), 8.0 * kCell_m, 3);
}

}  // namespace burin::haptics
