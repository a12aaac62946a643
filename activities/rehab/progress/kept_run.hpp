// SPDX-License-Identifier: MIT
// Runs of exercises, as they are kept: a folder for each participant, a file for each run, so that a file that is cut
// or a disk that is full loses no other run.
//
//   FOLDER/participant-007/2026-11-03T10-15-00-ball.json: {"run": 1, participant, date, time, hand, "report": {...}}
// Participants are numbers: no name is kept. Failure: an Error that names the file; what was kept before stays as it
// was. Any thread, one at a time in a folder.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "base/json.hpp"

namespace burin::activities {

struct KeptRun {
    static constexpr unsigned kMostParticipants = 999;
    unsigned participant = 1;  // to kMostParticipants
    std::string date, time;    // "2026-11-03", "10:15:00", as the clock on the wall has them
    std::string hand;          // "glove:47000"; "scripted, seed 1" where nobody did it
    Json report;               // Rehab::report()

    [[nodiscard]] bool is_scripted() const { return hand.starts_with("scripted"); }
};

// Checks a date of that form that the calendar has.
[[nodiscard]] Result<void> check_date(const std::string& date);
// Returns the day of a date, counted from 1970-01-01. Requires one that check_date() passes.
[[nodiscard]] int day_of(const std::string& date);

// Makes the participant's folder and checks that files can be made there.
[[nodiscard]] Result<void> prepare_results(const std::filesystem::path& folder, unsigned participant);
// Writes the run into a file of its own; returns its path. Overwrites nothing.
[[nodiscard]] Result<std::filesystem::path> keep_run(const std::filesystem::path& folder, const KeptRun& run);

// For the journal of a run that is under way (run_journal.hpp), which is a file of the same name.
inline constexpr const char* kParticipantFolders = "participant-";  // how their names begin
[[nodiscard]] std::filesystem::path participant_folder(const std::filesystem::path& folder, unsigned participant);
// Returns the name of its file by date, time and exercise, without what tells runs of one second apart.
[[nodiscard]] std::string run_name(const KeptRun& run);
// Returns a file for the run, beside which there is none of that name but for the extension.
[[nodiscard]] std::filesystem::path free_run_file(const std::filesystem::path& folder, const KeptRun& run);
// Writes the run into that file, all of it or nothing.
[[nodiscard]] Result<void> write_run(const std::filesystem::path& file, const KeptRun& run);
[[nodiscard]] Result<KeptRun> read_run(const std::filesystem::path& file);
// Returns the run that a file holds, but for its version; name: the file's, for messages.
[[nodiscard]] Result<KeptRun> run_of_json(const Json& json, const std::string& name);
// The failure of a file that a newer version has written: of the number at a key, and the one that this version has.
[[nodiscard]] std::unexpected<Error> written_by_newer(const std::string& name, const char* key, int version, int known);

// All runs of a folder that can be read, by participant and then in order of time; and what is wrong with the others.
struct KeptRuns {
    std::vector<KeptRun> runs;
    std::vector<Error> errors;
};
// Fails where the folder itself cannot be read.
[[nodiscard]] Result<KeptRuns> read_runs(const std::filesystem::path& folder);

}  // namespace burin::activities
