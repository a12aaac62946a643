// SPDX-License-Identifier: MIT
// The columns of what is touched, after those that every tick has (columns_for()): object0, object1, ... of each point
// of the probe, as its tick has found it (haptics::PointRecord::object); then the walls: of each point what its
// material asks and what the device renders of it, and the share of the force that the energy account affords.
// Recordings from before there were walls end with the objects, and are replayed all the same. Pure; any thread.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "record/columns.hpp"

namespace burin::record {

[[nodiscard]] std::vector<Column> touched_columns(const RowShape& shape);
// Appends what the points of a tick touch to its row.
void append_touched(const haptics::TickRecord& tick, const RowShape& shape, std::vector<Word>& row);
// The same in two parts.
void append_objects(const haptics::TickRecord& tick, const RowShape& shape, std::vector<Word>& row);
void append_walls(const haptics::TickRecord& tick, const RowShape& shape, std::vector<Word>& row);

// Whether these are the columns of a recording that this program replays: columns_for() and touched_columns(), with the
// walls or from before there were any. A row of this program has them first, in this order.
[[nodiscard]] bool can_be_replayed(std::span<const Column> recorded, const RowShape& shape);

}  // namespace burin::record
