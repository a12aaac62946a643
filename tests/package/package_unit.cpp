// SPDX-License-Identifier: MIT
// The Debian package of what this build folder holds, unpacked into a folder of its own: the program runs with nothing
// but the package's files, and what a user's system makes of these (manual, completion, the CMake package) works.
// Builds nothing of the program; packing takes seconds. Skips where a tool of packing is not installed.
#include <gtest/gtest.h>

#include <memory>

#include "tests/support/places.hpp"
#include "tests/support/run_command.hpp"

namespace burin {
namespace {

namespace fs = std::filesystem;

const fs::path& build_folder() {
    static const fs::path folder = fs::path(kBurinCommand).parent_path();
    return folder;
}

const fs::path& sources() {
    static const fs::path folder = fs::path(kSessionsFolder).parent_path().parent_path();
    return folder;
}

bool is_installed(const std::string& tool) { return Workplace().run("command -v " + tool).status == 0; }

std::string quoted(const fs::path& path) { return "'" + path.string() + "'"; }

// Packs and unpacks once for all tests.
class UnpackedPackage : public testing::Test {
protected:
    static void SetUpTestSuite() {
        for (const char* tool : {"cpack", "dpkg-deb", "dpkg-shlibdeps", "file"})
            if (!is_installed(tool)) {
                missing_ = tool;
                return;
            }
        place_ = std::make_unique<Workplace>();
        packed_ = pack("first");
        if (packed_.status != 0) return;
        packed_ = place_->run(
            "dpkg-deb -x first/*.deb root && dpkg-deb -I first/*.deb control > control.txt && cat control.txt");
    }
    static void TearDownTestSuite() { place_.reset(); }

    void SetUp() override {
        if (!missing_.empty()) GTEST_SKIP() << missing_ << " is not installed; scripts/setup installs it";
        ASSERT_EQ(packed_.status, 0) << packed_.output;
    }

    static Workplace::Outcome pack(const std::string& out) {
        return place_->run(quoted(sources() / "scripts/package-built") + " " + quoted(build_folder()) + " " + out);
    }
    static fs::path root() { return *place_ / "root"; }
    // Runs the unpacked program as a user whose environment holds nothing of this repository.
    static Workplace::Outcome burin(const std::string& arguments) {
        fs::create_directories(*place_ / "home");
        return place_->run("cd home && env -i PATH=/usr/bin:/bin HOME=\"$PWD\" " + quoted(root() / "usr/bin/burin") +
                           " " + arguments);
    }

