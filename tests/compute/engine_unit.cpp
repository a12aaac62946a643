// SPDX-License-Identifier: MIT
#include "compute/engine.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "compute/surface.hpp"
#include "compute/sweep_units.hpp"
#include "tests/compute/effort.hpp"
#include "tests/compute/random_solids.hpp"

namespace burin::test {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN(), kInf = std::numeric_limits<double>::infinity();

Solid cube(int resolution) { return *make_block(Vec3(1), resolution, {"cube", {}}); }

std::vector<BallSweep> random_stroke(Random& random, int count, double largest_radius) {
    std::vector<BallSweep> sweeps(static_cast<std::size_t>(count));
    const auto anywhere = [&] {
        return Vec3(random.between(-0.2, 1.2), random.between(-0.2, 1.2), random.between(-0.2, 1.2));
    };
    for (BallSweep& s : sweeps) {
        s.start_object_m = anywhere();
        s.end_object_m = random.chance(0.2)   ? s.start_object_m
                         : random.chance(0.5) ? s.start_object_m + (anywhere() - Vec3(0.5)) * 0.1
                                              : anywhere();
        if (random.chance(0.2)) s.end_object_m.z = s.start_object_m.z + random.between(-1e-5, 1e-5);
        s.radius_m = random.between(1e-4, largest_radius);
    }
    return sweeps;
}

}  // namespace

TEST(CpuEngine, RefusesBadSweepsAndLeavesTheSolidUntouched) {
    WorkerPool pool(2);
    const auto engine = make_cpu_engine(cube(32), pool);
    const Solid before = engine->solid();
    (void)engine->dirty_tiles().take();
    const BallSweep good{Vec3(0.5), Vec3(0.6), 0.1, 0};
    std::vector<BallSweep> bad(12, good);
    bad[0].start_object_m.x = kNan;
    bad[1].start_object_m.y = kInf;
    bad[2].end_object_m.z = -kInf;
    bad[3].end_object_m.x = kNan;
    bad[4].radius_m = 0;
    bad[5].radius_m = -0.1;
    bad[6].radius_m = kNan;
    bad[7].radius_m = kInf;
    bad[8].radius_m = 1e6;
    bad[9].start_object_m.x = 1e300;
    bad[10].end_object_m.y = -1e307;
    bad[11].material = 1;  // the cube has one
    for (std::size_t i = 0; i < bad.size(); ++i) {
        const auto result = engine->cut(std::vector{good, bad[i]});
        ASSERT_FALSE(result.has_value()) << i;
        EXPECT_FALSE(result.error().what.empty());
        EXPECT_FALSE(result.error().remedy.empty()) << i;
    }
    EXPECT_TRUE(engine->solid().same_content(before));
    EXPECT_TRUE(engine->dirty_tiles().take().empty());
}

TEST(CpuEngine, SweepsThatMissDoNothing) {
    WorkerPool pool(2);
    const auto engine = make_cpu_engine(cube(32), pool);
    const Solid before = engine->solid();
    (void)engine->dirty_tiles().take();
    const std::vector<BallSweep> misses{{Vec3(5), Vec3(6), 0.1, 0},
                                        {Vec3(-1e6, 0.5, 0.5), Vec3(-1e3, 0.5, 0.5), 0.4, 0},
                                        {Vec3(-1e6, 2, 0.5), Vec3(1e6, 2, 0.5), 0.4, 0},
                                        {Vec3(0.5, 0.5, 1.11), Vec3(0.5, 0.5, 1.11), 0.1, 0}};
    const auto stats = engine->cut(misses);
    ASSERT_TRUE(stats.has_value());
    EXPECT_EQ(stats->rays_changed, 0u);
    EXPECT_TRUE(engine->cut({}).has_value());
    EXPECT_TRUE(engine->solid().same_content(before));
    EXPECT_TRUE(engine->dirty_tiles().take().empty());
}

