// SPDX-License-Identifier: MIT
// The pictures that the command leaves, under the validation layer.
#include <gtest/gtest.h>

#include "gpu/device.hpp"
#include "tests/support/places.hpp"
#include "tests/support/run_command.hpp"

namespace burin::app {
namespace {

const std::string kBurin = kBurinCommand;

// Width and height from a PNG's header; zeros when it is none.
std::pair<unsigned, unsigned> png_size(const std::string& bytes) {
    if (bytes.size() < 24 || bytes.compare(1, 3, "PNG") != 0) return {0, 0};
    const auto number = [&](std::size_t at) {
        unsigned n = 0;
        for (std::size_t i = 0; i < 4; ++i) n = n << 8 | static_cast<unsigned char>(bytes[at + i]);
        return n;
    };
    return {number(16), number(20)};
}

}  // namespace

TEST(Pictures, AreLeftRightAndSideBySideAndRepeatToTheBit) {
    if (!gpu::list_devices()) GTEST_SKIP() << "no Vulkan driver";
    Workplace place;
    place.write("s.csv", kStrokeHeader + "0,0,0,0.055,0,0,0,1,1\n1,0.01,0,0.05,0,0,0,1,1\n");
    const std::string command =
        "BURIN_VULKAN_VALIDATION=1 " + kBurin +
        " sculpt --workpiece ball:0.05 --tool ball:0.01 --stroke s.csv --resolution 48 --pictures ";
    for (const std::string folder : {"one", "two"}) {
        const auto outcome = place.run(command + folder);
        ASSERT_EQ(outcome.status, 0) << outcome.output;
        EXPECT_EQ(outcome.output.find("VUID"), std::string::npos) << outcome.output;
    }
    for (const std::string name : {"before.png", "after.png", "left.png", "right.png"}) {
        EXPECT_EQ(png_size(place.read("one/" + name)), std::pair(1280u, 960u)) << name;
    }
    EXPECT_EQ(png_size(place.read("one/stereo.png")), std::pair(2560u, 960u));
    for (const std::string name : {"before.png", "after.png", "stereo.png"}) {
        EXPECT_TRUE(place.read("one/" + name) == place.read("two/" + name)) << name;
    }
    EXPECT_FALSE(place.read("one/before.png") == place.read("one/after.png"));
    EXPECT_FALSE(place.read("one/left.png") == place.read("one/right.png"));
}

}  // namespace burin::app
