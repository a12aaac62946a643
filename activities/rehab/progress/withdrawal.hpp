// SPDX-License-Identifier: MIT
// Who has withdrawn from a folder of results. Somebody who has is not exercised any more and is on no page; with
// `erase` nothing of the runs is left either. That a number has withdrawn, and when, stays: it is given to nobody else.
//
//   FOLDER/withdrawn.json: {"withdrawn": [{"participant": 7, "date": "2026-11-03", "erased": true}]}
// Nobody withdraws while an exercise is under way. A run that was killed (run_journal.hpp) is taken up no more.
// It is told before it is done, so that what a power cut leaves is erased when it is asked for again.
// Failure: an Error that names the file. One at a time in a folder.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/error.hpp"

namespace burin::activities {

struct Withdrawal {
    unsigned participant = 0;
    std::string date;
    bool erased = false;
};
using Withdrawals = std::vector<Withdrawal>;

[[nodiscard]] Result<Withdrawals> read_withdrawals(const std::filesystem::path& folder);
[[nodiscard]] bool has_withdrawn(const Withdrawals& withdrawals, unsigned participant);

// Withdraws a participant who has runs there, or had some and is to be erased now.
[[nodiscard]] Result<void> withdraw(const std::filesystem::path& folder, unsigned participant, const std::string& date,
                                    bool erase);

// Results are their owner's alone: gives a file to nobody else (0600), a folder likewise (0700).
[[nodiscard]] Result<void> make_private(const std::filesystem::path& place);
// Writes a text that is the owner's alone, all of it or nothing.
[[nodiscard]] Result<void> write_private(const std::filesystem::path& file, const std::string& text);

}  // namespace burin::activities
