// SPDX-License-Identifier: MIT
// The ball game in a session: its settings' table, its world, its scripted participant, whose catches are foretold by
// the mathematics of a ball that is thrown and bounces.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <string>

#include "activities/rehab/exercise_kinds.hpp"
#include "activities/rehab/game/game.hpp"
#include "activities/rehab/game/scripted_throws.hpp"
#include "activities/rehab/rehab.hpp"
#include "base/assets.hpp"
#include "base/file_io.hpp"
#include "scene/vrml_world.hpp"
#include "tests/activities/foretold_throws.hpp"

namespace burin::activities {
namespace {

Box box_of(const scene::SceneObject& object) {
    Box box;
    for (const Vec3& place : object.mesh->positions_m) box.include(object.pose * (object.scale * place));
    return box;
}

}  // namespace

TEST(GameSettings, TellEachMistakeWithItsLine) {
    const ExerciseKind* const kind = exercise_named("game");
    ASSERT_NE(kind, nullptr);
    const ReadSettings read = read_settings(
        "[game]\nsped = \"slow\"\nspeed = \"brisk\"\nlevel = 4\nthrows = 0\ntime_limit_s = 0\n", "s.toml", *kind);
    std::string text;
    for (const Error& error : read.errors) text += error.line() + "\n";
    for (const char* line : {"s.toml:2: [game] has no key named sped; did you mean speed?",
                             "s.toml:3: speed is brisk; there are slow, fast", "s.toml:4: level is 4",
                             "s.toml:5: throws is 0", "s.toml:6: time_limit_s is 0"})
        EXPECT_TRUE(text.contains(line)) << line << " is missing in\n" << text;
    EXPECT_EQ(read.errors.size(), 5u) << text;
    EXPECT_EQ(game_settings(read_settings("", "s.toml", *kind).values), GameSettings{}) << "every key has a default";
}

// Ball, wall and floor of the world are where the rules have them, and the hand reaches the ball.
TEST(Game, HasItsRoomInTheWorld) {
    const auto world = scene::read_any_world("assets/worlds/game.toml");
    ASSERT_TRUE(world);
    const ExerciseKind& kind = *exercise_named("game");
    const auto game = kind.make(SettingValues(kind.settings));
    const GameRoom room;
    const scene::SceneObject& ball = world->objects.at(game->body().object - 1);
    EXPECT_EQ(ball.name, "ball");
    EXPECT_LT(glm::length(box_of(ball).center() - room.serve_m), 1e-4);
    EXPECT_LT(glm::length(0.5 * box_of(ball).extent() - Vec3(room.radius_m)), 2e-4);
    for (const scene::SceneObject& object : world->objects) {
        if (object.name == "floor") {
            EXPECT_NEAR(box_of(object).hi.y, 0.0, 1e-4);
        }
        if (object.name == "wall") {
            EXPECT_NEAR(box_of(object).hi.z, room.wall_z_m, 1e-4);
        }
        if (object.name == "line") {
            EXPECT_NEAR(box_of(object).center().y, GameSettings{}.line_m(), 1e-4);
        }
    }
    const auto led = game->led_hand();
    ASSERT_TRUE(led);
    const Vec3 grip = led->rest_device * kGrip_hand_m;
    for (const Vec3& place : {room.serve_m, Vec3(0.0, 0.3, 0.1), Vec3(0.0, 0.1, -0.1)})
        for (int axis = 0; axis < 3; ++axis) {
            EXPECT_GT((place - grip)[axis], led->reach_scene.lo[axis] * 1.0 - 0.02) << axis;
            EXPECT_LT((place - grip)[axis], led->reach_scene.hi[axis] + 0.02) << axis;
        }
}

TEST(ScriptedThrows, AreAsManyAsAreAskedForAndGoAsAnIndependentBallDoes) {
    unsigned caught = 0, low = 0, elsewhere = 0, open = 0;
    for (const GameSpeed speed : {GameSpeed::slow, GameSpeed::fast})
        for (unsigned level = 1; level <= 3; ++level)
            for (std::uint64_t seed = 0; seed < 30; ++seed) {
                const GameSettings settings{.speed = speed, .level = level, .throws = 6};
                const auto throws = drawn_throws(settings, {}, seed);
                ASSERT_EQ(throws.size(), 6u);
                for (const ScriptedThrow& thrown : throws) {
                    const ForetoldThrow foretold = foretold_of(thrown, settings);
                    EXPECT_EQ(foretold.catches, foretold.above_line && thrown.caught == ScriptedCatch::there)
                        << "seed " << seed << " level " << level << " ball " << foretold.nearest_m << " m away";
                    caught += foretold.catches ? 1 : 0;
                    low += foretold.above_line ? 0 : 1;
                    elsewhere += thrown.caught == ScriptedCatch::elsewhere ? 1 : 0;
                    open += thrown.caught == ScriptedCatch::with_open_hand ? 1 : 0;
                }
            }
    EXPECT_GT(caught, 500u);
    for (const unsigned missed : {low, elsewhere, open}) EXPECT_GT(missed, 50u);
}

TEST(ScriptedThrows, AreLinesInTheOrderOfTheirTimesWhateverTheirNumber) {
    const ExerciseKind& kind = *exercise_named("game");
    const auto script = read_text_file(asset_path(kind.script));
    ASSERT_TRUE(script);
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
        const std::string text = kind.scripted(SettingValues(kind.settings), seed, *script);
        double last_s = 0.0;
        std::size_t lines = 0;
        for (std::size_t at = 0; at < text.size(); at = text.find('\n', at) + 1) {
            if (std::isdigit(static_cast<unsigned char>(text[at])) == 0) continue;
            const double at_s = std::stod(text.substr(at));
            EXPECT_GE(at_s, last_s) << "seed " << seed;
            last_s = at_s;
            ++lines;
        }
        EXPECT_GT(lines, 100u);
    }
}

TEST(ScriptedThrows, EndWithTheTimeLimit) {
    const ExerciseKind& kind = *exercise_named("game");
    const auto script = read_text_file(asset_path(kind.script));
    ASSERT_TRUE(script);
    SettingValues values(kind.settings);
    values.set("throws", 1000.0);
    values.set("time_limit_s", 12.0);
    const std::string text = kind.scripted(values, 3, *script);
    EXPECT_LT(text.size(), 100'000u);
    EXPECT_TRUE(text.ends_with("command quit\n"));
    const auto last = text.rfind('\n', text.size() - 2) + 1;
    EXPECT_GT(std::stod(text.substr(last)), 13.0) << "the time limit, not the script, ends the game";
}

}  // namespace burin::activities
