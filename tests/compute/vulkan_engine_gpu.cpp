// SPDX-License-Identifier: MIT
// The Vulkan engine against the CPU engine: the same ends on every ray, to the last bit, and the same counts.
#include "compute/vulkan/vulkan_engine.hpp"

#include <algorithm>
#include <limits>

#include "compute/mesher/surface.hpp"
#include "tests/compute/vulkan_engine_fixture.hpp"

namespace burin::compute::test {

TEST_F(VulkanEngineGpu, ABallAndACapsuleTakeTheSameEnds) {
    EnginePair engines(unit_cube(64), device());
    EXPECT_TRUE(engines.cut({Vec3(0.5, 0.5, 0.9), Vec3(0.5, 0.5, 0.9), 0.2, 1}));
    EXPECT_TRUE(engines.cut({Vec3(0.1, 0.2, 0.8), Vec3(0.9, 0.7, 1.1), 0.13, 0}));
    EXPECT_GT(engines.changed(), 1000u);
    EXPECT_TRUE(well_formed(engines.vulkan().solid()));
}

TEST_F(VulkanEngineGpu, EqualsTheCpuEngineOnRandomBatches) {
    for (int round = 0; round < repeated(32); ++round) {
        Random random(static_cast<std::uint64_t>(round));
        const Solid solid = unit_cube(random.small(16, 48));
        EnginePair engines(solid, device());
        for (int batch = 0; batch < 6; ++batch) {
            std::vector<BallSweep> sweeps(static_cast<std::size_t>(random.small(1, random.chance(0.2) ? 150 : 8)));
            for (BallSweep& sweep : sweeps) sweep = random_sweep(random, solid.lattice.spacing_m);
            ASSERT_TRUE(engines.cut(sweeps)) << "round " << round << " batch " << batch;
        }
    }
}

TEST_F(VulkanEngineGpu, EqualsTheCpuEngineOnStroke1000OneBallAtATime) {
    EnginePair engines(unit_cube(128), device());
    for (const BallSweep& sweep : stroke_1000(kSanitized ? 16 : 1)) ASSERT_TRUE(engines.cut(sweep));
    EXPECT_GT(engines.changed(), kSanitized ? 10'000u : 200'000u);
}

TEST_F(VulkanEngineGpu, EqualsTheCpuEngineOnStroke1000InBatches) {
    const std::vector<BallSweep> stroke = stroke_1000(kSanitized ? 4 : 1);
    for (const std::size_t size : {std::size_t{7}, std::size_t{100}, stroke.size()}) {
        EnginePair engines(unit_cube(kSanitized ? 64 : 128), device());
        for (std::size_t i = 0; i < stroke.size(); i += size) {
            ASSERT_TRUE(engines.cut(std::span(stroke).subspan(i, std::min(size, stroke.size() - i))));
        }
    }
}

// Whole units: rays exactly at the radius from a ball's centre or a capsule's axis, a unit inside, and a unit outside.
TEST_F(VulkanEngineGpu, RaysThatOnlyGrazeTheToolAreDecidedAlike) {
    const Solid solid = unit_cube(32);
    EnginePair engines(solid, device());
    const auto at = [&](double x, double y, double z) {
        return solid.lattice.object_from_units(Vec3(x, y, z) * double(shared::kUnitsPerCell));
    };
    for (const double off : {0.0, 1.0, -1.0, 0.5}) {
        const double radius_m = solid.lattice.unit_m() * (3.0 * shared::kUnitsPerCell + off);
        const BallSweep ball{at(9, 9, 9), at(9, 9, 9), radius_m, 1};
        const BallSweep along_x{at(5, 22, 9), at(20, 22, 9), radius_m, 1};
        const BallSweep along_z{at(22, 9, 25), at(22, 9, 8), radius_m, 1};
        const BallSweep diagonal{at(10, 10, 20), at(20, 20, 28), radius_m, 1};
        const BallSweep flat{at(26, 6, 20), at(27, 20, 20), radius_m, 1};
        ASSERT_TRUE(engines.cut(std::vector<BallSweep>{ball, along_x, along_z, diagonal, flat}));
    }
}

TEST_F(VulkanEngineGpu, AToolSmallerThanACellTakesTheSameEnds) {
    const Solid solid = unit_cube(32);
    EnginePair engines(solid, device());
    const double h = solid.lattice.spacing_m;
    Random random(4);
    for (int i = 0; i < repeated(64); ++i) {
        const Vec3 p = random_point(random, 0.0, 1.0);
        ASSERT_TRUE(engines.cut({p, p + random_point(random, -h, h), random.between(0.001 * h, 0.6 * h), 1}));
    }
    const Vec3 on_a_ray = solid.lattice.object_from_units(Vec3(10 * shared::kUnitsPerCell));
    EXPECT_TRUE(engines.cut({on_a_ray, on_a_ray, 0.01 * h, 1}));
    EXPECT_GT(engines.changed(), 0u);
}

TEST_F(VulkanEngineGpu, AToolLargerThanTheSolidLeavesNothing) {
    EnginePair engines(unit_cube(32), device());
    EXPECT_TRUE(engines.cut({Vec3(-1.0, 0.5, 0.5), Vec3(2.0, 0.5, 0.5), 1.1, 1}));
    for (const DexelSet& set : engines.vulkan().solid().sets) {
        for (std::size_t ray = 0; ray < set.ray_count(); ++ray) ASSERT_TRUE(set.ends(ray).empty());
    }
    EXPECT_TRUE(engines.cut({Vec3(0.5), Vec3(0.5), 0.1, 1})) << "cutting nothing";
}

TEST_F(VulkanEngineGpu, SegmentsThatLeaveTheLatticeTakeTheSameEnds) {
    EnginePair engines(unit_cube(32), device());
    EXPECT_TRUE(engines.cut({Vec3(0.5, 0.4, 0.9), Vec3(80.0, 30.0, 200.0), 0.1, 1}));
    EXPECT_TRUE(engines.cut({Vec3(-500.0, 0.31, 0.3), Vec3(700.0, 0.32, 0.35), 0.07, 1}));
    EXPECT_TRUE(engines.cut({Vec3(9.0), Vec3(10.0), 0.5, 1})) << "nowhere near";
    EXPECT_GT(engines.changed(), 0u);
}

// The store starts without any spare room, the exported ends and the passes are as small as can be.
TEST_F(VulkanEngineGpu, RunningOutOfRoomLosesNoMaterial) {
    for (const int most_plates : {1, 4, 32}) {
        EnginePair engines(plates(20, most_plates, 1), device(),
                           {.spare_ends = 0, .export_per_ray = 0, .tasks_a_pass = 2});
        Random random(2);
        for (int batch = 0; batch < repeated(32); ++batch) {
            std::vector<BallSweep> sweeps;
            for (int i = 0; i < 20; ++i) {
                const Vec3 p = random_point(random, 0.0, 1.0);
                sweeps.push_back(
                    {p, p + random_point(random, -0.3, 0.3), random.between(0.0005, 0.1 / (2.0 + most_plates)), 1});
            }
            ASSERT_TRUE(engines.cut(sweeps)) << "batch " << batch << " of " << most_plates << " plates";
        }
        EXPECT_GT(engines.vulkan().counts().store_rebuilds, 0u) << most_plates << " plates";
        EXPECT_TRUE(well_formed(engines.vulkan().solid()));
    }
}

// A software driver ends an invocation's loops after 65535 turns without a word; thousands of capsules on one ray need
// more.
TEST_F(VulkanEngineGpu, ThousandsOfCapsulesOnOneRayAreAllTaken) {
    const Solid solid = unit_cube(16);
    const double h = solid.lattice.spacing_m;
    const Vec3 ray = solid.lattice.object_from_units(Vec3(8 * shared::kUnitsPerCell));
    EnginePair engines(solid, device());
    std::vector<BallSweep> sweeps;
    for (int i = 0; i < 3000; ++i) {
        const Vec3 p(ray.x, ray.y, (i * 7 % 3000) / 3000.0);
        sweeps.push_back({p, p, h / 1000.0, static_cast<std::uint8_t>(i % 2)});
    }
    EXPECT_TRUE(engines.cut(sweeps));
    const auto middle = static_cast<std::size_t>(8 + 8 * solid.lattice.rays_u(2));
    EXPECT_EQ(engines.vulkan().solid().sets[2].ends(middle).size(), 2u + 2u * 3000u - 2u)
        << "3000 holes, the first of them open to the outside";
}

TEST_F(VulkanEngineGpu, ABatchLongerThanOnePassLooksAtIsTakenWhole) {
    EnginePair engines(unit_cube(16), device());
    std::vector<BallSweep> sweeps;
    Random random(3);
    for (int i = 0; i < 6000; ++i) {
        const Vec3 p = random_point(random, 0.0, 1.0);
        sweeps.push_back({p, p, 0.0005, 1});
    }
    EXPECT_TRUE(engines.cut(sweeps));
}

TEST_F(VulkanEngineGpu, AnUpdateIsOneSubmission) {
    EnginePair engines(unit_cube(64), device());
    for (const BallSweep& sweep : stroke_1000(kSanitized ? 32 : 4)) ASSERT_TRUE(engines.cut(sweep));
    const VulkanEngineCounts counts = engines.vulkan().counts();
    EXPECT_GT(counts.cuts, 20u);
    EXPECT_EQ(counts.submissions, counts.cuts);
    EXPECT_EQ(counts.store_rebuilds, 0u);
}

TEST_F(VulkanEngineGpu, TheMeshesOfBothEnginesAreTheSame) {
    const Solid solid = unit_cube(64);
    EnginePair engines(solid, device());
    Surface cpu_surface(solid.lattice), vulkan_surface(solid.lattice);
    cpu_surface.mesh_all(solid, engines.pool());
    vulkan_surface.mesh_all(solid, engines.pool());
    const std::vector<BallSweep> stroke = stroke_1000(4);
    for (std::size_t i = 0; i < stroke.size(); i += 25) {
        ASSERT_TRUE(engines.cut(std::span(stroke).subspan(i, std::min<std::size_t>(25, stroke.size() - i))));
        cpu_surface.update(engines.cpu().solid(), engines.cpu().take_changes(), engines.pool());
        vulkan_surface.update(engines.vulkan().solid(), engines.vulkan().take_changes(), engines.pool());
    }
    const geometry::TriangleMesh expected = cpu_surface.welded(), actual = vulkan_surface.welded();
    EXPECT_GT(expected.triangles.size(), 10'000u);
    EXPECT_EQ(actual.positions_m, expected.positions_m);
    EXPECT_EQ(actual.triangles, expected.triangles);
    EXPECT_EQ(actual.colours, expected.colours);
}

// As on a graphics card of its own: nothing is mapped, all goes through copies, each of which needs its barriers.
TEST_F(VulkanEngineGpu, WithoutUnifiedMemoryTheEndsAreTheSame) {
    capabilities().unified_memory = false;
    EnginePair engines(plates(20, 3, 5), device(), {.spare_ends = 0, .export_per_ray = 1});
    Random random(6);
    for (int batch = 0; batch < 32; ++batch) {
        std::vector<BallSweep> sweeps(4);
        for (BallSweep& sweep : sweeps) sweep = random_sweep(random, 0.05), sweep.radius_m *= 0.3;
        ASSERT_TRUE(engines.cut(sweeps));
        if (batch % 8 == 0) {
            ASSERT_TRUE(engines.assign(random_rays(engines.cpu().solid().lattice, 10, random)));
        }
    }
    EXPECT_GT(engines.vulkan().counts().store_rebuilds, 0u);
}

TEST_F(VulkanEngineGpu, BadSweepsAreRefusedAndChangeNothing) {
    const Solid solid = unit_cube(16);
    EnginePair engines(solid, device());
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const std::vector<BallSweep> good_then_bad = {{Vec3(0.5), Vec3(0.5), 0.3, 0}, {Vec3(nan), Vec3(0.5), 0.3, 0}};
    EXPECT_FALSE(engines.vulkan().carve(good_then_bad));
    EXPECT_FALSE(engines.vulkan().carve(std::vector<BallSweep>{{Vec3(0.5), Vec3(0.5), 0.0, 0}}));
    EXPECT_TRUE(engines.vulkan().solid().same_content(solid));
    EXPECT_TRUE(engines.cut(std::span<const BallSweep>{})) << "an empty batch";
}

TEST_F(VulkanEngineGpu, ADeviceWithout64BitArithmeticOrAddressesIsRefused) {
    for (bool gpu::Capabilities::* lacking :
         {&gpu::Capabilities::shader_int64, &gpu::Capabilities::shader_float64, &gpu::Capabilities::buffer_address}) {
        capabilities().*lacking = false;
        const auto engine = VulkanEngine::create(unit_cube(16), device(), pool_);
        ASSERT_FALSE(engine);
        EXPECT_NE(engine.error().line().find("--engine cpu"), std::string::npos) << engine.error().line();
        capabilities().*lacking = true;
    }
}

// With memory of its own a device also needs room to send through.
TEST_F(VulkanEngineGpu, ASolidTooLargeForTheDevicesBuffersIsRefusedWithAResolutionThatFits) {
    const Solid solid = unit_cube(128);
    device().core()->max_allocation_bytes = 512 << 10;
    for (const bool unified : {true, false}) {
        if (!unified) capabilities().unified_memory = false;
        const auto engine = VulkanEngine::create(Solid(solid), device(), pool_, {.spare_ends = 0});
        ASSERT_FALSE(engine);
        const std::string line = engine.error().line();
        const std::size_t number = line.find("about ");
        ASSERT_NE(number, std::string::npos) << line;
        const int fits = std::stoi(line.substr(number + 6));
        EXPECT_GE(fits, kMinResolution);
        const auto smaller = VulkanEngine::create(unit_cube(fits), device(), pool_, {.spare_ends = 0});
        EXPECT_TRUE(smaller) << fits << ": " << smaller.error().line();
    }
}

TEST_F(VulkanEngineGpu, AfterADeviceErrorTheSolidIsAsBeforeAndTheNextCutWorks) {
    const Solid before = plates(20, 4, 7);
    EnginePair engines(before, device(), {.spare_ends = 0});
    const std::uint64_t limit = device().core()->max_allocation_bytes;
    std::vector<BallSweep> holes;  // each splits a few plates
    Random random(8);
    for (int i = 0; i < 200; ++i) {
        const Vec3 p = random_point(random, 0.0, 1.0);
        holes.push_back({p, p + random_point(random, -0.3, 0.3), 0.01, 1});
    }
    (void)engines.vulkan().take_changes();

    device().core()->max_allocation_bytes = 1024;  // the store cannot grow
    const auto refused = engines.vulkan().carve(holes);
    device().core()->max_allocation_bytes = limit;

    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().line().find("--engine cpu"), std::string::npos) << refused.error().line();
    EXPECT_TRUE(engines.vulkan().solid().same_content(before));
    EXPECT_TRUE(engines.vulkan().take_changes().empty());
    EXPECT_TRUE(engines.cut(holes)) << "the device's half-cut solid must not shine through";
}

TEST_F(VulkanEngineGpu, ARayWithMoreEndsThanAPassCanHandleIsRefused) {
    Solid solid = unit_cube(16);
    std::vector<std::uint32_t> counts(solid.sets[2].ray_count(), 0);
    std::vector<shared::DexelEnd> ends;
    for (int i = 0; i < 10'000; ++i) ends.push_back(shared::make_end(1000 + 3 * i, 0, 0));
    counts[100] = static_cast<std::uint32_t>(ends.size());
    solid.sets[2].assign(counts, ends);
    const auto engine = VulkanEngine::create(Solid(solid), device(), pool_);
    ASSERT_TRUE(engine);
    const auto refused = (*engine)->carve(std::vector<BallSweep>{{Vec3(0.5), Vec3(0.5), 0.5, 0}});
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().line().find("--engine cpu"), std::string::npos);
    EXPECT_TRUE((*engine)->solid().same_content(solid));
}

// Undo and tools whose spans the host works out arrive as lists of ends; carves on the device go on from there.
TEST_F(VulkanEngineGpu, AssignedRaysAndCutsMixAndTheEnginesStayEqual) {
    for (int round = 0; round < repeated(12); ++round) {
        Random random(static_cast<std::uint64_t>(100 + round));
        const Solid solid = plates(random.small(16, 32), random.small(1, 5), static_cast<std::uint64_t>(round));
        EnginePair engines(solid, device(), {.spare_ends = 0});
        std::vector<Changes> strokes;
        for (int step = 0; step < 8; ++step) {
            (void)engines.vulkan().take_changes();
            std::vector<BallSweep> sweeps(static_cast<std::size_t>(random.small(1, 6)));
            for (BallSweep& sweep : sweeps) sweep = random_sweep(random, solid.lattice.spacing_m);
            ASSERT_TRUE(engines.cut(sweeps)) << "round " << round << " step " << step;
            strokes.push_back(engines.vulkan().take_changes());
            if (random.chance(0.5)) {
                const int count = random.small(0, 40);  // far more ends than the ray had room for
                ASSERT_TRUE(engines.assign(random_rays(solid.lattice, count, random)));
                strokes.push_back(engines.vulkan().take_changes());
            }
            if (random.chance(0.3)) {
                ASSERT_TRUE(engines.assign(as_before(strokes.back())));
                strokes.pop_back();
            }
        }
        EXPECT_GT(engines.vulkan().counts().store_rebuilds, 0u);
        while (!strokes.empty()) {
            ASSERT_TRUE(engines.assign(as_before(strokes.back())));
            strokes.pop_back();
        }
        EXPECT_TRUE(engines.cut({Vec3(0.4), Vec3(0.6), 0.1, 1})) << "the device must hold what was assigned";
    }
}

// What undo, smoothing and most tools do: the device learns of it when it is used again.
TEST_F(VulkanEngineGpu, AnyNumberOfAssignmentsGoesWithTheNextCut) {
    capabilities().unified_memory = false;
    EnginePair engines(unit_cube(32), device());
    const std::uint64_t before = engines.vulkan().counts().submissions;
    const std::uint64_t sent_before = engines.vulkan().traffic()->bytes_to_device;
    Random random(5);
    for (int batch = 0; batch < 20; ++batch)
        ASSERT_TRUE(engines.assign(random_rays(engines.cpu().solid().lattice, 10, random)));
    EXPECT_EQ(engines.vulkan().counts().submissions, before);
    ASSERT_TRUE(engines.cut({Vec3(0.4), Vec3(0.6), 0.3, 1}));
    EXPECT_EQ(engines.vulkan().counts().submissions, before + 1);
    EXPECT_EQ(engines.vulkan().counts().store_rebuilds, 0u);
    // Far less than the solid: 3 x 33 x 33 rays with two ends each.
    EXPECT_LT(engines.vulkan().traffic()->bytes_to_device - sent_before, engines.cpu().solid().bytes() / 2);
    const std::uint64_t after = engines.vulkan().counts().submissions;
    ASSERT_TRUE(engines.cut({Vec3(0.5), Vec3(0.6), 0.2, 1}));
    EXPECT_EQ(engines.vulkan().counts().submissions, after + 1) << "it is sent once";
}

TEST_F(VulkanEngineGpu, AfterADeviceErrorWhileAssignedRaysAreSentNothingIsLost) {
    const Solid before = plates(20, 4, 7);
    EnginePair engines(before, device(), {.spare_ends = 0});
    const std::uint64_t limit = device().core()->max_allocation_bytes;
    Random random(9);
    ASSERT_TRUE(engines.assign(random_rays(before.lattice, 500, random)));
    const Solid assigned = engines.cpu().solid();
    (void)engines.vulkan().take_changes();
    device().core()->max_allocation_bytes = 1024;
    const auto refused = engines.vulkan().carve(std::vector<BallSweep>{{Vec3(0.2), Vec3(0.8), 0.2, 1}});
    device().core()->max_allocation_bytes = limit;
    ASSERT_FALSE(refused);
    EXPECT_TRUE(engines.vulkan().solid().same_content(assigned));
    EXPECT_TRUE(engines.vulkan().take_changes().empty());
    EXPECT_TRUE(engines.cut({Vec3(0.2), Vec3(0.8), 0.2, 1}));
}

// Drivers bind as little as 128 MiB. The table of rays fits into that at every resolution; the ends need not.
TEST_F(VulkanEngineGpu, AStoreLargerThanABindingWorks) {
    const Solid solid = plates(24, 40, 11);
    capabilities().max_storage_buffer_bytes = solid.rays_held() * sizeof(shared::RayRef);
    ASSERT_GT(solid.sets[0].end_count() * sizeof(shared::DexelEnd), 3 * capabilities().max_storage_buffer_bytes);
    EnginePair engines(solid, device(), {.spare_ends = 0, .export_per_ray = 1, .tasks_a_pass = 1});
    Random random(12);
    for (int batch = 0; batch < repeated(8); ++batch) {
        std::vector<BallSweep> sweeps(4);
        for (BallSweep& sweep : sweeps) sweep = random_sweep(random, 0.04), sweep.radius_m *= 0.05;
        ASSERT_TRUE(engines.cut(sweeps)) << batch;
        ASSERT_TRUE(engines.assign(random_rays(solid.lattice, 20, random))) << batch;
    }
}

}  // namespace burin::compute::test
