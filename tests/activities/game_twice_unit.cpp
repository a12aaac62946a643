// SPDX-License-Identifier: MIT
// Throws one after the other in one game: each ends as it would have as the first, whatever the one before was.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "activities/rehab/game/game_exercise.hpp"

namespace burin::activities {
namespace {

namespace Event = game_event;

// Courses of a throw: off the wall and into the hand; into the hand before it has come to the wall; against the wall
// below the line; off the wall and twice off the floor; twice off the floor and never to the wall.
enum class ThrownBall { caught, hasty, below, twice, weak };
constexpr std::array kThrownBalls{ThrownBall::caught, ThrownBall::hasty, ThrownBall::below, ThrownBall::twice,
                                  ThrownBall::weak};
constexpr std::array<const char*, 5> kNamesOfThrows{"caught", "hasty", "below", "twice", "weak"};

using Told = std::vector<std::string>;

// Returns the events that the game's rules ask for in such a throw.
Told told_of_throw(ThrownBall ball) {
    const auto words = [](std::initializer_list<std::string_view> all) { return Told(all.begin(), all.end()); };
    switch (ball) {
        case ThrownBall::caught: return words({Event::kThrown, Event::kHit, Event::kCaught});
        case ThrownBall::hasty: return words({Event::kThrown, Event::kMissed});
        case ThrownBall::below: return words({Event::kThrown, Event::kBelow, Event::kMissed});
        case ThrownBall::twice:
            return words({Event::kThrown, Event::kHit, Event::kBounced, Event::kBounced, Event::kMissed});
        case ThrownBall::weak: return words({Event::kThrown, Event::kBounced, Event::kBounced, Event::kMissed});
    }
    return {};
}

class ManyThrows {
public:
    // Throws a ball, which waits at its place or is in the hand, and follows it to the end; returns what was told.
    Told play(ThrownBall kind) {
        const Vec3 velocity = velocity_of(kind);
        pick_up();
        told_.clear();
        for (int i = 0; i < 50; ++i) turn(at_m_ + 0.001 * velocity, kCup);
        turn(at_m_ + 0.001 * velocity, kOpenHand);
        EXPECT_EQ(state.phase, GamePhase::flies);
        EXPECT_LT(glm::distance(state.ball.velocity_m_per_s, velocity), 1e-9) << "as the hand in this throw";
        const Vec3 from_m = state.ball.place_m;
        // A hand that trembles while it goes along with the ball catches nothing of its own throw.
        for (int i = 0; i < 10; ++i) turn(at_m_ + 0.001 * velocity, i % 2 == 0 ? 0.26 : 0.19);
        EXPECT_EQ(state.phase, GamePhase::flies);
        if (kind == ThrownBall::caught) {
            const Vec3 there_m = off_the_wall(from_m, velocity, 0.7);
            stay(there_m, kOpenHand, 0.55);
            stay(there_m, kCup, 0.3);
        } else if (kind == ThrownBall::hasty) {
            stay(at_m_ + Vec3(0.0, 0.0, 0.1), kOpenHand, 0.1);
            stay(state.ball.place_m, kCup, 0.01);
        } else {
            for (int i = 0; i < 20'000 && state.phase == GamePhase::flies; ++i) turn(Vec3(5.0), kCup);
        }
        EXPECT_NE(state.phase, GamePhase::flies) << "it has ended";
        return told_;
    }
    GameState state;

private:
    static constexpr double kCup = 0.5, kOpenHand = 0.0;

    static Vec3 velocity_of(ThrownBall kind) {
        switch (kind) {
            case ThrownBall::caught: return {0.02, 0.3, -0.6};
            case ThrownBall::hasty: return {0.0, 0.0, -0.1};
            case ThrownBall::below: return {0.0, -0.2, -1.0};
            case ThrownBall::twice: return {0.01, 0.2, -0.6};
            case ThrownBall::weak: return {0.0, 0.0, -0.05};
        }
        return {};
    }
    void turn(const Vec3& grip_m, double closure) {
        at_m_ = grip_m;
        ExerciseTurn turn;
        turn.time_ns = now_ns_ += 1'000'000;
        turn.scene_from_hand.position_m = grip_m - kGrip_hand_m;
        turn.closure = closure;
        GameStep step = step_game(state, settings_, room_, turn);
        state = step.state;
        for (const ExerciseEvent& event : step.events) told_.emplace_back(event.what);
    }
    void stay(const Vec3& grip_m, double closure, double for_s) {
        for (double t = 0.0005; t < for_s; t += 0.001) turn(grip_m, closure);
    }
    // Has the ball in the hand, and the hand where the ball waits at first.
    void pick_up() {
        if (state.phase == GamePhase::held) {
            const Vec3 from_m = at_m_;
            for (int i = 1; i <= 200; ++i) turn(from_m + i / 200.0 * (room_.serve_m - from_m), kCup);
        } else {
            stay(room_.serve_m, kOpenHand, 0.01);
        }
        stay(room_.serve_m, kCup, 0.03);
        ASSERT_EQ(state.phase, GamePhase::held);
    }
    // Where a thrown ball is some seconds later, having hit the wall and not the floor.
    [[nodiscard]] Vec3 off_the_wall(const Vec3& from, const Vec3& v, double t) const {
        const double g = 9.81 * settings_.weight(), kept = room_.tangential_kept;
        const double wall_s = (from.z - room_.wall_z_m - room_.radius_m) / -v.z, left_s = t - wall_s;
        const double hit_y = from.y + v.y * wall_s - 0.5 * g * wall_s * wall_s, rise = kept * (v.y - g * wall_s);
        return {from.x + v.x * wall_s + kept * v.x * left_s, hit_y + rise * left_s - 0.5 * g * left_s * left_s,
                room_.wall_z_m + room_.radius_m - room_.restitution * v.z * left_s};
    }

    GameSettings settings_{.throws = 1000, .time_limit_s = 1e6};
    GameRoom room_;
    Vec3 at_m_{0.0};  // the grip
    Told told_;
    Nanoseconds now_ns_ = 1'000'000'000;
};

}  // namespace

TEST(GameThrows, EndAlikeWhateverTheOneBeforeWas) {
    for (const ThrownBall before : kThrownBalls)
        for (const ThrownBall ball : kThrownBalls) {
            ManyThrows game;
            const std::string of = std::string(kNamesOfThrows[static_cast<std::size_t>(ball)]) + " after " +
                                   kNamesOfThrows[static_cast<std::size_t>(before)];
            EXPECT_EQ(game.play(before), told_of_throw(before)) << of;
            EXPECT_EQ(game.play(ball), told_of_throw(ball)) << of;
            const auto catches = static_cast<unsigned>((before == ThrownBall::caught) + (ball == ThrownBall::caught));
            EXPECT_EQ(game.state.catches, catches) << of;
            EXPECT_EQ(game.state.misses, 2u - catches) << of;
            EXPECT_EQ(game.state.throws, 2u) << of;
        }
}

TEST(GameThrows, AreCountedOneByOneInALongGame) {
    ManyThrows game;
    unsigned catches = 0, throws = 0;
    for (int round = 0; round < 2; ++round)
        for (const ThrownBall ball : {ThrownBall::caught, ThrownBall::caught, ThrownBall::twice, ThrownBall::hasty,
                                      ThrownBall::hasty, ThrownBall::weak, ThrownBall::caught, ThrownBall::below}) {
            EXPECT_EQ(game.play(ball), told_of_throw(ball)) << "throw " << throws;
            catches += ball == ThrownBall::caught ? 1 : 0;
            ++throws;
            EXPECT_EQ(game.state.catches, catches) << throws;
            EXPECT_EQ(game.state.misses, throws - catches) << throws;
        }
}

}  // namespace burin::activities
