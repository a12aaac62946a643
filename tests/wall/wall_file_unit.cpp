// SPDX-License-Identifier: MIT
// Wall files, and burin wall as its user meets it.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <sstream>
#include <tuple>

#include "app/walls/wall_commands.hpp"
#include "base/json.hpp"
#include "base/toml.hpp"
#include "tests/support/places.hpp"
#include "tests/support/run_command.hpp"
#include "wall/wall_file.hpp"

namespace burin::wall {
namespace {

const std::string kBurin = kBurinCommand;
const std::filesystem::path kWalls = kWallsFolder;

const std::string kSmall =
    "units = \"cm\"\n"               // 1
    "[[screen]]\n"                   // 2
    "name = \"front\"\n"             // 3
    "lower_left = [-100, 0, 0]\n"    // 4
    "lower_right = [100, 0, 0]\n"    // 5
    "upper_left = [-100, 150, 0]\n"  // 6
    "pixels = [1200, 900]\n"         // 7
    "[viewer.fallback_head]\n"       // 8
    "position = [0, 120, 150]\n";    // 9

std::string with_text(const std::string& from, const std::string& to) {
    std::string text = kSmall;
    return text.replace(text.find(from), from.size(), to);
}

void expect_refused(const std::string& text, const std::vector<std::string>& parts) {
    const auto setup = parse_wall(text, "w.toml");
    ASSERT_FALSE(setup) << text;
    EXPECT_FALSE(setup.error().remedy.empty()) << setup.error().line();
    for (const std::string& part : parts) {
        EXPECT_NE(setup.error().line().find(part), std::string::npos)
            << "expected '" << part << "' in: " << setup.error().line();
    }
}

// A wall of 2 by 1.5 m that stands 40 mm nearer than the file says, and leans back by 2 degrees; centimetres.
std::string touches(int wrong = -1) {
    std::ostringstream csv;
    csv << "place,x,y,z\n# the tracker's frame, cm\n";
    int row = 0;
    const double c = std::cos(0.0349), s = std::sin(0.0349);
    for (const auto& [place, u, v] :
         {std::tuple{"lower_left", -1, 0}, {"lower_right", 1, 0}, {"upper_left", -1, 1}, {"upper_right", 1, 1}}) {
        for (const double e : {-0.05, 0.0, 0.05}) {
            csv << place << ',' << 100 * u + e << ", " << 150 * v * c - e << ','
                << 4 - 150 * v * s + (row == wrong ? 20.0 : e) << '\n';
            ++row;
        }
    }
    return csv.str();
}

}  // namespace

TEST(WallFile, ReadsEveryWallThatComesWithBurinAndNothingIsWrongWithThem) {
    int count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(kWalls)) {
        if (entry.path().extension() != ".toml") continue;
        const auto setup = read_wall(entry.path());
        ASSERT_TRUE(setup) << setup.error().line();
        for (const WallProblem& p : check(*setup)) ADD_FAILURE() << entry.path() << ": " << line_of(p);
        ++count;
    }
    EXPECT_EQ(count, 3);
}

TEST(WallFile, GivesThePowerWallInMetres) {
    const auto setup = read_wall(kWalls / "powerwall.toml");
    ASSERT_TRUE(setup) << setup.error().line();
    const Screen s = screen_world(*setup, setup->screens.at(0));
    EXPECT_NEAR(s.lower_right_world.x - s.lower_left_world.x, 3.048, 1e-12);
    EXPECT_NEAR(s.upper_left_world.y, 2.286, 1e-12);
    EXPECT_EQ(setup->timing.refresh_Hz, 120.0);
    EXPECT_EQ(setup->timing.eye_order, EyeOrder::left_first);
}

// A calibrated wall is written again; its tracker's description is no business of the wall's, and stays.
TEST(WallFile, WritingAndReadingKeepsTheTrackersTable) {
    const std::string tracker =
        "[tracker]\naddress = \"vrpn:a\"\nunits = \"m\"\n[tracker.head]\nbody = \"Glasses\"\n[[tracker.wand]]\n"
        "body = \"Stick/1\"\nposition = [0.1, -2, 1e-3]\n'odd \"key' = {mm = 0.25, on = true, day = 2026-01-02}\n";
    const auto setup = parse_wall(wall_text(*read_wall(kWalls / "desk.toml")) + tracker, "w");
    ASSERT_TRUE(setup) << setup.error().line();
    const auto again = parse_wall(wall_text(*setup), "w");
    ASSERT_TRUE(again) << again.error().line();
    EXPECT_EQ(again->tracker_toml, setup->tracker_toml);
    EXPECT_EQ(toml::parse(again->tracker_toml), toml::parse(tracker));
    EXPECT_FALSE(wall_text(*read_wall(kWalls / "desk.toml")).contains("[tracker]"));
}

