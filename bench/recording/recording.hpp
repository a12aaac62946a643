// SPDX-License-Identifier: MIT
// burin bench record: what it costs to keep every tick.
//
// Sizes and the time of a block come from a real session file, whose blocks are packed and unpacked again: how well
// ticks compress depends on what the hand did. What the haptic thread pays, and how long transactions take, comes from
// ticks that a thread pushes at 1 kHz while a recorder writes a file; once with a ring of a second and once with one of
// 16 s, whose memory is colder. Times are wall times: other work on the machine shows in them.
#pragma once

#include <string>
#include <vector>

#include "base/json.hpp"
#include "record/record_reader.hpp"

namespace burin::bench {

struct RecordTask {
    std::string session;    // a session file; empty: sizes and blocks are not measured
    std::string folder;     // where a file is recorded, and removed again
    unsigned seconds = 10;  // for each ring
};

struct RecordFigures {
    std::size_t columns = 0, row_bytes = 0;
    std::uint64_t ticks = 0;                                     // of the session file; 0: there was none
    double raw_bytes_per_s = 0.0, packed_bytes_per_s = 0.0;      // at 1 kHz
    double pack_ms = 0.0, pack_worst_ms = 0.0, unpack_ms = 0.0;  // median, largest, median of a block
    double row_us = 0.0;                                         // to make a row of a record, median

    struct Paced {
        std::size_t ring_ticks = 0;
        double push_us = 0.0, push_p99_us = 0.0;  // median; what the haptic thread pays
        double transaction_ms = 0.0, transaction_p99_ms = 0.0, transaction_worst_ms = 0.0;
        std::uint64_t pushed = 0, lost = 0;
    };
    std::vector<Paced> paced;
};

[[nodiscard]] Result<RecordFigures> measure_recording(const RecordTask& task);
[[nodiscard]] std::string recording_table(const RecordFigures& figures);
[[nodiscard]] Json recording_json(const RecordFigures& figures);

}  // namespace burin::bench
