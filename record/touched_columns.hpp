// SPDX-License-Identifier: MIT
// The columns of what is touched, after those that every tick has (columns_for()): object0, object1, ... of each point
// of the probe, as its tick has found it (haptics::PointRecord::object). Pure; any thread.
#pragma once

#include <cstdint>
#include <vector>

#include "record/columns.hpp"

namespace burin::record {

[[nodiscard]] std::vector<Column> touched_columns(const RowShape& shape);
// Appends what the points of a tick touch to its row.
void append_touched(const haptics::TickRecord& tick, const RowShape& shape, std::vector<Word>& row);

}  // namespace burin::record