TEST(WallFile, WritingAndReadingKeepsEverySetting) {
    WallSetup odd = *read_wall(kWalls / "cave.toml");
    odd.unit = LengthUnit::ft;
    odd.name = "a \"quoted\" \\ name";
    odd.world_from_tracker = {{1.0 / 3.0, -2, 0.1}, glm::normalize(Quat{0.3, 0.1, -0.7, 0.2})};
    odd.screens[1].homography = {{{0.9, 1.0 / 3.0, 0}, {0.01, 0.8, 1e-5}, {0.1, 0, 1}}};
    odd.screens[1].blend = {0.1, 0.2, 0.03, 0.04, 1.8};
    odd.screens[1].swap_eyes = true;
    odd.screens[2].output = "DP-1";
    odd.screens[2].direct = DisplayStereo::inband_displayport;
    odd.screens[3].direct = DisplayStereo::none;
    odd.budget = {1.25, 0.75};
    odd.timing = {96.0, EyeOrder::right_first};
    const std::string text = wall_text(odd);
    const auto read = parse_wall(text, "odd");
    ASSERT_TRUE(read) << read.error().line();
    EXPECT_EQ(wall_text(*read), text);
    EXPECT_EQ(read->name, odd.name);
    EXPECT_EQ(read->unit, odd.unit);
    EXPECT_LT(glm::length(read->world_from_tracker.position_m - odd.world_from_tracker.position_m), 1e-11);
    EXPECT_EQ(read->world_from_tracker.orientation, odd.world_from_tracker.orientation);
    ASSERT_EQ(read->screens.size(), odd.screens.size());
    for (std::size_t i = 0; i < odd.screens.size(); ++i) {
        const WallScreen &a = odd.screens[i], &b = read->screens[i];
        EXPECT_EQ(a.name, b.name);
        EXPECT_LT(glm::length(a.upper_left_tracker - b.upper_left_tracker), 1e-11);
        EXPECT_LT(glm::length(a.lower_left_tracker - b.lower_left_tracker), 1e-11);
        EXPECT_LT(glm::length(a.lower_right_tracker - b.lower_right_tracker), 1e-11);
        EXPECT_EQ(a.pixels, b.pixels);
        EXPECT_EQ(a.output, b.output);
        EXPECT_EQ(a.direct, b.direct);
        EXPECT_EQ(a.mode, b.mode);
        EXPECT_EQ(a.swap_eyes, b.swap_eyes);
        EXPECT_EQ(a.homography, b.homography);
        EXPECT_EQ(a.blend.left, b.blend.left);
        EXPECT_EQ(a.blend.bottom, b.blend.bottom);
        EXPECT_EQ(a.blend.gamma, b.blend.gamma);
    }
    EXPECT_LT(glm::length(read->eyes.left_sensor - odd.eyes.left_sensor), 1e-11);
    EXPECT_LT(glm::length(read->fallback_head_tracker.position_m - odd.fallback_head_tracker.position_m), 1e-11);
    EXPECT_EQ(read->budget.crossed_deg, 1.25);
    EXPECT_EQ(read->timing.refresh_Hz, 96.0);
    EXPECT_EQ(read->timing.eye_order, EyeOrder::right_first);
}

