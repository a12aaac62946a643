// SPDX-License-Identifier: MIT
// Keeps a run while it is under way, so that a program that is killed leaves what it had reached.
//
//   FOLDER/participant-007/2026-11-03T10-15-00-ball.journal, one JSON object a line:
//     {"run_journal": 1, participant, date, time, hand, "report": {...}, "events": []}    from the run's beginning
//     {"report": {...}, "events": [those since the line before]}     with each event, and a line each few seconds
//   the run ends       -> 2026-11-03T10-15-00-ball.json (kept_run.hpp) is written, then the journal is removed
//   the program ends   -> who next starts a run or writes the page makes that file of the journal: "broken off";
//                         none of a run that had not begun yet, nor of who has withdrawn
// A journal whose run is there as a file is a remnant and is removed: no run is kept twice. The first line is there
// whole or there is no journal; a torn line costs what it alone told.
// A participant has one run at a time. The process that does it keeps a lock (session/work/document_lock.hpp);
// nobody else touches its journal as long as it lives.
// A line is in the file when add() returns, and outlives the process; a thread of the journal's own brings it to the
// disk, so that no frame waits for that.
// Failure: an Error that names the file. What was written before stays. One thread.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "activities/rehab/progress/kept_run.hpp"
#include "session/work/document_lock.hpp"

namespace burin::activities {

// Tells what became of the journals of runs whose programs have ended.
struct LeftRuns {
    std::vector<std::filesystem::path> kept;  // the files that were made of them
    std::vector<Error> errors;
};

// Takes a participant for this process, who has no other run and is not erased as long as the lock is there. The
// participant's folder must be there. Fails where another process has the participant.
[[nodiscard]] Result<session::DocumentLock> take_participant(const std::filesystem::path& folder, unsigned participant);

class RunJournal {
public:
    // Takes the participant, takes up what runs of the past have left in the folder (left()), and writes the first
    // line. The participant's folder must be there (prepare_results()). Fails where the participant has another run.
    [[nodiscard]] static Result<std::unique_ptr<RunJournal>> begin(const std::filesystem::path& folder, KeptRun run);
    ~RunJournal();
    RunJournal(const RunJournal&) = delete;
    RunJournal& operator=(const RunJournal&) = delete;

    // Adds how far it has come: its report, whose own events are passed over, and the events since the last call that
    // succeeded.
    [[nodiscard]] Result<void> add(const Json& report, const Json& new_events);
    // Keeps the whole run as a file and removes the journal; returns the file's path.
    [[nodiscard]] Result<std::filesystem::path> keep(const Json& report);
    // Removes the journal of a run that never began.
    void discard();

    [[nodiscard]] const KeptRun& run() const { return run_; }
    // Returns the name of its files, without their extension.
    [[nodiscard]] std::string name() const { return journal_.stem().string(); }
    // Returns the journals that were made kept runs at the beginning, and the errors of those that could not be.
    [[nodiscard]] const LeftRuns& left() const { return left_; }

private:
    class Syncer;
    RunJournal(std::filesystem::path journal, KeptRun run, session::DocumentLock lock, LeftRuns left);

    std::filesystem::path journal_;
    KeptRun run_;
    session::DocumentLock lock_;
    LeftRuns left_;
    std::unique_ptr<Syncer> syncer_;
    bool ends_within_line_ = false;
};

// Makes kept runs of all journals in a folder whose process has ended.
[[nodiscard]] LeftRuns take_up_left_runs(const std::filesystem::path& folder);

// Keeps a run that a recording does again: as `name`, which its own files had (RunJournal::name()), or by its date and
// time where that is empty. A file that is there gives way to a run that has come farther, as where it was made of a
// journal, and stays otherwise. Fails where the participant has a run under way.
struct KeptAgain {
    std::filesystem::path file;
    bool is_new = false;  // false: it was kept before, as far or farther
};
[[nodiscard]] Result<KeptAgain> keep_again(const std::filesystem::path& folder, const KeptRun& run,
                                           const std::string& name);

// Returns the run that a journal's text tells: as of its last whole line, "broken off" unless it had ended. name: of
// the file, for messages. Pure.
[[nodiscard]] Result<KeptRun> run_in_journal(std::string_view text, const std::string& name);

}  // namespace burin::activities