    static inline std::unique_ptr<Workplace> place_;
    static inline Workplace::Outcome packed_;
    static inline std::string missing_;
};

}  // namespace

TEST_F(UnpackedPackage, CarvesTheDemonstrationFarFromTheSources) {
    const auto carved = burin("demo --resolution 64 --out out");
    EXPECT_EQ(carved.status, 0) << carved.output;
    for (const char* file : {"part.stl", "part.ply", "report.json", "after.png", "stereo.png"})
        EXPECT_TRUE(fs::exists(*place_ / ("home/out/" + std::string(file)))) << file;
}

TEST_F(UnpackedPackage, FindsAssetsInItsOwnShare) {
    const auto version = burin("--version");
    EXPECT_TRUE(version.output.contains("assets: " + (root() / "usr/share/burin").string() + "\n")) << version.output;
    EXPECT_EQ(burin("world check garden tube").status, 0);
    EXPECT_EQ(burin("wall check powerwall").status, 0);
    const auto study = burin("study init kinesthetic-path study --seed 1");
    EXPECT_EQ(study.status, 0) << study.output;
}

TEST_F(UnpackedPackage, NamesNoFolderInWhichItWasBuilt) {
    const auto named = place_->run("grep -rlF " + quoted(sources()) + " root");
    EXPECT_EQ(named.output, "") << "two builds of a commit in two folders would differ";
}

TEST_F(UnpackedPackage, IsTheSameByteForByteWhenMadeAgain) {
    const auto packed = pack("second");
    ASSERT_EQ(packed.status, 0) << packed.output;
    const auto compared = place_->run("cmp first/*.deb second/*.deb");
    EXPECT_EQ(compared.status, 0) << compared.output;
}

TEST_F(UnpackedPackage, TellsWhatItNeedsAndHasNoScripts) {
    const std::string control = place_->read("control.txt");
    for (const char* part : {"Package: burin\n", "libvulkan1", "libsqlite3-0", "libglfw3", "Installed-Size: "})
        EXPECT_TRUE(control.contains(part)) << part << " in\n" << control;
    EXPECT_FALSE(control.contains("-dev")) << "no compiler is needed to run it\n" << control;
    // What no script has made no purge leaves behind.
    const auto scripts = place_->run("dpkg-deb -I first/*.deb | grep -E ' (post|pre)(inst|rm)$'");
    EXPECT_EQ(scripts.output, "");
}

TEST_F(UnpackedPackage, BringsEveryFileThatADesktopAndUdevLookFor) {
    for (const char* file :
         {"lib/udev/rules.d/70-burin-devices.rules", "share/applications/burin.desktop",
          "share/mime/packages/burin.xml", "share/icons/hicolor/scalable/apps/burin.svg",
          "share/metainfo/io.github.burin.Burin.metainfo.xml", "share/doc/burin/copyright",
          "share/doc/burin/changelog.gz", "share/doc/burin/README.md", "share/doc/burin/docs/formats.md",
          "share/doc/burin/docs/study.md", "share/doc/burin/docs/devices.md", "share/doc/burin/docs/pictures/panes.png",
          "share/bash-completion/completions/burin", "share/man/man1/burin.1.gz", "share/man/man1/burin-sculpt.1.gz",
          "lib/burin/emulators/libburin_emulated_hd.so"})
        EXPECT_TRUE(fs::exists(root() / "usr" / file)) << file;
}

TEST_F(UnpackedPackage, HasAManualThatRendersWithoutAWarning) {
    if (!is_installed("man")) GTEST_SKIP() << "man-db is not installed";
    const auto rendered = place_->run(
        "for page in root/usr/share/man/man1/*.gz; do LC_ALL=C.UTF-8 MANWIDTH=100 man --warnings -l $page > page.txt "
        "|| "
        "exit 1; done");
    EXPECT_EQ(rendered.status, 0);
    EXPECT_EQ(rendered.output, "");
    const auto study = place_->run("LC_ALL=C.UTF-8 man -l root/usr/share/man/man1/burin-study.1.gz | cat");
    for (const char* part : {"BURIN STUDY POWER", "--participants", "EXIT STATUS", "BURIN_ASSETS"})
        EXPECT_TRUE(study.output.contains(part)) << part << " in\n" << study.output;
}

TEST_F(UnpackedPackage, CompletesCommandsOptionsWordsAndAssets) {
    const auto completed = [](const std::string& words, int at) {
        return place_->run("bash -c 'source root/usr/share/bash-completion/completions/burin; COMP_WORDS=(" + words +
                           "); COMP_CWORD=" + std::to_string(at) + "; _burin; echo \"${COMPREPLY[@]}\"'");
    };
    EXPECT_EQ(completed("burin scu", 1).output, "sculpt\n");
    EXPECT_EQ(completed("burin study enr", 2).output, "enrol\n");
    EXPECT_EQ(completed("burin sculpt --engine vul", 3).output, "vulkan\n");
    EXPECT_EQ(completed("burin sculpt --work", 2).output, "--workpiece\n");
    EXPECT_EQ(completed("burin world gard", 2).output, "garden\n");
    EXPECT_EQ(completed("burin sculpt --workpiece soc", 3).output, "soccer_ball\n");
}

TEST_F(UnpackedPackage, GivesAProgramOutsideTheTreeItsSolidAndItsTick) {
    // The same install without packing: headers and libraries are a component of their own.
    const auto installed = place_->run("cmake --install " + quoted(build_folder()) +
                                       " --component development --prefix \"$PWD/prefix\" > install.log && cp -r " +
                                       quoted(sources() / "docs/library") + " example");
    ASSERT_EQ(installed.status, 0) << installed.output;
    const auto built = place_->run(
        "cmake -S example -B example/build -DCMAKE_PREFIX_PATH=\"$PWD/prefix\" && cmake --build example/build");
    ASSERT_EQ(built.status, 0) << built.output;
    const auto ran = place_->run("example/build/carve_and_feel");
    EXPECT_EQ(ran.status, 0) << ran.output;
    // In the air above the groove, then on its floor.
    EXPECT_TRUE(ran.output.contains("mm: 0.00 N")) << ran.output;
    EXPECT_FALSE(ran.output.ends_with(" 0.00 N\n")) << ran.output;
}

}  // namespace burin
