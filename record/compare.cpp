// SPDX-License-Identifier: MIT
#include "record/compare.hpp"

#include "base/try.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace burin::record {
namespace {

// Goes to the next row in the range of ticks; all rows where there is no column of ticks.
Result<bool> next_in(RowWalk& walk, std::size_t tick, std::size_t columns, const TickRange& range) {
    for (;;) {
        const Result<bool> more = walk.next();
        if (!more || !*more || tick >= columns) return more;
        const auto number = static_cast<std::int64_t>(walk.at(tick));
        if (range.holds(number)) return true;
        if (number > range.to) return false;
    }
}

Result<void> compare_hand(RecordReader& a, RecordReader& b, std::size_t hand, const std::vector<std::size_t>& chosen,
                          const TickRange& range, Comparison& result) {
    const HandRecord& of = a.hands()[hand];
    const std::size_t tick = find_column(of, "tick", ColumnType::i64), columns = of.columns.size();
    const auto tick_of = [&](const RowWalk& walk) {
        return tick < of.columns.size() ? static_cast<std::int64_t>(walk.at(tick)) : std::int64_t{0};
    };
    RowWalk first(a, hand), second(b, hand);
    for (;;) {
        const Result<bool> more = next_in(first, tick, columns, range), also = next_in(second, tick, columns, range);
        if (!more) return std::unexpected(more.error());
        if (!also) return std::unexpected(also.error());
        if (!*more && !*also) return {};
        if (*more != *also) {
            result.difference = Difference{of.name, "", tick_of(*more ? first : second), *more ? "a tick" : "-",
                                           *also ? "a tick" : "-"};
            return {};
        }
        for (const std::size_t column : chosen) {
            if (first.at(column) == second.at(column)) continue;
            result.difference =
                difference_of(of.name, of.columns[column], tick_of(first), first.at(column), second.at(column));
            return {};
        }
        ++result.ticks;
    }
}

}  // namespace

Difference difference_of(const std::string& hand, const Column& column, std::int64_t tick, Word first, Word second) {
    Difference difference{hand, column.name, tick, text_of(first, column.type), text_of(second, column.type)};
    if (difference.first != difference.second) return difference;
    difference.first += " (bits " + std::to_string(first) + ")";
    difference.second += " (bits " + std::to_string(second) + ")";
    return difference;
}

std::optional<Difference> difference_in_row(const HandRecord& hand, const Block& block, std::uint32_t row,
                                            std::span<const Word> again) {
    BURIN_CHECK(again.size() == hand.columns.size() && again.size() == block.columns());
    const std::size_t tick = find_column(hand, "tick", ColumnType::i64);
    const auto number = tick < hand.columns.size() ? static_cast<std::int64_t>(block.at(tick, row)) : std::int64_t{0};
    for (std::size_t c = 0; c < again.size(); ++c) {
        const Word stored = block.at(c, row);
        if (stored != again[c]) return difference_of(hand.name, hand.columns[c], number, stored, again[c]);
    }
    return std::nullopt;
}

std::string Difference::line() const {
    if (column.empty())
        return hand + ", tick " + std::to_string(tick) + ": only the " + (first == "-" ? "second" : "first") +
               " has it";
    return hand + ", tick " + std::to_string(tick) + ", " + column + ": " + first + " in the first, " + second +
           " in the second";
}

Result<Comparison> compare(RecordReader& a, RecordReader& b, std::string_view columns, const TickRange& range) {
    if (a.hands().size() != b.hands().size())
        return fail(b.path(),
                    "has " + std::to_string(b.hands().size()) + " hands, and " + a.path() + " has " +
                        std::to_string(a.hands().size()),
                    "compare recordings of the same devices");
    Comparison result;
    for (std::size_t hand = 0; hand < a.hands().size(); ++hand) {
        const std::vector<Column>& of_a = a.hands()[hand].columns;
        const std::vector<Column>& of_b = b.hands()[hand].columns;
        // A version may have appended columns, which the other has not.
        const std::vector<Column>& common = of_a.size() <= of_b.size() ? of_a : of_b;
        if (!std::equal(common.begin(), common.end(), of_a.size() <= of_b.size() ? of_b.begin() : of_a.begin()))
            return fail(b.path(), "has other columns than " + a.path() + " for " + a.hands()[hand].name,
                        "compare recordings of the same device and probe");
        BURIN_TRY(chosen, choose_columns(common, columns));
        result.columns += chosen.size();
        BURIN_TRY_DO(compare_hand(a, b, hand, chosen, range, result));
        if (result.difference) return result;
    }
    return result;
}

}  // namespace burin::record
