// SPDX-License-Identifier: MIT
// The panel in a window of its own: no picture shows it, its window does, and the session is done again the same.
#include <gtest/gtest.h>

#include <set>

#include "gpu/device.hpp"
#include "tests/renderer/output/output_pictures.hpp"
#include "tests/support/places.hpp"
#include "tests/support/run_command.hpp"

namespace burin::session {
namespace {

class PanelWindow : public testing::Test {
protected:
    void SetUp() override {
        const auto devices = gpu::list_devices();
        if (!devices) GTEST_SKIP() << "no Vulkan device: " << devices.error().line();
    }
    // Runs a session of a ball with this script; its files lie in the folder.
    Workplace::Outcome session(const std::string& folder, const std::string& script, const std::string& more) {
        place.write(folder + ".txt", "burin-input 1 test\n" + script);
        Workplace::Outcome done =
            place.run(std::string("BURIN_VULKAN_VALIDATION=1 ") + kBurinCommand +
                      " sculpt --workpiece ball:0.1 --resolution 48 --tool ball:0.012 --width 960 "
                      "--height 540 --offscreen --outputs " +
                      folder + " --input " + folder + ".txt " + more);
        EXPECT_EQ(done.status, 0) << done.output;
        EXPECT_EQ(done.output.find("Vulkan validation"), std::string::npos) << done.output;
        return done;
    }
    Image picture(const std::string& name) { return renderer::read_png(place / name); }

    Workplace place;
};

}  // namespace

TEST_F(PanelWindow, ShowsThePanelAndThePicturesShowItNoMore) {
    session("own", "0.2 command screenshot a.png\n0.3 command quit\n", "--panel-window");
    session("none", "0.1 key press tab\n0.11 key release tab\n0.2 command screenshot a.png\n0.3 command quit\n", "");
    session("over", "0.2 command screenshot a.png\n0.3 command quit\n", "");
    EXPECT_TRUE(place.read("own/a.png") == place.read("none/a.png")) << "as a picture whose panel is hidden";
    EXPECT_FALSE(place.read("own/a.png") == place.read("over/a.png"));
    const Image panel = picture("own/a-panel.png");
    ASSERT_EQ(panel.size, (ImageSize{340, 900}));
    std::set<std::uint32_t> colours;
    for (std::uint32_t y = 0; y < 900; ++y) colours.insert(panel.pixel(170, y)[0]);
    EXPECT_GT(colours.size(), 5u) << "more than a ground";
}

TEST_F(PanelWindow, IsReplayedFromARecordingWithBothOfItsPictures) {
    const std::string script =
        "0.05 mouse 480 270\n0.1 scroll 0 15\n0.2 mouse 131242 100\n0.3 scroll 0 -3\n0.4 mouse 480 272\n"
        "0.5 command screenshot a.png\n0.6 command quit\n";
    session("live", script, "--panel-window --record live.log");
    EXPECT_TRUE(place.read("live.log").contains("--panel-window")) << "an option that its frames depend on";
    const Workplace::Outcome again =
        place.run(std::string(kBurinCommand) + " sculpt --input live.log --offscreen --outputs again");
    EXPECT_EQ(again.status, 0) << again.output;
    for (const char* name : {"a.png", "a-panel.png"}) {
        ASSERT_FALSE(place.read(std::string("live/") + name).empty()) << name;
        EXPECT_TRUE(place.read(std::string("live/") + name) == place.read(std::string("again/") + name)) << name;
    }
}

}  // namespace burin::session
