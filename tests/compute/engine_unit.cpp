// SPDX-License-Identifier: MIT
#include "compute/engine/engine.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "compute/mesher/surface.hpp"
#include "compute/tools/sweep_units.hpp"
#include "tests/compute/effort.hpp"
#include "tests/compute/mesh_topology.hpp"
#include "tests/compute/random_solids.hpp"

namespace burin::compute::test {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN(), kInf = std::numeric_limits<double>::infinity();

Solid cube(int resolution) { return *make_block(Vec3(1), resolution, {"cube", {}}); }

std::vector<BallSweep> random_stroke(Random& random, int count, double largest_radius,
                                     const std::vector<Operation>& operations = {Operation::cut}) {
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
        s.operation = operations[static_cast<std::size_t>(random.small(0, static_cast<int>(operations.size()) - 1))];
    }
    return sweeps;
}

}  // namespace

TEST(CpuEngine, RefusesBadSweepsAndLeavesTheSolidUntouched) {
    WorkerPool pool(2);
    const auto engine = make_cpu_engine(cube(32), pool);
    const Solid before = engine->solid();
    const BallSweep good{Vec3(0.5), Vec3(0.6), 0.1, 0};
    std::vector<BallSweep> bad(13, good);
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
    bad[12].operation = Operation::smooth;
    for (std::size_t i = 0; i < bad.size(); ++i) {
        const auto result = engine->carve(std::vector{good, bad[i]});
        ASSERT_FALSE(result.has_value()) << i;
        EXPECT_FALSE(result.error().what.empty());
        EXPECT_FALSE(result.error().remedy.empty()) << i;
    }
    EXPECT_TRUE(engine->solid().same_content(before));
    EXPECT_TRUE(engine->take_changes().empty());
}

TEST(CpuEngine, SweepsThatMissDoNothing) {
    WorkerPool pool(2);
    const auto engine = make_cpu_engine(cube(32), pool);
    const Solid before = engine->solid();
    const std::vector<BallSweep> misses{{Vec3(5), Vec3(6), 0.1, 0},
                                        {Vec3(-1e6, 0.5, 0.5), Vec3(-1e3, 0.5, 0.5), 0.4, 0},
                                        {Vec3(-1e6, 2, 0.5), Vec3(1e6, 2, 0.5), 0.4, 0},
                                        {Vec3(0.5, 0.5, 1.11), Vec3(0.5, 0.5, 1.11), 0.1, 0}};
    const auto stats = engine->carve(misses);
    ASSERT_TRUE(stats.has_value());
    EXPECT_EQ(stats->rays_changed, 0u);
    EXPECT_TRUE(engine->carve(std::span<const BallSweep>{}).has_value());
    EXPECT_TRUE(engine->solid().same_content(before));
    EXPECT_TRUE(engine->take_changes().empty());
}

