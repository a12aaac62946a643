// SPDX-License-Identifier: MIT
// A session in real time with its threads, recorded, and the recording done again: byte for byte the same pictures.
#include <gtest/gtest.h>

#include <regex>

#include "gpu/device.hpp"
#include "tests/support/places.hpp"
#include "tests/support/run_command.hpp"

namespace burin::session {
namespace {

// Wide enough for the panel, whose plots and figures are measured.
const std::string kRecordedScript = R"(burin-input 1 test
0.05 mouse 480 270
0.1 scroll 0 15
0.4 command screenshot before.png
0.45 command toggle-frame-figures
0.5 button press left
0.55 scroll 0 8
0.7 mouse 490 272
0.8 mouse 510 275
0.85 command screenshot carving.png
0.9 mouse 530 278
1.1 command screenshot carved.png
1.15 button release left
1.3 command undo
1.35 command export undone.ply
1.5 command screenshot undone.png
1.55 button press middle
1.6 command stereo-mode anaglyph_red_cyan
1.65 mouse 600 290
1.7 button release middle
1.8 command screenshot anaglyph.png
3 command screenshot late.png
3.1 command quit
)";
const std::string kPictures[] = {"before.png", "carving.png", "carved.png", "undone.png", "anaglyph.png", "late.png"};

std::string sculpt_offscreen(const std::string& more) {
    return std::string(kBurinCommand) + " sculpt --offscreen " + more;
}

// Where the lines of the frame end that took this picture.
std::size_t end_of_frame_with(const std::string& log, const std::string& name) {
    return log.find('\n', log.find(" saw ", log.find("screenshot " + name))) + 1;
}

class Recording : public testing::Test {
protected:
    void SetUp() override {
        const auto devices = gpu::list_devices();
        if (!devices) GTEST_SKIP() << "no Vulkan device: " << devices.error().line();
        place.write("script.txt", kRecordedScript);
        for (const char* folder : {"live", "again"}) std::filesystem::create_directory(place / folder);
        live = place.run(
            sculpt_offscreen("--workpiece ball:0.1 --resolution 48 --tool ball:0.012 --width 960 --height 540 "
                             "--outputs live --input script.txt --record live.log"));
        ASSERT_EQ(live.status, 0) << live.output;
        ASSERT_NE(place.read("live.log").find(" end "), std::string::npos)
            << "it was not recorded to its end: " << live.output;
    }
    [[nodiscard]] std::string picture(const std::string& folder, const std::string& name) const {
        return place.read(folder + "/" + name);
    }

    Workplace place;
    Workplace::Outcome live;
};

}  // namespace

TEST_F(Recording, GivesThePicturesThatWereTaken) {
    // Other options than it was recorded with do not count.
    const auto again = place.run(sculpt_offscreen("--tool ball:0.03 --outputs again --input live.log"));
    ASSERT_EQ(again.status, 0) << again.output;
    EXPECT_NE(again.output.find("--tool ball:0.012"), std::string::npos) << again.output;
    for (const std::string& name : kPictures) {
        EXPECT_FALSE(picture("live", name).empty()) << name;
        EXPECT_TRUE(picture("live", name) == picture("again", name)) << name;
    }
    EXPECT_FALSE(place.read("live/undone.ply").empty());
    EXPECT_TRUE(place.read("live/undone.ply") == place.read("again/undone.ply"));
    // That pictures can tell one moment from another.
    EXPECT_TRUE(picture("live", "before.png") != picture("live", "late.png"));
}

// A cube of 50, which no line of the file says a unit of.
const std::string kPart = [] {
    std::string text;
    for (int corner = 0; corner < 8; ++corner) {
        text += "v";
        for (int axis = 0; axis < 3; ++axis) text += (corner >> axis & 1) != 0 ? " 50" : " 0";
        text += "\n";
    }
    return text + "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";
}();

