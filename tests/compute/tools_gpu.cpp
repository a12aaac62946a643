// SPDX-License-Identifier: MIT
// Every tool and operation on both engines: the same solid to the last bit.
#include <gtest/gtest.h>

#include "compute/tools/apply.hpp"
#include "tests/compute/engine_pair.hpp"
#include "tests/compute/tool_reference.hpp"
#include "tests/gpu/test_device.hpp"

namespace burin::compute::test {
namespace {

class ToolsGpu : public gpu::DeviceTest {
protected:
    void SetUp() override {
        gpu::DeviceTest::SetUp();
        if (IsSkipped()) return;
        const gpu::Capabilities& can = device().capabilities();
        if (!can.shader_int64 || !can.shader_float64) {
            GTEST_SKIP() << device().info().name << " has no 64-bit integers or no doubles in shaders";
        }
    }
};

}  // namespace

TEST_F(ToolsGpu, EveryToolAndOperationGivesTheSolidOfTheCpuEngine) {
    EnginePair pair(unit_cube(40), device());
    Random random(1);
    const auto anywhere = [&] { return Vec3(random.unit(), random.unit(), random.unit()); };
    for (int i = 0; i < repeated(60) && !HasFailure(); ++i) {
        ToolSweep sweep;
        sweep.operation = static_cast<Operation>(random.small(0, 3));
        sweep.shape =
            any_shape(random, 0.05, 0.3, sweep.operation == Operation::smooth ? kKindOf<BallTool> : i % kDrawnKinds);
        sweep.start = {anywhere(), any_orientation(random)};
        sweep.end = {random.chance(0.3) ? sweep.start.position_m : anywhere(),
                     random.chance(0.7) ? sweep.start.orientation : any_orientation(random)};
        sweep.tolerance_cells = 0.5;
        sweep.material = static_cast<std::uint8_t>(random.small(0, 1));
        const auto expected = pair.cpu().carve({&sweep, 1});
        const auto actual = pair.vulkan().carve({&sweep, 1});
        ASSERT_TRUE(expected) << expected.error().line();
        ASSERT_TRUE(actual) << actual.error().line();
        EXPECT_EQ(actual->rays_changed, expected->rays_changed);
        EXPECT_EQ(first_difference(pair.vulkan().solid(), pair.cpu().solid()), "");
    }
}

}  // namespace burin::compute::test