TEST(CpuEngine, SegmentsFromFarAwayCutLikeTheirPartInside) {
    WorkerPool pool(2);
    const auto far = make_cpu_engine(cube(64), pool), near = make_cpu_engine(cube(64), pool);
    ASSERT_TRUE(far->carve(std::vector<BallSweep>{{Vec3(-1e4, 0.5, 0.97), Vec3(1e4, 0.5, 0.97), 0.1, 0}}).has_value());
    ASSERT_TRUE(near->carve(std::vector<BallSweep>{{Vec3(-0.5, 0.5, 0.97), Vec3(1.5, 0.5, 0.97), 0.1, 0}}).has_value());
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
        ASSERT_TRUE(engine->carve(stroke).has_value());
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

// Tunnels side by side at several heights: nearly every upright ray outgrows its page, again and again, on all threads.
TEST(CpuEngine, RaysThatOutgrowTheirPagesEndUpTheSameOnAnyNumberOfThreads) {
    const Solid start = cube(48);
    std::vector<BallSweep> stroke;
    for (const double z : {0.5, 0.25, 0.75, 0.125, 0.375, 0.625, 0.875}) {
        for (double y = 0.04; y < 1; y += 0.07) stroke.push_back({Vec3(0.04, y, z), Vec3(0.96, 1 - y, z), 0.03, 0});
    }
    WorkerPool one(1), two(2), five(5);
    const auto a = make_cpu_engine(start, one), b = make_cpu_engine(start, two), c = make_cpu_engine(start, five);
    const auto sa = a->carve(stroke), sb = b->carve(stroke), sc = c->carve(stroke);
    ASSERT_TRUE(sa && sb && sc);
    EXPECT_GT(sa->rays_changed, 1000u);
    EXPECT_EQ(sa->rays_changed, sb->rays_changed);
    EXPECT_EQ(sa->rays_changed, sc->rays_changed);
    EXPECT_EQ(sa->rays_touched, sc->rays_touched);
    EXPECT_TRUE(a->solid().same_content(b->solid()));
    EXPECT_TRUE(a->solid().same_content(c->solid()));
    const Changes changed = a->take_changes(), changed_by_five = c->take_changes();
    ASSERT_EQ(changed.rays.size(), changed_by_five.rays.size());
    for (std::size_t i = 0; i < changed.rays.size(); ++i) {
        ASSERT_EQ(changed.rays[i].ray, changed_by_five.rays[i].ray);
        ASSERT_EQ(changed.before_of(changed.rays[i]).size(), changed_by_five.before_of(changed_by_five.rays[i]).size());
    }
    EXPECT_TRUE(well_formed(a->solid()));
    EXPECT_GT(a->solid().bytes(), start.bytes());
    // One by one gives the same as all at once.
    const auto d = make_cpu_engine(start, two);
    for (const BallSweep& s : stroke) ASSERT_TRUE(d->carve(std::span(&s, 1)).has_value());
    EXPECT_TRUE(a->solid().same_content(d->solid()));
}

// Far more ends than a page usually holds.
TEST(CpuEngine, OneRayMayHaveThousandsOfWalls) {
    WorkerPool pool(1);
    Solid solid{{Vec3(0.0), 1.0, {16, 16, 16}}, {}, {{"walls", {}}}};
    for (int a = 0; a < 3; ++a)
        solid.sets[static_cast<std::size_t>(a)] = DexelSet(solid.lattice.rays_u(a), solid.lattice.rays_v(a));
    std::vector<shared::DexelEnd> walls;
    for (int i = 0; i < 8192; ++i) walls.push_back(shared::make_end(5000 + 6 * i, 0, 0));
    const std::size_t ray = 8 * 17 + 8;
    solid.sets[2].replace(ray, walls);
    const auto engine = make_cpu_engine(std::move(solid), pool);
    // A wall is 6 units thick; a ball of two units in its middle cuts it in two.
    const double unit = 1.0 / 4096;
    const Vec3 middle(8, 8, (5000 + 6 * 4000 + 3) * unit);
    ASSERT_TRUE(engine->carve(std::vector<BallSweep>{{middle, middle, 2 * unit, 0}}).has_value());
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
        ASSERT_TRUE(engine->carve(random_stroke(random, 10, 0.03)).has_value());
        ASSERT_TRUE(well_formed(engine->solid())) << batch;
        const auto now = length();
        for (std::size_t a = 0; a < 3; ++a) ASSERT_LE(now[a], before[a]);
        before = now;
    }
}

