// SPDX-License-Identifier: MIT
#include "activities/rehab/exercise/person_range.hpp"

#include "base/text.hpp"

namespace burin::activities {

SettingKind open_setting() {
    return {.key = "open",
            .option = "--open",
            .help = "How far the person's hand stays closed when it opens: 0, straight",
            .remedy = "give 0 to 1, as a report's person_range has it",
            .most = 1.0,
            .before = 0.0};
}

SettingKind closed_setting() {
    return {.key = "closed",
            .option = "--closed",
            .help = "How far the person's hand closes: 1, as far as healthy ones",
            .remedy = "give 0 to 1.5, as a report's person_range has it",
            .usual = 1.0,
            .most = 1.5,
            .before = 1.0};
}

SettingKind most_force_setting() {
    return {.key = "most_N",
            .option = "--most-force",
            .help =
                "With which force the person presses at most, all fingers together; targets are shares of it. 0: "
                "not known, targets are the level's",
            .remedy = "give 0, not known, to 40 N",
            .most = 40.0,
            .before = 0.0};
}

PersonRange range_of(const SettingValues& values) {
    if (!values.has("open") || !values.has("closed")) return {};
    return {values.number("open"), values.number("closed")};
}

std::optional<Error> too_short_a_way(const SettingValues& values) {
    const PersonRange range = range_of(values);
    if (range.closed - range.open >= PersonRange::kLeastWay) return std::nullopt;
    return Error{formatted("%g - %g = %g, and a hand is told by its closing where that is %g or more", range.closed,
                           range.open, range.closed - range.open, PersonRange::kLeastWay),
                 "closed, open", "measure the hand anew: the report of a run has its person_range"};
}

std::optional<Error> too_low_a_target(double share, double most_N) {
    if (most_N == 0.0 || share * most_N >= kLeastTarget_N) return std::nullopt;
    return Error{formatted("%g of %g N is a target of %g N, and any touch reaches one of less than %g N", share, most_N,
                           share * most_N, kLeastTarget_N),
                 "most_N", formatted("give %g N or more, or 0: not known", kLeastTarget_N / share)};
}

double fitted_target_N(double of_level_N, double share, double most_N) {
    return most_N > 0.0 ? share * most_N : of_level_N;
}

}  // namespace burin::activities