// The recording holds the unit that was guessed and the tool that was taken, so that its replay does not guess.
TEST_F(Recording, OfAPartInMillimetresHoldsItsUnitAndItsTool) {
    place.write("part.obj", kPart);
    const std::string options = "--workpiece part.obj --resolution 48 --width 960 --height 540 ";
    const auto run = place.run(sculpt_offscreen(options + "--outputs live --input script.txt --record part.log"));
    ASSERT_EQ(run.status, 0) << run.output;
    EXPECT_NE(run.output.find("part.obj: 50 x 50 x 50 mm (no unit that Burin knows is given"), std::string::npos)
        << run.output;
    const std::string log = place.read("part.log");
    const std::string first = log.substr(0, log.find('\n'));
    EXPECT_NE(first.find(" --units mm"), std::string::npos) << first;
    EXPECT_NE(first.find(" --tool ball:0.0025"), std::string::npos) << first;
    const auto again = place.run(sculpt_offscreen("--outputs again --input part.log"));
    ASSERT_EQ(again.status, 0) << again.output;
    for (const std::string& name : kPictures) EXPECT_TRUE(picture("live", name) == picture("again", name)) << name;
    EXPECT_TRUE(place.read("live/undone.ply") == place.read("again/undone.ply"));
    EXPECT_NE(place.read("again/undone.ply").find("comment units mm\n"), std::string::npos);
}

// Before there were units every file was read in metres, and no recording said so.
TEST_F(Recording, WithoutAUnitIsReadInMetresAsItWasMade) {
    place.write("part.obj", kPart);
    const std::string options = "--workpiece part.obj --units m --resolution 48 --width 960 --height 540 ";
    const auto run = place.run(sculpt_offscreen(options + "--outputs live --input script.txt --record part.log"));
    ASSERT_EQ(run.status, 0) << run.output;
    std::string log = place.read("part.log");
    const std::size_t unit = log.find(" --units m");
    ASSERT_LT(unit, log.find('\n'));
    place.write("old.log", log.erase(unit, std::string(" --units m").size()));
    const auto again = place.run(sculpt_offscreen("--outputs again --input old.log"));
    ASSERT_EQ(again.status, 0) << again.output;  // every tick and surface came out as recorded
    EXPECT_TRUE(place.read("live/undone.ply") == place.read("again/undone.ply"));
}

TEST_F(Recording, FailsWhenATickGoesAnotherWay) {
    std::string log = place.read("live.log");
    // After the first picture the hand is 5 mm beside where it was, for good.
    const auto after = log.cbegin() + static_cast<std::ptrdiff_t>(end_of_frame_with(log, "before.png"));
    std::smatch quiet;  // a tick in which nothing changes
    ASSERT_TRUE(std::regex_search(after, log.cend(), quiet, std::regex(";-?[0-9]+;")));
    log.insert(static_cast<std::size_t>(quiet[0].second - log.cbegin()) - 1, "z90");
    place.write("bent.log", log);
    const auto bent = place.run(sculpt_offscreen("--outputs again --input bent.log"));
    EXPECT_EQ(bent.status, 1) << bent.output;
    EXPECT_NE(bent.output.find("departs from the recording"), std::string::npos) << bent.output;
    EXPECT_TRUE(picture("live", "before.png") == picture("again", "before.png"));  // until then all was well
    EXPECT_TRUE(picture("live", "late.png") != picture("again", "late.png"));
}

TEST_F(Recording, IsReplayedAsFarAsItGoes) {
    const std::string log = place.read("live.log");
    // In the line behind that frame. It may be lost itself: the record of a tick that an update has taken can come a
    // moment later.
    place.write("torn.log", log.substr(0, end_of_frame_with(log, "carved.png") + 5));
    const auto torn = place.run(sculpt_offscreen("--outputs again --input torn.log"));
    EXPECT_EQ(torn.status, 0) << torn.output;
    EXPECT_TRUE(picture("live", "carving.png") == picture("again", "carving.png"));
    EXPECT_TRUE(picture("again", "late.png").empty());
}

}  // namespace burin::session
