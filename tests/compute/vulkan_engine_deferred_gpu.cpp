// SPDX-License-Identifier: MIT
// Cuts that the Vulkan engine keeps on the device until somebody reads the solid back: the same ends as the CPU
// engine's then.
#include "tests/compute/vulkan_engine_fixture.hpp"

namespace burin::compute::test {

TEST_F(VulkanEngineGpu, DeferredCutsReadBackAreTheSameAndRecordEachRayOnce) {
    for (int round = 0; round < repeated(12); ++round) {
        Random random(static_cast<std::uint64_t>(200 + round));
        const Solid solid = plates(random.small(16, 32), random.small(1, 5), static_cast<std::uint64_t>(round));
        EnginePair engines(solid, device(), {.spare_ends = 0, .tasks_a_pass = 8});
        for (int frame = 0; frame < 6; ++frame) {
            for (int update = random.small(1, 3); update > 0; --update) {
                std::vector<BallSweep> sweeps(static_cast<std::size_t>(random.small(1, 6)));
                for (BallSweep& sweep : sweeps) sweep = random_sweep(random, solid.lattice.spacing_m);
                ASSERT_TRUE(engines.cut_deferred(sweeps)) << "round " << round << " frame " << frame;
            }
            const Solid held = engines.vulkan().solid();
            (void)engines.vulkan().take_changes();
            ASSERT_TRUE(engines.read_back());
            const Changes changes = engines.vulkan().take_changes();
            std::vector<std::uint32_t> codes;
            for (const shared::ChangedRay& ray : changes.rays) {
                codes.push_back(ray.ray);
                const RayPlace place = place_of(ray.ray);
                const auto before = held.sets[static_cast<std::size_t>(place.axis)].ends(place.u, place.v);
                ASSERT_TRUE(std::ranges::equal(changes.before_of(ray), before, [](const auto& a, const auto& b) {
                    return a.depth_material == b.depth_material && a.normal == b.normal;
                }));
            }
            std::ranges::sort(codes);
            EXPECT_EQ(std::ranges::adjacent_find(codes), codes.end()) << "a ray is listed twice";
            if (random.chance(0.5)) {
                ASSERT_TRUE(engines.cut(random_sweep(random, solid.lattice.spacing_m)));
            }
        }
    }
}

// The first ball moves ends, which the device has done when the second one finds no room for new ends.
TEST_F(VulkanEngineGpu, ADeferredCutThatFailsHalfwayIsForgottenByTheDeviceToo) {
    const Solid solid = unit_cube(32);
    EnginePair engines(solid, device(), {.spare_ends = 0});
    VulkanEngine& engine = engines.vulkan();
    ASSERT_TRUE(engine.defer(std::vector<BallSweep>{{Vec3(0.0), Vec3(0.0), 0.2, 1}, {Vec3(0.6), Vec3(0.6), 0.2, 1}}));
    auto commands = gpu::Commands::begin(engine.device());
    ASSERT_TRUE(commands);
    engine.record_pass(*commands);
    auto submission = std::move(*commands).submit();
    ASSERT_TRUE(submission && submission->wait());
    const std::uint64_t limit = device().core()->max_allocation_bytes;
    device().core()->max_allocation_bytes = 1024;
    const auto failed = engine.end_pass();
    device().core()->max_allocation_bytes = limit;
    ASSERT_FALSE(failed);
    EXPECT_FALSE(engine.deferred_left());
    EXPECT_TRUE(engines.read_back());
    EXPECT_TRUE(engine.take_changes().empty());
    EXPECT_TRUE(engines.cut({Vec3(0.0), Vec3(0.0), 0.1, 1})) << "where the device had cut deeper already";
}

// Whatever works on the host's solid next has to have the cuts that only the device knows: a cut elsewhere, and an
// undo, which assigns rays.
TEST_F(VulkanEngineGpu, DeferredCutsAreReadBackBeforeTheNextCut) {
    const Solid solid = unit_cube(32);
    EnginePair engines(solid, device());
    ASSERT_TRUE(engines.cut_deferred(std::vector<BallSweep>{{Vec3(0.2), Vec3(0.3), 0.1, 1}}));
    ASSERT_GT(engines.vulkan().stale_rays(), 0u);
    EXPECT_TRUE(engines.cut({Vec3(0.8), Vec3(0.8), 0.1, 1}));
    Solid back = engines.vulkan().solid();
    const Changes changes = engines.vulkan().take_changes();
    for (const RayBatch batch = as_before(changes); const RayBatch::Ray& ray : batch.rays) {
        const RayPlace place = place_of(ray.code);
        back.sets[static_cast<std::size_t>(place.axis)].replace(place.u, place.v, batch.ends_of(ray));
    }
    EXPECT_EQ(first_difference(back, solid), "") << "the changes tell of both cuts";
}

TEST_F(VulkanEngineGpu, DeferredCutsAreReadBackBeforeAnUndo) {
    const Solid solid = unit_cube(32);
    EnginePair engines(solid, device());
    ASSERT_TRUE(engines.cut({Vec3(0.8), Vec3(0.8), 0.1, 1}));
    const RayBatch undo = as_before(engines.vulkan().take_changes());
    ASSERT_TRUE(engines.cut_deferred(std::vector<BallSweep>{{Vec3(0.2), Vec3(0.3), 0.1, 1}}));
    ASSERT_GT(engines.vulkan().stale_rays(), 0u);
    EXPECT_TRUE(engines.assign(undo));
    EXPECT_EQ(first_difference(engines.vulkan().solid(), engines.cpu().solid()), "");
    EXPECT_TRUE(engines.cut({Vec3(0.5), Vec3(0.5), 0.2, 1})) << "the device must hold the same";
}

}  // namespace burin::compute::test
