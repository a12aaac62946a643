// SPDX-License-Identifier: MIT
// A sculpture whose device is lost while it carves and meshes there: the processor does again what nobody had fetched.
#include <array>
#include <string>

#include "compute/vulkan/standby_engine.hpp"
#include "gpu/core.hpp"
#include "sculpt/mirror.hpp"
#include "sculpt/sculpture.hpp"
#include "tests/compute/vulkan_engine_fixture.hpp"

namespace burin::sculpt {
namespace {

using compute::test::Random;

class LostDeviceGpu : public compute::test::VulkanEngineGpu {};

// A ball that cuts, fills or paints, or a cylinder that cuts, which the host has to carve.
compute::ToolSweep random_sweep(Random& random, bool on_host) {
    const auto place = [&] { return compute::test::random_point(random, 0.1, 0.9); };
    compute::ToolSweep sweep{compute::BallTool{random.between(0.05, 0.2)}, {place()}, {place()}};
    if (on_host) {
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
        carved.mesh_on_device();
        for (int i = 0; i < kUpdates; ++i) {
            if (i == lost_at) own->core()->lose_at_next_submit = true;
            const std::array sweeps{random_sweep(random, false), random_sweep(random, i == 8 && lost_at % 2 == 0)};
            ASSERT_TRUE(carved.update(sweeps));
            ASSERT_TRUE(alone.update(sweeps));
            if (random.chance(0.2)) carved.read_back();
        }
        carved.read_back();
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

TEST_F(LostDeviceGpu, ReadsBackFromTimeToTimeAndMayBeLostJustThen) {
    if (compute::test::kSanitized) GTEST_SKIP() << "a thousand updates on a device in software";
    constexpr std::size_t kMostOnDevice = 1024;  // as in sculpt/sculpture.cpp
    const compute::Solid solid = compute::test::unit_cube(16);
    auto own = gpu::Device::create();
    ASSERT_TRUE(own);
    WorkerPool pool(1);
    Sculpture carved(std::make_unique<compute::StandbyEngine>(solid, *own, pool), pool);
    Sculpture alone(compute::make_cpu_engine(solid, pool), pool);
    carved.mesh_on_device();
    const auto sweep = [](std::size_t i) {
        return compute::ToolSweep{compute::BallTool{0.1},
                                  {Vec3(0.001 * double(i % 1000), 0.5, 1.0)},
                                  {Vec3(0.5, 0.001 * double(i % 1000), 1.0)}};
    };
    for (std::size_t i = 0; i < kMostOnDevice + 2; ++i) {
        if (i == kMostOnDevice) own->core()->lose_at_next_submit = true;
        const compute::ToolSweep one = sweep(i);
        ASSERT_TRUE(carved.update({&one, 1}));
        ASSERT_TRUE(alone.update({&one, 1}));
    }
    EXPECT_STREQ(carved.engine().name(), "cpu");
    EXPECT_TRUE(carved.engine().solid().same_content(alone.engine().solid()));
    EXPECT_EQ(carved.figures().updates, alone.figures().updates);
    EXPECT_EQ(carved.figures().rays_changed, alone.figures().rays_changed);
}

// What a device alone knows of is bounded, so that an update may begin with reading back, and lose the device there.
TEST_F(LostDeviceGpu, AtTheBeginningOfAnUpdateWithImagesCarvesTheseOnce) {
    constexpr std::size_t kMostOnDevice = 1024;  // updates; as in sculpture.cpp
    if (compute::test::kSanitized) GTEST_SKIP() << "a thousand updates take too long";
    const compute::Solid solid = compute::test::unit_cube(16);
    auto own = gpu::Device::create();
    ASSERT_TRUE(own);
    WorkerPool pool(1);
    Sculpture carved(std::make_unique<compute::StandbyEngine>(solid, *own, pool), pool);
    Sculpture alone(compute::make_cpu_engine(solid, pool), pool);
    carved.mesh_on_device();
    Random random(3);
    for (std::size_t i = 0; i <= kMostOnDevice; ++i) {
        if (i == kMostOnDevice) {
            own->core()->lose_at_next_submit = true;
            for (Sculpture* one : {&carved, &alone}) one->mirror(Mirror{.across = {true, false, false}});
        }
        compute::ToolSweep sweep{compute::BallTool{0.02}, {compute::test::random_point(random, 0.1, 0.9)}, {}};
        if (i == kMostOnDevice) sweep.shape = compute::BallTool{0.2};
        sweep.end = sweep.start;
        ASSERT_TRUE(carved.update({&sweep, 1}));
        ASSERT_TRUE(alone.update({&sweep, 1}));
    }
    EXPECT_EQ(std::string(carved.engine().name()), "cpu") << "the device is lost";
    EXPECT_TRUE(carved.engine().solid().same_content(alone.engine().solid()));
    EXPECT_EQ(carved.figures().sweeps, alone.figures().sweeps) << "an image of an image was carved";
}

}  // namespace burin::sculpt
