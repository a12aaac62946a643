// SPDX-License-Identifier: MIT
// A session whose one device carves on the scene's thread and draws on the frame's, and is lost while both do: a replay
// that the processor carves on one thread gives every tick and the solid again, to the bit.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "base/json.hpp"
#include "gpu/device.hpp"
#include "tests/support/places.hpp"
#include "tests/support/posing_device.hpp"
#include "tests/support/run_command.hpp"

namespace burin::session {
namespace {

// Carves from 0.3 to 1.8 s. Photographs before and afterwards, so that frames are drawn all along.
const std::string kCarvedInRealTime = R"(burin-input 1 test
0.02 mouse 160 180
0.04 scroll 0 15
0.1 command screenshot before.png
0.3 button press left
0.32 scroll 0 8
0.4 mouse 166 182
0.6 mouse 190 190
0.8 mouse 196 200
1 mouse 220 190
1.2 mouse 250 200
1.4 mouse 300 210
1.6 mouse 280 190
1.8 button release left
1.82 scroll 0 -14
1.9 command screenshot end.png
2 command quit
)";

class OneDevice : public testing::Test {
protected:
    void SetUp() override {
        const auto devices = gpu::list_devices();
        if (!devices) GTEST_SKIP() << "no Vulkan device: " << devices.error().line();
        at_.write("script.txt", kCarvedInRealTime);
    }
    // Plays the script with threads, which a recording has it do, and replays it; returns what it said.
    std::string carve_and_replay(const std::string& posing) {
        const auto played =
            at_.run(posing_as(posing + " BURIN_POSE_COUNTS=counts") + "BURIN_VULKAN_VALIDATION=1 " + kBurinCommand +
                    " sculpt --workpiece ball:0.1 --resolution 48 --tool ball:0.012 --offscreen --width 720 --height "
                    "360 --input script.txt --record it.session --engine vulkan --outputs files");
        EXPECT_EQ(played.status, 0) << played.output;
        EXPECT_FALSE(played.output.contains("Vulkan validation")) << played.output;
        EXPECT_FALSE(at_.read("files/before.png").empty());
        EXPECT_FALSE(at_.read("files/end.png").empty());
        const auto replayed = at_.run(std::string(kBurinCommand) + " replay it.session --set engine=cpu");
        EXPECT_EQ(replayed.status, 0) << replayed.output;
        EXPECT_TRUE(replayed.output.contains("equal to the bit")) << replayed.output;
        return played.output;
    }
    [[nodiscard]] std::size_t devices() const {
        const std::string counts = at_.read("counts");
        return static_cast<std::size_t>(std::ranges::count(counts, '\n'));
    }

    Workplace at_;
};

}  // namespace

TEST_F(OneDevice, CarvesOnOneThreadAndDrawsOnAnother) {
    static_cast<void>(carve_and_replay(""));
    ASSERT_EQ(devices(), 1u);
    EXPECT_GT(Json::parse(at_.read("counts"))["dispatches"], 5) << "nothing was carved";
}

TEST_F(OneDevice, IsLostInMidStrokeAndPictureAndSolidGoOn) {
    const std::string said = carve_and_replay("BURIN_POSE_LOSE_SUBMIT=5 BURIN_POSE_LOSE_DEVICES=1");
    EXPECT_EQ(devices(), 2u);
    EXPECT_TRUE(said.contains("the graphics device was lost; starting on a new one")) << said;
    EXPECT_TRUE(said.contains("the processor carves instead, and nothing is lost")) << said;
}

}  // namespace burin::session