TEST(WallFile, RefusesWhatItDoesNotUnderstandByLineWithTheRemedy) {
    ASSERT_TRUE(parse_wall(kSmall, "w.toml"));
    expect_refused(with_text("pixels", "pixles"), {"w.toml:7", "pixles", "did you mean pixels?"});
    expect_refused(with_text("units", "unit"), {"w.toml", "units"});
    expect_refused(with_text("\"cm\"", "\"yd\""), {"w.toml:1", "yd", "ft"});
    expect_refused(with_text("\"cm\"", "3"), {"w.toml:1", "quotes"});
    expect_refused(with_text("[-100, 0, 0]", "[-100, 0]"), {"w.toml:4", "3 numbers"});
    expect_refused(with_text("[-100, 0, 0]", "[-100, 0, nan]"), {"w.toml:4", "3 numbers"});
    expect_refused(with_text("[-100, 0, 0]", "[-100, 0,"), {"w.toml:", "not TOML"});
    expect_refused(with_text("lower_left = [-100, 0, 0]\n", ""), {"w.toml:2", "lower_left"});
    expect_refused(with_text("[1200, 900]", "[1200.5, 900]"), {"w.toml:7", "whole"});
    expect_refused(with_text("[[screen]]", "[screen]"), {"w.toml:", "[[screen]]"});
    expect_refused("units = \"m\"\n", {"w.toml", "[[screen]]"});
    expect_refused("", {"w.toml", "units"});
    expect_refused(kSmall + "[comfort]\ncrossed = 1\n", {"w.toml:11", "crossed_deg"});
    expect_refused(kSmall + "[display]\neye_order = \"both\"\n", {"w.toml:11", "left-first"});
    expect_refused(kSmall + "orientation = [0, 0, 0, 0]\n", {"w.toml:10", "no length"});
    expect_refused(
        "units = \"m\"\nzebra = 1\n[[screen]]\nlower_left=[0,0,0]\nlower_right=[1,0,0]\nupper_left=[0,1,0]\n",
        {"w.toml:2", "zebra", "its keys are"});
    expect_refused(with_text("name = \"front\"", "output = -1"), {"w.toml:3", "output"});
    expect_refused(with_text("pixels", "direct = \"hdmi\"\npixels"),
                   {"w.toml:7", "hdmi-3d", "onboard-din", "inband-displayport", "plain"});
    expect_refused(with_text("pixels", "direct = true\npixels"), {"w.toml:7", "quotes"});
    expect_refused(with_text("name = \"front\"", "swap_eyes = 1"), {"w.toml:3", "true or false"});
    expect_refused(with_text("name = \"front\"", "homography = [[1, 0, 0], [0, 1, 0]]"), {"w.toml:3", "homography"});
    expect_refused(with_text("[viewer.fallback_head]", "[viewer]\nleft_eye = [0, 0, 0]\n[viewer.fallback_head]"),
                   {"w.toml:8", "right_eye"});
    expect_refused("[[[", {"w.toml:1"});
    expect_refused(std::string(3000, '['), {"w.toml:1"});
}

TEST(WallCommand, ShowsChecksAndDraws) {
    Workplace place;
    const auto shown =
        place.run(kBurin + " wall show '" + (kWalls / "powerwall.toml").string() + "' --svg w.svg --json w.json");
    EXPECT_EQ(shown.status, 0) << shown.output;
    EXPECT_NE(shown.output.find("3.048 m, 2.286 m"), std::string::npos) << shown.output;
    const auto figures = Json::parse(place.read("w.json"));
    EXPECT_NEAR(figures["screens"][0]["viewing_distance_m"].get<double>(), 6.56 * 0.3048, 1e-9);
    EXPECT_NEAR(figures["screens"][0]["pixel_mm"][0].get<double>(), 3048.0 / 1440.0, 1e-9);
    EXPECT_NEAR(figures["screens"][0]["nearest_comfortable_m"].get<double>(), 0.99, 0.01);
    EXPECT_NE(place.read("w.svg").find("</svg>"), std::string::npos);
    EXPECT_EQ(place.run(kBurin + " wall check '" + (kWalls / "cave.toml").string() + "'").status, 0);

    place.write("bad.toml", with_text("[-100, 150, 0]", "[0, 0, 0]"));
    const auto bad = place.run(kBurin + " wall check bad.toml");
    EXPECT_EQ(bad.status, 1) << bad.output;
    EXPECT_NE(bad.output.find("front"), std::string::npos);
    EXPECT_NE(bad.output.find("on a line"), std::string::npos) << bad.output;
    place.write("mode.toml", with_text("pixels", "mode = \"shutter\"\npixels"));
    EXPECT_EQ(place.run(kBurin + " wall check mode.toml").status, 1);
    place.write("wide.toml", with_text("[-100, 150, 0]", "[-100, 1e30, 0]"));
    EXPECT_LT(place.run(kBurin + " wall show wide.toml --svg wide.svg").output.size(), 1u << 20);
    EXPECT_LT(place.read("wide.svg").size(), 1u << 20) << "a line for every few metres";
    EXPECT_EQ(place.run(kBurin + " wall").status, 2);
    const auto missing = place.run(kBurin + " wall show none.toml");
    EXPECT_EQ(missing.status, 1);
    EXPECT_NE(missing.output.find("none.toml"), std::string::npos);
}

