// SPDX-License-Identifier: MIT
// Asks at an exercise's start that each finger presses once, before its clock begins: so it is known which pistons give
// a force at all, and the first seconds of finding the body are no part of the time.
//
//   each turn -> a finger that is pushed with kPressed_N for kPressed_s, by what the device measures, has given
//   all have -> it begins; the others have for kWaits_s, or nobody for kMost_s -> it begins without those that are left
//   it has begun -> what they press with counts from when all have let go
// A device whose asked fingers have all had a fault until kMost_s begins nothing: it has failed.
// A device that does not measure is taken at its word. A finger with a fault gives nothing.
// Units: newtons, seconds. Pure; any thread.
#pragma once

#include <array>
#include <string>

#include "activities/rehab/measures/hand_measures.hpp"

namespace burin::activities {

using WhichFingers = std::array<bool, devices::kGloveFingers>;

struct StartCheck {
    static constexpr double kPressed_N = 0.3, kLetGo_N = 0.15, kPressed_s = 0.1, kWaits_s = 5.0, kMost_s = 20.0;

    WhichFingers asks{}, gave{};
    WhichFingers worked{};  // had no fault, at least once
    std::array<double, devices::kGloveFingers> pressed_s{};
    double asked_s = 0.0, since_last_s = 0.0;  // since it began, and since a finger has given

    // Returns whether all that are asked have given, or time is over; not where the device has failed.
    [[nodiscard]] bool is_done() const;
    // Returns whether none of those that are asked has worked for as long as they are waited for.
    [[nodiscard]] bool has_failed() const;
    // Returns whether no finger presses any more: told to give less than kLetGo_N.
    [[nodiscard]] static bool is_let_go(const FingersTurn& turn);
    // Returns those that are asked and have not given: "index, ring"; empty: none.
    [[nodiscard]] std::string missing() const;
    bool operator==(const StartCheck&) const = default;
};

[[nodiscard]] StartCheck with_turn(StartCheck check, const FingersTurn& turn);

}  // namespace burin::activities
