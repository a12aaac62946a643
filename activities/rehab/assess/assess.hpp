// SPDX-License-Identifier: MIT
// The assessment in a session: its instructions, and the springs that a press works against. One thread, the frame's.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "activities/rehab/assess/assessment.hpp"

namespace burin::activities {

class Assess final : public Exercise {
public:
    // A press is against a spring that is this stiff, where a fingertip was when the press began.
    static constexpr double kSpring_N_per_m = 400.0, kDamping_Ns_per_m = 1.0, kReach_m = 0.2;

    [[nodiscard]] static std::span<const SettingKind> setting_kinds();
    [[nodiscard]] static std::unique_ptr<Exercise> make(const SettingValues& values);
    [[nodiscard]] static std::optional<Error> conflict(const SettingValues& values);
    // Requires sound values.
    explicit Assess(const SettingValues& values);

    [[nodiscard]] const char* name() const override { return "assess"; }
    [[nodiscard]] const SettingValues& settings() const override { return values_; }
    [[nodiscard]] bool has_body() const override { return false; }
    [[nodiscard]] bodies::SoftPartSetup body() const override { return {}; }
    [[nodiscard]] std::array<double, 3> srgb() const override { return {}; }
    [[nodiscard]] std::optional<session::LedHand> led_hand() const override;
    // Returns none: nothing is there to press on.
    [[nodiscard]] WhichFingers pressing_fingers() const override { return {}; }
    void turn(const ExerciseTurn& turn, session::ActivityOrders& orders) override;
    void interrupt(Nanoseconds time_ns, session::ActivityOrders& orders) override;
    [[nodiscard]] ExerciseGoal goal() const override;
    [[nodiscard]] std::vector<std::string> help() const override;
    void adjust(std::size_t finger, haptics::TickParameters& parameters) const override;
    [[nodiscard]] ExerciseEnd end() const override { return state_.end; }
    [[nodiscard]] ExerciseCourse course() const override;
    [[nodiscard]] std::string task() const override;
    [[nodiscard]] Json findings() const override;
    [[nodiscard]] std::optional<Json> person_range() const override;

    [[nodiscard]] const AssessState& state() const { return state_; }

private:
    SettingValues values_;
    AssessState state_;
    std::vector<ExerciseEvent> events_;
    // Where each fingertip was when the press that goes on began.
    std::optional<std::array<Vec3, devices::kGloveFingers>> pressed_from_m_;
};

}  // namespace burin::activities
