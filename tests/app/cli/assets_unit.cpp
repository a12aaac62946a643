// SPDX-License-Identifier: MIT
// Files that come with the program are found from any folder, by name.
#include <gtest/gtest.h>

#include "tests/support/places.hpp"
#include "tests/support/run_command.hpp"

namespace burin::app {
namespace {

std::string burin_command(const std::string& arguments) { return std::string(kBurinCommand) + " " + arguments; }

// A command that is run with another folder of assets.
std::string with_assets(const std::string& folder, const std::string& arguments) {
    return "BURIN_ASSETS='" + folder + "' " + burin_command(arguments);
}

}  // namespace

TEST(Assets, AWorldOfTheProgramIsFoundByNameInAnyFolder) {
    const Workplace place;
    for (const char* name : {"garden", "garden.toml", "assets/worlds/garden.toml"}) {
        const auto checked = place.run(burin_command("world check " + std::string(name)));
        EXPECT_EQ(checked.status, 0) << checked.output;
        EXPECT_TRUE(checked.output.contains("mushroom")) << checked.output;
    }
    // Its settings lie beside it under the same name: the world is meant.
    const auto tube = place.run(burin_command("world check tube"));
    EXPECT_TRUE(tube.output.contains("tube.wrl")) << tube.output;
}

TEST(Assets, AFileInTheWorkingFolderGoesBeforeOneThatComesWithTheProgram) {
    const Workplace place;
    place.write("garden", "not a world");
    const auto checked = place.run(burin_command("world check garden"));
    EXPECT_EQ(checked.status, 1) << checked.output;
    // A folder can be no world: a session's outputs may have the world's name.
    std::filesystem::remove(place / "garden");
    std::filesystem::create_directory(place / "garden");
    EXPECT_EQ(place.run(burin_command("world check garden")).status, 0);
}

TEST(Assets, AMisspeltNameIsToldWithTheNamesThatThereAre) {
    const Workplace place;
    const auto refused = place.run(burin_command("world gardn"));
    EXPECT_EQ(refused.status, 2);
    for (const char* part : {"burin: ", "'gardn' is no file", "worlds: ", "garden", "tube", "/assets)"})
        EXPECT_TRUE(refused.output.contains(part)) << part << " in " << refused.output;
}

TEST(Assets, AMisspeltNameWithAHyphenIsToldToo) {
    const Workplace place;
    const auto refused = place.run(burin_command("sculpt ball:0.1 --input first-carv --offscreen"));
    EXPECT_EQ(refused.status, 2) << refused.output;
    EXPECT_TRUE(refused.output.contains("first-carve")) << refused.output;
}

TEST(Assets, AnotherFolderOfAssetsIsNamedByTheEnvironment) {
    const Workplace place;
    std::filesystem::create_directories(place / "mine/walls");
    place.write("mine/walls/flat.toml", "");
    const std::string mine = (place / "mine").string();
    const auto refused = place.run(with_assets(mine, "wall check powerwall"));
    EXPECT_EQ(refused.status, 2) << refused.output;
    EXPECT_TRUE(refused.output.contains("walls: flat (assets: " + mine)) << refused.output;
    EXPECT_EQ(place.run(burin_command("wall check powerwall")).status, 0);
    const auto version = place.run(with_assets("/nowhere", "--version"));
    EXPECT_TRUE(version.output.contains("BURIN_ASSETS names /nowhere, which is no folder")) << version.output;
}

TEST(Assets, AToolAndAWandAreFoundBehindTheirKind) {
    const Workplace place;
    const auto carved = place.run(
        burin_command("sculpt ball:0.1 --tool mesh:hex-bar --resolution 32 --stroke drawn --export part.stl"));
    EXPECT_FALSE(carved.output.contains("hex-bar: ")) << carved.output;
    EXPECT_TRUE(std::filesystem::exists(place / "part.stl")) << carved.output;
    const auto pressed = place.run(burin_command("demo wand --out w --no-pictures --wand short-wand"));
    EXPECT_TRUE(pressed.output.contains("one end alone cannot touch a face of that height")) << pressed.output;
}

TEST(Version, SaysWhatAReportOfAFaultNeeds) {
    const Workplace place;
    const auto version = place.run(burin_command("--version"));
    EXPECT_EQ(version.status, 0);
    EXPECT_TRUE(version.output.starts_with("burin 0.")) << version.output;
    for (const char* part : {"\nassets: /", "\nengines: cpu", "\ndrivers: simulated ", " falcon ", "\nlibraries: GLFW ",
                             "SQLite 3.", "libusb 1.", "Vulkan"})
        EXPECT_TRUE(version.output.contains(part)) << part << " in\n" << version.output;
}

}  // namespace burin::app
