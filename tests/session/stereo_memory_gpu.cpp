// SPDX-License-Identifier: MIT
// A stereo mode whose pictures the device has no memory for, on what poses as a card (tests/tools/vulkan_layer).
#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <string>

#include "base/json.hpp"
#include "gpu/device.hpp"
#include "tests/support/places.hpp"
#include "tests/support/posing_device.hpp"
#include "tests/support/run_command.hpp"

namespace burin::session {
namespace {

// Runs a session that begins with both eyes side by side, and asks for `mode` when a first picture has been taken.
Workplace::Outcome asks_for(const Workplace& at, const std::string& mode, const std::string& posing) {
    at.write("modes.txt", "burin-input 1 modes\n0.1 command screenshot before.png\n0.3 command stereo-mode " + mode +
                              "\n0.6 command screenshot after.png\n0.9 command quit\n");
    return at.run(posing_as(posing + " BURIN_POSE_COUNTS=counts") + kBurinCommand +
                  " sculpt --input modes.txt --offscreen --stereo side-by-side --workpiece ball:0.05 --resolution 32 "
                  "--engine cpu --outputs out");
}

}  // namespace

TEST(StereoMemory, AModeThatDoesNotFitIsRefusedByNameAndTheSessionGoesOn) {
    if (!gpu::list_devices()) GTEST_SKIP() << "no Vulkan driver";
    const Workplace at;
    ASSERT_EQ(asks_for(at, "side-by-side", "").status, 0);
    const auto small = Json::parse(at.read("counts"))["most_device_bytes"].get<std::uint64_t>();
    const std::string alike = at.read("out/after.png");
    std::filesystem::remove(at / "counts");
    std::filesystem::remove_all(at / "out");
    ASSERT_EQ(asks_for(at, "row-interlaced", "").status, 0);
    const auto large = Json::parse(at.read("counts"))["most_device_bytes"].get<std::uint64_t>();
    ASSERT_GT(large, small) << "each eye's picture is twice as wide";
    EXPECT_FALSE(at.read("out/after.png") == alike);
    std::filesystem::remove_all(at / "out");

    // A little more than what side by side takes.
    const auto refused = asks_for(at, "row-interlaced", "BURIN_POSE_DEVICE_BYTES=" + std::to_string(small + 4096));
    EXPECT_EQ(refused.status, 0) << refused.output;
    EXPECT_TRUE(refused.output.contains("could not be allocated")) << refused.output;
    EXPECT_TRUE(at.read("out/after.png") == alike) << "the picture is that of the mode before";
}

}  // namespace burin::session
