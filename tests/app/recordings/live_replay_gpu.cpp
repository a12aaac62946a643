// SPDX-License-Identifier: MIT
// A live session by the command line: recorded into a session file, done again, drawn, and given back as a text log.
#include <gtest/gtest.h>

#include <filesystem>

#include "base/json.hpp"
#include "gpu/device.hpp"
#include "tests/support/places.hpp"
#include "tests/support/run_command.hpp"

namespace burin::app {
namespace {

const std::string kLiveBurin = kBurinCommand;

bool tells(const Workplace::Outcome& outcome, const std::string& text) {
    return outcome.output.find(text) != std::string::npos;
}

// The pictures that are named by their time.
std::size_t pictures_in(const std::filesystem::path& folder) {
    std::size_t pictures = 0;
    for (const auto& file : std::filesystem::directory_iterator(folder))
        pictures += file.path().filename().string().starts_with("000") ? 1u : 0u;
    return pictures;
}

std::size_t count_of(const std::string& text, const std::string& part) {
    std::size_t count = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
    return count;
}

}  // namespace

TEST(LiveRecording, IsDoneAgainDrawnAndGivenBackAsText) {
    if (!gpu::list_devices()) GTEST_SKIP() << "no Vulkan driver";
    const Workplace at;
    // Carves into the ball, exports and takes a picture: what a replay that compares leaves out.
    at.write("s.txt", R"(burin-input 1 test
0.02 mouse 320 180
0.05 scroll 0 15
0.1 button press left
0.12 scroll 0 10
0.3 mouse 350 190
0.35 button release left
0.36 command screenshot carved.png
0.4 command export part.stl
0.9 close
)");
    const std::string carve =
        "--workpiece ball:0.1 --resolution 32 --tool ball:0.012 --width 320 --height 240 "
        "--input s.txt --offscreen --record a.session";
    const auto recorded = at.run(kLiveBurin + " sculpt " + carve);
    ASSERT_EQ(recorded.status, 0) << recorded.output;
    EXPECT_TRUE(tells(recorded, "ticks recorded, acknowledged up to tick ")) << recorded.output;
    EXPECT_TRUE(tells(recorded, ", 0 lost")) << recorded.output;
    EXPECT_TRUE(tells(at.run(kLiveBurin + " sculpt " + carve), "never overwrites"));

    const auto again = at.run(kLiveBurin + " replay a.session --pictures seen --every 0.5");
    EXPECT_EQ(again.status, 0) << again.output;
    EXPECT_TRUE(tells(again, "equal to the bit")) << again.output;
    EXPECT_GE(pictures_in(at / "seen"), 1u) << "the first frame's, and more where frames come as often";
    EXPECT_TRUE(std::filesystem::exists(at / "seen/carved.png"));
    EXPECT_FALSE(std::filesystem::exists(at / "seen/part.stl"));

    EXPECT_EQ(at.run(kLiveBurin + " replay a.session --pictures all --every 0.2").status, 0);
    ASSERT_EQ(at.run(kLiveBurin + " convert a.session --to log a.log").status, 0);
    // In real time: a busy machine may have drawn a frame or two alone.
    EXPECT_GE(pictures_in(at / "all"), pictures_in(at / "seen"));
    if (count_of(at.read("a.log"), " saw ") >= 20) {
        EXPECT_GE(pictures_in(at / "all"), 3u);
    }
    const auto other = at.run(kLiveBurin + " replay a.session --set tool=ball:0.0121");
    EXPECT_EQ(other.status, 1);
    EXPECT_TRUE(tells(other, "equal ticks: tick ")) << other.output;
    const auto drawn = at.run(kLiveBurin + " replay a.session --set tool=ball:0.0121 --pictures other --every 0.2");
    EXPECT_EQ(drawn.status, 1);
    EXPECT_TRUE(tells(drawn, "equal ticks: tick ")) << drawn.output;
    EXPECT_EQ(pictures_in(at / "other"), pictures_in(at / "all")) << "to the end, not to the first difference";
    EXPECT_TRUE(tells(at.run(kLiveBurin + " replay a.session --set tol=1"), "no option")) << "a setting that is none";
    // What no command line takes, no replay takes either.
    for (const auto& [set, said] : std::vector<std::pair<std::string, std::string>>{
             {"width=9", "--set width=9: '9' is no whole number from 64 to 8192"},
             {"resolution=4096", "'4096' is no whole number from 16 to 2048"},
             {"samples=3", "--set samples=3: "},
             {"undo-memory=-1", "'-1' is no whole number from 1 to 1048576"},
             {"smooth-strength=nan", "'nan' is no number from 0 to 1"},
             {"friction=9", "--friction: is out of range; give a number from 0 to 2"},
             {"friction=nan", "'nan' is no number"},
             {"tool=ball:-1", "ball:-1"},
             {"hardness=stone", "--hardness stone"},
             {"shadow=off", "did you mean shadows?"},
             {"swap-eyes=maybe", "'maybe' is no value of a flag, which is on or off"},
             {"close-holes=3x", "is no value of a flag"},
             {"units=", "names no value, and the recording needs one"},
             {"first-steps=on", "is no option"},
             {"world=nowhere", "'nowhere' is no file, and not among the worlds"}}) {
        const auto refused = at.run(kLiveBurin + " replay a.session --set " + set);
        EXPECT_EQ(refused.status, 1) << set;
        EXPECT_TRUE(tells(refused, said)) << refused.output;
        EXPECT_FALSE(tells(refused, "equal")) << refused.output;
    }
    // What the command line takes, a replay takes: flags, names of assets, and options that no recording keeps. What
    // changes the view alone leaves every tick as it was, though frames are seen otherwise.
    for (const std::string set :
         {"swap-eyes=on", "swap-eyes=false", "close-holes=true", "shadows=off", "detail=full", "stereo=side-by-side",
          "width=400", "panel-scale=2", "edge-comfort=on", "friction="}) {
        const auto same = at.run(kLiveBurin + " replay a.session --set " + set);
        EXPECT_EQ(same.status, 0) << set << ": " << same.output;
        EXPECT_TRUE(tells(same, "equal to the bit")) << same.output;
        EXPECT_FALSE(tells(same, "departs")) << same.output;
    }
    for (const std::string set : {"world=garden", "workpiece=soccer_ball"}) {
        const auto elsewhere = at.run(kLiveBurin + " replay a.session --set " + set);
        EXPECT_EQ(elsewhere.status, 1) << set;
        EXPECT_TRUE(tells(elsewhere, "equal ticks: tick 1, object_from_device")) << elsewhere.output;
    }
    EXPECT_TRUE(tells(at.run(kLiveBurin + " replay a.session --to 0"), "has no ticks in this range"));

    const auto by_text = at.run(kLiveBurin + " sculpt --input a.log --offscreen --outputs text");
    EXPECT_EQ(by_text.status, 0) << by_text.output;
    const auto by_file = at.run(kLiveBurin + " sculpt --input a.session --offscreen --outputs file");
    EXPECT_EQ(by_file.status, 0) << by_file.output;
    EXPECT_TRUE(tells(by_file, "equal to the bit")) << by_file.output;
    EXPECT_EQ(at.read("text/carved.png"), at.read("file/carved.png"));
    EXPECT_EQ(at.read("text/part.stl"), at.read("file/part.stl"));
}

// A replay in another world would compare what cannot be the same; on purpose it can be tried.
TEST(LiveRecording, IsNotDoneAgainInAnotherWorldThanItWasRecordedIn) {
    if (!gpu::list_devices()) GTEST_SKIP() << "no Vulkan driver";
    const Workplace at;
    const std::string world =
        "[[object]]\nname = \"a\"\nmesh = \"tetra.off\"\nmesh_units = \"m\"\nposition = [0, 0, 0.1";
    at.write("tetra.off", "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n");
    at.write("w.toml", world + "]\n");
    at.write("use.txt", "burin-input 1 test\n0.2 close\n");
    const auto recorded =
        at.run(kLiveBurin + " world w.toml --offscreen --width 320 --height 200 --input use.txt --record a.session");
    ASSERT_EQ(recorded.status, 0) << recorded.output;
    EXPECT_EQ(at.run(kLiveBurin + " replay a.session").status, 0);
    at.write("w.toml", world + "1]\n");
    const auto other = at.run(kLiveBurin + " replay a.session");
    EXPECT_EQ(other.status, 1);
    EXPECT_TRUE(tells(other, "w.toml: is another world than the one that was recorded")) << other.output;
    EXPECT_FALSE(tells(other, "equal to the bit")) << other.output;
    const auto on_purpose = at.run(kLiveBurin + " replay a.session --set world=w.toml");
    EXPECT_TRUE(tells(on_purpose, "is another world")) << on_purpose.output;
    EXPECT_EQ(on_purpose.status, 1);
    EXPECT_TRUE(tells(on_purpose, "differs after ")) << on_purpose.output;
}

// The points of a fingertip's patch were taken for those of a handle, and other options of an activity for none at all.
TEST(LiveRecording, KeepsTheOptionsOfItsActivity) {
    if (!gpu::list_devices()) GTEST_SKIP() << "no Vulkan driver";
    const Workplace at;
    at.write("use.txt", "burin-input 1 test\n0.1 close\n");
    const std::string by = " --offscreen --width 320 --height 200 --input use.txt --record ";
    ASSERT_EQ(at.run(kLiveBurin + " hand" + by + "h.session").status, 0);
    ASSERT_EQ(at.run(kLiveBurin + " seek garden" + by + "s.session").status, 0);
    for (const std::string set : {"h.session --set points=2", "h.session --set extent=5", "s.session --set seed=2",
                                  "s.session --set targets=1"}) {
        const auto refused = at.run(kLiveBurin + " replay " + set);
        EXPECT_EQ(refused.status, 1) << set;
        EXPECT_TRUE(tells(refused, "is the activity's own, and cannot be changed")) << refused.output;
    }
}

// The command wanted again what the recording knows, and told defaults of its own as what the user had given.
TEST(LiveRecording, IsDoneAgainByItsCommandWithoutItsOptions) {
    if (!gpu::list_devices()) GTEST_SKIP() << "no Vulkan driver";
    const Workplace at;
    at.write("use.txt", "burin-input 1 test\n0.05 command do start\n0.1 close\n");
    at.write("rest.txt", "burin-input 1 test\n0.1 close\n");
    const std::string by = " --offscreen --width 320 --height 200 --record ";
    ASSERT_EQ(at.run(kLiveBurin + " seek garden --targets 2 --seed 5 --input use.txt" + by + "s.session").status, 0);
    ASSERT_EQ(at.run(kLiveBurin + " hand --points 3 --extent 4 --mesh literal --device simulated-glove:pinch " +
                     "--input rest.txt" + by + "h.session")
                  .status,
              0);
    ASSERT_EQ(at.run(kLiveBurin + " rehab ball --level 2 --input rest.txt" + by + "r.session").status, 0);
    for (const std::string again : {"seek --input s.session", "seek garden --seed 5 --input s.session",
                                    "hand --input h.session", "rehab ball --input r.session"}) {
        const auto done = at.run(kLiveBurin + " " + again + " --offscreen --outputs out");
        EXPECT_EQ(done.status, 0) << again << ": " << done.output;
        EXPECT_TRUE(tells(done, "equal to the bit")) << done.output;
        EXPECT_FALSE(tells(done, "does not count")) << done.output;
    }
    for (const std::string other : {"seek --seed 6 --input s.session", "hand --points 2 --input h.session"}) {
        const auto refused = at.run(kLiveBurin + " " + other + " --offscreen --outputs out");
        EXPECT_EQ(refused.status, 1) << other;
        EXPECT_TRUE(tells(refused, "leave out what was given otherwise")) << refused.output;
    }
    const auto elsewhere = at.run(kLiveBurin + " sculpt --input s.session --offscreen");
    EXPECT_EQ(elsewhere.status, 1);
    EXPECT_TRUE(tells(elsewhere, "burin seek --input FILE")) << elsewhere.output;
    EXPECT_EQ(at.run(kLiveBurin + " seek --input use.txt --offscreen").status, 2) << "a script names no world";
}

// The digest of a world was computed from a second reading, which told its remarks again.
TEST(LiveRecording, TellsTheRemarksOfAWorldOnce) {
    if (!gpu::list_devices()) GTEST_SKIP() << "no Vulkan driver";
    const Workplace at;
    at.write("tetra.off", "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n");
    at.write("w.toml", "[[object]]\nname = \"a\"\nmesh = \"tetra.off\"\n");
    at.write("use.txt", "burin-input 1 test\n0.2 close\n");
    const auto recorded =
        at.run(kLiveBurin + " world w.toml --offscreen --width 320 --height 200 --input use.txt --record a.session");
    ASSERT_EQ(recorded.status, 0) << recorded.output;
    EXPECT_EQ(count_of(recorded.output, "no unit that Burin knows"), 1u) << recorded.output;
    const auto again = at.run(kLiveBurin + " replay a.session");
    EXPECT_EQ(again.status, 0) << again.output;
    EXPECT_EQ(count_of(again.output, "no unit that Burin knows"), 1u) << again.output;
}

// A wand's two points, led by a script, then felt in a world from which its recording knows nothing.
TEST(LiveRecording, OfAWandIsFeltThroughAnotherWorldInBothPoints) {
    if (!gpu::list_devices()) GTEST_SKIP() << "no Vulkan driver";
    const Workplace at;
    at.write("block.wrl",
             "#VRML V2.0 utf8\nTransform { translation 0 0.13 0.05 children DEF Block Shape {\n"
             "  geometry Box { size 0.1 0.1 0.1 } } }\n");
    at.write("other.wrl",
             "#VRML V2.0 utf8\nTransform { translation 0 0.13 0.04 children DEF Other Shape {\n"
             "  geometry Box { size 0.12 0.1 0.1 } } }\n");
    at.write("wand.toml",
             "[[point]]\nname = \"up\"\noffset = [0, 0.07, 0]\n[[point]]\nname = \"low\"\n"
             "offset = [0, -0.08, 0]\n");
    // In real time: on a busy machine the wand comes to the block later, and then it is given longer.
    const std::string through = " replay a.session --through other.wrl --json r.json";
    Workplace::Outcome felt;
    for (const std::string close_s : {"1", "6", "30"}) {
        at.write("use.txt",
                 "burin-input 1 test\n0.05 mouse 160 100\n0.1 scroll 0 6\n0.2 scroll 0 6\n0.6 mouse 180 100\n" +
                     close_s + " close\n");
        std::filesystem::remove(at / "a.session");
        const auto recorded = at.run(kLiveBurin +
                                     " world block.wrl --device simulated-wand:wand.toml --offscreen "
                                     "--width 320 --height 200 --input use.txt --record a.session --outputs out");
        ASSERT_EQ(recorded.status, 0) << recorded.output;
        EXPECT_EQ(at.run(kLiveBurin + " replay a.session").status, 0);
        std::filesystem::rename(at / "wand.toml", at / "moved.toml");
        felt = at.run(kLiveBurin + through);
        ASSERT_EQ(felt.status, 0) << felt.output;
        if (Json::parse(at.read("r.json"))["figures"]["points"][1]["first_contact"] == "Other") break;
        std::filesystem::rename(at / "moved.toml", at / "wand.toml");
    }
    EXPECT_TRUE(tells(felt, "38 columns: a new derived table")) << felt.output;
    EXPECT_TRUE(tells(felt, "the proxy of up begins at the hand") && tells(felt, "the proxy of low begins at the hand"))
        << felt.output;
    const Json figures = Json::parse(at.read("r.json"))["figures"];
    EXPECT_EQ(figures["points"][1]["first_contact"], "Other") << felt.output;
    EXPECT_GT(figures["torque_max_Nm"].get<double>(), 0.0) << "the lower point is pushed, not the middle";
    const std::string bits = at.read("a.session");
    const auto twice = at.run(kLiveBurin + " replay a.session --through other.wrl");
    EXPECT_TRUE(tells(twice, "equal to the bit with the derived table that is there")) << twice.output;
    EXPECT_EQ(at.read("a.session"), bits);

    const auto none = at.run(kLiveBurin + " replay a.session");
    EXPECT_EQ(none.status, 1);
    EXPECT_TRUE(tells(none, "wand.toml: is the description of the recording's wand, and is not there")) << none.output;
    const auto moved = at.run(kLiveBurin + " replay a.session --set device=simulated-wand:moved.toml");
    EXPECT_EQ(moved.status, 0) << moved.output;
    EXPECT_TRUE(tells(moved, "equal to the bit")) << moved.output;
    at.write("wand.toml",
             "[[point]]\nname = \"up\"\noffset = [0, 0.07, 0]\n[[point]]\nname = \"low\"\n"
             "offset = [0, -0.07, 0]\n");
    const auto another = at.run(kLiveBurin + " replay a.session");
    EXPECT_EQ(another.status, 1);
    EXPECT_TRUE(tells(another, "wand.toml: is another wand than the one that was recorded")) << another.output;
}

}  // namespace burin::app
