// SPDX-License-Identifier: MIT
// The ball game (G12): a ball is thrown at a wall above a marked line and caught after at most one bounce off the
// floor. A pure step from the turns of the haptic loop to catches and misses; the ball's flight is part of it.
//
//   the ball waits at its place -> taken: the hand closes around it -> thrown: the hand opens
//     -> it flies and bounces (bodies/flight/ball_flight.hpp) -> caught, or missed -> waits at its place again
// A throw ends as a catch where the ball has hit the wall above the line, has bounced off the floor no more than once
// since it was thrown, and comes into a closed hand. It ends as a miss with the second bounce off the floor, with a hit
// below the line, where it is caught before it has come to the wall, and where it comes to rest.
// A hand catches what comes within kReach_m of its grip while it is closed more than kClosed and less than kFist. Both
// move within a turn: the ball on its arcs, the grip and the closure evenly, so a catch is judged over all of the turn
// and a fast ball is not missed between two of them.
// A slow ball weighs a part of a fast one (kWeights): docs/decisions/032-flight-and-carrying.md.
// Units: SI; the scene's frame; closures from 0 straight to 1. Allocates in flight; any thread.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "base/clock.hpp"
#include "base/error.hpp"
#include "bodies/flight/ball_flight.hpp"

namespace burin::activities {

enum class GameSpeed : std::uint8_t { slow, fast };

struct GameSettings {
    static constexpr std::array<double, 2> kWeights{0.05, 0.125};      // by speed: shares of a ball's true weight
    static constexpr std::array<double, 3> kLines_m{0.16, 0.2, 0.24};  // by level: the line's height over the floor
    static constexpr unsigned kMostThrows = 1000;
    static constexpr double kMostTime_s = 3600.0;

    GameSpeed speed = GameSpeed::slow;
    unsigned level = 1;  // of difficulty; 1 to 3
    unsigned throws = 5;
    double time_limit_s = 120.0;

    [[nodiscard]] double line_m() const { return kLines_m[level - 1]; }
    [[nodiscard]] double weight() const { return kWeights[static_cast<std::size_t>(speed)]; }
    bool operator==(const GameSettings&) const = default;
};
// Returns what nobody can do: each names its setting and what would be right. Empty: the settings are sound.
[[nodiscard]] std::vector<Error> problems(const GameSettings& settings);

// The room of the game: a floor at y = 0, and a wall whose face looks along +z.
struct GameRoom {
    double wall_z_m = -0.3;
    Vec3 serve_m{0.0, 0.2, 0.05};  // where the ball waits
    double radius_m = 0.035;
    double restitution = 0.75, tangential_kept = 0.9;
};
[[nodiscard]] bodies::FlightRoom flight_room(const GameRoom& room, const GameSettings& settings);

struct GameTurn {
    Nanoseconds time_ns = 0;
    Vec3 grip_m{0.0};      // where a ball in the hand has its middle
    double closure = 0.0;  // the mean of the fingers'
};

enum class GamePhase : std::uint8_t { begins, waits, held, flies, ended };
enum class GameEnd : std::uint8_t { not_yet, done, time_over };

struct GameState {
    static constexpr double kReach_m = 0.03;                            // from the grip
    static constexpr double kClosed = 0.25, kFist = 0.95, kOpen = 0.2;  // closures
    static constexpr Nanoseconds kThrow_ns = 20'000'000;                // over which the velocity of a throw is taken

    GamePhase phase = GamePhase::begins;
    GameEnd end = GameEnd::not_yet;
    Nanoseconds begun_ns = 0;
    GameTurn last;
    std::vector<GameTurn> recent;  // of the last kThrow_ns, the newest last
    bodies::FlyingBall ball;
    bool hit_wall = false;
    unsigned bounces = 0;  // off the floor since the throw
    unsigned throws = 0, catches = 0, misses = 0;

    [[nodiscard]] double time_s() const { return seconds(last.time_ns - begun_ns); }
};

namespace game_event {
inline constexpr std::string_view kBegun = "begun", kTaken = "taken", kThrown = "thrown", kHit = "hit above the line",
                                  kBelow = "hit below the line", kBounced = "bounced", kCaught = "caught",
                                  kMissed = "missed", kDone = "done", kTimeOver = "time over";
}
struct GameEvent {
    std::string_view what;
    Nanoseconds time_ns = 0;
    Vec3 place_m{0.0};  // of the ball
    bool operator==(const GameEvent&) const = default;
};
struct GameStep {
    GameState state;
    std::vector<GameEvent> events;
};
// Goes on by a turn. Requires sound settings and a time that rises; a game that has ended stays as it is.
[[nodiscard]] GameStep step_game(GameState state, const GameSettings& settings, const GameRoom& room,
                                 const GameTurn& turn);

// From 0 to 100: the share of the throws that were caught.
[[nodiscard]] double score_of(const GameState& state, const GameSettings& settings);

}  // namespace burin::activities
