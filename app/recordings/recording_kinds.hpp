// SPDX-License-Identifier: MIT
// The table of what a recording can be of, by its fact "activity": how it is done again, and how large the ball was
// that touched. To add a kind, enter it in recording_kinds.cpp.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/recordings/live_replay.hpp"
#include "record/compare.hpp"

namespace burin::app {

// Options of a replay.
struct ReplayAsked {
    LiveReplay how;      // where files are now, changed settings, pictures
    std::string stroke;  // where the stroke's file is now; empty: where it was
    record::TickRange range;
};

struct RecordingKind {
    std::string_view activity;
    // Does it again, and compares the ticks in the range. Fails on what is asked and does not suit the kind.
    Result<LiveReplayed> (*replay)(record::RecordReader& reader, const ReplayAsked& asked);
    // Returns the radius of the ball that touched; nothing where another tool did.
    Result<std::optional<double>> (*ball_radius_m)(const record::RecordReader& reader);
};

// Returns the kind of a recording. Fails on one that this program does not know.
[[nodiscard]] Result<const RecordingKind*> kind_of(const record::RecordReader& reader);

}  // namespace burin::app
