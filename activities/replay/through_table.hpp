// SPDX-License-Identifier: MIT
// The recorded motion is felt in a world with the device that it was recorded with, and becomes a derived table of its
// file (docs/formats.md, "Replaying"). Computed again, it is compared with the table that is there. One thread.
#pragma once

#include <string>

#include "activities/world/felt_through.hpp"
#include "activities/world/opened_world.hpp"
#include "base/error.hpp"
#include "record/record_reader.hpp"
#include "record/row_walk.hpp"

namespace burin::activities {

struct ThroughOptions {
    std::string world;
    double radius_m = 0.004;  // of the balls that touch
    MaterialOverride materials;
    record::TickRange range;
    std::string program;  // name and version, which the table names
};

struct ThroughTable {
    std::string name;
    std::size_t columns = 0;
    bool was_there = false;   // with equal rows: nothing was written
    bool has_torque = false;  // the device has one
    ThroughFigures figures;
};

// Fails where the recording's file is one of a study, whose journal knows it byte by byte: with a table more it would
// be another file.
[[nodiscard]] Result<void> check_is_of_no_study(const std::string& file);

// Adds the table to the reader's file, or compares it with the one that is there. Fails at the first row that differs,
// and where the range has no tick.
[[nodiscard]] Result<ThroughTable> feel_into_table(record::RecordReader& reader, const ThroughOptions& options);

}  // namespace burin::activities
