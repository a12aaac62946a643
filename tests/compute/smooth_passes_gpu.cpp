// SPDX-License-Identifier: MIT
// Smoothing on a device: every end is the processor's, to the bit.
#include "compute/vulkan/smooth_passes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "tests/compute/tool_reference.hpp"
#include "tests/compute/vulkan_engine_fixture.hpp"

namespace burin::compute::test {
namespace {

// Counts the ends that two solids hold and that differ.
struct SolidsCompared {
    std::uint64_t ends = 0, differ = 0;
};
SolidsCompared compared(const Solid& a, const Solid& b) {
    SolidsCompared sum;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        for (std::size_t ray = 0; ray < a.sets[axis].ray_count(); ++ray) {
            const auto ends = a.sets[axis].ends(ray), others = b.sets[axis].ends(ray);
            sum.ends += std::max(ends.size(), others.size());
            for (std::size_t i = 0; i < std::max(ends.size(), others.size()); ++i) {
                const bool is_same = i < ends.size() && i < others.size() &&
                                     ends[i].depth_material == others[i].depth_material &&
                                     ends[i].normal == others[i].normal;
                sum.differ += is_same ? 0 : 1;
            }
        }
    }
    return sum;
}

ToolSweep any_smoothing(Random& random, double cell_m) {
    const double size = cell_m * std::pow(2.0, random.between(-1.0, 3.3));
    const auto part = [&] { return size * random.between(0.3, 1.5); };
    const ToolShape shapes[] = {BallTool{size}, BallTool{size}, CylinderTool{size, 2.0 * part()},
                                ConeTool{random.chance(0.3) ? 0.0 : part(), size, 2.0 * part()},
                                BoxTool{Vec3(part(), part(), part())}};
    ToolSweep sweep;
    sweep.shape = shapes[random.small(0, 4)];
    sweep.operation = Operation::smooth;
    sweep.start.position_m = random_point(random, -0.05, 1.05);
    if (random.chance(0.6)) sweep.start.position_m.z = random.between(0.9, 1.05);
    sweep.start.orientation = any_orientation(random);
    sweep.end = sweep.start;
    if (random.chance(0.8)) sweep.end.position_m += size * random.between(0.01, 0.6) * random_point(random, -1.0, 1.0);
    if (random.chance(0.2))
        sweep.end.orientation =
            glm::normalize(sweep.start.orientation + Quat(0.0, random.between(-0.1, 0.1), 0.0, 0.0));
    const double strengths[] = {0.0, 1.0, 0.5, random.unit(), random.unit()};
    sweep.smooth_strength = strengths[random.small(0, 4)];
    sweep.material = static_cast<std::uint8_t>(random.small(0, 2));
    return sweep;
}

// Cuts, fills and paint, among them thin walls: what is to be smoothed.
ToolSweep any_roughening(Random& random, double cell_m) {
    ToolSweep sweep;
    sweep.shape = BallTool{cell_m * random.between(1.0, 9.0)};
    if (random.chance(0.3)) sweep.shape = BoxTool{cell_m * Vec3(random.between(0.2, 1.5), 6.0, 8.0)};
    sweep.start.position_m = random_point(random, 0.0, 1.0);
    if (random.chance(0.7)) sweep.start.position_m.z = random.between(0.9, 1.05);
    sweep.end.position_m = sweep.start.position_m + 4.0 * cell_m * random_point(random, -1.0, 1.0);
    sweep.operation = static_cast<Operation>(random.small(0, 2));
    sweep.material = static_cast<std::uint8_t>(random.small(0, 2));
    return sweep;
}

class SmoothPassesGpu : public VulkanEngineGpu {
protected:
    // Carries out some random sweeps with both engines. Returns what was compared after each of them.
    SolidsCompared work(std::uint64_t seed, const VulkanEngineOptions& options, VulkanEngineCounts& counts) {
        Random random(seed);
        const int cells[] = {16, 20, 32, 48};
        Solid solid = unit_cube(cells[random.small(0, 3)]);
        solid.materials.push_back(geometry::Material{});
        const double cell_m = solid.lattice.spacing_m;
        const auto cpu = make_cpu_engine(Solid(solid), pool_);
        auto made = VulkanEngine::create(Solid(solid), device(), pool_, options);
        EXPECT_TRUE(made) << made.error().line();
        SolidsCompared sum;
        if (!made) return sum;
        VulkanEngine& vulkan = **made;
        for (int round = 0; round < 6; ++round) {
            std::vector<ToolSweep> sweeps;
            for (int i = random.small(0, 2); i > 0; --i) sweeps.push_back(any_roughening(random, cell_m));
            sweeps.push_back(any_smoothing(random, cell_m));
            if (random.chance(0.3)) sweeps.push_back(any_roughening(random, cell_m));
            const auto expected = cpu->carve(sweeps), actual = vulkan.carve(sweeps);
            EXPECT_TRUE(expected && actual) << (expected ? actual.error() : expected.error()).line();
            if (!expected || !actual) return sum;
            EXPECT_EQ(actual->rays_changed, expected->rays_changed);
            EXPECT_EQ(actual->rays_touched, expected->rays_touched);
            const SolidsCompared now = compared(vulkan.solid(), cpu->solid());
            EXPECT_EQ(now.differ, 0u) << "seed " << seed << " round " << round << ": "
                                      << first_difference(vulkan.solid(), cpu->solid());
            sum.ends += now.ends;
            sum.differ += now.differ;
            if (now.differ > 0) return sum;
        }
        counts.balls_smoothed += vulkan.counts().balls_smoothed;
        counts.submissions += vulkan.counts().submissions;
        return sum;
    }
};

}  // namespace

