// SPDX-License-Identifier: MIT
// Which version a build names: by its tag, by its commit where there is no tag, and by the release without git.
#include <gtest/gtest.h>

#include <regex>

#include "tests/support/places.hpp"
#include "tests/support/run_command.hpp"

namespace burin {
namespace {

// A repository that holds nothing but the script.
class VersionByGit : public testing::Test {
protected:
    void SetUp() override {
        if (place_.run("command -v git && command -v cmake").status != 0)
            GTEST_SKIP() << "git or cmake is not installed; scripts/setup installs both";
        const auto script =
            std::filesystem::path(kSessionsFolder).parent_path().parent_path() / "cmake/BurinVersion.cmake";
        std::filesystem::create_directories(place_ / "cmake");
        std::filesystem::copy_file(script, place_ / "cmake/BurinVersion.cmake");
    }
    void commit() const {
        const auto done = place_.run(
            "git init -q . 2>/dev/null; git add -A && GIT_COMMITTER_DATE='2026-03-01T23:30:00-0500' git -c user.name=x "
            "-c "
            "user.email=x@example.org commit -q --allow-empty -m x");
        ASSERT_EQ(done.status, 0) << done.output;
    }
    [[nodiscard]] std::string version() const {
        const auto made = place_.run("cmake -D VERSION=0.1.0 -D OUT=\"$PWD/out/v.cpp\" -P cmake/BurinVersion.cmake");
        EXPECT_EQ(made.status, 0) << made.output;
        const std::string text = place_.read("out/v.cpp");
        std::smatch found;
        return std::regex_search(text, found, std::regex("return \"(.*)\"")) ? found[1].str() : text;
    }

    Workplace place_;
};

}  // namespace

TEST_F(VersionByGit, IsTheReleaseWithoutGit) { EXPECT_EQ(version(), "0.1.0"); }

TEST_F(VersionByGit, IsTheDayAndTheCommitWithoutATagAsInAShallowClone) {
    commit();
    EXPECT_TRUE(std::regex_match(version(), std::regex("0\\.1\\.0\\+20260302\\.g[0-9a-f]{8}"))) << version();
}

TEST_F(VersionByGit, IsTheTagAndHowFarBehindItIs) {
    commit();
    ASSERT_EQ(place_.run("git tag v0.2.0").status, 0);
    EXPECT_EQ(version(), "0.2.0");
    commit();
    EXPECT_TRUE(std::regex_match(version(), std::regex("0\\.2\\.0\\+1\\.g[0-9a-f]{8}"))) << version();
}

// A copy of the sources in somebody else's repository has not that one's version.
TEST_F(VersionByGit, IsNotThatOfARepositoryAround) {
    std::filesystem::create_directories(place_ / "copy");
    std::filesystem::rename(place_ / "cmake", place_ / "copy/cmake");
    commit();
    const auto made = place_.run("cmake -D VERSION=0.1.0 -D OUT=\"$PWD/v.cpp\" -P copy/cmake/BurinVersion.cmake");
    EXPECT_EQ(made.status, 0) << made.output;
    EXPECT_TRUE(place_.read("v.cpp").contains("\"0.1.0\""));
}

}  // namespace burin
