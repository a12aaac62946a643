// SPDX-License-Identifier: MIT
// The files of scripted sessions: where they go, and that a session fails at its end when one of them is missing.
#include <gtest/gtest.h>

#include <vector>

#include "gpu/device.hpp"
#include "tests/support/places.hpp"
#include "tests/support/run_command.hpp"

namespace burin::session {
namespace {

namespace fs = std::filesystem;

class OutputsOfASession : public testing::Test {
protected:
    void SetUp() override {
        const auto devices = gpu::list_devices();
        if (!devices) GTEST_SKIP() << "no Vulkan device: " << devices.error().line();
    }
    // Runs a log of these lines. shell: what comes before the command.
    Workplace::Outcome run(const std::string& command, const std::string& lines, const std::string& shell = "") {
        place.write("script.txt", "burin-input 1 test\n" + lines);
        return place.run(shell + std::string(kBurinCommand) + " " + command +
                         " --workpiece ball:0.1 --resolution 32 --tool ball:0.012 --width 320 --height 180 "
                         "--input script.txt");
    }
    Workplace::Outcome play(const std::string& more, const std::string& lines, const std::string& shell = "") {
        return run("sculpt --offscreen " + more, lines, shell);
    }
    [[nodiscard]] bool is_there(const std::string& name) const { return fs::exists(place / name); }
    static void expect_said(const Workplace::Outcome& outcome, int status, const std::vector<std::string>& parts) {
        EXPECT_EQ(outcome.status, status) << outcome.output;
        for (const std::string& part : parts)
            EXPECT_TRUE(outcome.output.contains(part)) << part << " in " << outcome.output;
    }
    Workplace place;
};

const std::string kTwoFiles = "0.1 command screenshot a.png\n0.2 command export parts/b.stl\n0.3 command quit\n";
const std::string kTwoFilesByKeys =
    "0.1 key press f12\n0.12 key release f12\n0.2 key press e ctrl\n0.22 key release e ctrl\n0.3 command quit\n";

}  // namespace

TEST_F(OutputsOfASession, LieInAFolderNamedAfterTheLogOrInTheOneThatIsNamed) {
    expect_said(play("", kTwoFiles), 0, {"(script-outputs/a.png)", "(script-outputs/parts/b.stl)"});
    EXPECT_TRUE(is_there("script-outputs/a.png") && is_there("script-outputs/parts/b.stl"));
    expect_said(play("--outputs out", kTwoFiles), 0, {"out/a.png"});
    EXPECT_TRUE(is_there("out/a.png") && is_there("out/parts/b.stl"));
    expect_said(play("--outputs other --screenshots shots", kTwoFiles), 0, {});
    EXPECT_TRUE(is_there("shots/a.png") && is_there("other/parts/b.stl") && !is_there("other/a.png"));
    // The panel shows names alone: pictures do not depend on the folder.
    EXPECT_EQ(place.read("out/a.png"), place.read("script-outputs/a.png"));
    expect_said(play("--outputs keys", kTwoFilesByKeys), 0, {});
    EXPECT_TRUE(is_there("keys/burin.png") && is_there("keys/part.stl") && !is_there("part.stl"));
}

TEST_F(OutputsOfASession, AreNeverPutInPlaceOfOthersWithoutAWord) {
    EXPECT_FALSE(play("", kTwoFiles).output.contains("in place of"));
    const auto again = play("", kTwoFiles);
    expect_said(again, 0,
                {"(script-outputs/a.png, in place of the file that was there)",
                 "(script-outputs/parts/b.stl, in place of the file that was there)"});
}

TEST_F(OutputsOfASession, CannotOverwriteTheUsersFiles) {
    place.write("mine.png", "mine");
    place.write("mine.stl", "mine");
    const std::string mine = (place / "mine").string();
    for (const std::string& command : {"screenshot " + mine + ".png", "export " + mine + ".stl",
                                       std::string("screenshot ../mine.png"), std::string("export ../mine.stl")}) {
        const auto refused = play("--outputs out", "0.1 mouse 9 9\n0.2 command " + command + "\n0.3 command quit\n");
        expect_said(refused, 1, {"script.txt:3: "});
        EXPECT_FALSE(is_there("out")) << "the session has not begun";
    }
    fs::create_directory(place / "out");
    fs::create_symlink(place / "mine.png", place / "out/link.png");
    expect_said(play("--outputs out", "0.1 command screenshot link.png\n"), 1, {"script.txt:2: ", "leads out"});
    EXPECT_EQ(place.read("mine.png"), "mine");
    EXPECT_EQ(place.read("mine.stl"), "mine");
}

// F12 and Ctrl+E are as good as commands; links they meet are seen only when they are pressed.
TEST_F(OutputsOfASession, OfKeysFollowNoLinkOutOfTheFolderAndTheSessionGoesOn) {
    place.write("mine", "mine");
    fs::create_directory(place / "out");
    fs::create_symlink(place / "mine", place / "out/burin.png");
    fs::create_symlink(place / "mine", place / "out/part.stl");
    const std::string keys = kTwoFilesByKeys.substr(0, kTwoFilesByKeys.find("0.3"));
    const auto outcome = play("--outputs out", keys + "0.4 command screenshot later.png\n0.5 command quit\n");
    expect_said(outcome, 1, {"script.txt:", "burin.png: is a symbolic link", "part.stl: is a symbolic", "2 things"});
    EXPECT_EQ(place.read("mine"), "mine");
    EXPECT_TRUE(is_there("out/later.png"));
}

// SIGXFSZ ignored, a file that grows too large is as a full disk.
TEST_F(OutputsOfASession, ThatFailMeanwhileAreToldWithFileAndLineAndEndInFailure) {
    const auto outcome = play("",
                              "0.1 command export large.stl\n0.2 command undo\n0.3 command screenshot large.png\n" +
                                  std::string("0.4 command quit\n"),
                              "trap '' XFSZ; ulimit -f 1; ");
    expect_said(outcome, 1,
                {"script.txt:2: ", "large.stl: cannot be written", "no stroke to undo", "script.txt:4: ", "large.png",
                 "2 things"});
    EXPECT_FALSE(is_there("script-outputs/large.stl"));
}

TEST_F(OutputsOfASession, ARecordingThatBreaksOffEndsInFailure) {
    const auto outcome = play("--record new.log", "0.1 mouse 9 9\n0.6 command quit\n", "trap '' XFSZ; ulimit -f 2; ");
    expect_said(outcome, 1, {"script.txt:", "new.log", "is missing"});
    EXPECT_TRUE(is_there("new.log"));
}

TEST_F(OutputsOfASession, ASignalEndsAScriptAndTellsSo) {
    // A day of a session, of which the first picture is taken; then the signal comes.
    place.write("script.txt", "burin-input 1 test\n0.1 command screenshot a.png\n90000 command quit\n");
    for (const std::string time : {"", "--record new.log "}) {  // simulated and real
        const auto outcome = place.run("{ " + std::string(kBurinCommand) +
                                       " sculpt --offscreen --workpiece ball:0.1 --resolution 32 --tool ball:0.012 " +
                                       time + "--input script.txt --outputs out" + std::to_string(time.size()) +
                                       " & burin=$!; while [ ! -e out" + std::to_string(time.size()) +
                                       "/a.png ] && kill -0 $burin; do sleep 0.1; done; "
                                       "kill -TERM $burin; wait $burin; }");
        expect_said(outcome, 1, {"script.txt:2: ", "ended by a signal", "is missing"});
    }
}

TEST_F(OutputsOfASession, AScriptWhoseLastLineHasNoEndIsRefused) {
    const auto outcome = play("", "0.1 command screenshot a.png\n0.2 command export a.stl");
    expect_said(outcome, 1, {"script.txt", "the last line has no end"});
    EXPECT_EQ(place.files(), 1u) << "the script alone";
}

TEST_F(OutputsOfASession, AProfileLeavesNone) {
    const std::string actions = "0.1 command take-screenshot\n0.2 command export-mesh\n0.3 command quit\n";
    for (const std::string& lines : {kTwoFiles, kTwoFilesByKeys, actions}) {
        const auto outcome = run("profile", lines);
        EXPECT_EQ(outcome.status, 0) << outcome.output;
        EXPECT_EQ(place.files(), 1u) << "the script alone; " << lines;
    }
}

}  // namespace burin::session
