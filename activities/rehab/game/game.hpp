// SPDX-License-Identifier: MIT
// The ball game in a session: its settings, its ball, its rules' steps. It moves the ball by itself: the rules say who
// has it, and the body goes with the hand, flies or waits accordingly (bodies/body_frame.hpp). In flight fingers do
// not turn its way, so what is seen and felt is the flight that is judged. One thread, the frame's; the body is the
// scene's.
#pragma once

#include <memory>
#include <optional>
#include <span>

#include "activities/rehab/game/game_exercise.hpp"

namespace burin::activities {

// Requires sound values of Game::setting_kinds().
[[nodiscard]] GameSettings game_settings(const SettingValues& values);

class Game final : public Exercise {
public:
    [[nodiscard]] static std::span<const SettingKind> setting_kinds();
    [[nodiscard]] static std::unique_ptr<Exercise> make(const SettingValues& values);
    // Returns what cannot be met together. Requires sound values.
    [[nodiscard]] static std::optional<Error> conflict(const SettingValues& values);
    // Requires sound values.
    explicit Game(const SettingValues& values);

    [[nodiscard]] const char* name() const override { return "game"; }
    [[nodiscard]] const SettingValues& settings() const override { return values_; }
    [[nodiscard]] bodies::SoftPartSetup body() const override;
    [[nodiscard]] std::array<double, 3> srgb() const override { return {0.9, 0.55, 0.16}; }
    [[nodiscard]] std::optional<session::LedHand> led_hand() const override;
    void begin(bodies::SoftPart& body, session::ActivityOrders& orders) override;
    void turn(const ExerciseTurn& turn, session::ActivityOrders& orders) override;
    void interrupt(Nanoseconds time_ns, session::ActivityOrders& orders) override;
    [[nodiscard]] ExerciseGoal goal() const override;
    [[nodiscard]] ExerciseEnd end() const override { return state_.end; }
    [[nodiscard]] ExerciseCourse course() const override;
    [[nodiscard]] std::string task() const override;
    [[nodiscard]] std::vector<std::string> help() const override;

private:
    void tell(const ExerciseEvent& event, session::ActivityOrders& orders);
    // Has the body do what the rules' ball does from the step on.
    void move_body(const GameState& before, session::ActivityOrders& orders) const;

    SettingValues values_;
    GameSettings settings_;
    GameRoom room_;
    GameState state_;
    bodies::SoftPart* body_ = nullptr;  // the scene's
    Nanoseconds away_ns_ = 0;           // as the last turn has it
    std::vector<ExerciseEvent> events_;
};

}  // namespace burin::activities
