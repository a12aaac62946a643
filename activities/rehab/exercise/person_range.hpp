// SPDX-License-Identifier: MIT
// What a person's hand can do, by which exercises are fitted to it: how far it closes, and with how much force it
// presses. A run's report tells what it has shown of both; the next run takes it as settings.
//
//   settings "open" and "closed" -> closures as shares of this person's way: gestures, catches, throws
//   setting "most_N" -> targets as shares of this person's force
// With the usual values, 0, 1 and 0, everything is as of a hand that bends as healthy ones do, and a target is that of
// its level. Closures: 0 straight, 1 all joints as far as healthy ones go (geometry/hand/hand_joints.hpp). Pure.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "activities/rehab/exercise/exercise_settings.hpp"

namespace burin::activities {

struct PersonRange {
    // A hand that closes by less of the way shows no more than the noise of its joints.
    static constexpr double kLeastWay = 0.15;
    double open = 0.0, closed = 1.0;  // closures, as far as the hand opens and closes by itself

    // Returns a closure as a share of the way.
    [[nodiscard]] double share_of(double closure) const { return (closure - open) / (closed - open); }
    bool operator==(const PersonRange&) const = default;
};

// The settings of the range, which every exercise has, and of the most force, which those have that ask for forces.
[[nodiscard]] SettingKind open_setting();
[[nodiscard]] SettingKind closed_setting();
[[nodiscard]] SettingKind most_force_setting();
// Returns the range that values set; the usual one where they have no such settings.
[[nodiscard]] PersonRange range_of(const SettingValues& values);
// Returns what is wrong with a range that leaves less than kLeastWay; nothing where it is sound.
[[nodiscard]] std::optional<Error> too_short_a_way(const SettingValues& values);
// Returns what is wrong with a target, a share of the person's most force, below what any touch reaches.
inline constexpr double kLeastTarget_N = 0.1;
[[nodiscard]] std::optional<Error> too_low_a_target(double share, double most_N);
// Returns a level's target: the level's own, or its share of the person's most force where that is set.
[[nodiscard]] double fitted_target_N(double of_level_N, double share, double most_N);

}  // namespace burin::activities
