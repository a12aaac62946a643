// SPDX-License-Identifier: MIT
#include "session/drive/tick_comparison.hpp"

#include <algorithm>
#include <iterator>
#include <string_view>

#include "record/examination.hpp"
#include "session/record/session_recording.hpp"

namespace burin::session {
namespace {

// Counts the columns of one kind: "hip0_object_x_m", "hip1_object_x_m", ...
std::uint32_t counted(const std::vector<record::Column>& columns, std::string_view before, std::string_view after) {
    return static_cast<std::uint32_t>(std::ranges::count_if(columns, [&](const record::Column& column) {
        const std::string_view name = column.name;
        if (!name.starts_with(before) || !name.ends_with(after) || name.size() <= before.size() + after.size())
            return false;
        const std::string_view number = name.substr(before.size(), name.size() - before.size() - after.size());
        return number.find_first_not_of("0123456789") == std::string_view::npos;
    }));
}

}  // namespace

Result<TickComparison> TickComparison::create(record::RecordReader& reader, const record::TickRange& range,
                                              AtDifference then) {
    if (reader.hands().empty()) return fail(reader.path(), "holds no hand's ticks", "name a recorded session");
    if (const auto some = record::check_ticks(reader); !some) return std::unexpected(some.error());
    const std::vector<record::Column>& columns = reader.table(0).columns;
    const record::RowShape shape{counted(columns, "joint", ""), counted(columns, "hip", "_object_x_m")};
    std::vector<record::Column> expected = record::columns_for(shape);
    std::ranges::copy(touched_columns(shape), std::back_inserter(expected));
    if (columns != expected)
        return fail(reader.path(), "has other columns than this program's recordings",
                    "replay it with the program that recorded it; its data can be read and converted");
    Result<record::MotionColumns> motion = record::MotionColumns::find(reader, 0);
    if (!motion) return std::unexpected(motion.error());
    const std::size_t tick = record::find_column(reader.table(0), "tick", record::ColumnType::i64);
    TickComparison comparison(reader, range, shape, std::move(*motion), tick);
    comparison.then_ = then;
    return comparison;
}

Result<bool> TickComparison::go_to(std::uint64_t tick) {
    if (damaged_) return std::unexpected(*damaged_);
    const auto wanted = static_cast<std::int64_t>(tick);
    while (!over_ && (!begun_ || static_cast<std::int64_t>(walk_.at(tick_column_)) < wanted)) {
        begun_ = true;
        const Result<bool> more = walk_.next();
        if (!more) {
            damaged_ = more.error();
            return more;
        }
        over_ = !*more;
    }
    return !over_ && static_cast<std::int64_t>(walk_.at(tick_column_)) == wanted;
}

std::optional<TickWitness::Known> TickComparison::known(std::uint64_t tick) {
    const Result<bool> is_there = go_to(tick);
    if (!is_there || !*is_there) return std::nullopt;
    const record::RecordedTick recorded = motion_.at(walk_.block(), walk_.row());
    return Known{recorded.sample.joints, recorded.lateness_ns};
}

Result<void> TickComparison::take(const haptics::TickRecord& again) {
    if (found_.difference) return {};
    const Result<bool> is_there = go_to(again.tick);
    if (!is_there) return std::unexpected(is_there.error());
    if (*is_there) ++repeated_;
    if (!range_.holds(static_cast<std::int64_t>(again.tick))) return {};
    if (!*is_there) {
        ++unrecorded_;
        return {};
    }
    const std::vector<record::Word> row = session_row(again, shape_);
    for (std::size_t c = 0; c < row.size(); ++c) {
        const record::Word was = walk_.at(c);
        if (was == row[c]) continue;
        const record::HandRecord& hand = reader_->table(0);
        found_.difference =
            record::difference_of(hand.name, hand.columns[c], static_cast<std::int64_t>(again.tick), was, row[c]);
        if (then_ == AtDifference::goes_on) return {};
        return fail(reader_->path(), "differs: " + found_.difference->line());
    }
    ++found_.ticks;
    return {};
}

}  // namespace burin::session