TEST(WallCommand, ChecksAndShowsADisplayDrivenDirectly) {
    Workplace place;
    const auto check = [&](const std::string& keys) {
        place.write("w.toml", with_text("pixels", keys + "\npixels"));
        return place.run(kBurin + " wall check w.toml");
    };
    const auto sound = check("direct = \"hdmi-3d\"\nmode = \"two_layers\"");
    EXPECT_EQ(sound.status, 0) << sound.output;
    const auto shown = place.run(kBurin + " wall show w.toml --json w.json");
    EXPECT_NE(shown.output.find("0, two_layers, driven directly: hdmi-3d"), std::string::npos) << shown.output;
    const auto figures = Json::parse(place.read("w.json"));
    EXPECT_EQ(figures["screens"][0]["direct"].get<std::string>(), "hdmi-3d");
    EXPECT_EQ(check("direct = \"plain\"\nmode = \"frame_sequential\"").status, 0);
    for (const auto& [keys, part] :
         {std::pair{"direct = \"hdmi-3d\"\nmode = \"side_by_side\"", "separates two pictures"},
          {"direct = \"onboard-din\"", "mode mono has one"},
          {"direct = \"plain\"\nmode = \"two_layers\"", "hdmi-3d"},
          {"direct = \"plain\"\nmode = \"two_windows\"", "without windows"}}) {
        const auto refused = check(keys);
        EXPECT_EQ(refused.status, 1) << keys;
        EXPECT_NE(refused.output.find("error: front: "), std::string::npos) << refused.output;
        EXPECT_NE(refused.output.find(part), std::string::npos) << refused.output;
    }
}

TEST(WallCommand, CalibratesAScreenFromTouchesAndTellsTheResiduals) {
    Workplace place;
    place.write("wall.toml", kSmall);
    place.write("touches.csv", touches());
    const std::string start = kBurin + " wall calibrate --wall wall.toml --samples touches.csv --screen front ";
    const auto outcome = place.run(start + "--out new.toml --json r.json");
    ASSERT_EQ(outcome.status, 0) << outcome.output;
    EXPECT_EQ(place.read("wall.toml"), kSmall) << "the old file was not to be touched";
    const auto setup = parse_wall(place.read("new.toml"), "new.toml");
    ASSERT_TRUE(setup) << setup.error().line();
    EXPECT_NEAR(setup->screens[0].lower_left_tracker.z, 0.04, 1e-4);
    EXPECT_NEAR(setup->screens[0].upper_left_tracker.z, 0.04 - 1.5 * std::sin(0.0349), 1e-4);
    EXPECT_EQ(setup->screens[0].pixels, (std::array{1200, 900}));
    const auto residuals = Json::parse(place.read("r.json"));
    EXPECT_GT(residuals["before_rms_mm"].get<double>(), 20.0);
    EXPECT_LT(residuals["rms_mm"].get<double>(), 1.0);
    // In place, with one touch that went wrong and is named.
    place.write("touches.csv", touches(4));
    const auto again = place.run(start + "--out wall.toml");
    ASSERT_EQ(again.status, 0) << again.output;
    EXPECT_NE(again.output.find("set aside: sample 5 (lower_right)"), std::string::npos) << again.output;
    EXPECT_NEAR(parse_wall(place.read("wall.toml"), "")->screens[0].lower_left_tracker.z, 0.04, 1e-3);
    EXPECT_EQ(place.files(), 4u) << "something was left behind";
}

