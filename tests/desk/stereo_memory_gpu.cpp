// SPDX-License-Identifier: MIT
// A stereo mode whose pictures the device has no memory for, on what poses as a card (tests/tools/vulkan_layer).
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>

#include "base/image.hpp"
#include "base/json.hpp"
#include "gpu/device.hpp"
#include "picture/png.hpp"
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

Image read_after(const Workplace& at) {
    auto image = picture::load_png(at / "out/after.png");
    EXPECT_TRUE(image) << image.error().line();
    return image ? std::move(*image) : Image{};
}

// Returns whether two pictures have the same first rows, which no message on the panel covers.
bool is_beginning(const Image& a, const Image& b) {
    const auto bytes = static_cast<std::ptrdiff_t>(std::size_t{4} * a.size.width * 200);
    return a.size == b.size && a.size.height > 200 &&
           std::equal(a.rgba.begin(), a.rgba.begin() + bytes, b.rgba.begin());
}

}  // namespace

TEST(StereoMemory, AModeThatDoesNotFitIsRefusedByNameAndTheSessionGoesOn) {
    if (!gpu::list_devices()) GTEST_SKIP() << "no Vulkan driver";
    const Workplace at;
    ASSERT_EQ(asks_for(at, "side-by-side", "").status, 0);
    const auto small = Json::parse(at.read("counts"))["most_device_bytes"].get<std::uint64_t>();
    const Image alike = read_after(at);
    std::filesystem::remove(at / "counts");
    std::filesystem::remove_all(at / "out");
    ASSERT_EQ(asks_for(at, "row-interlaced", "").status, 0);
    const auto large = Json::parse(at.read("counts"))["most_device_bytes"].get<std::uint64_t>();
    ASSERT_GT(large, small) << "each eye's picture is twice as wide";
    EXPECT_FALSE(is_beginning(read_after(at), alike));
    std::filesystem::remove_all(at / "out");

    // A little more than what side by side takes.
    const auto refused = asks_for(at, "row-interlaced", "BURIN_POSE_DEVICE_BYTES=" + std::to_string(small + 4096));
    EXPECT_EQ(refused.status, 0) << refused.output;
    EXPECT_TRUE(refused.output.contains("stereo mode interlaced rows is not shown, side by side goes on: "))
        << refused.output;
    EXPECT_TRUE(refused.output.contains("could not be allocated")) << refused.output;
    EXPECT_TRUE(is_beginning(read_after(at), alike)) << "the picture is that of the mode before";
}

}  // namespace burin::session
