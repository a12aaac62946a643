// SPDX-License-Identifier: MIT
// The ball exercise in a session: its settings, its body, its rules' steps. One thread, the frame's.
#pragma once

#include <memory>
#include <optional>
#include <span>

#include "activities/rehab/ball/ball_exercise.hpp"

namespace burin::activities {

// Requires sound values of Ball::setting_kinds().
[[nodiscard]] BallSettings ball_settings(const SettingValues& values);

class Ball final : public Exercise {
public:
    [[nodiscard]] static std::span<const SettingKind> setting_kinds();
    [[nodiscard]] static std::unique_ptr<Exercise> make(const SettingValues& values);
    // Returns what cannot be met together. Requires sound values.
    [[nodiscard]] static std::optional<Error> conflict(const SettingValues& values);
    // Requires sound values.
    explicit Ball(const SettingValues& values);

    [[nodiscard]] const char* name() const override { return "ball"; }
    [[nodiscard]] const SettingValues& settings() const override { return values_; }
    [[nodiscard]] bodies::SoftPartSetup body() const override;
    [[nodiscard]] bool is_carried() const override { return true; }
    [[nodiscard]] std::array<double, 3> srgb() const override { return kind_of(settings_.colour).srgb; }
    [[nodiscard]] double target_N() const override { return target_N_of(state_, settings_); }
    [[nodiscard]] Json findings() const override;
    void turn(const ExerciseTurn& turn, session::ActivityOrders& orders) override;
    void interrupt(Nanoseconds time_ns, session::ActivityOrders& orders) override;
    [[nodiscard]] ExerciseGoal goal() const override;
    [[nodiscard]] ExerciseEnd end() const override { return state_.end; }
    [[nodiscard]] ExerciseCourse course() const override;
    [[nodiscard]] std::string task() const override;
    [[nodiscard]] std::vector<std::string> help() const override;

private:
    void follow_pressed_open(const ExerciseTurn& turn, session::ActivityOrders& orders);
    void tell(const ExerciseEvent& event, session::ActivityOrders& orders);

    SettingValues values_;
    BallSettings settings_;
    BallState state_;
    std::vector<ExerciseEvent> events_;
    double pressed_open_s_ = 0.0;  // with the target's force and no grasp, since it was less
    unsigned pressed_open_ = 0;    // how often for kPressedOpen_s
};

}  // namespace burin::activities
