// SPDX-License-Identifier: MIT
// The tiles near the tool against every triangle of the surface, one by one.
#include <gtest/gtest.h>

#include <cstring>
#include <map>
#include <memory>
#include <set>

#include "compute/engine/engine.hpp"
#include "compute/mesher/surface.hpp"
#include "geometry/contact/local_surface_search.hpp"
#include "tests/compute/random_solids.hpp"

namespace burin::compute::test {
namespace {

using Name = std::array<float, 9>;  // a triangle by its corners, to the bit

Surface meshed(const Solid& solid, WorkerPool& pool) {
    Surface surface(solid.lattice);
    surface.mesh_all(solid, pool);
    return surface;
}

std::vector<geometry::Triangle> all_triangles(const Surface& surface) {
    std::vector<geometry::Triangle> result;
    for (std::uint32_t t = 0; t < surface.tile_count(); ++t) {
        const TileMesh& tile = surface.tile(t);
        const auto corner = [&](std::size_t i) {
            const shared::SurfaceVertex& v = tile.vertices[tile.indices[i]];
            return Vec3(v.x, v.y, v.z);
        };
        for (std::size_t i = 0; i < tile.indices.size(); i += 3) {
            result.push_back({corner(i), corner(i + 1), corner(i + 2)});
        }
    }
    return result;
}

Name name_of(const geometry::Triangle& t) {
    const Vec3f a(t.a), b(t.b), c(t.c);
    return {a.x, a.y, a.z, b.x, b.y, b.z, c.x, c.y, c.z};
}

Box box_of(const geometry::Triangle& t) {
    Box box;
    for (const Vec3& corner : {t.a, t.b, t.c}) box.include(corner);
    return box;
}

bool meet(const Box& a, const Box& b) {
    return glm::all(glm::lessThanEqual(a.lo, b.hi)) && glm::all(glm::lessThanEqual(b.lo, a.hi));
}

double distance_to_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
    const Vec3 e = b - a;
    const double length2 = glm::dot(e, e);
    const double t = length2 > 0 ? glm::clamp(glm::dot(p - a, e) / length2, 0.0, 1.0) : 0.0;
    return glm::length(p - a - e * t);
}

double distance_to_triangle(const Vec3& p, const geometry::Triangle& t) {
    const std::array<Vec3, 3> c{t.a, t.b, t.c};
    const Vec3 n = glm::cross(c[1] - c[0], c[2] - c[0]);
    bool above = glm::length(n) > 0;
    for (std::size_t k = 0; k < 3 && above; ++k) {
        above = glm::dot(glm::cross(c[(k + 1) % 3] - c[k], p - c[k]), n) >= 0;
    }
    if (above) return std::abs(glm::dot(p - c[0], n)) / glm::length(n);
    return std::min(
        {distance_to_segment(p, c[0], c[1]), distance_to_segment(p, c[1], c[2]), distance_to_segment(p, c[2], c[0])});
}

// How often the search comes by each triangle. Ids are those of the triangles, none comes twice, and none is
// degenerate.
std::map<Name, int> found_in(const geometry::LocalSurface& local, const Box& box) {
    std::map<Name, int> found;
    std::set<std::uint32_t> ids;
    geometry::for_each_triangle_near(local, box.lo, box.hi, [&](std::uint32_t id, const geometry::Triangle& t) {
        EXPECT_TRUE(ids.insert(id).second);
        EXPECT_LT(id, local.triangles());
        EXPECT_EQ(name_of(local.triangle(id)), name_of(t));
        EXPECT_FALSE(geometry::is_degenerate(t));
        ++found[name_of(t)];
        return true;
    });
    return found;
}

// Every triangle that fits the description is found as often as the surface has it, and nothing that it does not have.
template <typename Wanted>
std::size_t expect_all(const std::vector<geometry::Triangle>& all, std::map<Name, int> found, Wanted&& wanted,
                       const std::string& what) {
    std::size_t count = 0;
    for (const geometry::Triangle& t : all) {
        const auto at = found.find(name_of(t));
        const bool is_found = at != found.end() && at->second-- > 0;
        if (geometry::is_degenerate(t) || !wanted(t)) continue;
        ++count;
        EXPECT_TRUE(is_found) << what;
    }
    for (const auto& [name, left] : found) EXPECT_LE(left, 0) << what << ": found what is not there";
    return count;
}

std::vector<Solid> random_solids() {
    std::vector<Solid> solids;
    for (const Rays rays : {Rays::agree, Rays::disturbed, Rays::unrelated}) {
        solids.push_back(noise_solid({20, 37, 50}, 0.5, rays, 7));  // with fans
        solids.push_back(noise_solid({33, 16, 15}, 0.05, rays, 8));
    }
    solids.push_back(*make_ball(0.4, 40, {"ball", {}}));
    return solids;
}

// Over the upper side of a ball of radius 0.4.
std::vector<BallSweep> stroke(int sweeps) {
    std::vector<BallSweep> result;
    for (int i = 0; i < sweeps; ++i) {
        const Vec3 at(0.3 * std::sin(0.7 * i), 0.38, 0.3 * std::cos(0.4 * i));
        result.push_back({at, at + Vec3(0.05, 0.0, 0.02), 0.08, 0});
    }
    return result;
}

}  // namespace

