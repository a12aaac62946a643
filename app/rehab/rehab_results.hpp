// SPDX-License-Identifier: MIT
// The results of exercises as burin rehab keeps them (activities/rehab/progress): what its options say of it, a run's
// journal and file, and the page over all runs. One thread.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "activities/rehab/progress/baseline.hpp"
#include "activities/rehab/progress/kept_run.hpp"
#include "activities/rehab/progress/run_journal.hpp"
#include "activities/rehab/rehab.hpp"
#include "app/cli/command_line.hpp"
#include "base/error.hpp"
#include "base/json.hpp"

namespace burin::app {

struct ResultsOptions {
    std::string folder, date;  // empty: nothing is kept; today
    std::optional<unsigned> participant;

    // Returns the folders that keeping a run makes, where they are not there.
    [[nodiscard]] std::vector<std::filesystem::path> folders() const;
};
void add_results_options(Command command, ResultsOptions& options);

// Checks the options, and that the participant has not withdrawn. scripted: no person does it.
// recording: it is done again by one, which says whose it is.
[[nodiscard]] Result<void> check_results(const ResultsOptions& options, bool scripted, const std::string& recording);
// Returns the baseline of the participant in the folder of results; nothing where there is none, or no folder yet.
[[nodiscard]] Result<std::optional<activities::Baseline>> baseline_in(const ResultsOptions& options);

// Returns the force with which the participant's last run of an exercise would have gone on, likewise.
[[nodiscard]] Result<std::optional<double>> adapted_target_in(const ResultsOptions& options,
                                                              const std::string& exercise);

// The run that is to be done, as the folder of results keeps it; without a folder all of it does nothing.
class ResultsOfRun {
public:
    // Takes the participant, takes up what runs that were killed have left, and writes that this one begins. Prints
    // what was taken up. hand: what does it. Also has the exercise's session file, where one is recorded, keep whose
    // run it is and when it was done. Requires checked options.
    [[nodiscard]] static Result<ResultsOfRun> begin(const ResultsOptions& options, const std::string& hand,
                                                    const std::shared_ptr<activities::Rehab>& exercise);
    // Likewise of a run that `recording` does again: it is that one's, by whom and when it was.
    [[nodiscard]] static Result<ResultsOfRun> again(const ResultsOptions& options, const std::string& recording);

    // Keeps the run that has ended, brings the folder's page up to it, and prints where they are and what is proposed.
    [[nodiscard]] Result<void> keep(const Json& report);
    // Leaves no trace of a run that never began.
    void discard();

private:
    std::string folder_, name_;  // of the results, empty: nothing is kept; and of the run that is done again
    activities::KeptRun run_;
    std::shared_ptr<activities::RunJournal> journal_;  // null: it is done again
};

// burin rehab report FOLDER: writes all participants' pages, and one that leads to them; empty: FOLDER/report.html.
// language: of them all; empty: each participant's own.
[[nodiscard]] Result<void> rehab_report(const std::string& folder, const std::string& page,
                                        const std::string& language);

}  // namespace burin::app
