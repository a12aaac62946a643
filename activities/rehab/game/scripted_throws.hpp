// SPDX-License-Identifier: MIT
// A scripted participant of the ball game, drawn from a seed, as lines of a session's input: where it throws from, how
// fast, and where it waits for the ball. Some throws go below the line, and some balls it does not catch: it waits
// elsewhere, or its hand stays open. It leads its hand by mouse and wheel, so what comes of it is the session's: hand,
// fingers, ball and rules.
// Frame: the scene's, in which a desk of the usual size leads the hand (Game::led_hand()); it stays in the plane x = 0.
// Pure; any thread.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "activities/rehab/game/game_exercise.hpp"

namespace burin::activities {

enum class ScriptedCatch : std::uint8_t { there, elsewhere, with_open_hand };

struct ScriptedThrow {
    Vec3 from_m{0.0}, velocity_m_per_s{0.0};  // of the ball's middle, as it leaves the hand
    ScriptedCatch caught = ScriptedCatch::there;
    Vec3 waits_m{0.0};     // where the grip is then
    double returns_s = 0;  // from the throw until the ball is there, or would be; of one below the line until it hits
};
// Returns as many throws as the game asks for.
[[nodiscard]] std::vector<ScriptedThrow> drawn_throws(const GameSettings& settings, const GameRoom& room,
                                                      std::uint64_t seed);

// Returns the script, up to its first command to the mouse, with these throws; it ends with the last of them, or a
// little after the time limit.
[[nodiscard]] std::string with_throws(std::string_view script, const std::vector<ScriptedThrow>& throws,
                                      const GameSettings& settings, const GameRoom& room);

// Returns the script as the participant of that seed follows it.
[[nodiscard]] std::string scripted_game(const SettingValues& values, std::uint64_t seed, std::string_view script);

}  // namespace burin::activities
