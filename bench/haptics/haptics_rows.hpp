// SPDX-License-Identifier: MIT
// Writes the figures of ticks as a table, rows and a figure. Used by haptics.cpp and haptics_output.cpp.
#pragma once

#include <array>
#include <cstdio>

#include "bench/haptics/haptics.hpp"

namespace burin::bench {

template <typename... Values>
[[nodiscard]] std::string formatted(const char* format, Values... values) {
    std::array<char, 512> text{};
    std::snprintf(text.data(), text.size(), format, values...);
    return text.data();
}

// Returns median, p99, p99.9 and maximum, named NAME_median_UNIT and so on.
[[nodiscard]] Json quantiles(const std::string& name, const std::string& unit, const std::vector<double>& values);

// Brings the runs into order: combinations of scene, probe and friction by the p99.9 of their cold ticks, the largest
// first; within one: cold, rehearsed, back to back.
void sort_worst_first(std::vector<TickCosts>& ticks);

// Returns everything that is known of one combination of scene, probe, friction and pacing.
[[nodiscard]] Json tick_row(const TickCosts& t);

// Returns two lines of a heading, a row for each combination of scene, probe and friction, the worst first, and a line
// that says how many deadlines were skipped.
[[nodiscard]] std::string ticks_table(const std::vector<TickCosts>& ticks);

[[nodiscard]] Json peer_row(const PeerTicks& t);
// Returns, for each combination, our cold ticks and CHAI3D's, their ratios, and where the proxies are; the worst ratio
// first. Empty where there are none.
[[nodiscard]] std::string peers_table(const std::vector<PeerTicks>& peers);
// Returns, for each combination, the ratios of our times to the peer's.
[[nodiscard]] Json peer_ratios(const std::vector<PeerTicks>& peers);

}  // namespace burin::bench