TEST(LocalSurface, ABoxFindsWhatALookAtEveryTriangleFinds) {
    WorkerPool pool(2);
    Random random(2);
    std::size_t with_fans = 0, without = 0, wanted = 0;
    for (const Solid& solid : random_solids()) {
        const Surface surface = meshed(solid, pool);
        for (std::uint32_t t = 0; t < surface.tile_count(); ++t) {
            (surface.tile(t).only_quads() ? without : with_fans) += surface.shared_tile(t) ? 1u : 0u;
        }
        const std::vector<geometry::Triangle> all = all_triangles(surface);
        const double h = solid.lattice.spacing_m;
        const Vec3 extent = h * Vec3(solid.lattice.cells[0], solid.lattice.cells[1], solid.lattice.cells[2]);
        geometry::LocalSurface local;
        gather_local_surface(surface, solid.lattice.origin_object + 0.5 * extent, glm::length(extent), local);
        EXPECT_EQ(local.triangles(), surface.triangles());
        for (int i = 0; i < repeated(60); ++i) {
            Box box;
            for (int axis = 0; axis < 3; ++axis) {  // some begin, end or lie beyond the lattice
                box.lo[axis] = random.between(-6.0 * h, extent[axis] + 3.0 * h);
                box.hi[axis] = box.lo[axis] + random.between(0.0, random.chance(0.3) ? 2.0 * extent[axis] : 4.0 * h);
                if (random.chance(0.2)) box.lo[axis] = h * std::round(box.lo[axis] / h);
            }
            if (box.empty()) continue;
            wanted += expect_all(
                all, found_in(local, box), [&](const geometry::Triangle& t) { return meet(box_of(t), box); },
                std::to_string(i));
        }
    }
    EXPECT_GT(with_fans, 10u);
    EXPECT_GT(without, 10u);
    EXPECT_GT(wanted, kSanitized ? 100u : 10000u);
}

TEST(LocalSurface, HoldsEveryTriangleWithinTheBall) {
    WorkerPool pool(2);
    Random random(1);
    std::size_t within = 0;
    for (const Solid& solid : random_solids()) {
        const Surface surface = meshed(solid, pool);
        const std::vector<geometry::Triangle> all = all_triangles(surface);
        const double h = solid.lattice.spacing_m;
        geometry::LocalSurface local;
        for (int i = 0; i < repeated(40); ++i) {
            Vec3 center(0.0);  // relative to the lattice's origin
            for (int axis = 0; axis < 3; ++axis) {
                center[axis] = h * random.between(-6.0, solid.lattice.cells[static_cast<std::size_t>(axis)] + 6.0);
            }
            const double radius = h * random.between(0.01, 10.0);
            gather_local_surface(surface, solid.lattice.origin_object + center, radius, local);
            EXPECT_EQ(local.radius_m, radius);
            EXPECT_EQ(local.center_object, solid.lattice.origin_object + center);
            EXPECT_EQ(local.origin_object, solid.lattice.origin_object);
            // A thousandth of a cell for the rounding of the centre.
            const auto inside = [&](const geometry::Triangle& t) {
                return distance_to_triangle(center, t) <= radius - 1e-3 * h;
            };
            within += expect_all(all, found_in(local, {center - radius, center + radius}), inside, std::to_string(i));
        }
        gather_local_surface(surface, Vec3(1e6), h, local);
        EXPECT_EQ(local.triangles(), 0u);
    }
    EXPECT_GT(within, kSanitized ? 100u : 10000u);
}

