// SPDX-License-Identifier: MIT
// The ball game (G12): a ball is thrown at a wall above a marked line and caught after at most one bounce off the
// floor. A pure step from the turns of the haptic loop to catches and misses; the ball's flight is part of it.
//
//   the ball waits at its place -> taken: the hand closes around it -> thrown: the hand opens
//     -> it flies and bounces (bodies/flight/ball_flight.hpp) -> caught, or missed -> waits at its place again
// A throw ends as a catch where the ball has hit the wall above the line, has bounced off the floor no more than once
// since it was thrown, and comes into a closed hand. It ends as a miss with the second bounce off the floor, with a hit
// below the line, where it is caught before it has come to the wall, and where it comes to rest. A ball that has just
// been thrown is not caught until it has touched wall or floor or has left the hand's reach: else a hand whose closure
// trembles would catch its own throw.
// A hand catches what comes within kReach_m of its grip while it is closed more than kClosed and less than kFist. Both
// move within a turn: the ball on its arcs, the grip and the closure evenly, so a catch is judged over all of the turn
// and a fast ball is not missed between two of them. It stays in the hand where it was caught.
// A slow ball weighs a part of a fast one (kWeights): docs/decisions/032-flight-and-carrying.md.
// Units: SI; the scene's frame; closures from 0 straight to 1. Allocates in flight; any thread.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "activities/rehab/exercise/exercise.hpp"
#include "base/clock.hpp"
#include "bodies/flight/ball_flight.hpp"

namespace burin::activities {

enum class GameSpeed : std::uint8_t { slow, fast };

struct GameSettings {
    static constexpr std::array<double, 2> kWeights{0.05, 0.125};      // by speed: shares of a ball's true weight
    static constexpr std::array<double, 3> kLines_m{0.16, 0.2, 0.24};  // by level: the line's height over the floor

    GameSpeed speed = GameSpeed::slow;
    unsigned level = 1;  // of difficulty; 1 to 3
    unsigned throws = 5;
    double time_limit_s = 120.0;

    [[nodiscard]] double line_m() const { return kLines_m[level - 1]; }
    [[nodiscard]] double weight() const { return kWeights[static_cast<std::size_t>(speed)]; }
    bool operator==(const GameSettings&) const = default;
};

// The room of the game: a floor at y = 0, and a wall whose face looks along +z.
struct GameRoom {
    double wall_z_m = -0.3;
    Vec3 serve_m{0.0, 0.2, 0.05};  // where the ball waits
    double radius_m = 0.035;
    double restitution = 0.75, tangential_kept = 0.9;
};
[[nodiscard]] bodies::FlightRoom flight_room(const GameRoom& room, const GameSettings& settings);

// The hand at a turn of the session, as the rules read it.
struct GameTurn {
    Nanoseconds time_ns = 0;
    Pose palm;
    Vec3 grip_m{0.0};      // where a ball that is held has its middle
    double closure = 0.0;  // the mean of the fingers'
};
// The middle of a ball of 7 cm between the fingertips of a simulated hand that closes on it, in the hand's frame
// (devices/gloves/glove_hand.hpp).
inline constexpr Vec3 kGrip_hand_m{-0.005, 0.053, -0.06};
[[nodiscard]] GameTurn game_turn(const ExerciseTurn& turn);

// Phases of the ball, which go on after the game's end. resumes: after a break, it waits from the next turn on.
enum class GamePhase : std::uint8_t { begins, waits, held, flies, resumes };

struct GameState {
    static constexpr double kReach_m = 0.03;                            // from the grip
    static constexpr double kClosed = 0.25, kFist = 0.95, kOpen = 0.2;  // closures
    static constexpr Nanoseconds kThrow_ns = 20'000'000;                // over which the velocity of a throw is taken

    GamePhase phase = GamePhase::begins;
    ExerciseEnd end = ExerciseEnd::not_yet;
    Nanoseconds begun_ns = 0;
    GameTurn last;
    std::vector<GameTurn> recent;  // of the last kThrow_ns, the newest last
    bodies::FlyingBall ball;
    Vec3 in_palm_m{0.0};    // of a ball that is held: where it lies
    bool has_left = false;  // of one that flies: the hand that threw it
    bool hit_wall = false;
    unsigned bounces = 0;  // off the floor since the throw
    unsigned throws = 0, catches = 0, misses = 0;

    [[nodiscard]] double time_s() const { return seconds(last.time_ns - begun_ns); }
};

namespace game_event {
inline constexpr std::string_view kBegun = "begun", kTaken = "taken", kThrown = "thrown", kHit = "hit above the line",
                                  kBelow = "hit below the line", kBounced = "bounced", kCaught = "caught",
                                  kMissed = "missed", kDone = "done", kTimeOver = "time over",
                                  kInterrupted = "interrupted";
}
struct GameStep {
    GameState state;
    std::vector<ExerciseEvent> events;
};
// Goes on by a turn. Requires sound settings and a time that rises; a game that has ended stays as it is.
[[nodiscard]] GameStep step_game(GameState state, const GameSettings& settings, const GameRoom& room,
                                 const ExerciseTurn& turn);

// Breaks off a throw that is under way, which counts for nothing; the ball is back at its place with the next turn.
[[nodiscard]] GameStep interrupted(GameState state, Nanoseconds time_ns);

// From 0 to 100: the share of the throws that were caught.
[[nodiscard]] double score_of(const GameState& state, const GameSettings& settings);

}  // namespace burin::activities
