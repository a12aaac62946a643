// SPDX-License-Identifier: MIT
#include "record/touched_columns.hpp"

#include <string>

namespace burin::record {

std::vector<Column> touched_columns(const RowShape& shape) {
    std::vector<Column> columns;
    for (std::uint32_t i = 0; i < shape.points; ++i)
        columns.push_back({"object" + std::to_string(i), "", "", ColumnType::u32});
    return columns;
}

void append_touched(const haptics::TickRecord& tick, const RowShape& shape, std::vector<Word>& row) {
    for (std::uint32_t i = 0; i < shape.points; ++i)
        row.push_back(i < tick.contact.point_count ? tick.contact.points[i].object : 0u);
}

}  // namespace burin::record
