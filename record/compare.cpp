// SPDX-License-Identifier: MIT
#include "record/compare.hpp"

#include <bit>
#include <cmath>

namespace burin::record {
namespace {

// Walks through the rows of a hand.
class RowWalk {
public:
    RowWalk(RecordReader& reader, std::size_t hand) : reader_(reader), hand_(hand) {}

    // Goes to the next row: false at the end.
    [[nodiscard]] Result<bool> next() {
        if (++row_ < block_.rows()) return true;
        if (number_ >= reader_.hands()[hand_].blocks.size()) return false;
        Result<Block> read = reader_.block(hand_, number_++);
        if (!read) return std::unexpected(read.error());
        block_ = std::move(*read);
        row_ = 0;
        return true;
    }
    [[nodiscard]] Word at(std::size_t column) const { return block_.at(column, static_cast<std::uint32_t>(row_)); }

private:
    RecordReader& reader_;
    std::size_t hand_, number_ = 0;
    Block block_;
    std::int64_t row_ = -1;
};

std::size_t tick_column(const HandRecord& hand) {
    for (std::size_t c = 0; c < hand.columns.size(); ++c)
        if (hand.columns[c].name == "tick") return c;
    return hand.columns.size();
}

// Values that look alike and differ in bits are told as bits.
void set_values(Difference& difference, Word first, Word second, ColumnType type) {
    difference.first = text_of(first, type);
    difference.second = text_of(second, type);
    if (difference.first != difference.second) return;
    difference.first += " (bits " + std::to_string(first) + ")";
    difference.second += " (bits " + std::to_string(second) + ")";
}

Result<void> compare_hand(RecordReader& a, RecordReader& b, std::size_t hand, const std::vector<std::size_t>& chosen,
                          Comparison& result) {
    const HandRecord& of = a.hands()[hand];
    const std::size_t tick = tick_column(of);
    const auto tick_of = [&](const RowWalk& walk) {
        return tick < of.columns.size() ? static_cast<std::int64_t>(walk.at(tick)) : std::int64_t{0};
    };
    RowWalk first(a, hand), second(b, hand);
    for (;;) {
        const Result<bool> more = first.next(), also = second.next();
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
            Difference difference{of.name, of.columns[column].name, tick_of(first), "", ""};
            set_values(difference, first.at(column), second.at(column), of.columns[column].type);
            result.difference = std::move(difference);
            return {};
        }
        ++result.ticks;
    }
}

}  // namespace

std::string Difference::line() const {
    if (column.empty())
        return hand + ", tick " + std::to_string(tick) + ": only the " + (first == "-" ? "second" : "first") +
               " has it";
    return hand + ", tick " + std::to_string(tick) + ", " + column + ": " + first + " in the first, " + second +
           " in the second";
}

Result<Comparison> compare(RecordReader& a, RecordReader& b, std::string_view columns) {
    if (a.hands().size() != b.hands().size())
        return fail(b.path(),
                    "has " + std::to_string(b.hands().size()) + " hands, and " + a.path() + " has " +
                        std::to_string(a.hands().size()),
                    "compare recordings of the same devices");
    Comparison result;
    for (std::size_t hand = 0; hand < a.hands().size(); ++hand) {
        if (a.hands()[hand].columns != b.hands()[hand].columns)
            return fail(b.path(), "has other columns than " + a.path() + " for " + a.hands()[hand].name,
                        "compare recordings of the same device and probe");
        const auto chosen = choose_columns(a.hands()[hand].columns, columns);
        if (!chosen) return std::unexpected(chosen.error());
        result.columns += chosen->size();
        if (const auto done = compare_hand(a, b, hand, *chosen, result); !done) return std::unexpected(done.error());
        if (result.difference) return result;
    }
    return result;
}

}  // namespace burin::record