// BURIN_SOAK_SMOOTHING=1000 in the environment for the long form.
TEST_F(SmoothPassesGpu, EveryEndIsThatOfTheProcessor) {
    const char* soak = std::getenv("BURIN_SOAK_SMOOTHING");
    const int rounds = soak != nullptr ? std::atoi(soak) : repeated(16);
    SolidsCompared sum;
    VulkanEngineCounts counts;
    for (int i = 0; i < rounds && !HasFailure(); ++i) {
        const SolidsCompared one = work(7000 + static_cast<std::uint64_t>(i), {}, counts);
        sum.ends += one.ends;
        sum.differ += one.differ;
    }
    if (soak != nullptr) {
        std::cout << counts.balls_smoothed << " balls in " << counts.submissions << " submissions; " << sum.differ
                  << " of " << sum.ends << " ends differ\n";
    }
    EXPECT_GT(counts.balls_smoothed, 2u * static_cast<unsigned>(rounds));
}

TEST_F(SmoothPassesGpu, ListsThatAreTooShortGrow) {
    VulkanEngineCounts counts;
    for (int i = 0; i < repeated(6) && !HasFailure(); ++i) {
        work(8000 + static_cast<std::uint64_t>(i),
             {.spare_ends = 0, .export_per_ray = 0, .tasks_a_pass = 2, .spans_a_ray = 0, .smooth_percent = 0}, counts);
    }
    EXPECT_GT(counts.balls_smoothed, 0u);
}

// A wide kernel: points merge to boxes of eight cells.
TEST_F(SmoothPassesGpu, AWideBallMergesPointsOverSeveralLevels) {
    EnginePair engines(unit_cube(96), device());
    ToolSweep cut{.shape = BallTool{0.2}, .start = {Vec3(0.4, 0.5, 1.0)}, .end = {Vec3(0.4, 0.5, 1.0)}};
    ToolSweep smooth = cut;
    smooth.shape = BallTool{0.4};
    smooth.operation = Operation::smooth;
    smooth.smooth_strength = 1.0;
    const auto steps = smooth_steps(engines.cpu().solid().lattice, smooth);
    ASSERT_TRUE(steps && steps->size() == 1);
    EXPECT_EQ(steps->front().task.levels, 4);
    EXPECT_TRUE(engines.carve(std::vector{cut, smooth}));
    EXPECT_EQ(engines.vulkan().counts().balls_smoothed, 1u);
    EXPECT_EQ(engines.vulkan().counts().submissions, 1u);
}