// Filling against the exact predicate: the capsule's own depths, and nothing else, become material; the lattice's
// outermost nodes stay empty, so that the surface closes.
TEST(CpuEngine, FillsExactlyWhatTheCapsuleCovers) {
    WorkerPool pool(2);
    Random random(2);
    for (int i = 0; i < repeated(40); ++i) {
        const Solid before = cube(random.small(16, 40));
        const auto stroke = random_stroke(random, 1, 0.3, {Operation::fill});
        const auto engine = make_cpu_engine(before, pool);
        ASSERT_TRUE(engine->carve(stroke).has_value());
        ASSERT_TRUE(well_formed(engine->solid()));
        const auto capsules = capsules_in_units(before, stroke);
        ASSERT_TRUE(capsules.has_value());
        for (int axis = 0; axis < 3; ++axis) {
            const auto a = static_cast<std::size_t>(axis);
            const int last = before.lattice.cells[a] * 4096, rays_u = before.lattice.rays_u(axis),
                      rays_v = before.lattice.rays_v(axis);
            for (int v = 0; v < rays_v; ++v) {
                for (int u = 0; u < rays_u; ++u) {
                    const auto was = before.sets[a].ends(u, v), is = engine->solid().sets[a].ends(u, v);
                    const bool border = u == 0 || v == 0 || u == rays_u - 1 || v == rays_v - 1;
                    const auto holds = [](std::span<const shared::DexelEnd> ends, int depth) {
                        bool material = false;
                        for (std::size_t e = 0; e < ends.size(); e += 2) {
                            material = material || (depth_of(ends[e]) <= depth && depth < depth_of(ends[e + 1]));
                        }
                        return material;
                    };
                    for (int depth = 0; depth <= last; depth += 397) {
                        const bool on_end =
                            std::ranges::any_of(is, [&](const shared::DexelEnd& e) { return depth_of(e) == depth; });
                        if (on_end) continue;
                        bool covered = !border && depth > 0 && depth < last && !capsules->empty();
                        if (covered) {
                            const auto k = shared::capsule_from_ray(capsules->front(), axis, u * 4096, v * 4096);
                            covered = shared::inside_capsule(k, depth - k.start_s);
                        }
                        ASSERT_EQ(holds(is, depth), holds(was, depth) || covered) << i << " axis " << axis;
                    }
                }
            }
        }
        Surface surface(before.lattice);
        surface.mesh_all(engine->solid(), pool);
        ASSERT_EQ(topology_of(surface.welded()), MeshTopology{}) << i;
    }
}

TEST(CpuEngine, PaintChangesMaterialsAndNothingElse) {
    WorkerPool pool(2);
    Random random(4);
    Solid start = cube(40);
    start.materials.push_back({"paint", {200, 0, 0}});
    const auto engine = make_cpu_engine(start, pool);
    ASSERT_TRUE(engine->carve(random_stroke(random, 20, 0.2)).has_value());
    const Solid before = engine->solid();
    (void)engine->take_changes();
    auto stroke = random_stroke(random, 5, 0.2, {Operation::paint});
    for (BallSweep& s : stroke) s.material = 1;
    const auto stats = engine->carve(stroke);
    ASSERT_TRUE(stats.has_value());
    EXPECT_GT(stats->rays_changed, 100u);
    const auto capsules = capsules_in_units(before, stroke);
    std::size_t painted = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const auto a = static_cast<std::size_t>(axis);
        for (int v = 0; v < before.lattice.rays_v(axis); ++v) {
            for (int u = 0; u < before.lattice.rays_u(axis); ++u) {
                const auto was = before.sets[a].ends(u, v), is = engine->solid().sets[a].ends(u, v);
                ASSERT_EQ(was.size(), is.size());
                for (std::size_t e = 0; e < is.size(); ++e) {
                    ASSERT_EQ(depth_of(was[e]), depth_of(is[e]));
                    ASSERT_EQ(was[e].normal, is[e].normal);
                    const bool within = std::ranges::any_of(*capsules, [&](const shared::Capsule& c) {
                        const auto k = shared::capsule_from_ray(c, axis, u * 4096, v * 4096);
                        return shared::inside_capsule(k, depth_of(is[e]) - k.start_s);
                    });
                    ASSERT_EQ(material_of(is[e]), within ? 1u : 0u);
                    painted += within ? 1 : 0;
                }
            }
        }
    }
    EXPECT_GT(painted, 100u);
    // Twice is once.
    EXPECT_EQ(engine->carve(stroke)->rays_changed, 0u);
}

TEST(CpuEngine, ChangesSayWhatEveryRayHeldBefore) {
    WorkerPool pool(2);
    Random random(5);
    Solid start = cube(48);
    const auto engine = make_cpu_engine(start, pool);
    for (int i = 0; i < repeated(30); ++i) {
        ASSERT_TRUE(engine
                        ->carve(random_stroke(random, random.small(1, 4), 0.2,
                                              {Operation::cut, Operation::fill, Operation::paint}))
                        .has_value());
    }
    Solid back = engine->solid();
    const Changes changes = engine->take_changes();
    EXPECT_TRUE(engine->take_changes().empty());
    for (std::size_t i = changes.rays.size(); i-- > 0;) {
        const RayPlace place = place_of(changes.rays[i].ray);
        back.sets[static_cast<std::size_t>(place.axis)].replace(place.u, place.v, changes.before_of(changes.rays[i]));
    }
    EXPECT_TRUE(back.same_content(start));
    EXPECT_FALSE(engine->solid().same_content(start));
}

