// SPDX-License-Identifier: MIT
// Proposes a level of difficulty by a participant's last runs of one exercise; it is never set. Pure; any thread.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "activities/rehab/progress/kept_run.hpp"

namespace burin::activities {

// A level is proposed where the last kRuns runs that were carried to an end, all with the same settings but for their
// time limits and where a force that adapts began, agree: the
// next higher where each scored kWell or more, the next lower where none scored more than kBadly.
struct Proposal {
    static constexpr std::size_t kRuns = 3;
    static constexpr double kWell = 90.0, kBadly = 40.0;
    // Why, as the page says it in any language: up also for the next lower level.
    enum class Why : std::uint8_t { none, few, differ, scores, up };
    unsigned level = 0;  // 0: none is proposed
    std::string reason;  // a sentence, always
    Why why = Why::none;
    unsigned stays = 0;               // the level of the last run
    std::size_t ended = 0;            // how many runs were carried to an end
    std::vector<double> scores = {};  // the last ones
};
// levels: how many the exercise has. The runs are one participant's, of one exercise, in order of time; at least one.
[[nodiscard]] Proposal proposed(std::span<const KeptRun* const> runs, unsigned levels);

// Returns the force with which the last of a participant's runs of an exercise, in order of time, would have gone on,
// whether it was carried to its end or not; nothing where none has adapted it.
[[nodiscard]] std::optional<double> adapted_target_N(std::span<const KeptRun> runs, unsigned participant,
                                                     std::string_view exercise);

// Returns the runs that were carried to an end with the settings of the last of them, in order; a setting that a run
// lacks counts as its default. Of one participant's runs of one exercise.
[[nodiscard]] std::vector<const KeptRun*> alike(std::span<const KeptRun* const> runs);

}  // namespace burin::activities
