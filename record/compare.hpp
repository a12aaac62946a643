// SPDX-License-Identifier: MIT
// Compares two recordings value by value, bit for bit, whatever blocks they lie in.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "record/row_walk.hpp"

namespace burin::record {

struct Difference {
    std::string hand, column;   // column empty: one of the two has no more ticks
    std::int64_t tick = 0;      // of the first recording; of the second where the first has no more
    std::string first, second;  // both values, as text_of() gives them; "-" where there is none

    [[nodiscard]] std::string line() const;
};

struct Comparison {
    std::uint64_t ticks = 0;  // compared
    std::size_t columns = 0;
    std::optional<Difference> difference;  // the first, by tick and then by column; none: equal to the bit
};

// Names two values of a column that differ; values that look alike and differ in bits are told as bits.
[[nodiscard]] Difference difference_of(const std::string& hand, const Column& column, std::int64_t tick, Word first,
                                       Word second);

// Looks for the first column of a tick whose bits differ from those that were computed again, in all of its columns.
// `again` is in the order of the hand's columns, as many.
[[nodiscard]] std::optional<Difference> difference_in_row(const HandRecord& hand, const Block& block, std::uint32_t row,
                                                          std::span<const Word> again);

// Compares the columns that the list names (choose_columns()) of all hands, in the order of the hands, in a range of
// ticks. Fails where a file cannot be read, a block is damaged, or hands or columns differ. Memory: one block of each.
[[nodiscard]] Result<Comparison> compare(RecordReader& a, RecordReader& b, std::string_view columns = {},
                                         const TickRange& range = {});

}  // namespace burin::record
