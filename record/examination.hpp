// SPDX-License-Identifier: MIT
// What a recording holds and what is wrong with it: for `burin session info` and `check`.
// One thread. Memory: one block.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "record/row_walk.hpp"

namespace burin::record {

// Ticks that are missing between two that are there: lost by the ring, by a damaged block, or by a kill.
struct TickGap {
    std::int64_t after_tick = 0, missing = 0;
};

// What the list of blocks says of a hand, without reading one.
struct HandSummary {
    std::uint64_t ticks = 0;  // none: nothing was recorded, or its blocks are gone
    std::int64_t first_tick = 0;
    Nanoseconds first_ns = 0, last_block_ns = 0;
    std::vector<TickGap> gaps;  // that show between blocks; one within a block is told at the block's end
};
[[nodiscard]] HandSummary summary_of(const HandRecord& hand);

// Checks that the first hand has ticks, and that some may be in the range: a comparison of none would look like
// success. Fails with those that there are. Reads the last block alone; gaps are not looked at.
[[nodiscard]] Result<void> check_ticks(RecordReader& reader, const TickRange& range = {});

// How far the wall clock moved against the monotonic one, in all: of a clock that is not set, some milliseconds.
[[nodiscard]] Nanoseconds wall_clock_moved_ns(const std::vector<ClockPair>& clocks);

// What reading every block of a table found.
struct HandExamination {
    std::uint64_t ticks = 0;  // read
    std::vector<Error> damaged;
    std::vector<TickGap> gaps;
    std::uint64_t backward_times = 0;  // ticks that are not later than the one before
    std::uint64_t not_finite = 0;      // numbers that are none, but for the points that a tick does not have
    // Ticks that were due and that the loop skipped because it came too late, by the lateness of those that ran.
    // Nothing: the file does not say how far apart ticks were due.
    std::optional<std::uint64_t> never_run;
    Nanoseconds longest_interval_ns = 0;  // between two ticks that follow one another
};
[[nodiscard]] HandExamination examine(RecordReader& reader, std::size_t table);

}  // namespace burin::record
