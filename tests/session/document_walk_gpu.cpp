// SPDX-License-Identifier: MIT
// A user saves, is killed in the middle of the next stroke, opens, goes on, undoes past the save and exports. With
// BURIN_DOCUMENT_PICTURES=DIR the pictures of the steps are left there (docs/sculpting.md).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "base/text.hpp"
#include "gpu/device.hpp"
#include "tests/support/places.hpp"
#include "tests/support/run_command.hpp"

namespace burin::session {
namespace {

namespace fs = std::filesystem;

// A circle over the middle of the window, begun at a time and gone through once in `round_s`.
std::string circle(double from_s, double to_s, double round_s, double radius_px) {
    const auto at = [&](double time_s) {
        const double turn = 2.0 * std::numbers::pi * (time_s - from_s) / round_s;
        return formatted("%.2f mouse %.0f %.0f\n", time_s, 317.0 + radius_px * std::cos(turn),
                         163.0 + radius_px * std::sin(turn));
    };
    std::string lines = at(from_s) + formatted("%.2f button press left\n", from_s + 0.05);
    for (double time_s = from_s + 0.1; time_s < to_s; time_s += 0.05) lines += at(time_s);
    return lines + formatted("%.2f button release left\n", to_s);
}

std::string by_time(const std::string& lines) {
    std::vector<std::string> all;
    std::istringstream in(lines);
    for (std::string line; std::getline(in, line);) all.push_back(line);
    std::ranges::stable_sort(all, {}, [](const std::string& line) { return std::stod(line); });
    std::string sorted;
    for (const std::string& line : all) sorted += line + "\n";
    return sorted;
}

class DocumentOfAKilledUser : public testing::Test {
protected:
    void SetUp() override {
        const auto devices = gpu::list_devices();
        if (!devices) GTEST_SKIP() << "no Vulkan device: " << devices.error().line();
    }
    void TearDown() override {
        const char* folder = std::getenv("BURIN_DOCUMENT_PICTURES");
        if (folder == nullptr || IsSkipped()) return;
        std::error_code ignored;
        for (const char* outputs : {"a", "b"})
            for (const auto& file : fs::directory_iterator(place / outputs, ignored))
                if (file.path().extension() == ".png")
                    fs::copy_file(file.path(), folder / file.path().filename(), fs::copy_options::overwrite_existing);
    }
    std::string session(const std::string& workpiece, const std::string& outputs, const std::string& lines) {
        place.write(outputs + ".txt", "burin-input 1 test\n" + by_time(lines));
        return std::string(kBurinCommand) + " sculpt " + workpiece + " --offscreen --journal j --outputs " + outputs +
               " --mouse surface --width 640 --height 360 --input " + outputs + ".txt";
    }
    Workplace place;
};

}  // namespace

TEST_F(DocumentOfAKilledUser, HasTheStrokeThatTheKillCutOffAndIsUndonePastTheSave) {
    const std::string saves = circle(0.3, 1.1, 1.6, 62) +
                              "1.8 command screenshot 1-saved.png\n1.8 command save work.burin\n"
                              "1.9 command export saved.ply\n";
    const std::string goes_on_for_ever = circle(3, 600, 8, 36) + "7 command screenshot 2-middle.png\n";
    // Killed when the journal was written twice more after the picture in the middle of the stroke.
    const std::string kill =
        " & burin=$!; lives() { sleep 0.02; kill -0 $burin 2>/dev/null; }; while lives && [ ! -e a/2-middle.png ]; do "
        ":; done; for i in 1 2; do was=$(stat -c %y j/*-wal); while lives && [ \"$was\" = \"$(stat -c %y j/*-wal)\" ]; "
        "do "
        ":; done; done; kill -9 $burin; wait $burin; }";
    const auto killed =
        place.run("{ " + session("ball:0.1 --resolution 96 --tool ball:0.012", "a", saves + goes_on_for_ever) + kill);
    ASSERT_EQ(killed.status, 128 + 9) << "it ended by itself: " << killed.output;

    const auto burin = [&](const std::string& command) {
        const auto done = place.run(std::string(kBurinCommand) + " " + command);
        EXPECT_EQ(done.status, 0) << done.output;
    };
    burin("convert j/*.burin found.ply");
    burin("convert a/work.burin saved.ply");
    const std::string opens = "0.2 command screenshot 3-opened.png\n",
                      goes_on = circle(0.5, 1.3, 1.6, 12) + "2 command screenshot 4-goes-on.png\n",
                      undoes =
                          "2.1 command undo\n2.2 command undo\n2.3 command undo\n"
                          "2.9 command screenshot 5-undone.png\n3 command export uncut.ply\n",
                      repeats =
                          "3.3 command redo\n3.6 command export saved.ply\n3.7 command redo\n"
                          "4 command export found.ply\n4.1 command quit discard\n";
    const auto opened = place.run(session("a/work.burin", "b", opens + goes_on + undoes + repeats));
    ASSERT_EQ(opened.status, 0) << opened.output;
    EXPECT_TRUE(opened.output.contains("what was not saved has come back")) << opened.output;
    ASSERT_EQ(place.run(session("ball:0.1 --resolution 96", "c", "0.1 command export uncut.ply\n")).status, 0);

    EXPECT_EQ(place.read("a/saved.ply"), place.read("saved.ply"));
    EXPECT_NE(place.read("found.ply"), place.read("saved.ply")) << "nothing of the stroke was found";
    EXPECT_EQ(place.read("b/uncut.ply"), place.read("c/uncut.ply")) << "the stroke before the save is undone as well";
    EXPECT_EQ(place.read("b/saved.ply"), place.read("saved.ply"));
    EXPECT_EQ(place.read("b/found.ply"), place.read("found.ply")) << "what the kill cut off is one stroke";
}

}  // namespace burin::session
