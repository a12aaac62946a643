// SPDX-License-Identifier: MIT
// What a run that was refused leaves of folders: none that it made and put nothing into.
#include "app/cli/new_folders.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "tests/support/places.hpp"
#include "tests/support/run_command.hpp"

namespace burin::app {
namespace {

namespace fs = std::filesystem;

}  // namespace

TEST(NewFolders, ThatAreEmptyGoAndAllOthersStay) {
    const Workplace at;
    fs::create_directories(at / "old/empty");
    {
        const NewFolders folders({at / "old", at / "new/deep", at / "used", at / "never", ""});
        fs::create_directories(at / "new/deep/deeper");
        fs::create_directories(at / "used/empty");
        std::ofstream(at / "used/file") << "kept";
    }
    EXPECT_TRUE(fs::exists(at / "old/empty")) << "it was there";
    EXPECT_FALSE(fs::exists(at / "new"));
    EXPECT_FALSE(fs::exists(at / "used/empty"));
    EXPECT_EQ(at.read("used/file"), "kept");
}

TEST(NewFolders, OfARunThatHasBegunStay) {
    const Workplace at;
    {
        NewFolders folders({at / "new"});
        fs::create_directory(at / "new");
        folders.keep();
    }
    EXPECT_TRUE(fs::exists(at / "new"));
}

TEST(NewFolders, OfAnExerciseThatIsRefusedAreNotLeft) {
    const Workplace at;
    at.write("x.txt", "burin-input 1 rehab ball\n0.1 command screenshot a.png\n0.2 command screenshot ../b.png\n");
    at.write("y.txt", "burin-input 1 rehab ball\n0.1 command rubbish\n");
    for (const char* const input : {"x.txt", "y.txt", "none.txt"}) {
        const auto run =
            at.run(std::string(kBurinCommand) + " rehab ball --offscreen --results F --participant 7 --outputs q" +
                   " --input " + input);
        EXPECT_NE(run.status, 0) << input;
        EXPECT_FALSE(fs::exists(at / "F")) << input << run.output;
        EXPECT_FALSE(fs::exists(at / "q")) << input << run.output;
    }
}

}  // namespace burin::app
