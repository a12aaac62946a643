// SPDX-License-Identifier: MIT
// Screens, heads and window images of a live session, without any picture.
#include <gtest/gtest.h>

#include <random>

#include "desk/draw/presented_parts.hpp"
#include "tests/desk/viewed.hpp"
#include "tests/support/places.hpp"
#include "tests/support/run_command.hpp"
#include "wall/wall_file.hpp"

namespace burin::session {
namespace {

std::string wall_file(const std::string& name) { return std::string(kWallsFolder) + "/" + name; }

SessionWall wall_of(const std::string& name, const DeskOptions& more = {}) {
    DeskOptions options = more;
    options.wall = wall_file(name);
    auto wall = session_wall(options);
    EXPECT_TRUE(wall) << (wall ? "" : wall.error().line());
    return *wall;
}

InputEvent head_at(Nanoseconds t, const Vec3& place) { return {t, HeadInput{{place, Quat{1, 0, 0, 0}}, true}}; }

}  // namespace

TEST(SessionWall, OfADeskIsOneScreenOfItsWindowsShape) {
    DeskOptions options;
    options.width = 640;
    options.height = 320;
    auto wall = session_wall(options);
    ASSERT_TRUE(wall);
    EXPECT_TRUE(wall->desk);
    ASSERT_EQ(wall->screens.size(), 1u);
    fit_desk_screen(*wall, {300, 100});
    const wall::Screen screen = wall::screen_world(wall->setup, wall->setup.screens[0]);
    EXPECT_NEAR(glm::length(screen.lower_right_world - screen.lower_left_world),
                3.0 * glm::length(screen.upper_left_world - screen.lower_left_world), 1e-12);
}

// Who has a tracker asked for the true depth, near the edges too; elsewhere it is a choice, and several screens and one
// eye have none.
TEST(SessionWall, FadesDepthAtItsEdgesOnlyWhereNobodyTracksAHead) {
    Viewed viewed = block_before_wall(wall_of("powerwall.toml"));
    const wall::WallSetup& setup = viewed.desk.wall.setup;
    const Pose home = viewed.desk.hands.front().home_head_world;
    ASSERT_EQ(setup.screens.size(), 1u);
    const auto fade = [](const Viewed& of) {
        const auto scene = scene_of(of.seen(), of.desk.wall.main, Vec3(0.0), {});
        return scene ? scene->edge_fade : -1.0;
    };
    viewed.viewer.head = follow_head({}, setup, {}, {}, 0, home);
    EXPECT_EQ(fade(viewed), 1.0);
    const std::vector<InputEvent> told{head_at(1'000'000, home.position_m)};
    Viewed tracked = viewed;
    tracked.viewer.head = follow_head({}, setup, {}, told, 2'000'000, home);
    ASSERT_TRUE(tracked.viewer.head.tracked);
    EXPECT_EQ(fade(tracked), 0.0);
    tracked.viewer.edge_comfort = EdgeComfort::on;
    EXPECT_EQ(fade(tracked), 1.0) << "whoever asks for it has it";
    viewed.viewer.edge_comfort = EdgeComfort::off;
    EXPECT_EQ(fade(viewed), 0.0);
    viewed.viewer.edge_comfort = EdgeComfort::on;
    viewed.viewer.output.mode = wall::StereoMode::mono;
    EXPECT_FALSE(could_fade_at_edges(viewed.seen(), viewed.desk.wall.main));
    EXPECT_EQ(fade(viewed), 0.0);
    Viewed inside = block_before_wall(wall_of("cave.toml"));
    inside.viewer.edge_comfort = EdgeComfort::on;
    EXPECT_FALSE(could_fade_at_edges(inside.seen(), inside.desk.wall.main));
}

TEST(SessionWall, OfACaveIsFacedAtItsFrontAndShownOnItsMonitors) {
    const SessionWall wall = wall_of("cave.toml");
    ASSERT_EQ(wall.screens.size(), 4u);
    EXPECT_EQ(wall.screens[wall.main].name, "front");
    EXPECT_EQ(wall.screens[0].monitor, "0");
    EXPECT_EQ(wall.screens[0].size, (ImageSize{1080, 1080}));
    EXPECT_EQ(wall.screens[0].shown.mode, wall::StereoMode::two_layers);
    DeskOptions small;
    small.windowed = true;
    small.width = 800;
    small.height = 270;
    for (const SessionScreen& screen : wall_of("cave.toml", small).screens) {
        EXPECT_EQ(screen.size, (ImageSize{270, 270}));
        EXPECT_TRUE(screen.monitor.empty());
    }
}

TEST(SessionWall, DrivesADisplayDirectlyButNotInWindowsOrOffScreen) {
    Workplace place;
    wall::WallSetup setup = *wall::read_wall(wall_file("powerwall.toml"));
    setup.screens[0].output = "HDMI";
    setup.screens[0].direct = DisplayStereo::hdmi_3d;
    place.write("wall.toml", wall::wall_text(setup));
    DeskOptions options;
    options.wall = (place / "wall.toml").string();
    const auto wall = session_wall(options);
    ASSERT_TRUE(wall) << wall.error().line();
    const SessionScreen& screen = wall->screens[0];
    ASSERT_TRUE(screen.direct);
    EXPECT_TRUE(screen.monitor.empty());
    EXPECT_EQ(screen.direct->display, "HDMI");
    EXPECT_EQ(screen.direct->width, 1440u);
    EXPECT_EQ(screen.direct->height, 1080u);
    EXPECT_EQ(screen.direct->stereo, DisplayStereo::hdmi_3d);
    EXPECT_EQ(screen.direct->refresh_Hz, 60.0) << "a frame holds both of 120 fields a second";
    for (bool DeskOptions::* const option : {&DeskOptions::windowed, &DeskOptions::offscreen}) {
        DeskOptions other = options;
        other.*option = true;
        EXPECT_FALSE(session_wall(other).value().screens[0].direct);
    }
    setup.screens[0].mode = "mono";
    place.write("wall.toml", wall::wall_text(setup));
    const auto refused = session_wall(options);
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().line().find("wall.toml, front: "), std::string::npos) << refused.error().line();
}

