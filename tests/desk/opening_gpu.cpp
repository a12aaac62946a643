// SPDX-License-Identifier: MIT
// A workpiece is made before its user's eyes: pictures come before the solid is there, and the user can end it.
#include <gtest/gtest.h>

#include <cstdlib>

#include "compute/vulkan/engine_choice.hpp"
#include "desk/live/desk.hpp"
#include "desk/opening/opening.hpp"
#include "desk/run/session.hpp"
#include "gpu/device.hpp"
#include "tests/session/carving_setup.hpp"
#include "tests/support/places.hpp"
#include "tests/support/run_command.hpp"
#include "tests/window/xvfb.hpp"

namespace burin::session {
namespace {

class Opening : public testing::Test {
protected:
    void SetUp() override {
        const auto devices = gpu::list_devices();
        if (!devices) GTEST_SKIP() << "no Vulkan device: " << devices.error().line();
        const std::string& display = window::Xvfb::running().name();
        if (display.empty()) GTEST_SKIP() << "Xvfb is not installed or does not start";
        setenv("DISPLAY", display.c_str(), 1);
        options.carve.workpiece.source = "assets/workpieces/soccer_ball.obj";
        options.carve.workpiece.resolution = 32;
        options.desk.width = 480;
        options.desk.height = 360;
        wall = session_wall(options.desk).value();
    }
    [[nodiscard]] Result<Presenter> present() const { return Presenter::open(options.desk, wall); }
    [[nodiscard]] Result<std::unique_ptr<workpiece::Workpiece>> make(OpeningSight& sight) const {
        CarveOptions carve = options.carve;
        carve.make_engine = compute::engine_maker(carve.engine);
        return make_in_sight(carve, 1, sight);
    }
    static bool can_run(const std::string& program) {
        return std::system(("command -v " + program + " >/dev/null 2>&1").c_str()) == 0;
    }

    SessionSetup options = carving_setup();
    SessionWall wall;
};

}  // namespace

TEST_F(Opening, ShowsPicturesBeforeTheSolidIsThere) {
    auto presenter = present();
    ASSERT_TRUE(presenter) << presenter.error().line();
    unsigned before_the_mesh = 0, with_the_mesh = 0;
    const auto made = open_before_eyes(*presenter, options, wall, [&](OpeningSight& sight) {
        EXPECT_TRUE(sight.wait_for_pictures(1));
        before_the_mesh = sight.pictures();
        workpiece::LoadWatch watch{&sight.work()};
        watch.look = [&](const geometry::TriangleMesh& mesh) {
            EXPECT_STREQ(sight.work().look().step, "reading the file");
            auto drawn = picture::drawn_mesh(mesh);
            const unsigned so_far = sight.pictures();
            sight.show({drawn, drawn->bounds});
            EXPECT_TRUE(sight.wait_for_pictures(so_far + 1)) << "the file's mesh is seen";
            with_the_mesh = sight.pictures();
        };
        return sculpt::make_carved_workpiece(options.carve.workpiece, {}, compute::engine_maker(options.carve.engine),
                                             1, watch);
    });
    ASSERT_TRUE(made) << made.error().line();
    ASSERT_TRUE(*made);
    EXPECT_GE(before_the_mesh, 1u);
    EXPECT_GT(with_the_mesh, before_the_mesh);
    EXPECT_GE(presenter->presented(), with_the_mesh);
    EXPECT_GT((*made)->surface().triangles(), 0u);
}

TEST_F(Opening, NamesTheFileInTheTitleOfItsWindow) {
    if (!can_run("xdotool")) GTEST_SKIP() << "xdotool is not installed";
    auto presenter = present();
    ASSERT_TRUE(presenter) << presenter.error().line();
    presenter->name_windows("part of mine.stl");
    static_cast<void>(presenter->inputs(0.2));
    EXPECT_EQ(std::system("xdotool search --name '^part of mine.stl \u2014 Burin$' >/dev/null 2>&1"), 0);
}

TEST_F(Opening, EndsAtOnceByTheEscapeKeyWithItsWindow) {
    if (!can_run("xdotool")) GTEST_SKIP() << "xdotool is not installed";
    auto presenter = present();
    ASSERT_TRUE(presenter) << presenter.error().line();
    const auto made = open_before_eyes(*presenter, options, wall, [&](OpeningSight& sight) {
        EXPECT_TRUE(sight.wait_for_pictures(1));
        EXPECT_EQ(std::system("xdotool mousemove 200 150 key Escape >/dev/null 2>&1"), 0);
        EXPECT_FALSE(sight.wait_for_pictures(1'000'000)) << "until it is ended";
        return make(sight);
    });
    ASSERT_TRUE(made) << made.error().line();
    EXPECT_FALSE(*made);
}

TEST_F(Opening, TellsTheFaultsOfAFileInTheWordsOfASessionWithoutPictures) {
    Workplace place;
    place.write("cut.stl", "solid cut\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n");
    const std::string sculpt = std::string(kBurinCommand) + " sculpt cut.stl --resolution 32";
    place.write("script.txt", "burin-input 1 test\n0.1 command quit\n");
    const auto seen = place.run(sculpt), unseen = place.run(sculpt + " --offscreen --input script.txt");
    EXPECT_EQ(seen.status, 1);
    EXPECT_EQ(seen.output, unseen.output);
    EXPECT_TRUE(seen.output.contains("cut.stl:")) << seen.output;
    options.carve.workpiece.source = place / "cut.stl";
    auto presenter = present();
    ASSERT_TRUE(presenter) << presenter.error().line();
    const auto made = open_before_eyes(*presenter, options, wall, [&](OpeningSight& sight) { return make(sight); });
    ASSERT_FALSE(made);
    EXPECT_TRUE(seen.output.contains(made.error().what)) << made.error().line();
}

TEST_F(Opening, LeavesTheSessionTheSamePictureAsWithoutIt) {
    Workplace place;
    options.desk.screenshots = place / "shots";
    std::filesystem::create_directories(place / "shots");
    auto presenter = present();
    ASSERT_TRUE(presenter) << presenter.error().line();
    auto made = open_before_eyes(*presenter, options, wall, [&](OpeningSight& sight) { return make(sight); });
    ASSERT_TRUE(made && *made);
    SimulatedClock clock;
    const auto with = Desk::create(options, wall, clock, 1.0, std::move(*made));
    const auto without = Desk::create(options, wall, clock);
    ASSERT_TRUE(with && without);
    const Session &one = (*with)->session(), &other = (*without)->session();
    EXPECT_EQ(one.state().world_from_object, other.state().world_from_object);
    EXPECT_EQ(one.scene_side().surface()->triangles(), other.scene_side().surface()->triangles());
    EXPECT_EQ(one.found().name, other.found().name);
}

TEST(OpeningInput, EndsByAClosedWindowEscAndCtrlQAlone) {
    EXPECT_TRUE(ends_opening(WindowClose{}));
    EXPECT_TRUE(ends_opening(KeyInput{Key::escape, KeyMotion::press, {}}));
    EXPECT_TRUE(ends_opening(KeyInput{Key::q, KeyMotion::press, {.ctrl = true}}));
    EXPECT_FALSE(ends_opening(KeyInput{Key::q, KeyMotion::press, {}}));
    EXPECT_FALSE(ends_opening(KeyInput{Key::escape, KeyMotion::release, {}}));
    EXPECT_FALSE(ends_opening(MouseMove{}));
    EXPECT_FALSE(ends_opening(MouseClick{MouseButton::left, true, {}}));
}

}  // namespace burin::session
