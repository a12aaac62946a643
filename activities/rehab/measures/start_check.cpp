// SPDX-License-Identifier: MIT
#include "activities/rehab/measures/start_check.hpp"

#include <algorithm>
#include <cstddef>

namespace burin::activities {

bool StartCheck::is_done() const {
    if (asked_s >= kMost_s) return !has_failed();
    const bool any = std::ranges::find(gave, true) != gave.end();
    return missing().empty() || (any && since_last_s >= kWaits_s);
}

bool StartCheck::has_failed() const {
    if (asked_s < kMost_s) return false;
    for (std::size_t i = 0; i < asks.size(); ++i)
        if (asks[i] && worked[i]) return false;
    return true;
}

bool StartCheck::is_let_go(const FingersTurn& turn) {
    return std::ranges::all_of(turn.forces_N, [](double force_N) { return force_N < kLetGo_N; });
}

std::string StartCheck::missing() const {
    std::string names;
    for (std::size_t i = 0; i < asks.size(); ++i)
        if (asks[i] && !gave[i]) names += (names.empty() ? "" : ", ") + std::string(kFingerNames[i]);
    return names;
}

StartCheck with_turn(StartCheck check, const FingersTurn& turn) {
    check.asked_s += turn.dt_s;
    check.since_last_s += turn.dt_s;
    for (std::size_t i = 0; i < check.asks.size(); ++i) {
        check.worked[i] = check.worked[i] || !turn.has_fault[i];
        const double given_N = std::min(turn.forces_N[i], turn.measured_N[i].value_or(turn.forces_N[i]));
        const bool presses = !turn.has_fault[i] && given_N >= StartCheck::kPressed_N;
        check.pressed_s[i] = presses ? check.pressed_s[i] + turn.dt_s : 0.0;
        if (!check.asks[i] || check.gave[i] || check.pressed_s[i] < StartCheck::kPressed_s) continue;
        check.gave[i] = true;
        check.since_last_s = 0.0;
    }
    return check;
}

}  // namespace burin::activities