TEST(SessionWall, TellsAllScreensWhatIsChosenAndKeepsTheirOwn) {
    SessionWall wall = wall_of("cave.toml");
    wall.screens[0].shown.mode = wall::StereoMode::mono;
    wall.screens[0].shown.swap_eyes = true;
    wall.screens[0].shown.blend.left = 0.1;
    wall::OutputSettings told = wall.screens[wall.main].shown;
    EXPECT_EQ(output_on(wall, 0, told).mode, wall::StereoMode::mono) << "nothing was chosen";
    EXPECT_TRUE(output_on(wall, 0, told).swap_eyes);
    told.mode = wall::StereoMode::side_by_side;
    told.swap_eyes = !told.swap_eyes;
    EXPECT_EQ(output_on(wall, 0, told).mode, wall::StereoMode::side_by_side);
    EXPECT_FALSE(output_on(wall, 0, told).swap_eyes) << "exchanged twice";
    EXPECT_EQ(output_on(wall, 0, told).blend.left, 0.1);
    EXPECT_EQ(output_on(wall, 1, told), told);
}

TEST(SessionWall, NamesTheFileTheScreenAndTheRemedy) {
    DeskOptions options;
    options.wall = wall_file("no-such.toml");
    const auto missing = session_wall(options);
    ASSERT_FALSE(missing);
    EXPECT_NE(missing.error().line().find("no-such.toml"), std::string::npos);
}

TEST(SessionHead, IsTheFlownOneUntilATrackerSpeaks) {
    Viewed viewed = block_before_wall(wall_of("powerwall.toml"));
    const Vec3 home = head_world(viewed.desk.wall.setup, viewed.viewer.head).position_m;
    EXPECT_LT(glm::length(home - viewed.desk.hands.front().home_head_world.position_m), 1e-12);
    const std::vector<InputEvent> press{{0, KeyInput{Key::right, KeyMotion::press, {}}}};
    static_cast<void>(viewed.step(press, {.dt_s = 0.5, .tool = {}}, {.eye_size = {1280, 720}}));
    EXPECT_GT(head_world(viewed.desk.wall.setup, viewed.viewer.head).position_m.x, home.x + 0.05);

    const Vec3 place = home + Vec3(-0.4, 0.1, 0.2);
    std::vector<InputEvent> said;
    for (int i = 0; i < 20; ++i) said.push_back(head_at(i * 5'000'000, place));
    SessionHead head = follow_head(viewed.viewer.head, viewed.desk.wall.setup, viewed.desk.wall.setup.timing, said,
                                   100'000'000, viewed.viewer.desk.head_world);
    EXPECT_TRUE(head.tracked);
    EXPECT_LT(glm::length(head_world(viewed.desk.wall.setup, head).position_m - place), 1e-9);
}

