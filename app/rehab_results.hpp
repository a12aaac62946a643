// SPDX-License-Identifier: MIT
// The results of exercises as burin rehab keeps them (activities/rehab/progress): what its options say of it, a run's
// file, and the page over all runs. One thread.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "app/command_line.hpp"
#include "base/error.hpp"
#include "base/json.hpp"

namespace burin::app {

struct ResultsOptions {
    std::string folder, date;  // empty: nothing is kept; today
    std::optional<unsigned> participant;
};
void add_results_options(Command command, ResultsOptions& options);

// Checks the options. scripted: no person does it.
[[nodiscard]] Result<void> check_results(const ResultsOptions& options, bool scripted);
// Makes the participant's folder, before the exercise. Requires checked options.
[[nodiscard]] Result<void> prepare_results(const ResultsOptions& options);
// Keeps the run that has ended now, brings the folder's page up to it, and prints where they are and what is proposed.
// Does nothing where nothing is to be kept.
[[nodiscard]] Result<void> keep_results(const ResultsOptions& options, const std::string& hand, const Json& report);

// burin rehab report FOLDER: writes all participants' pages, and one that leads to them; empty: FOLDER/report.html.
// language: of them all; empty: each participant's own.
[[nodiscard]] Result<void> rehab_report(const std::string& folder, const std::string& page,
                                        const std::string& language);

}  // namespace burin::app
