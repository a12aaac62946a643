// SPDX-License-Identifier: MIT
// Pages of a folder of results: one a participant, in the participant's language, with a table beside it, and one that
// leads to them. Withdrawal from the folder. All of it is for the folder's owner alone. One thread.
#pragma once

#include <optional>
#include <string>

#include "app/cli/command_line.hpp"
#include "base/error.hpp"
#include "base/json.hpp"

namespace burin::app {

// What is told of a run besides what the exercise knows itself.
struct RunRemarks {
    std::string language, comment;  // empty: as before; none
};
void add_remark_options(Command command, RunRemarks& remarks);
// Checks that the language is one of those that there are. kept: the run is kept; else nothing is to be told of it.
[[nodiscard]] Result<void> check_remarks(const RunRemarks& remarks, bool kept);
// Returns what stands in the run's report of them.
[[nodiscard]] Json json_of(const RunRemarks& remarks);

// Checks that a participant has not withdrawn from the folder, which need not be there yet.
[[nodiscard]] Result<void> check_stays(const std::string& folder, unsigned participant);

struct PagesToWrite {
    std::string folder;
    std::string index;                                   // empty: FOLDER/report.html
    std::string language;                                // empty: each participant's own
    std::optional<unsigned> participant = std::nullopt;  // whose page is written; nothing: all
};
// Writes them. Returns where the page that leads to them is.
[[nodiscard]] Result<std::string> write_pages(const PagesToWrite& pages);

// burin rehab withdraw FOLDER: withdraws a participant, and brings the pages up to it.
struct RehabWithdrawOptions {
    std::string folder;
    unsigned participant = 0;
    bool erase = false;
};
[[nodiscard]] Result<void> rehab_withdraw(const RehabWithdrawOptions& options);

}  // namespace burin::app