TEST(CpuEngine, SegmentsFromFarAwayCutLikeTheirPartInside) {
    WorkerPool pool(2);
    const auto far = make_cpu_engine(cube(64), pool), near = make_cpu_engine(cube(64), pool);
    ASSERT_TRUE(far->cut(std::vector<BallSweep>{{Vec3(-1e4, 0.5, 0.97), Vec3(1e4, 0.5, 0.97), 0.1, 0}}).has_value());
    ASSERT_TRUE(near->cut(std::vector<BallSweep>{{Vec3(-0.5, 0.5, 0.97), Vec3(1.5, 0.5, 0.97), 0.1, 0}}).has_value());
    // Clipping rounds the new ends to whole units, so depths may differ by one.
    for (std::size_t a = 0; a < 3; ++a) {
        const DexelSet &one = far->solid().sets[a], &other = near->solid().sets[a];
        for (std::size_t r = 0; r < one.ray_count(); ++r) {
            ASSERT_EQ(one.ends(r).size(), other.ends(r).size());
            for (std::size_t i = 0; i < one.ends(r).size(); ++i) {
                ASSERT_NEAR(depth_of(one.ends(r)[i]), depth_of(other.ends(r)[i]), 2);
            }
        }
    }
}

// Every ray against the exact predicate: what is left is the block without the capsule.
TEST(CpuEngine, LeavesExactlyWhatTheCapsuleDoesNotCover) {
    WorkerPool pool(2);
    Random random(1);
    for (int i = 0; i < repeated(64); ++i) {
        const Solid before = cube(random.small(16, 40));
        const auto stroke = random_stroke(random, 1, 0.3);
        const auto engine = make_cpu_engine(before, pool);
        ASSERT_TRUE(engine->cut(stroke).has_value());
        const auto capsules = capsules_in_units(before, stroke);
        ASSERT_TRUE(capsules.has_value());
        for (int axis = 0; axis < 3; ++axis) {
            const auto a = static_cast<std::size_t>(axis);
            for (std::size_t r = 0; r < before.sets[a].ray_count(); ++r) {
                const auto was = before.sets[a].ends(r), is = engine->solid().sets[a].ends(r);
                if (was.empty()) {
                    ASSERT_TRUE(is.empty());
                    continue;
                }
                const int u = static_cast<int>(r) % before.lattice.rays_u(axis),
                          v = static_cast<int>(r) / before.lattice.rays_u(axis);
                const auto covered = [&](int depth) {
                    if (capsules->empty()) return false;
                    const auto k = shared::capsule_from_ray(capsules->front(), axis, u * 4096, v * 4096);
                    return shared::inside_capsule(k, depth - k.start_s);
                };
                // Sampled depths: material where it was and is not covered.
                for (int depth = depth_of(was[0]); depth < depth_of(was[1]); depth += 397) {
                    bool material = false, on_end = false;
                    for (std::size_t e = 0; e < is.size(); e += 2) {
                        material = material || (depth_of(is[e]) <= depth && depth < depth_of(is[e + 1]));
                        on_end = on_end || depth == depth_of(is[e]) || depth == depth_of(is[e + 1]);
                    }
                    if (!on_end) {
                        ASSERT_EQ(material, !covered(depth)) << i << " axis " << axis << " ray " << r;
                    }
                }
            }
        }
    }
}

// Tunnels side by side at several heights: nearly every upright ray outgrows its room, again and again, on all threads.
TEST(CpuEngine, RaysThatOutgrowTheStoreEndUpTheSameOnAnyNumberOfThreads) {
    const Solid start = cube(48);
    std::vector<BallSweep> stroke;
    for (const double z : {0.5, 0.25, 0.75, 0.125, 0.375, 0.625, 0.875}) {
        for (double y = 0.04; y < 1; y += 0.07) stroke.push_back({Vec3(0.04, y, z), Vec3(0.96, 1 - y, z), 0.03, 0});
    }
    WorkerPool one(1), two(2), five(5);
    const auto a = make_cpu_engine(start, one), b = make_cpu_engine(start, two), c = make_cpu_engine(start, five);
    const auto sa = a->cut(stroke), sb = b->cut(stroke), sc = c->cut(stroke);
    ASSERT_TRUE(sa && sb && sc);
    EXPECT_GT(sa->rays_changed, 1000u);
    EXPECT_EQ(sa->rays_changed, sb->rays_changed);
    EXPECT_EQ(sa->rays_changed, sc->rays_changed);
    EXPECT_EQ(sa->rays_touched, sc->rays_touched);
    EXPECT_TRUE(a->solid().same_content(b->solid()));
    EXPECT_TRUE(a->solid().same_content(c->solid()));
    EXPECT_EQ(a->dirty_tiles().take(), c->dirty_tiles().take());
    EXPECT_TRUE(well_formed(a->solid()));
    EXPECT_GT(a->solid().bytes(), start.bytes());
    // One by one gives the same as all at once.
    const auto d = make_cpu_engine(start, two);
    for (const BallSweep& s : stroke) ASSERT_TRUE(d->cut(std::span(&s, 1)).has_value());
    EXPECT_TRUE(a->solid().same_content(d->solid()));
}