TEST(SessionHead, IsPredictedToEachEyesOwnTime) {
    const Viewed viewed = block_before_wall(wall_of("powerwall.toml"));
    ASSERT_EQ(viewed.desk.wall.setup.timing.eye_order, wall::EyeOrder::left_first);
    std::vector<InputEvent> said;
    const double speed_m_per_s = 0.6;
    const auto x_at = [&](Nanoseconds t) { return speed_m_per_s * seconds(t); };
    for (int i = 0; i <= 20; ++i) said.push_back(head_at(i * 5'000'000, {x_at(i * 5'000'000), 1.6, 2.0}));
    const Nanoseconds shown_ns = 120'000'000;
    const SessionHead head = follow_head({}, viewed.desk.wall.setup, viewed.desk.wall.setup.timing, said, shown_ns, {});
    EXPECT_NEAR(head.poses.left_tracker.position_m.x, x_at(shown_ns), 1e-6);
    EXPECT_NEAR(head.poses.right_tracker.position_m.x, x_at(shown_ns) + speed_m_per_s / 120.0, 1e-6);
}

TEST(SessionHead, SeesATurnOfTheSessionsOwnWithBothEyesAtItsTime) {
    const wall::WallSetup setup = wall_of("powerwall.toml").setup;
    ASSERT_EQ(setup.timing.eye_order, wall::EyeOrder::left_first);
    EXPECT_EQ(timing_in(setup, wall::StereoMode::two_layers).eye_order, wall::EyeOrder::left_first);
    EXPECT_EQ(timing_in(setup, wall::StereoMode::frame_sequential).eye_order, wall::EyeOrder::simultaneous)
        << "the other eye's turn has a frame of its own, predicted to its own time";
}

TEST(SessionHead, GivesEveryScreenTheSameEyes) {
    Viewed viewed = block_before_wall(wall_of("cave.toml"));
    const wall::Eyes eyes = wall::eyes_world(viewed.desk.wall.setup, viewed.viewer.head.poses);
    for (std::size_t i = 0; i < viewed.desk.wall.screens.size(); ++i) {
        const View sight = view_of(viewed.desk.wall.setup, i, viewed.viewer.head, viewed.viewer.interpupillary_m);
        EXPECT_TRUE(sight.visible) << viewed.desk.wall.screens[i].name;
        EXPECT_LT(glm::length(wall::eyes_of(sight.viewer).left_world - eyes.left_world), 1e-9);
        EXPECT_LT(glm::length(wall::eyes_of(sight.viewer).right_world - eyes.right_world), 1e-9);
    }
    const View wider = view_of(viewed.desk.wall.setup, 1, viewed.viewer.head, 0.07);
    EXPECT_NEAR(wider.viewer.interpupillary_m, 0.07, 1e-12);
}

TEST(SessionHead, BehindAScreenLeavesThatOneDark) {
    Viewed viewed = block_before_wall(wall_of("cave.toml"));
    viewed.viewer.head = follow_head(viewed.viewer.head, viewed.desk.wall.setup, viewed.desk.wall.setup.timing, {}, 0,
                                     {{-1.8, 1.6, 1.5}, Quat{1, 0, 0, 0}});
    EXPECT_FALSE(scene_of(viewed.seen(), 0, Vec3(0.0), {})) << "the left wall";
    EXPECT_TRUE(scene_of(viewed.seen(), 1, Vec3(0.0), {}));
}