TEST(WallCommand, LeavesTheWallFileAloneWhenItCannotCalibrate) {
    Workplace place;
    place.write("wall.toml", kSmall);
    const auto refused = [&](const std::string& csv, const std::string& arguments, const std::string& part) {
        place.write("touches.csv", csv);
        const auto outcome =
            place.run(kBurin + " wall calibrate --wall wall.toml --samples touches.csv --out wall.toml " + arguments);
        EXPECT_EQ(outcome.status, 1) << outcome.output;
        EXPECT_NE(outcome.output.find(part), std::string::npos) << outcome.output;
        EXPECT_EQ(place.read("wall.toml"), kSmall);
    };
    refused(touches(), "--screen back", "its screens are front");
    refused("lower_left,0,0,0\nlower_right,100,0,0\n", "--screen front", "three corners");
    refused("lower_left,0,0\n", "--screen front", "touches.csv:1");
    refused("lower_left,0,0,x\n", "--screen front", "touches.csv:1");
    refused("middle,0,0,0\n", "--screen front", "upper_right");
    // Left and right exchanged while touching: a mirrored screen.
    std::string mirrored = touches();
    for (std::size_t at = 0; (at = mirrored.find("lower_", at)) != std::string::npos; at += 6) {
        const bool left = mirrored.compare(at + 6, 4, "left") == 0;
        mirrored.replace(at + 6, left ? 4 : 5, left ? "right" : "left");
    }
    for (std::size_t at = 0; (at = mirrored.find("upper_", at)) != std::string::npos; at += 6) {
        const bool left = mirrored.compare(at + 6, 4, "left") == 0;
        mirrored.replace(at + 6, left ? 4 : 5, left ? "right" : "left");
    }
    refused(mirrored, "--screen front", "exchanged");
}

std::string with_ends(const std::string& text, const std::string& end) {
    std::string result;
    for (const char c : text) result += c == '\n' ? end : std::string(1, c);
    return result;
}

TEST(WallFile, IsReadAfterAByteOrderMarkAndWithAnyLineEnds) {
    const Workplace place;
    for (const std::string mark : {"", "\xEF\xBB\xBF"}) {
        for (const std::string end : {"\n", "\r\n", "\r"}) {
            place.write("wall.toml", mark + with_ends(kSmall, end));
            const auto setup = read_wall(place / "wall.toml");
            ASSERT_TRUE(setup) << setup.error().line();
            EXPECT_EQ(wall_text(*setup), wall_text(*parse_wall(kSmall, "small")));
            place.write("wall.toml", mark + with_ends("units = \"m\"\n\n= 3\n", end));
            EXPECT_NE(read_wall(place / "wall.toml").error().line().find("wall.toml:3: "), std::string::npos);
        }
    }
    place.write("wall.toml", std::string("\xFE\xFF\0u\0n", 6));
    EXPECT_NE(read_wall(place / "wall.toml").error().line().find("is UTF-16 text; save it as UTF-8"),
              std::string::npos);
}

TEST(WallCommand, ReadsTouchesAfterAByteOrderMarkAndWithAnyLineEnds) {
    const Workplace place;
    place.write("wall.toml", kSmall);
    const auto calibrated = [&](const std::string& bytes, const std::string& samples) {
        place.write("touches.csv", bytes);
        const auto outcome = place.run(kBurin + " wall calibrate --wall wall.toml --screen front --out new.toml " +
                                       "--samples " + samples);
        return outcome.status == 0 ? place.read("new.toml") : outcome.output;
    };
    const std::string wanted = calibrated(touches(), "touches.csv");
    ASSERT_TRUE(parse_wall(wanted, "new.toml")) << wanted;
    for (const std::string end : {"\n", "\r\n", "\r"})
        EXPECT_EQ(calibrated("\xEF\xBB\xBF" + with_ends(touches(), end), "touches.csv"), wanted);
    EXPECT_NE(calibrated(std::string("l\0o\0", 4), "touches.csv").find("is UTF-16 text; save it as UTF-8"),
              std::string::npos);
}