// Tiles are meshed anew between these depths only: an end that came, went or changed its material lies within them.
TEST(CpuEngine, ChangesSayBetweenWhichDepthsARayDiffers) {
    WorkerPool pool(2);
    Random random(8);
    Solid start = cube(40);
    start.materials.push_back({"other", {200, 0, 0}});
    const auto engine = make_cpu_engine(start, pool);
    std::array<std::size_t, 3> seen{};
    for (int i = 0; i < repeated(60); ++i) {
        auto stroke = random_stroke(random, 1, 0.2, {static_cast<Operation>(i % 3)});
        stroke[0].material = static_cast<std::uint8_t>(random.small(0, 1));
        ASSERT_TRUE(engine->carve(stroke).has_value());
        const Changes changes = engine->take_changes();
        for (const shared::ChangedRay& ray : changes.rays) {
            const RayPlace place = place_of(ray.ray);
            const auto was = changes.before_of(ray),
                       is = engine->solid().sets[static_cast<std::size_t>(place.axis)].ends(place.u, place.v);
            const auto has = [](std::span<const shared::DexelEnd> ends, const shared::DexelEnd& end) {
                return std::ranges::any_of(ends, [&](const shared::DexelEnd& e) {
                    return e.depth_material == end.depth_material && e.normal == end.normal;
                });
            };
            for (const auto& [some, others] : {std::pair(was, is), std::pair(is, was)}) {
                for (const shared::DexelEnd& end : some) {
                    if (has(others, end)) continue;
                    ++seen[static_cast<std::size_t>(i % 3)];
                    ASSERT_GE(depth_of(end), ray.changed_lo) << "operation " << i % 3;
                    ASSERT_LE(depth_of(end), ray.changed_hi) << "operation " << i % 3;
                }
            }
        }
    }
    for (const std::size_t ends : seen) EXPECT_GT(ends, 10 * static_cast<std::size_t>(repeated(60)));
}

TEST(CpuEngine, AssignsRaysAndSkipsThoseThatAreSoAlready) {
    WorkerPool pool(2);
    Random random(6);
    const Solid start = cube(32);
    const auto carved = make_cpu_engine(start, pool), engine = make_cpu_engine(start, pool);
    ASSERT_TRUE(carved->carve(random_stroke(random, 10, 0.2)).has_value());
    RayBatch batch;
    for (int axis = 0; axis < 3; ++axis) {
        for (int v = 0; v < start.lattice.rays_v(axis); ++v) {
            for (int u = 0; u < start.lattice.rays_u(axis); ++u) {
                batch.add(RayPlace{axis, u, v}.code(), carved->solid().sets[static_cast<std::size_t>(axis)].ends(u, v));
            }
        }
    }
    const auto stats = engine->assign(batch);
    ASSERT_TRUE(stats.has_value());
    EXPECT_TRUE(engine->solid().same_content(carved->solid()));
    EXPECT_GT(stats->rays_changed, 100u);
    EXPECT_LT(stats->rays_changed, stats->rays_touched);
    EXPECT_EQ(engine->assign(batch)->rays_changed, 0u);
}

// A stroke level but for a micrometre: its end planes meet the upright rays far away (capsule.h).
TEST(CpuEngine, AlmostLevelStrokeLeavesTheRestOfTheBlockAlone) {
    WorkerPool pool(2);
    for (const double tilt : {1e-6, -1e-6, 3e-6, 1e-5}) {
        const auto engine = make_cpu_engine(cube(128), pool);
        ASSERT_TRUE(engine->carve(std::vector<BallSweep>{{Vec3(0.2, 0.5, 0.9), Vec3(0.8, 0.5, 0.9 + tilt), 0.05, 0}})
                        .has_value());
        Surface surface(engine->solid().lattice);
        surface.mesh_all(engine->solid(), pool);
        const double removed = std::numbers::pi * (0.05 * 0.05 * 0.6 + 4.0 / 3.0 * 0.05 * 0.05 * 0.05);
        EXPECT_NEAR(1.0 - surface.volume_m3(), removed, 0.01 * removed);
    }
}

}  // namespace burin::compute::test
