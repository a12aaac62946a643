// SPDX-License-Identifier: MIT
// A target that adapts from trial to trial, so that a chosen share of them succeeds: the weighted up-down method
// (Kaernbach 1991, "Simple adaptive testing with the weighted up-down method", Perception & Psychophysics 49(3),
// 227-229), with steps of ratios, since forces are told apart by these.
//
//   a success: target * r          a failure: target / r^(p / (1 - p))          within [least, most]
// Where it comes to rest a success is as often p as the steps up and down cancel: p ln r = (1 - p) p / (1 - p) ln r.
// Pure; any thread.
#pragma once

#include <array>

#include "activities/rehab/exercise/exercise_settings.hpp"

namespace burin::activities {

struct Staircase {
    static constexpr double kUp = 1.05;                          // r
    static constexpr double kLeastRate = 0.5, kMostRate = 0.95;  // p; beyond, a step down is more than a half
    double target_N = 0.0, least_N = 0.0, most_N = 0.0;
    double rate = 0.75;
    bool operator==(const Staircase&) const = default;
};
// Requires a rate within its bounds.
[[nodiscard]] Staircase after_trial(Staircase staircase, bool succeeded);

// The settings of an exercise whose target adapts: the rate, 0: it does not; and where it begins, 0: at the level's.
[[nodiscard]] SettingKind success_setting();
[[nodiscard]] SettingKind begin_force_setting();
// Returns what is wrong with them together; nothing where they are sound.
[[nodiscard]] std::optional<Error> no_staircase(const SettingValues& values);
// Returns the staircase that they ask for, from a level's target; a rate of 0: there is none. most_N: the person's most
// force, 0: not known. It goes from a quarter of the level's target, or what any touch reaches, to the person's most
// force, or twice the level's target.
[[nodiscard]] Staircase staircase_of(const SettingValues& values, double of_level_N, double most_N);

}  // namespace burin::activities
