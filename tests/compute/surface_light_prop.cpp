// SPDX-License-Identifier: MIT
// The light that is kept up to date while a solid is carved is that of a fresh bake, on any number of threads.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "compute/engine/engine.hpp"
#include "compute/light/surface_light.hpp"
#include "compute/tools/apply.hpp"
#include "tests/compute/effort.hpp"

namespace burin::compute::test {
namespace {

constexpr Lamp kLamp{{0.2, -0.5, 1.0}, 0.08};

// A floor beneath a roof on three walls, its surface and its light, carved at random: what is cut or filled at one
// place gives or takes light at others.
struct Workpiece {
    WorkerPool pool;
    std::unique_ptr<CarvingEngine> engine;
    Surface surface;
    SurfaceLight light;

    Workpiece(int resolution, unsigned threads, bool hollow = true)
        : pool(threads),
          engine(make_cpu_engine(*make_block(Vec3(1.0, 0.8, 0.6), resolution, {"block", {}}), pool)),
          surface(engine->solid().lattice),
          light(surface.lattice(), kLamp) {
        const Pose middle{{0.5, 0.3, 0.33}, Quat(1.0, 0.0, 0.0, 0.0)};
        const ToolSweep cut{BoxTool{Vec3(0.42, 0.42, 0.2)}, middle, middle};
        if (hollow) {
            EXPECT_TRUE(engine->carve(std::span(&cut, 1)).has_value());
        }
        (void)engine->take_changes();
        surface.mesh_all(engine->solid(), pool);
        light.follow(engine->solid(), surface, pool);
    }
    void carve(Random& random) {
        BallSweep sweep;
        const auto anywhere = [&] { return Vec3(random.unit(), random.unit() * 0.8, random.unit() * 0.6); };
        sweep.start_object_m = anywhere();
        sweep.end_object_m = sweep.start_object_m + (anywhere() - Vec3(0.5, 0.4, 0.3)) * 0.3;
        sweep.radius_m = random.between(0.01, 0.12);
        sweep.operation = random.chance(0.4) ? Operation::fill : Operation::cut;
        ASSERT_TRUE(engine->carve(std::span(&sweep, 1)).has_value());
        surface.update(engine->solid(), engine->take_changes(), pool);
        light.follow(engine->solid(), surface, pool);
    }
    void bake_all() {
        while (light.step(Vec3(0.5), 1000, pool) > 0) {
        }
    }
};

// -1 when all light is the same.
int first_light_difference(const SurfaceLight& a, const SurfaceLight& b, std::size_t tiles) {
    for (std::uint32_t t = 0; t < tiles; ++t) {
        const TileLight *of_a = a.shared_light(t).get(), *of_b = b.shared_light(t).get();
        if ((of_a == nullptr) != (of_b == nullptr)) return static_cast<int>(t);
        if (of_a != nullptr && of_a->vertices != of_b->vertices) return static_cast<int>(t);
    }
    return -1;
}

void expect_fresh_light(Workpiece& piece, const char* when) {
    piece.bake_all();
    SurfaceLight fresh(piece.surface.lattice(), piece.light.lamp());
    Surface surface(piece.surface.lattice());
    surface.mesh_all(piece.engine->solid(), piece.pool);
    fresh.follow(piece.engine->solid(), surface, piece.pool);
    fresh.step(Vec3(0.0), surface.tile_count(), piece.pool);
    ASSERT_EQ(fresh.pending(), 0u);
    ASSERT_EQ(piece.light.pending(), 0u);
    ASSERT_EQ(first_light_difference(piece.light, fresh, surface.tile_count()), -1) << when;
}

TEST(SurfaceLightKept, EqualsAFreshBakeAfterRandomCuts) {
    for (int seed = 0; seed < repeated(2); ++seed) {
        Random random(static_cast<std::uint64_t>(seed) + 100);
        Workpiece piece(random.small(50, 84), 2);
        for (int update = 0; update < 8; ++update) {
            piece.carve(random);
            // Mostly a few tiles between updates, as when carving goes on; now and then none.
            piece.light.step(Vec3(0.3), static_cast<std::size_t>(random.small(0, 6)), piece.pool);
            if (update % 4 == 3) expect_fresh_light(piece, "carved");
        }
        ASSERT_TRUE(piece.light.set_lamp({{-1.0, 0.3, 0.2}, 0.2}).has_value());
        piece.carve(random);
        expect_fresh_light(piece, "after another lamp");
    }
}

TEST(SurfaceLightKept, IsTheSameOnAnyNumberOfThreads) {
    std::vector<std::unique_ptr<Workpiece>> pieces;
    for (const unsigned threads : {1u, 2u, 5u}) pieces.push_back(std::make_unique<Workpiece>(64, threads));
    for (int update = 0; update < 4; ++update) {
        for (auto& piece : pieces) {
            Random random(static_cast<std::uint64_t>(update) + 5);
            piece->carve(random);
            piece->light.step(Vec3(0.4), 7, piece->pool);
        }
        const auto baked = pieces[0]->light.take_baked();
        EXPECT_EQ(baked.size(), 7u);
        for (std::size_t i = 1; i < pieces.size(); ++i) {
            EXPECT_EQ(first_light_difference(pieces[0]->light, pieces[i]->light, pieces[0]->surface.tile_count()), -1);
            EXPECT_EQ(pieces[i]->light.take_baked(), baked);
        }
    }
}

TEST(SurfaceLightKept, HasALightForEachVertexAtEveryMoment) {
    Random random(3);
    Workpiece piece(48, 2);
    for (int update = 0; update < repeated(16); ++update) {
        piece.carve(random);
        for (std::uint32_t t = 0; t < piece.surface.tile_count(); ++t) {
            const TileLight* light = piece.light.shared_light(t).get();
            ASSERT_EQ(light == nullptr ? 0 : light->vertices.size(), piece.surface.tile(t).vertices.size());
        }
        piece.light.step(Vec3(0.5), 5, piece.pool);
    }
}

TEST(SurfaceLightKept, GivesAnUnchangedVertexTheLightItHadAndANewOneThatOfTheNearest) {
    Random random(11);
    geometry::SurfaceTile before;
    TileLight light;
    for (int i = 0; i < 300; ++i) {
        const auto place = [&] { return static_cast<float>(random.unit()); };
        before.vertices.push_back({place(), place(), place(), static_cast<std::uint32_t>(i), 0});
        light.vertices.push_back({static_cast<std::uint8_t>(i), static_cast<std::uint8_t>(i / 2)});
    }
    geometry::SurfaceTile after;
    for (int i = 0; i < 300; ++i) {
        if (i % 3 == 0) continue;
        shared::SurfaceVertex v = before.vertices[static_cast<std::size_t>(i)];
        if (i % 5 == 0) v.x += 0.02f;
        after.vertices.push_back(v);
    }
    const std::vector<geometry::VertexLight> carried = carried_over(after, &before, &light);
    for (std::size_t i = 0; i < after.vertices.size(); ++i) {
        const auto far = [&](const shared::SurfaceVertex& v) {
            return glm::distance(Vec3(v.x, v.y, v.z),
                                 Vec3(after.vertices[i].x, after.vertices[i].y, after.vertices[i].z));
        };
        const auto nearest = std::ranges::min_element(before.vertices, {}, far);
        EXPECT_EQ(carried[i], light.vertices[static_cast<std::size_t>(nearest - before.vertices.begin())]);
    }
    for (const geometry::VertexLight& all : carried_over(after, nullptr, nullptr))
        EXPECT_EQ(all, (geometry::VertexLight{255, 255}));
}

TEST(InnerBoxesKept, LieInsideTheSolidAfterEveryCut) {
    Random random(9);
    Workpiece piece(96, 2, false);
    std::size_t most = 0;
    for (int update = 0; update < repeated(40); ++update) {
        piece.carve(random);
        if (update % 2 == 0) piece.light.step(Vec3(0.5), 1, piece.pool);
        const Lattice& lattice = piece.surface.lattice();
        most = std::max(most, piece.light.inner_boxes_object().size());
        for (const Box& box : piece.light.inner_boxes_object()) {
            const Vec3 lo = (box.lo - lattice.origin_object) / lattice.spacing_m;
            const Vec3 hi = (box.hi - lattice.origin_object) / lattice.spacing_m;
            for (int x = static_cast<int>(std::floor(lo.x)); x <= static_cast<int>(std::ceil(hi.x)); ++x)
                for (int y = static_cast<int>(std::floor(lo.y)); y <= static_cast<int>(std::ceil(hi.y)); ++y) {
                    const auto ends = piece.engine->solid().sets[2].ends(x, y);
                    // One interval from below the box to above it.
                    bool covered = false;
                    for (std::size_t i = 0; i < ends.size(); i += 2) {
                        covered |= depth_of(ends[i]) <= lo.z * shared::kUnitsPerCell &&
                                   hi.z * shared::kUnitsPerCell < depth_of(ends[i + 1]);
                    }
                    ASSERT_TRUE(covered) << update;
                }
        }
    }
    EXPECT_GT(most, 0u);
}

}  // namespace
}  // namespace burin::compute::test
