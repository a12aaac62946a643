// SPDX-License-Identifier: MIT
// How close the carved surface comes to the closed form, and how fast it comes closer. Each bound is about twice what was
// measured when it was written (bench/results/); the orders are the method's: second for smooth surfaces and volumes.
#include <gtest/gtest.h>

#include "tests/compute/carve_scenes.hpp"
#include "tests/compute/effort.hpp"
#include "tests/compute/mesh_topology.hpp"

namespace burin::test {
namespace {

CarveErrors errors_at(const CarveScene& scene, int resolution) {
    WorkerPool pool(2);
    Solid cube = *make_block(Vec3(1.0), resolution, {"cube", {200, 200, 200}});
    Surface surface(cube.lattice);
    const auto engine = make_cpu_engine(std::move(cube), pool);
    for (const BallSweep& sweep : scene.sweeps) EXPECT_TRUE(engine->cut(std::span(&sweep, 1)).has_value());
    surface.remesh(engine->solid(), engine->dirty_tiles().take(), pool);
    EXPECT_TRUE(well_formed(engine->solid()));
    if (resolution < 256) {
        EXPECT_EQ(topology_of(surface.welded()), MeshTopology{});
    }
    const CarveErrors errors = measure(surface, scene);
    testing::Test::RecordProperty("volume_error_" + scene.name + "_" + std::to_string(resolution),
                                  std::to_string(errors.volume * 1e6) + "e-6");
    testing::Test::RecordProperty("surface_rms_nm_" + scene.name + "_" + std::to_string(resolution),
                                  std::to_string(errors.surface_rms_m * 1e9));
    return errors;
}

// Bounds at N = 64; each doubling must bring volume and rms down.
struct Bounds {
    double volume, rms_h, max_h, normal_rad;
    int finest;
    double least_rms_ratio;
};

void expect_second_order(const CarveScene& scene, const Bounds& bounds) {
    CarveErrors coarser;
    for (int n = 64, doublings = 0; n <= (kSanitized ? 64 : bounds.finest); n *= 2, ++doublings) {
        const double h = 1.0 / n;
        const CarveErrors e = errors_at(scene, n);
        EXPECT_LT(std::abs(e.volume), bounds.volume / (1 << (2 * doublings))) << scene.name << n;
        EXPECT_LT(e.surface_rms_m, bounds.rms_h * h) << scene.name << n;
        EXPECT_LT(e.surface_max_m, bounds.max_h * h) << scene.name << n;
        EXPECT_LT(e.edge_max_m, 0.001 * h) << scene.name << n;
        EXPECT_LT(e.corner_max_m, 0.001 * h) << scene.name << n;
        EXPECT_LT(e.normal_max_rad, bounds.normal_rad * 64 / n) << scene.name << n;
        if (n > 64) {
            const double ratio = coarser.volume / e.volume;
            EXPECT_GE(ratio, 2.5) << scene.name << n;
            EXPECT_LE(ratio, 8.0) << scene.name << n;
            EXPECT_GE(coarser.surface_rms_m / e.surface_rms_m, bounds.least_rms_ratio) << scene.name << n;
        }
        coarser = e;
    }
}

}  // namespace

TEST(Accuracy, CubeCutByABall) { expect_second_order(ball_scene(), {2.6e-3, 0.02, 0.2, 0.05, 256, 2.8}); }

TEST(Accuracy, CubeCutByACapsule) { expect_second_order(capsule_scene(), {3.3e-3, 0.022, 0.12, 0.07, 256, 2.8}); }

TEST(Accuracy, CapsuleShapedCavity) { expect_second_order(cavity_scene(), {3.4e-3, 0.023, 0.1, 0.07, 256, 3.0}); }

// N = 256 takes half a minute and is left to bench_stroke. Rims and scallops, where the surface is not smooth, hold the surface error at less than second order.
TEST(Accuracy, Stroke1000) { expect_second_order(stroke_1000_scene(), {9e-3, 0.045, 0.8, 0.15, 128, 2.2}); }

}  // namespace burin::test
