// SPDX-License-Identifier: MIT
#include "compute/tools/smooth.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "compute/engine/engine.hpp"
#include "compute/mesher/surface.hpp"
#include "compute/rays/scan_convert.hpp"
#include "compute/rays/set_algebra.hpp"
#include "compute/tools/apply.hpp"
#include "shaders/shared/octahedral.h"
#include "tests/compute/mesh_topology.hpp"
#include "tests/compute/random_solids.hpp"
#include "tests/compute/test_meshes.hpp"
#include "tests/compute/tool_reference.hpp"

namespace burin::compute::test {
namespace {

WorkerPool& smoothing_pool() {
    static WorkerPool two(2);
    return two;
}

ToolSweep smoothing(const Vec3& from, const Vec3& to, double radius_m, double strength = 1.0) {
    ToolSweep sweep{BallTool{radius_m}, Pose{from}, Pose{to}, Operation::smooth};
    sweep.smooth_strength = strength;
    return sweep;
}

void apply_to(CarvingEngine& engine, const ToolSweep& sweep, int times = 1) {
    for (int i = 0; i < times; ++i) {
        const auto done = engine.carve({&sweep, 1});
        ASSERT_TRUE(done) << done.error().line();
    }
    ASSERT_TRUE(well_formed(engine.solid()));
}

Surface meshed_here(const Solid& solid) {
    Surface surface(solid.lattice);
    surface.mesh_all(solid, smoothing_pool());
    EXPECT_EQ(topology_of(surface.welded()), MeshTopology{});
    return surface;
}

// The upper face of a block, every upright end of it moved by up to 0.4 cells either way, and its normal turned.
Solid rough_block(int resolution, Random& random) {
    Solid solid = *make_block(Vec3(1), resolution, {"block", {}});
    DexelSet& set = solid.sets[2];
    for (int v = 0; v < set.rays_v(); ++v) {
        for (int u = 0; u < set.rays_u(); ++u) {
            std::vector<shared::DexelEnd> ends(set.ends(u, v).begin(), set.ends(u, v).end());
            if (ends.empty()) continue;
            const int depth = depth_of(ends.back()) + random.small(-1600, 1600);
            ends.back() = shared::make_end(
                depth, 0, shared::encode_normal({random.whole(-30, 30), random.whole(-30, 30), random.whole(60, 100)}));
            set.replace(u, v, ends);
        }
    }
    return solid;
}

double height_rms_cells(const Solid& solid, double within_m) {
    const Lattice& lattice = solid.lattice;
    double sum = 0.0;
    int count = 0;
    for (int v = 0; v < lattice.rays_v(2); ++v) {
        for (int u = 0; u < lattice.rays_u(2); ++u) {
            const auto ends = solid.sets[2].ends(u, v);
            if (ends.empty()) continue;
            const Vec3 p = lattice.object_from_units(Vec3(u * 4096.0, v * 4096.0, depth_of(ends.back())));
            if (glm::length(Vec2(p.x - 0.5, p.y - 0.5)) > within_m) continue;
            sum += (p.z - 1.0) * (p.z - 1.0);
            ++count;
        }
    }
    return std::sqrt(sum / count) / lattice.spacing_m;
}

}  // namespace

TEST(Smooth, FlatFacesStayToTheBit) {
    const Solid block = *make_block(Vec3(1), 48, {"block", {}});
    const auto engine = make_cpu_engine(block, smoothing_pool());
    apply_to(*engine, smoothing(Vec3(0.4, 0.5, 1.0), Vec3(0.6, 0.5, 1.0), 0.15), 5);
    EXPECT_TRUE(engine->solid().same_content(block));
    EXPECT_TRUE(engine->take_changes().empty());
}

// Normals are known to 6e-5 rad and depths to a unit, which is all that a slanting face moves by, however often.
TEST(Smooth, SlantingFacesDoNotDrift) {
    Random random(4);
    for (int i = 0; i < 4; ++i) {
        const Quat turn = any_orientation(random);
        const geometry::TriangleMesh box = transformed(box_mesh(Vec3(-0.5), Vec3(0.5)), turn);
        const auto engine = make_cpu_engine(scan_convert(box, 64, smoothing_pool())->solid, smoothing_pool());
        const Solid before = engine->solid();
        const Vec3 middle = turn * Vec3(0.5, 0, 0);
        apply_to(*engine, smoothing(middle, middle, 0.2), 6);
        for (std::size_t a = 0; a < 3; ++a) {
            for (std::size_t r = 0; r < before.sets[a].ray_count(); ++r) {
                const auto was = before.sets[a].ends(r), is = engine->solid().sets[a].ends(r);
                ASSERT_EQ(was.size(), is.size());
                for (std::size_t e = 0; e < was.size(); ++e) {
                    const shared::Direction d = shared::decode_normal(was[e].normal);
                    const double across = a == 0   ? d.x
                                          : a == 1 ? d.y
                                                   : d.z;  // a depth counts by its share along the normal
                    EXPECT_LE(std::abs((depth_of(was[e]) - depth_of(is[e])) * across), 8.0);
                }
            }
        }
    }
}

// A plate that lies on a rough face flattens all of it that is under the plate, and leaves what is beside it.
TEST(Smooth, APlateSmoothsWhatIsUnderIt) {
    Random random(11);
    const Solid rough = rough_block(64, random);
    const auto engine = make_cpu_engine(rough, smoothing_pool());
    ToolSweep sweep{BoxTool{{0.2, 0.1, 0.05}}, Pose{Vec3(0.5, 0.5, 1.0)}, Pose{Vec3(0.5, 0.5, 1.0)}, Operation::smooth};
    sweep.smooth_strength = 1.0;
    const double before = height_rms_cells(rough, 0.1);
    apply_to(*engine, sweep, 3);
    EXPECT_LT(height_rms_cells(engine->solid(), 0.1), 0.5 * before);
    const Lattice& lattice = rough.lattice;
    int beside = 0, under = 0;
    for (int v = 0; v < lattice.rays_v(2); ++v)
        for (int u = 0; u < lattice.rays_u(2); ++u) {
            const auto was = rough.sets[2].ends(u, v), is = engine->solid().sets[2].ends(u, v);
            if (was.empty()) continue;
            const Vec3 p = lattice.object_from_units(Vec3(u * 4096.0, v * 4096.0, depth_of(was.back())));
            const bool changed = is.empty() || depth_of(was.back()) != depth_of(is.back());
            if (std::abs(p.x - 0.5) > 0.27 || std::abs(p.y - 0.5) > 0.17) {
                ASSERT_FALSE(changed) << p.x << " " << p.y;
                ++beside;
            } else if (std::abs(p.x - 0.5) < 0.17 && std::abs(p.y - 0.5) < 0.07) {
                under += changed ? 1 : 0;
            }
        }
    EXPECT_GT(beside, 1000);
    EXPECT_GT(under, 150);
}

// A stamp's kernel has the variance s^2 = 0.18 * 0.25 R^2 in its middle at strength 1, and lowers a sphere of radius r
// by s^2 / 2r there (smooth_field.hpp): here by 1.8 mm, of 1 m.
TEST(Smooth, ABallSinksAsItsCurvatureSaysAndNoFaster) {
    const auto engine = make_cpu_engine(*make_ball(0.5, 80, {"ball", {}}), smoothing_pool());
    const Vec3 top = 0.5 * glm::normalize(Vec3(1, 2, 3));
    const auto depth_m = [&] {
        double deepest = 0.0;
        for (const Vec3& p : meshed_here(engine->solid()).welded().positions_m)
            deepest = std::max(deepest, 0.5 - glm::length(p));
        return deepest;
    };
    const double meshed_m = depth_m();
    apply_to(*engine, smoothing(top, top, 0.2), 1);
    EXPECT_NEAR(depth_m() - meshed_m, 0.0018, 0.0002);
    apply_to(*engine, smoothing(top, top, 0.2), 9);
    EXPECT_LT(depth_m(), 0.018);
}

TEST(Smooth, NoiseGetsSmallerAndKeepsItsMean) {
    Random random(1);
    const Solid rough = rough_block(48, random);
    const auto engine = make_cpu_engine(rough, smoothing_pool());
    const double before = height_rms_cells(rough, 0.1), volume_m3 = meshed_here(rough).volume_m3();
    apply_to(*engine, smoothing(Vec3(0.5, 0.5, 1.0), Vec3(0.5, 0.5, 1.0), 0.3), 4);
    EXPECT_GT(before, 0.15);
    EXPECT_LT(height_rms_cells(engine->solid(), 0.1), 0.4 * before);
    EXPECT_NEAR(meshed_here(engine->solid()).volume_m3(), volume_m3, 0.28 * 0.1 * rough.lattice.spacing_m);
    // Beyond the ball nothing changed.
    for (int axis = 0; axis < 3; ++axis) {
        const Lattice& lattice = rough.lattice;
        for (int v = 0; v < lattice.rays_v(axis); ++v) {
            for (int u = 0; u < lattice.rays_u(axis); ++u) {
                Vec3 p(0.5, 0.5, 1.0);
                const Vec3 ray = lattice.object_from_units(Vec3(0));
                p[(axis + 1) % 3] = ray[(axis + 1) % 3] + u * lattice.spacing_m;
                p[(axis + 2) % 3] = ray[(axis + 2) % 3] + v * lattice.spacing_m;
                if (glm::length(p - Vec3(0.5, 0.5, 1.0)) <= 0.3) continue;
                ASSERT_TRUE(same_ends(engine->solid().sets[static_cast<std::size_t>(axis)].ends(u, v),
                                      rough.sets[static_cast<std::size_t>(axis)].ends(u, v)));
            }
        }
    }
}

TEST(Smooth, ASharpRidgeGetsRounder) {
    const auto engine = make_cpu_engine(*make_block(Vec3(1), 48, {"block", {}}), smoothing_pool());
    const double cell = engine->solid().lattice.spacing_m, before_m3 = meshed_here(engine->solid()).volume_m3();
    const auto ridge = [&] {  // how far the edge at x = z = 1 has moved in, half-way along
        double nearest = 1e300;
        for (const Vec3& p : meshed_here(engine->solid()).welded().positions_m) {
            if (std::abs(p.y - 0.5) < 0.05) nearest = std::min(nearest, glm::length(Vec2(p.x - 1.0, p.z - 1.0)));
        }
        return nearest / cell;
    };
    EXPECT_LT(ridge(), 0.01);
    double last = 0.0;
    for (int round = 0; round < 3; ++round) {
        apply_to(*engine, smoothing(Vec3(1, 0.5, 1), Vec3(1, 0.5, 1), 0.25), 3);
        const double now = ridge();
        EXPECT_GT(now, last + 0.01);
        last = now;
    }
    EXPECT_GT(last, 0.15);
    EXPECT_LT(meshed_here(engine->solid()).volume_m3(), before_m3);
}

// Whatever the rays say, and whether or not they agree: well formed afterwards, and about nodes within the tool they
// agree.
TEST(Smooth, NoiseOfAnyKindStaysWellFormedAndComesToAgree) {
    Random random(2);
    for (const Rays rays : {Rays::agree, Rays::disturbed, Rays::unrelated}) {
        for (int i = 0; i < repeated(6); ++i) {
            const Solid noise = noise_solid({24, 20, 22}, random.between(0.2, 0.8), rays, random.bits());
            const auto engine = make_cpu_engine(noise, smoothing_pool());
            const Vec3 middle = noise.lattice.object_from_units(Vec3(12, 10, 11) * 4096.0);
            const double radius_m = 7 * noise.lattice.spacing_m;
            apply_to(*engine, smoothing(middle, middle, radius_m, random.between(0.1, 1.0)), 2);
            for (int z = 1; z < 22; ++z) {
                for (int y = 1; y < 20; ++y) {
                    for (int x = 1; x < 24; ++x) {
                        const Vec3 p = noise.lattice.object_from_units(Vec3(x, y, z) * 4096.0);
                        if (glm::length(p - middle) > 0.999 * radius_m) continue;
                        const auto inside = [&](std::size_t axis, int u, int v, int s) {
                            int below = 0;
                            for (const shared::DexelEnd& e : engine->solid().sets[axis].ends(u, v)) {
                                below += depth_of(e) <= s * 4096 ? 1 : 0;
                            }
                            return below % 2 != 0;
                        };
                        const bool by_z = inside(2, x, y, z);
                        ASSERT_EQ(inside(0, y, z, x), by_z);
                        ASSERT_EQ(inside(1, z, x, y), by_z);
                    }
                }
            }
        }
    }
}

TEST(Smooth, ThreadsDoNotMatterAndStrengthZeroDoesNothing) {
    Random random(3);
    const Solid rough = rough_block(40, random);
    WorkerPool one(1), five(5);
    const SmoothBall ball{Vec3(0.4, 0.4, 1.0), Vec3(0.5, 0.45, 0.97), 0.2, 0.7, 0};
    const RayBatch a = smoothed_rays(rough, ball, one), b = smoothed_rays(rough, ball, five);
    EXPECT_GT(a.rays.size(), 100u);
    EXPECT_TRUE(same_ends(a.ends, b.ends));
    EXPECT_TRUE(smoothed_rays(rough, {ball.start_object_m, ball.end_object_m, 0.2, 0.0, 0}, one).rays.empty());
    EXPECT_TRUE(smoothed_rays(rough, {Vec3(9), Vec3(9), 0.2, 1.0, 0}, one).rays.empty());
}

// A way of four radii is sixteen stretches of a quarter, one after the other; these numbers have no rounding.
TEST(Smooth, ALongWayIsTheStretchesThatItConsistsOf) {
    Random random(8);
    const Solid start = rough_block(48, random);
    const auto at_once = make_cpu_engine(start, smoothing_pool()),
               by_stretches = make_cpu_engine(start, smoothing_pool());
    apply_to(*at_once, smoothing(Vec3(0.25, 0.5, 1.0), Vec3(0.75, 0.5, 1.0), 0.125));
    for (double x = 0.25; x < 0.75; x += 0.03125) {
        const SmoothBall stretch{Vec3(x, 0.5, 1.0), Vec3(x + 0.03125, 0.5, 1.0), 0.125, 1.0, 0};
        const auto done = by_stretches->assign(smoothed_rays(by_stretches->solid(), stretch, smoothing_pool()));
        ASSERT_TRUE(done);
        EXPECT_GT(done->rays_changed, 0u) << x;
    }
    EXPECT_TRUE(at_once->solid().same_content(by_stretches->solid()));
}

TEST(Smooth, ReachesTheBorderOfTheLatticeUnharmed) {
    const auto engine = make_cpu_engine(*make_ball(0.5, 24, {"ball", {}}), smoothing_pool());
    const ToolSweep fill{BallTool{0.4}, Pose{Vec3(0.5)}, Pose{Vec3(0.5)}, Operation::fill};
    apply_to(*engine, fill);
    apply_to(*engine, smoothing(Vec3(0.5), Vec3(0.6), 0.4), 3);
    apply_to(*engine, smoothing(Vec3(-0.6), Vec3(0.6), 0.3), 1);
}

}  // namespace burin::compute::test