TEST(SessionState, StrainsNobodyAtHomeAndSaysSoWhenTheWorkpieceComesTooNear) {
    Viewed viewed = block_before_wall(wall_of("powerwall.toml"));
    haptics::ToolState tool;
    tool.proxy_object_m = {0.0, 0.0, 0.1};
    const wall::ComfortFinding home = comfort_of(viewed.seen(), tool);
    EXPECT_FALSE(home.crossed_too_much || home.uncrossed_too_much)
        << wall::warning_of(home, viewed.desk.wall.setup.budget);
    viewed.state.world_from_object.position_m.z += 1.5;
    const wall::ComfortFinding near = comfort_of(viewed.seen(), tool);
    EXPECT_TRUE(near.crossed_too_much);
    EXPECT_FALSE(wall::warning_of(near, viewed.desk.wall.setup.budget).empty());
}

TEST(SessionState, AWandCarriesTheScene) {
    Viewed viewed = block_before_wall(wall_of("powerwall.toml"));
    const auto wand = [](double x) { return WandInput{0, {{x, 1.2, 1.0}, Quat{1, 0, 0, 0}}, true}; };
    const Similarity before = viewed.state.world_from_object;
    const std::vector<InputEvent> grabs{{0, wand(0.0)}, {0, WandClick{0, 0, true}}}, moves{{20'000'000, wand(0.25)}};
    const StepView view{.dt_s = 0.02, .tool = {}};
    static_cast<void>(viewed.step(grabs, view, {.eye_size = {1280, 720}}));
    EXPECT_TRUE(viewed.step(moves, view, {.eye_size = {1280, 720}}).parameters);
    EXPECT_LT(glm::length(viewed.state.world_from_object.position_m - before.position_m - Vec3(0.25, 0, 0)), 1e-9);
}

TEST(PresentedParts, BringEveryImageUpToDateWhateverItsAge) {
    // Pictures of a few pixels, changed at random; images are taken in any order, as a window system gives them.
    constexpr std::uint32_t kWidth = 12, kHeight = 7;
    std::mt19937 random(17);
    const auto below = [&](std::uint32_t n) { return static_cast<std::uint32_t>(random() % n); };
    for (int run = 0; run < 30; ++run) {
        PresentedParts parts;
        std::vector<int> picture(kWidth * kHeight, 0);
        struct SwapImage {
            std::vector<int> pixels = std::vector<int>(kWidth * kHeight, -1);
            std::uint64_t shown_as = 0;
        };
        std::array<SwapImage, 4> images;
        std::uint64_t presented = 0;
        std::size_t drawn = 0;
        for (int frame = 1; frame < 200; ++frame) {
            const bool all = below(20) == 0;
            for (std::uint32_t change = below(3); change > 0; --change) {
                PixelRect part{below(kWidth), below(kHeight), 0, 0};
                part.width = below(kWidth - part.x + 1);
                part.height = below(kHeight - part.y + 1);
                for (std::uint32_t y = part.y; y < part.y + part.height; ++y)
                    for (std::uint32_t x = part.x; x < part.x + part.width; ++x) picture[y * kWidth + x] = frame;
                parts.change(part);
            }
            if (all) {
                std::ranges::fill(picture, frame);
                parts.change_all();
            }
            if (below(4) == 0) continue;  // the window took no picture this time
            SwapImage& image = images.at(below(4));
            const auto needed = parts.since(image.shown_as == 0 ? 0 : presented - image.shown_as + 1);
            if (needed.whole) image.pixels = picture;
            std::vector<int> times(kWidth * kHeight, 0);
            for (const PixelRect& part : needed.parts)
                for (std::uint32_t y = part.y; y < part.y + part.height; ++y)
                    for (std::uint32_t x = part.x; x < part.x + part.width; ++x) {
                        image.pixels[y * kWidth + x] = picture[y * kWidth + x];
                        ++times[y * kWidth + x];
                    }
            ASSERT_EQ(image.pixels, picture) << "frame " << frame;
            EXPECT_LE(*std::ranges::max_element(times), 1) << "no pixel is drawn twice";
            image.shown_as = ++presented;
            parts.presented();
            drawn += needed.whole ? 1 : 0;
        }
        EXPECT_LT(drawn, 120u) << "not everything each time";
    }
}

}  // namespace burin::session
