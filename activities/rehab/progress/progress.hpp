// SPDX-License-Identifier: MIT
// Proposes a level of difficulty by a participant's last runs of one exercise; it is never set. Pure; any thread.
#pragma once

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
    unsigned level = 0;  // 0: none is proposed
    std::string reason;  // a sentence, always
};
// levels: how many the exercise has. The runs are one participant's, of one exercise, in order of time; at least one.
[[nodiscard]] Proposal proposed(std::span<const KeptRun* const> runs, unsigned levels);

// Returns the force with which the last of a participant's runs of an exercise, in order of time, would have gone on,
// whether it was carried to its end or not; nothing where none has adapted it.
[[nodiscard]] std::optional<double> adapted_target_N(std::span<const KeptRun> runs, unsigned participant,
                                                     std::string_view exercise);

// Returns all runs as a page, participant by participant: its plots, its proposals, its table. `levels` as proposed()
// takes it, by the exercise's name; `lost`: what could not be read, which the page says.
[[nodiscard]] std::string progress_page(const KeptRuns& kept, unsigned (*levels)(std::string_view exercise),
                                        const std::string& program);

}  // namespace burin::activities