TEST(LocalSurface, BoxesThatAreNoBoxesFindNothing) {
    WorkerPool pool(1);
    const Surface surface = meshed(*make_ball(0.4, 24, {"ball", {}}), pool);
    geometry::LocalSurface local;
    const Vec3 center = surface.lattice().origin_object;
    gather_local_surface(surface, center, 2.0, local);
    ASSERT_GT(local.triangles(), 0u);
    const double nan = std::nan(""), inf = HUGE_VAL;
    EXPECT_TRUE(found_in(local, {Vec3(nan), Vec3(nan)}).empty());
    EXPECT_TRUE(found_in(local, {Vec3(0.0), Vec3(1.0, nan, 1.0)}).empty());
    EXPECT_TRUE(found_in(local, {Vec3(1.0), Vec3(-1.0)}).empty());
    EXPECT_TRUE(found_in(local, {Vec3(inf), Vec3(inf)}).empty());
    EXPECT_EQ(found_in(local, {Vec3(-inf), Vec3(inf)}), found_in(local, {Vec3(-1e9), Vec3(1e9)}));
    EXPECT_FALSE(found_in(local, {Vec3(-inf), Vec3(inf)}).empty());
    EXPECT_TRUE(found_in(geometry::LocalSurface{}, {Vec3(-1.0), Vec3(1.0)}).empty());
}

TEST(LocalSurface, TilesThatAReaderHoldsStayAsTheyAreWhileCarvingGoesOn) {
    WorkerPool pool(2);
    const auto engine = make_cpu_engine(*make_ball(0.4, 48, {"ball", {}}), pool);
    Surface surface = meshed(engine->solid(), pool);
    geometry::LocalSurface held, draft;
    const Vec3 top(0.0, 0.4, 0.0);
    gather_local_surface(surface, top, 0.3, held);
    std::vector<geometry::SurfaceTile> before;
    for (const geometry::TileBlock::Place& place : held.tiles.places)
        before.push_back(place.tile ? *place.tile : geometry::SurfaceTile{});
    const std::vector<geometry::Triangle> touched_before = all_triangles(surface);
    for (const BallSweep& sweep : stroke(repeated(100))) {
        ASSERT_TRUE(engine->carve({&sweep, 1}));
        surface.update(engine->solid(), engine->take_changes(), pool);
        gather_local_surface(surface, sweep.end_object_m, 0.1, draft);
    }
    const auto same_bytes = [](const auto& a, const auto& b) {
        return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(a[0])) == 0);
    };
    std::size_t changed = 0;
    for (std::size_t i = 0; i < before.size(); ++i) {
        if (!held.tiles.places[i].tile) continue;
        const geometry::SurfaceTile& now = *held.tiles.places[i].tile;
        EXPECT_TRUE(same_bytes(now.vertices, before[i].vertices) && same_bytes(now.indices, before[i].indices) &&
                    same_bytes(now.quads, before[i].quads) && same_bytes(now.row_quads, before[i].row_quads) &&
                    same_bytes(now.row_triangles, before[i].row_triangles));
        changed += held.tiles.places[i].tile.use_count() == 1 ? 1u : 0u;  // the surface has another by now
    }
    EXPECT_GT(changed, 3u);
    // What is found is still what the surface was, and no other.
    expect_all(
        touched_before, found_in(held, {Vec3(-1e9), Vec3(1e9)}), [](const geometry::Triangle&) { return false; },
        "held");
}

TEST(LocalSurface, ADraftFilledAgainLetsGoOfWhatItHeld) {
    WorkerPool pool(1);
    const auto engine = make_cpu_engine(*make_ball(0.4, 48, {"ball", {}}), pool);
    Surface surface = meshed(engine->solid(), pool);
    geometry::LocalSurface draft;
    gather_local_surface(surface, Vec3(0.0, 0.4, 0.0), 0.1, draft);
    std::vector<std::weak_ptr<const geometry::SurfaceTile>> held;
    for (const geometry::TileBlock::Place& place : draft.tiles.places) {
        if (place.tile) held.push_back(place.tile);
    }
    ASSERT_GT(held.size(), 0u);
    gather_local_surface(surface, Vec3(0.0, -0.4, 0.0), 0.01, draft);
    for (const auto& tile : held) EXPECT_EQ(tile.use_count(), 1);  // the surface's own
    gather_local_surface(surface, Vec3(0.0, 0.4, 0.0), 0.1, draft);
    surface = Surface(surface.lattice());
    for (const auto& tile : held) EXPECT_EQ(tile.use_count(), 1);  // the draft's
    draft = {};
    for (const auto& tile : held) EXPECT_TRUE(tile.expired());
}

}  // namespace burin::compute::test
