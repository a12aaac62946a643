// SPDX-License-Identifier: MIT
// Descriptions of wands: the one that comes with Burin, and what is wrong with others.
#include "devices/haptic/wand_file.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "base/file_io.hpp"
#include "devices/haptic/wand_choice.hpp"

namespace burin::devices {
namespace {

// Returns the problems of a text as lines, joined.
std::string problems_of(const std::string& text) {
    const WandOrProblems wand = parse_wand(text, "w.toml");
    std::string lines;
    if (!wand)
        for (const Error& problem : wand.error()) lines += problem.line() + "\n";
    return lines;
}

bool reports(const std::string& text, const std::string& said) {
    const std::string problems = problems_of(text);
    if (problems.find(said) != std::string::npos) return true;
    ADD_FAILURE() << "said: " << problems;
    return false;
}

}  // namespace

// W2, W3 and W5 of the thesis, written out.
TEST(WandFile, TheQuanserWandIsTheOneOfTheThesis) {
    const Result<WandDescription> wand = read_wand("assets/devices/quanser-wand.toml");
    ASSERT_TRUE(wand) << wand.error().line();
    EXPECT_EQ(wand->workspace_maker_m.lo, Vec3(-0.240, 0.085, -0.215));
    EXPECT_EQ(wand->workspace_maker_m.hi, Vec3(0.240, 0.335, 0.235));
    EXPECT_EQ(wand->max_force_maker_N, Vec3(2.3, 2.1, 3.0));
    EXPECT_EQ(wand->max_torque_maker_Nm, Vec3(0.230, 0.0, 0.250));
    EXPECT_NEAR(wand->highest_turn_rad.x, 1.13446, 1e-5);
    EXPECT_NEAR(wand->highest_turn_rad.z, 1.48353, 1e-5);
    ASSERT_EQ(wand->points.size(), 2u);
    EXPECT_EQ(wand->points[0].name, "top");
    EXPECT_EQ(wand->points[1].offset_m, Vec3(0.0, -0.08, 0.0));
    EXPECT_EQ(wand->calibration.maker_from_handle.position_m, Vec3(0.0, 0.0, 0.123));
    EXPECT_EQ(*wand, WandDescription{}) << "what simulated-wand is without a file";
}

TEST(WandFile, AnEmptyFileIsTheQuanserWand) {
    const WandOrProblems wand = parse_wand("", "w.toml");
    ASSERT_TRUE(wand);
    EXPECT_EQ(*wand, WandDescription{});
}

TEST(WandFile, TheBoxIsCentredInTheDeviceFrameAndStandsWhereItWasInTheScene) {
    const WandOrProblems wand = parse_wand("[frame]\nposition = [1, 2, 3]\ngain = 2\n", "w.toml");
    ASSERT_TRUE(wand);
    EXPECT_EQ(device_of(*wand).workspace_m, Vec3(0.48, 0.335 - 0.085, 0.235 + 0.215));
    const Vec3 in_maker(0.1, 0.2, -0.05);
    const Vec3 in_scene = scene_from_device(*wand) * (device_from_maker(*wand) * in_maker);
    EXPECT_LT(glm::length(in_scene - (Vec3(1, 2, 3) + 2.0 * in_maker)), 1e-15);
}

TEST(WandFile, TheTableOfTheThesisIsASetting) {
    const WandOrProblems wand = parse_wand("[torque]\ndriven = [\"x\", \"y\"]\nlimit = [0.23, 0.25]\n", "w.toml");
    ASSERT_TRUE(wand);
    EXPECT_EQ(device_of(*wand).max_torque_Nm, Vec3(0.23, 0.25, 0.0));
}

// A maker that counts z up and y away from the user.
TEST(WandFile, AxesAreTakenIntoTheDevicesOwn) {
    const WandOrProblems wand = parse_wand(
        "[frame]\naxes = [\"x\", \"z\", \"-y\"]\n[workspace]\nlowest = [-0.1, 0.2, 0.3]\nhighest = [0.1, 0.6, 0.5]\n"
        "lowest_turn = [-10, -20, 0]\nhighest_turn = [30, 40, 0]\n[force]\nlimit = [1, 2, 3]\n"
        "[torque]\ndriven = [\"x\", \"y\"]\nlimit = [0.1, 0.2]\n",
        "w.toml");
    ASSERT_TRUE(wand) << wand.error().front().line();
    const DeviceDescription device = device_of(*wand);
    EXPECT_LT(glm::length(device.workspace_m - Vec3(0.2, 0.2, 0.4)), 1e-15);
    EXPECT_EQ(device.axis_max_force_N, Vec3(1.0, 3.0, 2.0));
    EXPECT_EQ(device.max_torque_Nm, Vec3(0.1, 0.0, 0.2));
    EXPECT_LT(glm::length(device.lowest_turn_rad / kDegree_rad - Vec3(-10.0, 0.0, -40.0)), 1e-12);
    EXPECT_LT(glm::length(device.highest_turn_rad / kDegree_rad - Vec3(30.0, 0.0, 20.0)), 1e-12);
    // The device's y is the maker's z, by the map and by the rotation alike.
    const Pose to_device = device_from_maker(*wand);
    const Vec3 some(0.3, -0.2, 0.7);
    EXPECT_LT(glm::length(to_device.orientation * some - device_axes(wand->axes, some)), 1e-15);
    EXPECT_LT(glm::length(to_device * Vec3(0.0, 0.4, 0.4)), 1e-15) << "the middle of the workspace";
    EXPECT_LT(glm::length(scene_from_device(*wand) * (to_device * some) - some), 1e-15);
}

TEST(WandFile, AToolMayBeHeldElsewhereAndTurned) {
    const WandOrProblems wand = parse_wand(
        "[handle]\nposition = [0, 0, 0.05]\norientation = [1, 0, 0, 1]\n[[point]]\nname = \"tip\"\noffset = [0, 0.1, "
        "0]\n",
        "w.toml");
    ASSERT_TRUE(wand);
    ASSERT_EQ(wand->points.size(), 1u);
    EXPECT_LT(glm::length(offset_device_m(*wand, wand->points[0]) - Vec3(0.0, 0.0, 0.15)), 1e-15);
}

TEST(WandFile, TellsHowFarTheHandleIsFromItsJig) {
    const WandDescription wand;
    const Vec3 jig_device = device_from_maker(wand) * Vec3(0.0, 0.0, 0.123);
    EXPECT_TRUE(calibration_error(wand, {jig_device}).within_tolerance);
    EXPECT_TRUE(calibration_error(wand, {jig_device, -Quat(1, 0, 0, 0)}).within_tolerance) << "the same turn";
    const CalibrationError off = calibration_error(wand, {jig_device + Vec3(0.0, 0.006, 0.0)});
    EXPECT_NEAR(off.distance_m, 0.006, 1e-12);
    EXPECT_FALSE(off.within_tolerance);
    const CalibrationError turned = calibration_error(wand, {jig_device, glm::angleAxis(0.05, Vec3(0, 0, 1))});
    EXPECT_NEAR(turned.angle_rad, 0.05, 1e-12);
    EXPECT_FALSE(turned.within_tolerance);
}

TEST(WandFile, ListsAllProblemsWithTheirLines) {
    const std::string problems = problems_of(
        "nmae = \"Wand\"\n"
        "[force]\n"
        "limit = [2.3, -2.1, 3.0]\n"
        "[torque]\n"
        "driven = [\"x\", \"roll\"]\n"
        "limit = [0.23, 0.25]\n"
        "[workspace]\n"
        "lowest = [-0.24, 0.5, -0.215]\n");
    for (const char* said :
         {"w.toml:1: the file has no key named nmae; did you mean name?", "w.toml:3: limit has -2.1 for y",
          "w.toml:5: driven has roll", "w.toml:8: lowest leaves no room along y"})
        EXPECT_NE(problems.find(said), std::string::npos) << said << "\n" << problems;
    EXPECT_EQ(std::ranges::count(problems, '\n'), 4) << problems;
}

TEST(WandFile, RefusesWhatNoWandIs) {
    EXPECT_TRUE(reports("[frame]\naxes = [\"x\", \"y\", \"y\"]\n", "does not name each of x, y and z once"));
    EXPECT_TRUE(reports("[frame]\naxes = [\"x\", \"y\", \"-z\"]\n", "is a mirror image"));
    EXPECT_TRUE(reports("[frame]\naxes = [1, 2, 3]\n", "is not a list of texts"));
    EXPECT_TRUE(reports("[torque]\ndriven = [\"x\"]\n", "[torque] has no limit"));
    EXPECT_TRUE(reports("[torque]\nlimit = [0.1]\n", "[torque] has no driven"));
    EXPECT_TRUE(reports("[torque]\ndriven = [\"x\"]\nlimit = [0]\n", "limit is 0 for x"));
    EXPECT_TRUE(reports("[torque]\ndriven = [\"x\", \"x\"]\nlimit = [1, 1]\n", "driven has x twice"));
    EXPECT_TRUE(reports("[[point]]\nname = \"a\"\noffset = [0, 0, 0]\n[[point]]\nname = \"a\"\noffset = [0, 0, 1]\n",
                        "w.toml:5: name \"a\" is another point's too"));
    EXPECT_TRUE(reports("[[point]]\nname = \"centre\"\noffset = [0, 0, 0]\n", "name is \"centre\": that is the"));
    EXPECT_TRUE(reports("[arm]\nmass = 0\n", "mass is 0; write a number from 0.001 to 100"));
    EXPECT_TRUE(reports("[arm]\ndelay = 0.1\n", "delay is 0.1"));
    EXPECT_TRUE(reports("[workspace]\nhighest_turn = [95, 0, 85]\n", "highest_turn has 95 for x"));
    EXPECT_TRUE(reports("[workspace\n", "is not TOML"));
    std::string points;
    for (std::size_t i = 0; i <= kMostWandPoints; ++i)
        points += "[[point]]\nname = \"p" + std::to_string(i) + "\"\noffset = [0, 0, 0]\n";
    EXPECT_TRUE(reports(points, "w.toml:61: is one point more than 20"));
    EXPECT_FALSE(read_wand("no-such.toml"));
}

// --points could not name such a point, or would take it for something else.
TEST(WandFile, PointsHaveNamesThatCanBeChosen) {
    const auto named = [](const std::string& name) {
        return "[[point]]\nname = \"" + name + "\"\noffset = [0, 0, 0]\n";
    };
    EXPECT_TRUE(reports(named(""), "w.toml:2: name is \"\": nothing stands there; name it by a word"));
    EXPECT_TRUE(reports(named("  "), "nothing stands there"));
    EXPECT_TRUE(reports(named("5"), "name is \"5\": a number says how many points touch"));
    EXPECT_TRUE(reports(named(" top"), "blanks stand around it"));
    EXPECT_TRUE(reports(named("a,b"), "a comma separates names"));
    EXPECT_TRUE(reports(named("a\\tb"), "it holds control characters"));
    EXPECT_EQ(problems_of(named("5th")), "");
    EXPECT_EQ(problems_of(named("ring finger")), "");
    EXPECT_TRUE(reports("[[point]]\noffset = [0, 0, 0]\n", "[[point]] has no name"));
}

TEST(WandFile, TheListOfKeysIsWhole) {
    EXPECT_TRUE(reports("something-quite-different = 1\n", "handle, point, calibration, arm"));
    EXPECT_TRUE(reports("[torque]\nwhatever-it-may-be = 1\n", "its keys are driven, limit"));
}

TEST(WandFile, APointIsChosenOnce) {
    const WandDescription wand;
    const auto refused = [&](const std::string& text) {
        const auto points = points_named(wand, text);
        return points ? "" : points.error().line();
    };
    EXPECT_EQ(refused("top,centre,bottom"), "");
    EXPECT_TRUE(refused("top,top").contains("names top twice")) << refused("top,top");
    EXPECT_TRUE(refused("centre,bottom,centre").contains("names centre twice"));
    for (const char* wrong : {"0", "05", "21", "99999999999999999999999"})
        EXPECT_TRUE(refused(wrong).contains("write a number from 1 to 20")) << wrong << ": " << refused(wrong);
}

// A description names its ends as it likes.
TEST(WandFile, WhereNothingIsSaidItsOwnPointsTouch) {
    WandDescription wand;
    EXPECT_EQ(usual_points(wand), "top,bottom");
    wand.points.push_back({"grip", Vec3(0.0)});
    EXPECT_EQ(usual_points(wand), "top,bottom");
    wand.points = {{"tip", {0.0, 0.08, 0.0}}, {"grip", Vec3(0.0)}, {"tail", {0.0, -0.08, 0.0}}};
    EXPECT_EQ(usual_points(wand), "tip,grip,tail");
    wand.points.clear();
    EXPECT_EQ(usual_points(wand), "centre");
}

// A byte changed, removed or doubled anywhere: what is still read is a wand that a loop can run.
TEST(WandFile, DamagedFilesAreRefusedOrGiveAWandThatCanBe) {
    const Result<std::string> whole = read_text_file("assets/devices/quanser-wand.toml");
    ASSERT_TRUE(whole);
    std::mt19937 random(11);
    const std::string bytes = "0123456789.-[]\"= \n#exyz";
    int accepted = 0;
    for (int i = 0; i < 3000; ++i) {
        std::string text = *whole;
        const std::size_t at = random() % text.size(), kind = random() % 3, which = random() % bytes.size();
        if (kind == 0) text[at] = bytes[which];
        if (kind == 1) text.erase(at, 1);
        if (kind == 2) text.insert(at, 1, bytes[which]);
        const WandOrProblems wand = parse_wand(text, "w.toml");
        if (!wand) {
            for (const Error& problem : wand.error()) EXPECT_FALSE(problem.what.empty() || problem.where.empty());
            continue;
        }
        ++accepted;
        const DeviceDescription device = device_of(*wand);
        for (int axis = 0; axis < 3; ++axis) {
            EXPECT_GT(device.workspace_m[axis], 0.0);
            EXPECT_GT(device.axis_max_force_N[axis], 0.0);
            EXPECT_GE(device.max_torque_Nm[axis], 0.0);
        }
        EXPECT_GT(device.apparent_mass_kg, 0.0);
        EXPECT_GT(device.apparent_inertia_kgm2, 0.0);
        EXPECT_LE(wand->points.size(), kMostWandPoints);
        EXPECT_NEAR(glm::length(scene_from_device(*wand).orientation), 1.0, 1e-12);
    }
    EXPECT_GT(accepted, 500) << "damage in a comment does no harm";
}

TEST(WandFile, ACardHasAName) { EXPECT_TRUE(reports("[mechanism]\ncard = \"\"\n", "card is empty")); }

TEST(WandFile, EachAmplifierHasAnOutputOfItsOwn) {
    EXPECT_TRUE(reports("[mechanism]\nenable_lines = [0, 1, 2, 3, 16, 16]\n", "has 16 twice"));
    EXPECT_TRUE(reports("[mechanism]\nenable_lines = [0, 1, 2, 3, 16, 17.5]\n", "has 17.5"));
    EXPECT_EQ(problems_of("[mechanism]\nenable_lines = [5, 4, 3, 2, 1, 0]\n"), "");
}

}  // namespace burin::devices
