// SPDX-License-Identifier: MIT
// What a session file of a live session keeps so that it can be done again, and doing it again: its log is replayed as
// a text log is, and every column of every tick is compared on the way.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "record/compare.hpp"
#include "session/options/session_setup.hpp"

namespace burin::app {

// Returns what a session file says of the program and of the files that the session read. Digests are of files and
// worlds that can be read; one that cannot be read has none.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> facts_of_live(const session::SessionSetup& options,
                                                                             const std::string& command);

// Runs a session (desk/run/session.hpp). Where a session file is recorded, checks its place first, and gives it
// its facts.
[[nodiscard]] Result<void> run_recorded_session(const session::SessionSetup& options, const std::string& command);

// Returns the radius of the ball with which a live session's recording began; nothing where its tool was another.
[[nodiscard]] std::optional<double> live_ball_radius_m(const record::RecordReader& reader);

// How a live session is done again.
struct LiveReplay {
    std::string world, workpiece;   // where the files are now; empty: where they were
    std::vector<std::string> sets;  // "OPTION=VALUE": settings that are changed
    std::string pictures = {};      // a folder for pictures of its frames; empty: none are drawn
    double every_s = 1.0;           // of them
};
struct LiveReplayed {
    record::Comparison comparison;
    std::uint64_t unrecorded = 0;  // ticks that the log has and the columns have not
    std::uint64_t left = 0;        // ticks that the columns have after what the log can repeat
};
// Does it again and compares the ticks in the range. Where a file is another one than was recorded, says so on standard
// error and goes on: then the first difference tells what that has changed. Fails where the log does not lead to its
// own frames though all ticks are equal.
[[nodiscard]] Result<LiveReplayed> replay_live(record::RecordReader& reader, const LiveReplay& how,
                                               const record::TickRange& range);

}  // namespace burin::app
