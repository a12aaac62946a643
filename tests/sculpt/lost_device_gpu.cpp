// SPDX-License-Identifier: MIT
// A sculpture whose device is lost while it carves there: the processor does again what nobody had taken.
#include <array>
#include <string>

#include "compute/vulkan/standby_engine.hpp"
#include "gpu/core.hpp"
#include "sculpt/sculpture.hpp"
#include "tests/compute/vulkan_engine_fixture.hpp"
#include "toolbox/mirror.hpp"

namespace burin::sculpt {
namespace {

using compute::test::Random;

class LostDeviceGpu : public compute::test::VulkanEngineGpu {};

// A ball that cuts, fills or paints, or a cylinder that cuts.
compute::ToolSweep random_sweep(Random& random, bool is_cylinder) {
    const auto place = [&] { return compute::test::random_point(random, 0.1, 0.9); };
    compute::ToolSweep sweep{compute::BallTool{random.between(0.05, 0.2)}, {place()}, {place()}};
    if (is_cylinder) {
        sweep.shape = compute::CylinderTool{random.between(0.05, 0.2), 0.2};
        return sweep;
    }
    sweep.operation = std::array{compute::Operation::cut, compute::Operation::fill,
                                 compute::Operation::paint}[static_cast<std::size_t>(random.small(0, 2))];
    sweep.material = static_cast<std::uint8_t>(random.small(0, 1));
    return sweep;
}

}  // namespace

TEST_F(LostDeviceGpu, LeavesTheSolidTheSurfaceAndTheCountsThatTheProcessorAloneWouldHave) {
    constexpr int kUpdates = 10;
    for (int lost_at = 0; lost_at < compute::test::repeated(kUpdates); ++lost_at) {
        Random random(static_cast<std::uint64_t>(lost_at) + 7);
        const compute::Solid solid = compute::test::unit_cube(24);
        auto own = gpu::Device::create({.validation = true});
        ASSERT_TRUE(own);
        WorkerPool pool(1);
        Sculpture carved(std::make_unique<compute::StandbyEngine>(solid, *own, pool), pool);
        Sculpture alone(compute::make_cpu_engine(solid, pool), pool);
        for (int i = 0; i < kUpdates; ++i) {
            if (i == lost_at) own->core()->lose_at_next_submit = true;
            const std::array sweeps{random_sweep(random, false), random_sweep(random, i == 8 && lost_at % 2 == 0)};
            ASSERT_TRUE(carved.update(sweeps));
            ASSERT_TRUE(alone.update(sweeps));
        }
        EXPECT_EQ(std::string(carved.engine().name()), "cpu") << "the device is lost";
        EXPECT_TRUE(carved.engine().solid().same_content(alone.engine().solid())) << "lost at " << lost_at;
        ASSERT_EQ(carved.surface().tile_count(), alone.surface().tile_count());
        EXPECT_EQ(carved.surface().triangles(), alone.surface().triangles());
        EXPECT_EQ(carved.surface().volume_m3(), alone.surface().volume_m3());
        EXPECT_EQ(carved.figures().updates, alone.figures().updates);
        EXPECT_EQ(carved.figures().rays_touched, alone.figures().rays_touched);
        EXPECT_EQ(carved.figures().rays_changed, alone.figures().rays_changed);
        EXPECT_EQ(carved.take_notices().size(), 1u);
        EXPECT_TRUE(carved.take_notices().empty());
    }
}

TEST_F(LostDeviceGpu, AtTheBeginningOfAnUpdateWithImagesCarvesTheseOnce) {
    const compute::Solid solid = compute::test::unit_cube(16);
    auto own = gpu::Device::create();
    ASSERT_TRUE(own);
    WorkerPool pool(1);
    Sculpture carved(std::make_unique<compute::StandbyEngine>(solid, *own, pool), pool);
    Sculpture alone(compute::make_cpu_engine(solid, pool), pool);
    for (Sculpture* one : {&carved, &alone}) one->mirror(toolbox::Mirror{.across = {true, false, false}});
    Random random(3);
    for (const bool is_lost : {false, true}) {
        own->core()->lose_at_next_submit = is_lost;
        compute::ToolSweep sweep{compute::BallTool{0.2}, {compute::test::random_point(random, 0.1, 0.9)}, {}};
        sweep.end = sweep.start;
        ASSERT_TRUE(carved.update({&sweep, 1}));
        ASSERT_TRUE(alone.update({&sweep, 1}));
    }
    EXPECT_EQ(std::string(carved.engine().name()), "cpu") << "the device is lost";
    EXPECT_TRUE(carved.engine().solid().same_content(alone.engine().solid()));
    EXPECT_EQ(carved.surface().volume_m3(), alone.surface().volume_m3());
    EXPECT_EQ(carved.figures().sweeps, alone.figures().sweeps) << "an image of an image was carved";
}

}  // namespace burin::sculpt
