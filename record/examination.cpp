// SPDX-License-Identifier: MIT
#include "record/examination.hpp"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <system_error>

#include "haptics/tick_record.hpp"
#include "record/record_writer.hpp"

namespace burin::record {
namespace {

std::optional<std::size_t> column_named(const HandRecord& hand, std::string_view name) {
    for (std::size_t c = 0; c < hand.columns.size(); ++c)
        if (hand.columns[c].name == name && hand.columns[c].type == ColumnType::i64) return c;
    return {};
}

// The columns of points, which may be absent in a tick.
bool is_of_point(const Column& column) {
    for (const std::string_view begin : {"hip", "proxy", "normal", "force", "penetration"})
        if (column.name.starts_with(begin) && column.name.size() > begin.size() &&
            std::string_view("0123456789").contains(column.name[begin.size()]))
            return true;
    return false;
}

// Differences of any two numbers of a file, which may be anything.
std::int64_t saturated_difference(std::int64_t a, std::int64_t b) {
    std::int64_t difference = 0;
    if (!__builtin_sub_overflow(a, b, &difference)) return difference;
    return a > b ? std::numeric_limits<std::int64_t>::max() : std::numeric_limits<std::int64_t>::min();
}

// Follows the ticks of a hand from block to block.
class TickWatch {
public:
    TickWatch(const HandRecord& hand, std::optional<Nanoseconds> period_ns, HandExamination& found)
        : tick_(column_named(hand, "tick")),
          time_(column_named(hand, "time_ns")),
          lateness_(column_named(hand, "lateness_ns")),
          period_ns_(period_ns),
          found_(found) {
        if (lateness_ && period_ns_) found_.never_run = 0;
    }

    void see(const Block& block, std::uint32_t row) {
        if (tick_) see_tick(static_cast<std::int64_t>(block.at(*tick_, row)));
        if (found_.never_run)
            *found_.never_run +=
                haptics::skipped_deadlines(static_cast<std::int64_t>(block.at(*lateness_, row)), *period_ns_);
        if (!time_) return;
        const auto time_ns = static_cast<std::int64_t>(block.at(*time_, row));
        if (saw_time_ && time_ns <= last_ns_) ++found_.backward_times;
        if (saw_time_)
            found_.longest_interval_ns = std::max(found_.longest_interval_ns, saturated_difference(time_ns, last_ns_));
        saw_time_ = true;
        last_ns_ = time_ns;
    }

private:
    void see_tick(std::int64_t tick) {
        const std::int64_t step = saw_tick_ ? saturated_difference(tick, last_tick_) : 1;
        if (step != 1 && found_.gaps.size() < kMostGaps) found_.gaps.push_back({last_tick_, step - 1});
        saw_tick_ = true;
        last_tick_ = tick;
    }

    static constexpr std::size_t kMostGaps = 100'000;
    std::optional<std::size_t> tick_, time_, lateness_;
    std::optional<Nanoseconds> period_ns_;
    bool saw_tick_ = false, saw_time_ = false;
    std::int64_t last_tick_ = 0, last_ns_ = 0;
    HandExamination& found_;
};

std::uint64_t not_finite_in(const Block& block, const HandRecord& hand) {
    std::uint64_t count = 0;
    for (std::size_t c = 0; c < block.columns(); ++c) {
        if (block.type(c) != ColumnType::f64 || is_of_point(hand.columns[c])) continue;
        for (std::uint32_t row = 0; row < block.rows(); ++row)
            count += std::isfinite(std::bit_cast<double>(block.at(c, row))) ? 0 : 1;
    }
    return count;
}

std::optional<Nanoseconds> period_of(const RecordReader& reader, std::size_t hand) {
    const auto fact = reader.facts().find(period_fact(hand));
    if (fact == reader.facts().end()) return {};
    Nanoseconds period_ns = 0;
    const std::string& text = fact->second;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), period_ns);
    if (error != std::errc() || end != text.data() + text.size() || period_ns <= 0) return {};
    return period_ns;
}

}  // namespace

Result<void> check_ticks(RecordReader& reader, const TickRange& range) {
    if (reader.hands().empty() || reader.hands()[0].blocks.empty())
        return fail(reader.path(), "holds no ticks", "it ended before its first transaction, or its blocks are gone");
    const HandRecord& hand = reader.hands()[0];
    const std::int64_t first = hand.blocks.front().header.tick0;
    std::int64_t last = std::numeric_limits<std::int64_t>::max();  // as long as it is not known
    const std::size_t tick = find_column(hand, "tick", ColumnType::i64);
    const Result<Block> block = reader.block(0, hand.blocks.size() - 1);
    const bool is_known = block && block->rows() > 0 && tick < hand.columns.size();
    if (is_known) last = static_cast<std::int64_t>(block->at(tick, block->rows() - 1));
    if (range.to >= first && range.from <= last) return {};
    return fail(reader.path(),
                "has no ticks in this range: its first is " + std::to_string(first) +
                    (is_known ? ", its last " + std::to_string(last) : std::string()),
                "choose --from and --to among them");
}

HandSummary summary_of(const HandRecord& hand) {
    HandSummary summary;
    summary.ticks = hand.rows();
    if (hand.blocks.empty()) return summary;
    summary.first_tick = hand.blocks.front().header.tick0;
    summary.first_ns = hand.blocks.front().header.t0_ns;
    summary.last_block_ns = hand.blocks.back().header.t0_ns;
    for (std::size_t i = 1; i < hand.blocks.size(); ++i) {
        const BlockHeader &before = hand.blocks[i - 1].header, &here = hand.blocks[i].header;
        const std::int64_t missing = saturated_difference(saturated_difference(here.tick0, before.tick0), before.rows);
        if (missing != 0) summary.gaps.push_back({saturated_difference(here.tick0, 1), missing});
    }
    return summary;
}

Nanoseconds wall_clock_moved_ns(const std::vector<ClockPair>& clocks) {
    Nanoseconds least = 0, most = 0;
    for (const ClockPair& pair : clocks) {
        const Nanoseconds moved = saturated_difference(saturated_difference(pair.utc_ns, clocks.front().utc_ns),
                                                       saturated_difference(pair.mono_ns, clocks.front().mono_ns));
        least = std::min(least, moved);
        most = std::max(most, moved);
    }
    return saturated_difference(most, least);
}

HandExamination examine(RecordReader& reader, std::size_t table) {
    const HandRecord& of = reader.table(table);
    HandExamination found;
    TickWatch watch(of, of.is_derived() ? std::nullopt : period_of(reader, of.number), found);
    for (std::size_t number = 0; number < of.blocks.size(); ++number) {
        const Result<Block> block = reader.block(table, number);
        if (!block) {
            found.damaged.push_back(block.error());
            continue;
        }
        for (std::uint32_t row = 0; row < block->rows(); ++row) watch.see(*block, row);
        found.ticks += block->rows();
        found.not_finite += not_finite_in(*block, of);
    }
    return found;
}

}  // namespace burin::record
