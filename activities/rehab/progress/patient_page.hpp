// SPDX-License-Identifier: MIT
// The page of one participant over all visits, in a language of texts (page_texts.hpp): each exercise's plots, how much
// was done in each week, how measures have changed and how sure that is, and all runs. And the same as a table, and a
// page that leads to the participants' pages. Pure; any thread.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "activities/rehab/progress/page_texts.hpp"
#include "activities/rehab/progress/progress.hpp"
#include "activities/rehab/progress/withdrawal.hpp"

namespace burin::activities {

using LevelsOf = unsigned (*)(std::string_view exercise);  // how many an exercise has

// The runs are one participant's, in order of time, at least one.
[[nodiscard]] std::string patient_page(std::span<const KeptRun* const> runs, LevelsOf levels, const PageTexts& texts,
                                       const std::string& program);

// Returns the runs as CSV (RFC 4180): a line of names, then a line for each run; numbers with a point.
[[nodiscard]] std::string patient_table(std::span<const KeptRun* const> runs);

// Returns the page that leads to theirs, with all that could not be read. page_of: where a participant's is.
[[nodiscard]] std::string index_page(const KeptRuns& kept, const Withdrawals& withdrawn, const std::string& program,
                                     std::string (*page_of)(unsigned participant));

// Returns the participant's language: of the newest run that says one, else English.
[[nodiscard]] std::string language_of(std::span<const KeptRun* const> runs);

}  // namespace burin::activities