// A cover of many balls, and a long path in stretches: they follow each other without the host, as many as a submission
// holds.
TEST_F(SmoothPassesGpu, BallsFollowEachOtherInOneSubmission) {
    EnginePair engines(unit_cube(32), device());
    ToolSweep sweep{.shape = CylinderTool{0.08, 0.5}, .start = {Vec3(0.3, 0.2, 0.97)}, .end = {Vec3(0.35, 0.2, 0.97)}};
    sweep.operation = Operation::smooth;
    const auto steps = smooth_steps(engines.cpu().solid().lattice, sweep);
    ASSERT_TRUE(steps);
    ASSERT_GT(steps->size(), 8u);
    ASSERT_LE(steps->size(), static_cast<std::size_t>(shared::kMostPasses));
    ToolSweep cut = sweep;
    cut.operation = Operation::cut;
    EXPECT_TRUE(engines.carve(std::vector{sweep, cut}));
    EXPECT_EQ(engines.vulkan().counts().balls_smoothed, steps->size());
    EXPECT_LE(engines.vulkan().counts().submissions, 2u);
}

// The first balls of a sweep are the device's, the rest the host's: a ray near the path has more ends than the device
// looks at.
TEST_F(SmoothPassesGpu, WhatIsBeyondTheDeviceIsGoneOnWithByTheHost) {
    EnginePair engines(unit_cube(32), device());
    RayBatch plates;
    std::vector<shared::DexelEnd> ends;
    for (int i = 0; i < 600; ++i) ends.push_back(shared::make_end(5000 + 200 * i, 1, 0x7fff7fffu));
    for (int u = 25; u < 27; ++u) plates.add(shared::ray_code(2, u, 16), ends);
    ASSERT_TRUE(engines.assign(plates));
    ToolSweep sweep{.shape = BallTool{0.12}, .start = {Vec3(0.1, 0.5, 1.0)}, .end = {Vec3(0.8, 0.5, 1.0)}};
    sweep.operation = Operation::smooth;
    ToolSweep cut = sweep;
    cut.operation = Operation::cut;
    EXPECT_TRUE(engines.carve(std::vector{cut, sweep, cut}));
    const std::uint64_t by_device = engines.vulkan().counts().balls_smoothed;
    EXPECT_GT(by_device, 2u);
    EXPECT_LT(by_device, SmoothBalls(sweep).size());
    EXPECT_TRUE(engines.carve(std::vector{sweep}));
}

// Rays of the three axes that do not fit together, with plates close to each other: all loops take many turns.
TEST_F(SmoothPassesGpu, CrowdedRaysAreSmoothedAlike) {
    for (int i = 0; i < repeated(3) && !HasFailure(); ++i) {
        Random random(static_cast<std::uint64_t>(90 + i));
        EnginePair engines(plates(16, 4 << (2 * i), static_cast<std::uint64_t>(i)), device());
        for (int round = 0; round < 3 && !HasFailure(); ++round) {
            ToolSweep sweep{.shape = BallTool{random.between(0.1, 0.4)}, .start = {Vec3(0.5)}, .end = {Vec3(0.55)}};
            sweep.operation = Operation::smooth;
            EXPECT_TRUE(engines.carve(std::vector{sweep}));
        }
    }
}

TEST_F(SmoothPassesGpu, UndoAndCutsInBetweenSeeWhatWasSmoothed) {
    EnginePair engines(unit_cube(40), device());
    ToolSweep cut{.shape = BallTool{0.15}, .start = {Vec3(0.5, 0.5, 1.0)}, .end = {Vec3(0.6, 0.5, 1.0)}};
    ToolSweep smooth = cut;
    smooth.operation = Operation::smooth;
    smooth.start.position_m.x = 0.65;
    for (int round = 0; round < 3; ++round) {
        ASSERT_TRUE(engines.carve(std::vector{cut, smooth}));
        const Solid before = engines.cpu().solid();
        (void)engines.vulkan().take_changes();
        ASSERT_TRUE(engines.carve(std::vector{smooth, cut, smooth}));
        ASSERT_TRUE(engines.assign(as_before(engines.vulkan().take_changes())));
        EXPECT_TRUE(engines.vulkan().solid().same_content(before)) << "undone";
        ASSERT_TRUE(engines.carve(std::vector{smooth, smooth}));
    }
}

}  // namespace burin::compute::test
