// SPDX-License-Identifier: MIT
// A workpiece that is carved in a world in which one object moves and one is moved by the hand, in real time with its
// threads, recorded, and the recording done again: byte for byte the same pictures.
#include <gtest/gtest.h>

#include "gpu/device.hpp"
#include "tests/support/places.hpp"
#include "tests/support/run_command.hpp"

namespace burin::session {
namespace {

// A box of 6 x 6 x 6 cm about its origin.
const std::string kBox =
    "OFF\n8 12 0\n-0.03 -0.03 -0.03\n0.03 -0.03 -0.03\n0.03 0.03 -0.03\n-0.03 0.03 -0.03\n"
    "-0.03 -0.03 0.03\n0.03 -0.03 0.03\n0.03 0.03 0.03\n-0.03 0.03 0.03\n"
    "3 0 2 1\n3 0 3 2\n3 4 5 6\n3 4 6 7\n3 0 1 5\n3 0 5 4\n3 2 3 7\n3 2 7 6\n3 0 4 7\n3 0 7 3\n3 1 2 6\n3 1 6 5\n";

const std::string kBoxes = R"([[object]]
name = "crate"
mesh = "box.off"
mesh_units = "m"
position = [0.1, 0.0, 0.0]
colour = "#a06030"
[[object]]
name = "lift"
mesh = "box.off"
mesh_units = "m"
scale = 0.3
position = [-0.12, 0.05, 0.0]
colour = "#3060c0"
[[object.path]]
time = 0.0
[[object.path]]
time = 0.5
position = [0.0, 0.03, 0.0]
[[object.path]]
time = 1.0
)";

// Carves the ball in the middle, moves over to the crate, takes it along, lets go.
const std::string kUse = R"(burin-input 1 test
0.05 mouse 320 200
0.1 scroll 0 9
0.2 command screenshot before.png
0.3 button press left
0.35 scroll 0 4
0.5 mouse 326 204
0.7 mouse 332 206
0.8 button release left
0.85 scroll 0 -8
0.9 command object crate colour 0.9,0.1,0.1
1 command screenshot carved.png
1.1 mouse 400 200
1.2 scroll 0 14
1.5 button press right
1.6 mouse 400 180
1.7 mouse 410 160
1.8 mouse 420 140
2.0 button release right
2.2 command object lift stiffness 100
2.4 command screenshot moved.png
2.6 command quit
)";

}  // namespace

TEST(RecordedWorld, IsDoneAgainToTheBit) {
    if (!gpu::list_devices()) GTEST_SKIP() << "no Vulkan device";
    const Workplace place;
    place.write("box.off", kBox);
    place.write("boxes.toml", kBoxes);
    place.write("use.txt", kUse);
    const std::string burin = kBurinCommand;
    const auto live = place.run(burin +
                                " world boxes.toml --workpiece ball:0.04 --resolution 48 --tool ball:0.006 --offscreen "
                                "--width 640 --height 400 --input use.txt --record live.log --outputs live");
    ASSERT_EQ(live.status, 0) << live.output;
    const std::string log = place.read("live.log");
    ASSERT_NE(log.find(" end "), std::string::npos) << "it was not recorded to its end: " << live.output;
    EXPECT_NE(log.find("--world boxes.toml"), std::string::npos);
    const auto again = place.run(burin + " world --input live.log --offscreen --outputs again");
    ASSERT_EQ(again.status, 0) << again.output;
    for (const std::string name : {"before.png", "carved.png", "moved.png"}) {
        EXPECT_FALSE(place.read("live/" + name).empty()) << name;
        EXPECT_TRUE(place.read("live/" + name) == place.read("again/" + name)) << name;
    }
}

}  // namespace burin::session
