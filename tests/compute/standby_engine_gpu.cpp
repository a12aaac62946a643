// SPDX-License-Identifier: MIT
// A device that is lost, at whichever of its calls, costs nothing that was carved: the processor's engine goes on, and
// another device after it where one is offered, and all that they have changed is what the processor alone changes.
#include "compute/vulkan/standby_engine.hpp"

#include <memory>

#include "compute/engine/history.hpp"
#include "tests/compute/updates.hpp"
#include "tests/compute/vulkan_engine_fixture.hpp"

namespace burin::compute::test {
namespace {

using StandbyEngineGpu = VulkanEngineGpu;

// The rays of a lattice plane, emptied: what undo and other tools assign.
RayBatch emptied(const Solid& solid, Random& random) {
    RayBatch batch;
    const int axis = random.small(0, 2), v = random.small(1, solid.lattice.rays_v(axis) - 2);
    for (int u = 1; u < solid.lattice.rays_u(axis) - 1; ++u) batch.add(shared::ray_code(axis, u, v), {});
    return batch;
}

}  // namespace

TEST_F(StandbyEngineGpu, GoesOnWithTheProcessorAtWhicheverCallTheDeviceIsLost) {
    for (int lost_at = 0; lost_at < repeated(8); ++lost_at) {
        Random random(static_cast<std::uint64_t>(lost_at));
        const Solid solid = unit_cube(24);
        auto own = gpu::Device::create({.validation = true});
        ASSERT_TRUE(own);
        StandbyEngine engine(solid, *own, pool_);
        ASSERT_NE(engine.on_device(), nullptr);
        const auto alone = make_cpu_engine(solid, pool_);
        for (int call = 0; call < 8; ++call) {
            if (call == lost_at) own->core()->lose_at_next_submit = true;
            const bool assigns = call < 7 && random.chance(0.4);
            const RayBatch batch = emptied(solid, random);
            std::vector<BallSweep> sweeps(3);
            for (BallSweep& sweep : sweeps) sweep = random_sweep(random, solid.lattice.spacing_m);
            sweeps.push_back(
                {Vec3(0.5), Vec3(0.4, 0.5, 0.1 * call), 0.1, 1});  // reaches the lattice, whatever the rest
            const auto done = assigns ? engine.assign(batch) : engine.carve(sweeps);
            const auto expected = assigns ? alone->assign(batch) : alone->carve(sweeps);
            ASSERT_TRUE(done) << done.error().line();
            ASSERT_TRUE(expected);
            EXPECT_EQ(done->rays_changed, expected->rays_changed);
            // Assigned rays are sent with the next cut, which is the first call that notices the loss.
            if (call < lost_at) {
                EXPECT_STREQ(engine.name(), "vulkan");
            } else if (!assigns) {
                EXPECT_STREQ(engine.name(), "cpu");
            }
            ASSERT_TRUE(engine.solid().same_content(alone->solid())) << "lost at " << lost_at << ", call " << call;
            // Taken after every second call, so that some are of both engines.
            if (call % 2 == 0) continue;
            EXPECT_EQ(first_held(engine.take_changes()), first_held(alone->take_changes()));
        }
        const auto notices = engine.take_notices();
        ASSERT_EQ(notices.size(), 1u);
        EXPECT_TRUE(notices[0].ends_with("the processor carves instead, and nothing is lost")) << notices[0];
        EXPECT_TRUE(engine.take_notices().empty());
    }
}

TEST_F(StandbyEngineGpu, CarvesWithTheProcessorFromTheBeginningWhereTheDeviceLacksSomething) {
    const Solid solid = unit_cube(16);
    for (bool gpu::Capabilities::* lacking :
         {&gpu::Capabilities::shader_int64, &gpu::Capabilities::shader_float64, &gpu::Capabilities::buffer_address}) {
        capabilities().*lacking = false;
        StandbyEngine engine(solid, device(), pool_);
        capabilities().*lacking = true;
        EXPECT_EQ(engine.on_device(), nullptr);
        EXPECT_TRUE(engine.solid().same_content(solid)) << "the solid is not lost with the engine that did not come";
        EXPECT_EQ(engine.take_notices().size(), 1u);
        EXPECT_TRUE(engine.carve(std::vector<BallSweep>{{Vec3(0.5), Vec3(0.5), 0.2, 1}}));
    }
}

TEST_F(StandbyEngineGpu, CarvesAgainOnWhatIsOfferedUntilThreeDevicesAreLost) {
    Random random(5);
    const Solid solid = unit_cube(24);
    auto own = gpu::Device::create({.validation = true});
    ASSERT_TRUE(own);
    StandbyEngine engine(solid, *own, pool_);
    const auto offered = std::make_shared<OfferedDevice>();
    engine.hear_offers(offered);
    const auto alone = make_cpu_engine(solid, pool_);
    const auto both = [&](bool assigns) {
        if (assigns) {
            const RayBatch batch = emptied(solid, random);
            ASSERT_TRUE(engine.assign(batch) && alone->assign(batch));
        }
        const std::vector<BallSweep> sweeps{random_sweep(random, solid.lattice.spacing_m),
                                            {Vec3(0.5), random_point(random, 0.0, 1.0), 0.1, 1}};
        ASSERT_TRUE(engine.carve(sweeps) && alone->carve(sweeps));
        ASSERT_TRUE(engine.solid().same_content(alone->solid()));
    };
    for (int loss = 1; loss <= StandbyEngine::kMostLosses + 1; ++loss) {
        both(false);
        EXPECT_STREQ(engine.name(), loss <= StandbyEngine::kMostLosses ? "vulkan" : "cpu");
        own->core()->shared().note_loss();
        both(true);
        EXPECT_STREQ(engine.name(), "cpu");
        own = gpu::Device::create({.validation = true});
        ASSERT_TRUE(own);
        auto lane = own->lane();
        ASSERT_TRUE(lane);
        offered->offer(*std::move(lane));
        if (loss % 2 == 0) {  // else what changed on the processor is taken with what changes on the device after it
            EXPECT_EQ(first_held(engine.take_changes()), first_held(alone->take_changes()));
        }
    }
    EXPECT_EQ(first_held(engine.take_changes()), first_held(alone->take_changes()));
    const auto notices = engine.take_notices();
    ASSERT_EQ(notices.size(), 5u);
    for (std::size_t i = 0; i < notices.size(); ++i)
        EXPECT_TRUE(notices[i].ends_with(i % 2 == 0 ? "nothing is lost" : "carves again")) << notices[i];
    EXPECT_FALSE(offered->take()) << "a device that nobody takes is not held back";
}

TEST_F(StandbyEngineGpu, GoesOnWithTheProcessorWhereWhatIsOfferedCannotCarve) {
    const Solid solid = unit_cube(16);
    auto own = gpu::Device::create({.validation = true});
    ASSERT_TRUE(own);
    StandbyEngine engine(solid, *own, pool_);
    const auto offered = std::make_shared<OfferedDevice>();
    engine.hear_offers(offered);
    const auto alone = make_cpu_engine(solid, pool_);
    own->core()->lose_at_next_submit = true;
    for (const double x : {0.2, 0.5, 0.8}) {
        if (x == 0.5) offered->offer(device());
        capabilities().shader_float64 = false;
        const std::vector<BallSweep> sweeps{{Vec3(x, 0.5, 1.0), Vec3(x, 0.6, 0.9), 0.1, 1}};
        const bool carved = engine.carve(sweeps) && alone->carve(sweeps);
        capabilities().shader_float64 = true;
        ASSERT_TRUE(carved);
        EXPECT_STREQ(engine.name(), "cpu");
        EXPECT_TRUE(engine.solid().same_content(alone->solid()));
    }
    const auto notices = engine.take_notices();
    ASSERT_EQ(notices.size(), 2u);
    EXPECT_TRUE(notices[1].contains("no doubles in shaders")) << notices[1];
    EXPECT_TRUE(notices[1].ends_with("the processor goes on")) << notices[1];
}

TEST_F(StandbyEngineGpu, CountsTheWorkOfAllItsDevices) {
    auto own = gpu::Device::create({.validation = true});
    ASSERT_TRUE(own);
    StandbyEngine engine(unit_cube(16), *own, pool_);
    const auto offered = std::make_shared<OfferedDevice>();
    engine.hear_offers(offered);
    const std::vector<BallSweep> sweeps{{Vec3(0.5, 0.5, 1.0), Vec3(0.5, 0.6, 0.9), 0.1, 1}};
    ASSERT_TRUE(engine.carve(sweeps));
    const auto before = engine.traffic();
    own->core()->lose_at_next_submit = true;
    ASSERT_TRUE(engine.carve(sweeps));
    offered->offer(device());
    ASSERT_TRUE(engine.carve(sweeps));
    EXPECT_STREQ(engine.name(), "vulkan");
    const auto after = engine.traffic();
    ASSERT_TRUE(before && after);
    EXPECT_EQ(after->submissions, before->submissions + device().asked().submissions);
    EXPECT_EQ(after->blocking_waits, before->blocking_waits + device().asked().blocking_waits);
}

TEST_F(StandbyEngineGpu, KeepsItsDeviceAfterASweepThatMakesNoSense) {
    StandbyEngine engine(unit_cube(16), device(), pool_);
    EXPECT_FALSE(engine.carve(std::vector<BallSweep>{{Vec3(0.5), Vec3(0.5), -1.0, 1}}));
    EXPECT_NE(engine.on_device(), nullptr);
    EXPECT_TRUE(engine.take_notices().empty());
}

TEST_F(StandbyEngineGpu, UndoesWhatALostDeviceHasCarved) {
    const Solid solid = unit_cube(24);
    auto own = gpu::Device::create({.validation = true});
    ASSERT_TRUE(own);
    StandbyEngine engine(solid, *own, pool_);
    History history(History::kDefaultBudget_bytes);
    for (const double x : {0.2, 0.5, 0.8}) {
        if (x == 0.8) own->core()->lose_at_next_submit = true;
        ASSERT_TRUE(engine.carve(std::vector<BallSweep>{{Vec3(x, 0.5, 1.0), Vec3(x, 0.6, 0.9), 0.1, 1}}));
        history.record(engine.take_changes());
        history.end_stroke();
    }
    EXPECT_EQ(engine.on_device(), nullptr);
    for (int stroke = 0; stroke < 3; ++stroke) {
        const auto undone = history.undo(engine);
        ASSERT_TRUE(undone && *undone);
        (void)engine.take_changes();
    }
    EXPECT_TRUE(engine.solid().same_content(solid));
}

}  // namespace burin::compute::test
