// SPDX-License-Identifier: MIT
#include "activities/rehab/adapt/staircase.hpp"

#include <algorithm>
#include <cmath>

#include "activities/rehab/exercise/person_range.hpp"
#include "base/text.hpp"

namespace burin::activities {

Staircase after_trial(Staircase staircase, bool succeeded) {
    const double ratio =
        succeeded ? Staircase::kUp : std::pow(Staircase::kUp, -staircase.rate / (1.0 - staircase.rate));
    staircase.target_N = std::clamp(staircase.target_N * ratio, staircase.least_N, staircase.most_N);
    return staircase;
}

SettingKind success_setting() {
    return {.key = "success",
            .option = "--success",
            .help = "Have the force adapt so that this share of the squeezes succeeds, such as 0.75; 0: it stays",
            .remedy = "give 0, it stays, or 0.5 to 0.95",
            .most = Staircase::kMostRate,
            .before = 0.0};
}

SettingKind begin_force_setting() {
    return {.key = "begin_N",
            .option = "--begin-force",
            .help = "With which force one that adapts begins; 0: where the last run of --results ended, or the level's",
            .remedy = "give 0, or up to 40 N",
            .most = 40.0,
            .before = 0.0};
}

std::optional<Error> no_staircase(const SettingValues& values) {
    const double rate = values.number("success"), begin_N = values.number("begin_N");
    if (rate > 0.0 && rate < Staircase::kLeastRate)
        return Error{formatted("is %g: fewer than half of the squeezes would count", rate), "success",
                     "give 0, the force stays, or 0.5 to 0.95"};
    if (begin_N > 0.0 && rate == 0.0)
        return Error{formatted("is %g N, and the force does not adapt", begin_N), "begin_N",
                     "give --success, or leave it out"};
    return std::nullopt;
}

Staircase staircase_of(const SettingValues& values, double of_level_N, double most_N) {
    Staircase staircase;
    staircase.rate = values.number("success");
    staircase.least_N = std::max(kLeastTarget_N, 0.25 * of_level_N);
    staircase.most_N = std::max(most_N > 0.0 ? most_N : 2.0 * of_level_N, staircase.least_N);
    const double begin_N = values.number("begin_N");
    staircase.target_N = std::clamp(begin_N > 0.0 ? begin_N : of_level_N, staircase.least_N, staircase.most_N);
    return staircase;
}

}  // namespace burin::activities
