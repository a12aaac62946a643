// SPDX-License-Identifier: MIT
// Walks through the rows of a table, tick after tick, whatever blocks they lie in. One thread. Memory: one block.
#pragma once

#include <cstdint>
#include <limits>
#include <utility>

#include "record/record_reader.hpp"

namespace burin::record {

// Ticks by their numbers, both ends included.
struct TickRange {
    std::int64_t from = std::numeric_limits<std::int64_t>::min(), to = std::numeric_limits<std::int64_t>::max();

    [[nodiscard]] bool holds(std::int64_t tick) const { return tick >= from && tick <= to; }
};

class RowWalk {
public:
    // The reader must outlive the walk.
    RowWalk(RecordReader& reader, std::size_t table) : reader_(&reader), table_(table) {}

    // Goes to the next row: false at the end. Fails on a block that cannot be read.
    [[nodiscard]] Result<bool> next() {
        if (++row_ < static_cast<std::int64_t>(block_.rows())) return true;
        if (number_ >= reader_->table(table_).blocks.size()) return false;
        Result<Block> read = reader_->block(table_, number_++);
        if (!read) return std::unexpected(read.error());
        block_ = std::move(*read);
        row_ = 0;
        return true;
    }
    // Of the row at which the walk is: next() must have returned true.
    [[nodiscard]] Word at(std::size_t column) const { return block_.at(column, row()); }
    [[nodiscard]] const Block& block() const { return block_; }
    [[nodiscard]] std::uint32_t row() const { return static_cast<std::uint32_t>(row_); }

private:
    RecordReader* reader_;
    std::size_t table_, number_ = 0;
    Block block_;
    std::int64_t row_ = -1;
};

// Returns the column of this name and type, or where there is none the number of columns.
[[nodiscard]] std::size_t find_column(const HandRecord& table, std::string_view name, ColumnType type);

}  // namespace burin::record