TEST(WallCommand, ReadsTouchesWithSemicolonsOrTabsBetweenThem) {
    const std::string commas = "place,x,y,z\nlower_left,-5,0,0\nlower_right,5,0,0.25\n";
    std::string semicolons = commas, tabs = commas;
    std::ranges::replace(semicolons, ',', ';');
    std::ranges::replace(tabs, ',', '\t');
    for (const std::string& text : {commas, semicolons, tabs, "sep=;\n" + semicolons,
                                    std::string("\"lower_left\",\"-5\",0,0\nlower_right;5;0;0.25\n"),
                                    std::string("lower_left,-5,\t0,0\t\nlower_right,5,0,0.25\n")}) {
        const auto samples = app::parse_samples(text, "touches.csv", 0.01);
        ASSERT_TRUE(samples) << text << samples.error().line();
        ASSERT_EQ(samples->size(), 2u) << text;
        EXPECT_EQ((*samples)[0].place, "lower_left");
        EXPECT_EQ((*samples)[0].tip_tracker, (Vec3{-0.05, 0.0, 0.0}));
        EXPECT_EQ((*samples)[1].tip_tracker, (Vec3{0.05, 0.0, 0.0025}));
    }
    const auto decimal_commas = app::parse_samples("lower_left;-5,0;0,0;0,0\n", "touches.csv", 0.01);
    ASSERT_FALSE(decimal_commas);
    EXPECT_NE(decimal_commas.error().line().find("decimal point"), std::string::npos) << decimal_commas.error().line();
}

TEST(WallCommand, AsksForTouchAfterTouch) {
    std::istringstream in("1,2,3\nnonsense\n4,5,6\n\n7,8,9\nupper_right,0,0,1\n10,11,12\ndone\n1,1,1\n");
    std::ostringstream prompts;
    const auto samples = app::guided_samples(in, prompts, 0.01);
    ASSERT_EQ(samples.size(), 5u);
    EXPECT_EQ(samples[2].place, "lower_left");
    EXPECT_EQ(samples[2].tip_tracker, (Vec3{0.07, 0.08, 0.09}));
    EXPECT_EQ(samples[3].place, "upper_right");
    EXPECT_EQ(samples[4].place, "lower_right") << "the next corner, after three touches";
    std::istringstream marked(
        "\xEF\xBB\xBF"
        "1,2,3\r\ndone\r\n");
    EXPECT_EQ(app::guided_samples(marked, prompts, 0.01).size(), 1u) << "a file with a byte-order mark came by a pipe";
    EXPECT_NE(prompts.str().find("touch lower_right with the wand's tip, 1 of 3"), std::string::npos) << prompts.str();
    EXPECT_NE(prompts.str().find("is not a sample"), std::string::npos);
}

TEST(WallFile, ReadsEyesByTheirMiddleAndDistanceInTheFilesUnit) {
    const auto viewer = [](const std::string& keys) {
        return parse_wall(with_text("[viewer.fallback_head]", "[viewer]\n" + keys + "\n[viewer.fallback_head]"),
                          "w.toml");
    };
    const auto by_middle =
        viewer("middle_of_eyes = [1, -8, 5]\ninterpupillary_m = 0.06");  // centimetres, but for the distance
    ASSERT_TRUE(by_middle) << by_middle.error().line();
    EXPECT_LT(glm::length(by_middle->eyes.left_sensor - Vec3(-0.02, -0.08, 0.05)), 1e-12);
    EXPECT_LT(glm::length(by_middle->eyes.right_sensor - Vec3(0.04, -0.08, 0.05)), 1e-12);
    const auto one_by_one = viewer("left_eye = [-2, -8, 5]\nright_eye = [4, -8, 5]");
    ASSERT_TRUE(one_by_one) << one_by_one.error().line();
    EXPECT_LT(glm::length(one_by_one->eyes.left_sensor - by_middle->eyes.left_sensor), 1e-12);
    EXPECT_LT(glm::length(one_by_one->eyes.right_sensor - by_middle->eyes.right_sensor), 1e-12);
    EXPECT_LT(glm::length(by_middle->fallback_head_tracker.position_m - Vec3(0.0, 1.2, 1.5)), 1e-12);
}

TEST(WallFile, RefusesEyesThatAreGivenInTwoWays) {
    const auto eyes = [](const std::string& keys) {
        return with_text("[viewer.fallback_head]", "[viewer]\n" + keys + "\n[viewer.fallback_head]");
    };
    const std::string both = "left_eye = [-3, 0, 0]\nright_eye = [3, 0, 0]\n";
    ASSERT_TRUE(parse_wall(eyes(both), "w.toml"));
    expect_refused(eyes(both + "interpupillary_m = 0.06"), {"left_eye", "interpupillary_m"});
    expect_refused(eyes(both + "middle_of_eyes = [0, 0, 0]"), {"left_eye", "middle_of_eyes"});
}

}  // namespace burin::wall
