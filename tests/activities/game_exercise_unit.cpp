// SPDX-License-Identifier: MIT
// The ball game's rules, by throws whose way is worked out by hand.
#include <gtest/gtest.h>

#include <algorithm>
#include <string_view>
#include <vector>

#include "activities/rehab/game/game_exercise.hpp"
#include "tests/support/uneven_poses.hpp"

namespace burin::activities {
namespace {

constexpr double kCupped = 0.5, kFlat = 0.0;

// A game whose hand is led from place to place.
class Played {
public:
    explicit Played(const GameSettings& settings) : settings_(settings) {}
    void turn(const Vec3& grip_m, double closure, double turn_s = 0.001) {
        now_ns_ += static_cast<Nanoseconds>(1e9 * turn_s + 0.5);
        ExerciseTurn turn;
        turn.time_ns = now_ns_;
        turn.scene_from_hand.position_m = grip_m - kGrip_hand_m;
        turn.closure = closure;
        GameStep step = step_game(state, settings_, room, turn);
        state = step.state;
        events.insert(events.end(), step.events.begin(), step.events.end());
    }
    void stay(const Vec3& grip_m, double closure, double for_s, double turn_s = 0.001) {
        for (double t = 0.5 * turn_s; t < for_s; t += turn_s) turn(grip_m, closure, turn_s);
    }
    // Takes the ball from its place and throws it; returns where it leaves the hand.
    Vec3 throws(const Vec3& velocity) {
        Vec3 at = room.serve_m;
        stay(at, kFlat, 0.01);
        stay(at, kCupped, 0.01);
        for (int i = 0; i < 50; ++i) turn(at += 0.001 * velocity, kCupped);
        turn(at += 0.001 * velocity, kFlat);
        return at;
    }
    [[nodiscard]] bool has(std::string_view what) const {
        return std::ranges::any_of(events, [&](const ExerciseEvent& event) { return event.what == what; });
    }
    GameRoom room;
    GameState state;
    std::vector<ExerciseEvent> events;

private:
    GameSettings settings_;
    Nanoseconds now_ns_ = 1'000'000'000;
};

// Where a thrown ball is some seconds after it has left the hand, having hit the wall and not the floor.
Vec3 back_from_wall(const Played& game, const GameSettings& settings, const Vec3& from, const Vec3& v, double t) {
    const double g = 9.81 * settings.weight(), kept = game.room.tangential_kept, e = game.room.restitution;
    const double wall_s = (from.z - game.room.wall_z_m - game.room.radius_m) / -v.z, left_s = t - wall_s;
    const double hit_y = from.y + v.y * wall_s - 0.5 * g * wall_s * wall_s, rise = kept * (v.y - g * wall_s);
    return {from.x + v.x * wall_s + kept * v.x * left_s, hit_y + rise * left_s - 0.5 * g * left_s * left_s,
            game.room.wall_z_m + game.room.radius_m - e * v.z * left_s};
}

}  // namespace

TEST(GameExercise, CountsACatchWhereTheBallComesBackInto) {
    for (const GameSpeed speed : {GameSpeed::slow, GameSpeed::fast}) {
        const GameSettings settings{.speed = speed, .throws = 1};
        Played game(settings);
        const Vec3 velocity(0.02, 0.3, -0.6), from = game.throws(velocity);
        const Vec3 there = back_from_wall(game, settings, from, velocity, 0.7);
        game.stay(there, kFlat, 0.55);  // it is open while the ball passes on its way to the wall
        game.stay(there, kCupped, 0.3);
        EXPECT_TRUE(game.has(game_event::kHit));
        EXPECT_EQ(game.state.catches, 1u);
        EXPECT_EQ(game.state.end, ExerciseEnd::done);
        EXPECT_DOUBLE_EQ(score_of(game.state, settings), 100.0);
        Played beside(settings);
        beside.throws(velocity);
        beside.stay(there + Vec3(2.0 * GameState::kReach_m, 0.0, 0.0), kCupped, 60.0);
        EXPECT_EQ(beside.state.misses, 1u);
    }
}

TEST(GameExercise, CatchesNothingWithAnOpenHandOrAFist) {
    const GameSettings settings{.throws = 1};
    for (const double closure : {0.1, 0.99}) {
        Played game(settings);
        const Vec3 velocity(0.0, 0.3, -0.6), from = game.throws(velocity);
        game.stay(back_from_wall(game, settings, from, velocity, 0.9), closure, 60.0);
        EXPECT_EQ(game.state.catches, 0u) << closure;
        EXPECT_EQ(game.state.misses, 1u);
    }
}

// At neither end of the turn is the ball in the hand, and the hand is open at its beginning.
TEST(GameExercise, CatchesABallThatPassesWithinATurn) {
    const GameSettings settings{.throws = 1};
    Played game(settings);
    const Vec3 velocity(0.0, 0.3, -0.6), from = game.throws(velocity);
    const Vec3 there = back_from_wall(game, settings, from, velocity, 0.9);
    game.stay(there + Vec3(0.0, 0.0, 0.5), kFlat, 0.8);
    ASSERT_GT(glm::length(game.state.ball.place_m - there), 1.2 * GameState::kReach_m);
    game.turn(there - Vec3(0.0, 0.0, 0.5), 0.9, 0.2);
    EXPECT_EQ(game.state.catches, 1u);
}

TEST(GameExercise, CountsAMissBelowTheLineAndWithTheSecondBounce) {
    Played low({.level = 3, .throws = 1});
    low.throws({0.0, 0.0, -0.6});
    low.stay({5.0, 5.0, 5.0}, kCupped, 2.0);
    EXPECT_TRUE(low.has(game_event::kBelow));
    EXPECT_EQ(low.state.misses, 1u);
    Played twice({.throws = 1});
    twice.throws({0.0, 0.2, -0.6});
    twice.stay({5.0, 5.0, 5.0}, kCupped, 20.0);
    EXPECT_TRUE(twice.has(game_event::kHit));
    EXPECT_EQ(std::ranges::count(twice.events, game_event::kBounced, &ExerciseEvent::what), 2);
    EXPECT_EQ(twice.state.misses, 1u);
}

// A hand whose closure trembles about the thresholds opens and closes 50 times a second while it throws.
TEST(GameExercise, ThrowsABallFromATremblingHand) {
    const GameSettings settings{.throws = 1};
    Played game(settings);
    const Vec3 velocity(0.0, 0.3, -0.6);
    Vec3 at = game.throws(velocity);
    for (int i = 0; i < 40; ++i) game.turn(at += 0.001 * velocity, i % 20 < 10 ? 0.26 : 0.19);
    EXPECT_EQ(game.state.phase, GamePhase::flies) << "the hand goes with the ball, and has not caught it";
    EXPECT_EQ(game.state.misses, 0u);
    game.stay(at + Vec3(0.0, 0.0, 0.2), kFlat, 0.5);
    EXPECT_TRUE(game.has(game_event::kHit));
    // Where it has left the hand, a hand that comes after it catches it before the wall, and that is a miss.
    Played hasty(settings);
    at = hasty.throws({0.0, 0.0, -0.1});
    hasty.stay(at + Vec3(0.0, 0.0, 0.1), kFlat, 0.1);
    hasty.stay(hasty.state.ball.place_m, kCupped, 0.01);
    EXPECT_EQ(hasty.state.misses, 1u);
}

// Caught at the border of what the hand reaches, it stays there in the hand.
TEST(GameExercise, KeepsACaughtBallWhereItLies) {
    const GameSettings settings{.throws = 2};
    Played game(settings);
    const Vec3 velocity(0.02, 0.3, -0.6), from = game.throws(velocity);
    const Vec3 there = back_from_wall(game, settings, from, velocity, 0.7) + Vec3(0.02, 0.0, 0.0);
    game.stay(there, kFlat, 0.55);
    Vec3 before = game.state.ball.place_m;
    double farthest_m = 0.0;
    for (int i = 0; i < 400; ++i) {
        game.turn(there + Vec3(0.0, 0.0, 0.0003 * i), kCupped);
        farthest_m = std::max(farthest_m, glm::length(game.state.ball.place_m - before));
        before = game.state.ball.place_m;
    }
    EXPECT_EQ(game.state.catches, 1u);
    EXPECT_LT(farthest_m, 0.001) << "no faster than the ball, or the hand";
    EXPECT_GT(glm::length(game.state.ball.place_m - (there + Vec3(0.0, 0.0, 0.0003 * 399))), 0.015);
}

TEST(GameExercise, EndsWithItsTimeAndStaysAsItIsThen) {
    Played game({.time_limit_s = 0.5});
    game.stay(Vec3(1.0), kFlat, 1.0);
    EXPECT_EQ(game.state.end, ExerciseEnd::time_over);
    EXPECT_NEAR(game.state.time_s(), 0.5, 1e-9);
}

// The ball lies in the palm as it was taken, however that stood then and turns afterwards.
TEST(GameExercise, CarriesTheBallAlongAsThePalmTurns) {
    const GameSettings settings{.throws = 1};
    const GameRoom room;
    for (std::size_t pose = 0; pose < kUnevenPoses; ++pose) {
        GameState state;
        ExerciseTurn turn;
        turn.time_ns = 1'000'000'000;
        const auto go_to = [&](const Pose& palm, double closure) {
            turn.time_ns += 1'000'000;
            turn.scene_from_hand = {palm.position_m, palm.orientation, 1.0};
            turn.closure = closure;
            state = step_game(state, settings, room, turn).state;
        };
        const Quat stands = uneven_turn(pose);
        const Vec3 beside_m = 0.2 * GameState::kReach_m * uneven_direction(pose);
        const Pose taken{room.serve_m + beside_m - stands * kGrip_hand_m, stands};
        go_to(taken, kFlat);
        for (int i = 0; i < 3; ++i) go_to(taken, kCupped);
        ASSERT_EQ(state.phase, GamePhase::held) << pose;
        const Vec3 in_palm_m = glm::conjugate(taken.orientation) * (room.serve_m - taken.position_m);
        for (int i = 1; i <= 100; ++i) {
            const Pose palm{taken.position_m + 0.01 * i * uneven_offset(pose + 1),
                            stands * glm::angleAxis(0.02 * i, uneven_direction(pose + 2))};
            go_to(palm, kCupped);
            ASSERT_LT(glm::distance(state.ball.place_m, palm.position_m + palm.orientation * in_palm_m), 1e-12)
                << pose << " " << i;
        }
    }
}

}  // namespace burin::activities