// A single ray with thousands of walls needs more room than the store's usual growth gives.
TEST(CpuEngine, OneRayWithThousandsOfWallsDoesNotHangTheGrowth) {
    WorkerPool pool(1);
    Solid solid{{Vec3(0.0), 1.0, {16, 16, 16}}, {}, {{"walls", {}}}};
    for (int a = 0; a < 3; ++a) solid.sets[static_cast<std::size_t>(a)] = DexelSet(solid.lattice.rays(a));
    std::vector<shared::DexelEnd> walls;
    for (int i = 0; i < 8192; ++i) walls.push_back(shared::make_end(5000 + 6 * i, 0, 0));
    const std::size_t ray = 8 * 17 + 8;
    solid.sets[2].replace(ray, walls);
    const auto engine = make_cpu_engine(std::move(solid), pool);
    // A wall is 6 units thick; a ball of two units in its middle cuts it in two.
    const double unit = 1.0 / 4096;
    const Vec3 middle(8, 8, (5000 + 6 * 4000 + 3) * unit);
    ASSERT_TRUE(engine->cut(std::vector<BallSweep>{{middle, middle, 2 * unit, 0}}).has_value());
    EXPECT_EQ(engine->solid().sets[2].ends(ray).size(), 8194u);
    EXPECT_TRUE(well_formed(engine->solid()));
}

TEST(CpuEngine, AThousandRandomStrokesKeepEveryRayWellFormed) {
    WorkerPool pool(2);
    Random random(3);
    const auto engine = make_cpu_engine(cube(64), pool);
    const auto length = [&] {
        std::array<double, 3> sum{};
        for (std::size_t a = 0; a < 3; ++a) {
            for (std::size_t r = 0; r < engine->solid().sets[a].ray_count(); ++r) {
                const auto ends = engine->solid().sets[a].ends(r);
                for (std::size_t i = 0; i < ends.size(); i += 2) sum[a] += depth_of(ends[i + 1]) - depth_of(ends[i]);
            }
        }
        return sum;
    };
    auto before = length();
    for (int batch = 0; batch < repeated(100); ++batch) {
        ASSERT_TRUE(engine->cut(random_stroke(random, 10, 0.03)).has_value());
        ASSERT_TRUE(well_formed(engine->solid())) << batch;
        const auto now = length();
        for (std::size_t a = 0; a < 3; ++a) ASSERT_LE(now[a], before[a]);
        before = now;
    }
}

// A stroke level but for a micrometre: its end planes meet the upright rays far away (capsule.h).
TEST(CpuEngine, AlmostLevelStrokeLeavesTheRestOfTheBlockAlone) {
    WorkerPool pool(2);
    for (const double tilt : {1e-6, -1e-6, 3e-6, 1e-5}) {
        const auto engine = make_cpu_engine(cube(128), pool);
        ASSERT_TRUE(engine->cut(std::vector<BallSweep>{{Vec3(0.2, 0.5, 0.9), Vec3(0.8, 0.5, 0.9 + tilt), 0.05, 0}})
                        .has_value());
        Surface surface(engine->solid().lattice);
        surface.remesh(engine->solid(), engine->dirty_tiles().take(), pool);
        const double removed = std::numbers::pi * (0.05 * 0.05 * 0.6 + 4.0 / 3.0 * 0.05 * 0.05 * 0.05);
        EXPECT_NEAR(1.0 - surface.volume_m3(), removed, 0.01 * removed);
    }
}

}  // namespace burin::test
