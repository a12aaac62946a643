// SPDX-License-Identifier: MIT
// The putty exercise in a session: its settings, its body, its rules' steps. One thread, the frame's.
#pragma once

#include <memory>
#include <optional>
#include <span>

#include "activities/rehab/putty/putty_exercise.hpp"

namespace burin::activities {

// Requires sound values of Putty::setting_kinds().
[[nodiscard]] PuttySettings putty_settings(const SettingValues& values);

class Putty final : public Exercise {
public:
    [[nodiscard]] static std::span<const SettingKind> setting_kinds();
    [[nodiscard]] static std::unique_ptr<Exercise> make(const SettingValues& values);
    // Returns what cannot be met together. Requires sound values.
    [[nodiscard]] static std::optional<Error> conflict(const SettingValues& values);
    // Returns how a simulated hand has to close for it (devices/gloves/grip_shape.hpp). Requires sound values.
    [[nodiscard]] static std::string_view grip(const SettingValues& values);
    // Requires sound values.
    explicit Putty(const SettingValues& values);

    [[nodiscard]] const char* name() const override { return "putty"; }
    [[nodiscard]] const SettingValues& settings() const override { return values_; }
    [[nodiscard]] bodies::SoftPartSetup body() const override;
    [[nodiscard]] std::array<double, 3> srgb() const override { return kind_of(settings_.hardness).srgb; }
    [[nodiscard]] WhichFingers pressing_fingers() const override {
        return {true, true, !settings_.is_pinch(), !settings_.is_pinch()};
    }
    [[nodiscard]] double target_N() const override { return settings_.target_N(); }
    void turn(const ExerciseTurn& turn, session::ActivityOrders& orders) override;
    void interrupt(Nanoseconds time_ns, session::ActivityOrders& orders) override;
    [[nodiscard]] ExerciseGoal goal() const override;
    [[nodiscard]] ExerciseEnd end() const override { return state_.end; }
    [[nodiscard]] ExerciseCourse course() const override;
    [[nodiscard]] std::string task() const override;
    [[nodiscard]] std::vector<std::string> help() const override;

private:
    void tell(const ExerciseEvent& event, session::ActivityOrders& orders);

    SettingValues values_;
    PuttySettings settings_;
    PuttyState state_;
    std::vector<ExerciseEvent> events_;
};

}  // namespace burin::activities
