// SPDX-License-Identifier: MIT
// Tests what a log's commands may write, and that they are checked before its session begins.
#include "session/record/log_outputs.hpp"

#include <gtest/gtest.h>

#include <array>

#include "desk/run/session.hpp"
#include "tests/session/carving_setup.hpp"
#include "tests/support/run_command.hpp"

namespace burin::session {
namespace {

namespace fs = std::filesystem;

const std::string kHead = "burin-input 1 test\n";

// Returns what is wrong with the commands of a log; empty: nothing.
std::string complaint_about(const std::string& lines) {
    const auto log = parse_input_log(kHead + lines, "script.txt");
    if (!log) return log.error().line();
    const auto checked = check_commands(*log, "script.txt");
    return checked ? "" : checked.error().line();
}

SessionSetup led_by(const std::string& log, const std::string& outputs) {
    SessionSetup setup = carving_setup();
    setup.record.input = log;
    setup.work.outputs = outputs;
    return setup;
}

}  // namespace

TEST(LogCommands, AreCheckedWithFileLineAndRemedyBeforeTheSession) {
    struct Wrong {
        const char* command;
        const char* what;
        const char* remedy;
    };
    const std::array wrongs{
        Wrong{"raduis 0.004", "is not known", "did you mean radius"},
        Wrong{"radius -1", "out of bounds", "number from"},
        Wrong{"screenshot", "lacks its argument", "screenshot FILE"},
        Wrong{"screenshot /tmp/a.png", "absolute path", "--outputs"},
        Wrong{"screenshot ../a.png", "\"..\"", "--outputs"},
        Wrong{"screenshot a/../../b.png", "\"..\"", "--outputs"},
        Wrong{"screenshot .bashrc", "picture", ".png"},
        Wrong{"screenshot part.stl", "picture", ".png"},
        Wrong{"screenshot \"a\\n.png\"", "control characters", "--outputs"},
        Wrong{"export /tmp/a.stl", "absolute path", "--outputs"},
        Wrong{"export a/..", "\"..\"", "--outputs"},
        Wrong{"export authorized_keys", "extension", ".stl"},
        Wrong{"export a.png", "extension", ".stl"},
        Wrong{"export a.off", "extension", ".stl"},
        Wrong{"object a opacity 1.5", "out of bounds", "from 0, clear as glass, to 1"},
        Wrong{"object a opacity nan", "is not a number", "from 0, clear as glass, to 1"},
        Wrong{"amplifiers", "lacks its argument", "amplifiers on|off"},
        Wrong{"tool box:0.01,0,0.01", "has no size", "above zero"},
        Wrong{"tool mesh:no/such/file.stl", "no/such/file.stl", "check the path"},
        Wrong{"save part.stl", "no name of a document", ".burin"},
        Wrong{"save ../a.burin", "\"..\"", "--outputs"},
        Wrong{"save /tmp/a.burin", "absolute path", "--outputs"},
    };
    for (const Wrong& wrong : wrongs) {
        const std::string said = complaint_about("0.1 mouse 1 1\n# a comment\n0.2 command " +
                                                 std::string(wrong.command) + "\n0.3 command quit\n");
        EXPECT_TRUE(said.starts_with("script.txt:4: ")) << wrong.command << " -> " << said;
        EXPECT_TRUE(said.contains(wrong.what)) << wrong.command << " -> " << said;
        EXPECT_TRUE(said.contains(wrong.remedy)) << wrong.command << " -> " << said;
    }
}

TEST(LogCommands, ThatMakeSenseAreTaken) {
    EXPECT_EQ(complaint_about("0 command screenshot a.png\n0.1 command screenshot views/of/it..png\n"
                              "0.2 command export a.STL\n0.3 command export \"two words.ply\"\n"
                              "0.4 command export b.obj\n0.5 command undo\n0.6 command tool ball:0.01\n"
                              "0.7 command smaller-radius\n0.75 command save a.burin\n0.76 command save\n0.8 command "
                              "operation smooth\n0.9 command export-mesh\n"
                              "1 command quit\n"),
              "");
}

TEST(SessionOutputs, OfALogLieBelowItsFolderWhereverLinksLead) {
    const Workplace place;
    place.write("mine.png", "mine");
    fs::create_directories(place / "out/inside");
    fs::create_symlink(place / "mine.png", place / "out/link.png");
    fs::create_symlink(place / "", place / "out/up");
    fs::create_symlink("inside", place / "out/down");
    fs::create_symlink("nowhere", place / "out/dangling.png");
    fs::create_symlink("circle.png", place / "out/circle.png");
    const SessionOutputs outputs(led_by("x/script.txt", (place / "out").string()));
    const auto refused = [&](const std::string& name) {
        const auto placed = outputs.place_of(name, OutputKind::picture);
        return placed ? "" : placed.error().line();
    };
    EXPECT_EQ(outputs.place_of("a.png", OutputKind::picture).value(), place / "out/a.png");
    EXPECT_EQ(outputs.place_of("new/a.stl", OutputKind::mesh).value(), place / "out/new/a.stl");
    EXPECT_TRUE(fs::is_directory(place / "out/new"));
    EXPECT_EQ(outputs.place_of("down/a.png", OutputKind::picture).value(), place / "out/inside/a.png");
    for (const std::string name : {"link.png", "up/a.png", "up/out/a.png/../b.png", "dangling.png", "circle.png",
                                   "../a.png", "/tmp/a.png", "a.stl"})
        EXPECT_FALSE(refused(name).empty()) << name;
    EXPECT_TRUE(refused("link.png").contains("leads out")) << refused("link.png");
    EXPECT_TRUE(refused("up/a.png").contains("leads out")) << refused("up/a.png");
}

TEST(SessionOutputs, LieBesideWhereTheProgramRunsUnlessAFolderIsNamed) {
    const Workplace place;
    const fs::path before = fs::current_path();
    fs::current_path(place / "");
    const SessionOutputs outputs(led_by("/far/away/today.log", ""));
    EXPECT_EQ(outputs.place_of("a.stl", OutputKind::mesh).value(), "today-outputs/a.stl");
    EXPECT_TRUE(fs::is_directory("today-outputs"));
    // A folder that came with the log may lead anywhere.
    fs::create_directory("home");
    fs::create_symlink("home", "other-outputs");
    EXPECT_TRUE(SessionOutputs(led_by("other.log", ""))
                    .place_of("a.stl", OutputKind::mesh)
                    .error()
                    .line()
                    .contains("--outputs"));
    EXPECT_EQ(SessionOutputs(led_by("other.log", "other-outputs")).place_of("a.stl", OutputKind::mesh).value(),
              "other-outputs/a.stl");
    fs::current_path(before);
}

TEST(SessionOutputs, OfAUserTakeNoInputsPlace) {
    const Workplace place;
    place.write("part.stl", "x");
    const SessionOutputs outputs(SessionSetup{}, {(place / "part.stl").string()});
    const auto refused = outputs.place_of((place / "./part.stl").string(), OutputKind::mesh);
    ASSERT_FALSE(refused);
    EXPECT_TRUE(refused.error().line().contains("is a file that this session reads")) << refused.error().line();
    EXPECT_TRUE(outputs.place_of((place / "other.stl").string(), OutputKind::mesh));
}

TEST(SessionOutputs, OfAUserLieWhereTheUserSays) {
    SessionSetup setup = carving_setup();
    setup.desk.screenshots = "shots";
    const SessionOutputs outputs(setup);
    EXPECT_EQ(outputs.place_of("/elsewhere/a.png", OutputKind::picture).value(), "/elsewhere/a.png");
    EXPECT_EQ(outputs.place_of("a.png", OutputKind::picture).value(), "shots/a.png");
    EXPECT_EQ(outputs.place_of("../part.stl", OutputKind::mesh).value(), "../part.stl");
}

TEST(SessionOutputs, AreFoundUnusableBeforeTheSession) {
    const Workplace place;
    place.write("file", "");
    fs::create_directories(place / "out/a.png");
    const auto log = parse_input_log(kHead + "0.1 mouse 1 1\n0.2 command screenshot a.png\n", "script.txt");
    ASSERT_TRUE(log);
    const auto complaint = [&](const std::string& folder) {
        const auto ready = SessionOutputs(led_by("script.txt", (place / folder).string())).prepare(*log, "script.txt");
        return ready ? "" : ready.error().line();
    };
    for (const std::string folder : {"file", "out", "file/below"})
        EXPECT_TRUE(complaint(folder).starts_with("script.txt:3: ")) << folder << ": " << complaint(folder);
    EXPECT_EQ(complaint("new"), "");
    EXPECT_TRUE(fs::is_directory(place / "new"));
}

TEST(RunSession, RefusesALogWhoseCommandsAreWrongBeforeItLoadsAnything) {
    const Workplace place;
    SessionSetup options = carving_setup();
    options.carve.workpiece.source = "missing.off";
    options.record.input = (place / "script.txt").string();
    options.desk.offscreen = true;
    for (const std::string wrong : {"export /tmp/x.stl", "radios 3", "screenshot ../x.png"}) {
        for (const std::string record : {"", "new.log"}) {
            place.write("script.txt", kHead + "0.1 command " + wrong + "\n");
            options.record.path = record.empty() ? "" : (place / record).string();
            const auto outcome = run_session(options);
            ASSERT_FALSE(outcome);
            EXPECT_TRUE(outcome.error().where.starts_with(options.record.input + ":2")) << outcome.error().line();
            EXPECT_FALSE(fs::exists(place / "new.log"));
        }
        EXPECT_FALSE(time_session(options, false));
        EXPECT_TRUE(time_session(options, false).error().where.starts_with(options.record.input + ":2"));
    }
}

TEST(RunSession, RefusesAFolderOfOutputsWithoutALog) {
    SessionSetup options = carving_setup();
    options.work.outputs = "out";
    EXPECT_TRUE(wants_session(options));
    const auto outcome = run_session(options);
    ASSERT_FALSE(outcome);
    EXPECT_TRUE(outcome.error().line().contains("--input")) << outcome.error().line();
}

// A key asks nobody whether the file that has its name may go; nor may the next press take the place of one that is
// still being written.
TEST(SessionOutputs, OfAUserTakeNoFilesPlaceButANumber) {
    const Workplace place;
    SessionSetup setup = carving_setup();
    setup.desk.screenshots = (place / "").string();
    SessionOutputs outputs(setup);
    const auto name = [&] {
        const auto at = outputs.new_place_of("wall.png", OutputKind::picture);
        return at ? at->filename().string() : at.error().line();
    };
    EXPECT_EQ(name(), "wall.png");
    EXPECT_EQ(name(), "wall-2.png");
    place.write("wall-3.png", "a picture");
    EXPECT_EQ(name(), "wall-4.png");

    SessionOutputs of_log(led_by("script.txt", (place / "out").string()));
    for (int run = 0; run < 2; ++run) {
        const auto at = of_log.new_place_of("wall.png", OutputKind::picture);
        ASSERT_TRUE(at);
        EXPECT_EQ(at->filename(), "wall.png");
    }
}

}  // namespace burin::session
