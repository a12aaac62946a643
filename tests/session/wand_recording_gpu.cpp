// SPDX-License-Identifier: MIT
// A wand at a block in real time with its threads, turned and pressed, the block edited meanwhile; recorded, and the
// recording done again: byte for byte the same pictures, with the wand that it was recorded with.
#include <gtest/gtest.h>

#include "gpu/device.hpp"
#include "tests/support/places.hpp"
#include "tests/support/run_command.hpp"

namespace burin::session {
namespace {

const std::string kWandWorld = R"(#VRML V2.0 utf8
Transform { translation 0 0.13 0.05 children DEF Block Shape {
  appearance Appearance { material Material { diffuseColor 0.3 0.4 0.8 } }
  geometry Box { size 0.1 0.1 0.1 } } }
)";

// Pushes the bottom end against the block, leans and nods meanwhile, changes what is pressed.
const std::string kWandUse = R"(burin-input 1 test
0.05 mouse 160 100
0.1 scroll 0 6
0.2 scroll 0 6
0.5 command screenshot touched.png
0.55 button press middle ctrl+shift
0.6 mouse 180 100
0.65 button release middle ctrl+shift
0.7 command object Block colour 0.9,0.1,0.1
0.75 command object Block stiffness 300
0.8 button press middle ctrl
0.85 mouse 180 110
0.9 button release middle ctrl
1.0 command object Block felt off
1.1 command screenshot through.png
1.2 command quit
)";

}  // namespace

TEST(RecordedWand, IsDoneAgainToTheBitEditsIncluded) {
    if (!gpu::list_devices()) GTEST_SKIP() << "no Vulkan device";
    const Workplace place;
    place.write("block.wrl", kWandWorld);
    place.write("wand.toml",
                "[[point]]\nname = \"up\"\noffset = [0, 0.07, 0]\n[[point]]\nname = \"low\"\n"
                "offset = [0, -0.08, 0]\n");
    place.write("use.txt", kWandUse);
    const std::string burin = kBurinCommand;
    const auto live = place.run(burin +
                                " world block.wrl --device simulated-wand:wand.toml --points up,low --offscreen "
                                "--width 320 --height 200 --input use.txt --record live.log --outputs live");
    ASSERT_EQ(live.status, 0) << live.output;
    const std::string log = place.read("live.log");
    ASSERT_NE(log.find(" end "), std::string::npos) << "it was not recorded to its end: " << live.output;
    EXPECT_NE(log.find("--points up,low"), std::string::npos);
    const auto again = place.run(burin + " world --input live.log --offscreen --outputs again");
    ASSERT_EQ(again.status, 0) << again.output;
    for (const std::string name : {"touched.png", "through.png"}) {
        EXPECT_FALSE(place.read("live/" + name).empty()) << name;
        EXPECT_TRUE(place.read("live/" + name) == place.read("again/" + name)) << name;
    }
    EXPECT_FALSE(place.read("live/touched.png") == place.read("live/through.png")) << "the block has another colour";
}

// The ticks without force are in the recording, and so is what the device answered.
TEST(RecordedWand, WhoseAmplifiersWereOffIsDoneAgainToTheBit) {
    if (!gpu::list_devices()) GTEST_SKIP() << "no Vulkan device";
    const Workplace place;
    place.write("block.wrl", kWandWorld);
    place.write("use.txt",
                "burin-input 1 test\n0.05 mouse 160 100\n0.1 scroll 0 6\n0.2 scroll 0 6\n0.5 command amplifiers off\n"
                "0.7 command screenshot off.png\n0.8 command amplifiers on\n1.2 command screenshot on.png\n"
                "1.3 command quit\n");
    const std::string burin = kBurinCommand;
    const auto live = place.run(burin +
                                " world block.wrl --device simulated-wand --offscreen --width 320 --height 200 "
                                "--input use.txt --record live.session --outputs live");
    ASSERT_EQ(live.status, 0) << live.output;
    EXPECT_TRUE(live.output.contains("the amplifiers are off")) << live.output;
    EXPECT_TRUE(live.output.contains("the amplifiers are on")) << live.output;
    const auto again = place.run(burin + " world --input live.session --offscreen --outputs again");
    ASSERT_EQ(again.status, 0) << again.output;
    EXPECT_TRUE(again.output.contains("equal to the bit")) << again.output;
    EXPECT_FALSE(again.output.contains("amplifiers")) << "no device was asked: " << again.output;
    for (const std::string name : {"off.png", "on.png"}) {
        EXPECT_FALSE(place.read("live/" + name).empty()) << name;
        EXPECT_TRUE(place.read("live/" + name) == place.read("again/" + name)) << name;
    }
    const auto table = place.run(burin + " convert live.session ticks.csv --to csv --columns cause");
    ASSERT_EQ(table.status, 0) << table.output;
    EXPECT_TRUE(place.read("ticks.csv").contains("\n1\n")) << "a tick whose force a fault of the device took";
}

}  // namespace burin::session
