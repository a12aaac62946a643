// SPDX-License-Identifier: MIT
// A ball's strokes carved, meshed and touched on the Vulkan device give the part that the host's engine gives.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "base/json.hpp"
#include "gpu/device.hpp"
#include "tests/support/places.hpp"
#include "tests/support/run_command.hpp"

namespace burin::sculpt {
namespace {

// Two scratches across the top of a ball of 5 cm, the tool lifted in between.
std::string scratches() {
    std::string text = kStrokeHeader;
    for (int i = 0; i <= 40; ++i) {
        const double x = -0.02 + 0.001 * i, y = i < 20 ? 0.004 : -0.004, z = std::sqrt(0.052 * 0.052 - x * x - y * y);
        text += std::to_string(0.02 * i) + "," + std::to_string(x) + "," + std::to_string(y) + "," + std::to_string(z) +
                ",0,0,0,1," + (i == 0 || i == 20 || i == 40 ? "0" : "1") + "\n";
    }
    return text;
}

}  // namespace

TEST(DeviceCarving, GivesTheSamePartAndCountsTheSameRaysWhetherTheHandIsRigidOrFeels) {
    const auto device = gpu::Device::create();
    if (!device) GTEST_SKIP() << "no Vulkan driver";
    const gpu::Capabilities& can = device->capabilities();
    if (!can.shader_int64 || !can.shader_float64 || !can.buffer_address || !can.scalar_block_layout) {
        GTEST_SKIP() << device->info().name << " cannot run the Vulkan engine";
    }
    Workplace place;
    place.write("s.csv", scratches());
    for (const std::string hand : {"rigid", "simulated"}) {
        for (const std::string engine : {"cpu", "vulkan"}) {
            const auto outcome = place.run(std::string(kBurinCommand) +
                                           " sculpt --workpiece ball:0.05 --tool ball:0.004 --stroke s.csv " +
                                           "--resolution 64 --mirror yz --hand " + hand + " --engine " + engine +
                                           " --export " + engine + ".ply --report " + engine + ".json");
            ASSERT_EQ(outcome.status, 0) << outcome.output;
        }
        const auto cpu = Json::parse(place.read("cpu.json"));
        const auto vulkan = Json::parse(place.read("vulkan.json"));
        EXPECT_EQ(vulkan["engine"]["name"], "vulkan");
        EXPECT_GT(vulkan["carving"]["rays_changed"].get<int>(), 100);
        EXPECT_GT(vulkan["carving"]["triangles_remeshed"].get<int>(), 100);
        EXPECT_TRUE(place.read("vulkan.ply") == place.read("cpu.ply")) << hand;
        for (const char* count : {"updates", "rays_touched", "rays_changed", "triangles_held"}) {
            EXPECT_EQ(vulkan["carving"][count], cpu["carving"][count]) << hand << ", " << count;
        }
        if (hand == "rigid") continue;
        EXPECT_GT(vulkan["feel"]["ticks_in_contact"].get<int>(), 100);
        for (const char* felt : {"ticks_in_contact", "force_max_N", "penetration_max_m"}) {
            ASSERT_TRUE(cpu["feel"].contains(felt)) << felt;
            EXPECT_EQ(vulkan["feel"][felt], cpu["feel"][felt]) << felt;
        }
    }
}

}  // namespace burin::sculpt
