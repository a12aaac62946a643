// SPDX-License-Identifier: MIT
// Places of output files are checked before the first long step, not after it.
#include "app/output_files.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <vector>

#include "tests/support/run_command.hpp"

namespace burin::app {

TEST(OutputFiles, AreRefusedBeforeAnythingIsWrittenWhereTheyCannotBe) {
    const Workplace place;
    const std::string missing = (place / "no/such/folder").string();
    const std::array good{(place / "a.stl").string(), (place / "b.ply").string()};
    const std::string report = (place / "report.json").string();
    EXPECT_TRUE(check_outputs(good, report));
    EXPECT_TRUE(check_outputs({}, ""));
    const auto refused = [&](std::span<const std::string> exports, const std::string& report_at) {
        const auto checked = check_outputs(exports, report_at);
        return checked ? "" : checked.error().line();
    };
    EXPECT_NE(refused(good, missing + "/report.json").find(missing), std::string::npos);
    EXPECT_NE(refused(good, place / ".").find("is a folder"), std::string::npos);
    EXPECT_NE(refused(std::array{good[0], missing + "/c.ply"}, report).find(missing), std::string::npos);
    EXPECT_NE(refused(std::array{good[0], (place / "c.off").string()}, report).find("c.off"), std::string::npos);
    EXPECT_EQ(place.files(), 0u);
}

// All of these were noticed only when the file was written, which may be hours later.
TEST(OutputFiles, AreRefusedBeforehandWhereNoFileCanBeReplaced) {
    const Workplace place;
    const auto refused = [&](const std::string& report) {
        const auto checked = check_outputs({}, report);
        return checked ? "" : checked.error().line();
    };
    std::filesystem::create_symlink(place / "loop.json", place / "loop.json");
    std::filesystem::create_symlink("/dev/full", place / "full.json");
    place.write("good.json", "");
    std::filesystem::create_symlink(place / "good.json", place / "link.json");
    EXPECT_TRUE(refused("/dev/full").contains("not a regular file"));
    EXPECT_TRUE(refused(place / "full.json").contains("not a regular file"));
    EXPECT_TRUE(refused(place / "loop.json").contains("symbolic link")) << refused(place / "loop.json");
    EXPECT_EQ(refused(place / "link.json"), "");
    EXPECT_EQ(refused(place / "new.json"), "");
    if (geteuid() == 0) return;  // who may write everywhere
    std::filesystem::permissions(place / "good.json", std::filesystem::perms::owner_read);
    EXPECT_TRUE(refused(place / "good.json").contains("write-protected"));
}

TEST(OutputFiles, OverwriteNeitherAnInputNorEachOther) {
    const Workplace place;
    place.write("in.csv", "x");
    place.write("in.stl", "x");
    const std::array inputs{(place / "in.stl").string(), (place / "in.csv").string(), std::string("block:1,1,1")};
    const auto refused = [&](const std::vector<std::string>& exports, const std::string& report) {
        const auto checked = check_outputs(exports, report, inputs);
        return checked ? "" : checked.error().line();
    };
    EXPECT_EQ(refused({(place / "a.stl").string()}, (place / "r.json").string()), "");
    EXPECT_TRUE(refused({(place / "./in.stl").string()}, "").contains("is another file of this command"));
    EXPECT_TRUE(refused({}, (place / "in.csv").string()).contains("is another file of this command"));
    EXPECT_TRUE(refused({(place / "a.stl").string(), (place / "./a.stl").string()}, "").contains("two outputs"));
}

// A log names what it was recorded with in its first line.
TEST(OutputFiles, OverwriteNoFileThatARecordingNames) {
    const Workplace place;
    const auto path = [&](const std::string& name) { return (place / name).string(); };
    place.write("a.log", "burin-input 2 burin sculpt --workpiece " + path("part.stl") + " --world " + path("w.toml") +
                             " --tool mesh:" + path("tip.stl") + " --device simulated-wand:" + path("wand.toml") +
                             " --wall " + path("wall.toml") + "\n0.1 mouse 1 2\n");
    place.write("script.txt", "burin-input 1 somebody's --world " + path("w.toml") + "\n");
    const auto refused = [&](const std::string& input, const std::string& output) {
        const auto checked = check_overwrites_none(output, std::array{path(input)});
        return checked ? "" : checked.error().line();
    };
    for (const std::string name : {"part.stl", "w.toml", "tip.stl", "wand.toml", "wall.toml"})
        EXPECT_TRUE(refused("a.log", path(name)).contains("is a file of the recording")) << name;
    EXPECT_EQ(refused("a.log", path("r.json")), "");
    EXPECT_EQ(refused("script.txt", path("w.toml")), "") << "it is no recording";
    EXPECT_EQ(refused("none.log", path("w.toml")), "");
}

}  // namespace burin::app
