// SPDX-License-Identifier: MIT
#include "session/drive/tick_comparison.hpp"

#include <algorithm>
#include <string_view>

#include "base/try.hpp"
#include "record/examination.hpp"
#include "record/touched_columns.hpp"
#include "session/record/session_recording.hpp"
#include "session/stream/lsl_streams.hpp"

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
    BURIN_TRY_DO(record::check_ticks(reader));
    TickComparison comparison(reader, range, then);
    for (std::size_t table = 0; table < reader.hands().size(); ++table) BURIN_TRY_DO(comparison.add_part(table));
    return comparison;
}

Result<void> TickComparison::add_part(std::size_t table) {
    const std::vector<record::Column>& columns = reader_->table(table).columns;
    const bool one_way = std::ranges::find(columns, "drive_state", &record::Column::name) != columns.end();
    const record::RowShape shape{counted(columns, "joint", ""), counted(columns, "hip", "_object_x_m"), one_way};
    if (!record::can_be_replayed(columns, shape))
        return fail(reader_->path(), "has other columns than this program's recordings",
                    "replay it with the program that recorded it; its data can be read and converted");
    BURIN_TRY(motion, record::MotionColumns::find(*reader_, table));
    parts_.push_back({shape, std::move(motion), record::RowWalk(*reader_, table),
                      record::find_column(reader_->table(table), "tick", record::ColumnType::i64)});
    found_.columns += columns.size();
    return {};
}

Result<bool> TickComparison::go_to(Part& part, std::uint64_t tick) {
    if (part.damaged) return std::unexpected(*part.damaged);
    const auto wanted = static_cast<std::int64_t>(tick);
    while (!part.over && (!part.begun || static_cast<std::int64_t>(part.walk.at(part.tick_column)) < wanted)) {
        part.begun = true;
        const Result<bool> more = part.walk.next();
        if (!more) {
            part.damaged = more.error();
            return more;
        }
        part.over = !*more;
    }
    return !part.over && static_cast<std::int64_t>(part.walk.at(part.tick_column)) == wanted;
}

std::optional<TickWitness::Known> TickComparison::known(std::size_t part, std::uint64_t tick) {
    Part& own = parts_[part];
    const Result<bool> is_there = go_to(own, tick);
    if (!is_there || !*is_there) return std::nullopt;
    const record::RecordedTick recorded = own.motion.at(own.walk.block(), own.walk.row());
    return Known{recorded.sample.joints, recorded.lateness_ns};
}

Result<void> TickComparison::take(std::size_t part, const haptics::TickRecord& again) {
    if (found_.difference) return {};
    Part& own = parts_[part];
    BURIN_TRY(is_there, go_to(own, again.tick));
    if (is_there) ++repeated_;
    if (!range_.holds(static_cast<std::int64_t>(again.tick))) return {};
    if (!is_there) {
        ++unrecorded_;
        return {};
    }
    const record::HandRecord& hand = reader_->table(part);
    const std::vector<record::Word> row = session_row(again, own.shape);
    for (std::size_t c = 0; c < hand.columns.size(); ++c) {
        const record::Word was = own.walk.at(c);
        if (was == row[c]) continue;
        found_.difference =
            record::difference_of(hand.name, hand.columns[c], static_cast<std::int64_t>(again.tick), was, row[c]);
        if (then_ == AtDifference::goes_on) return {};
        return fail(reader_->path(), "differs: " + found_.difference->line());
    }
    ++found_.ticks;
    return {};
}

Result<void> compare_trials(record::RecordReader& reader, std::span<const TrialMark> again, bool whole) {
    const Result<std::vector<record::TrialRecord>> recorded = reader.trials();
    if (!recorded) return std::unexpected(recorded.error());
    std::vector<record::TrialRecord> now;
    for (const TrialMark& mark : again) {
        if (!mark.name.empty())
            now.push_back({static_cast<std::int64_t>(now.size() + 1), mark.name, "open", mark.time_ns, 0});
        else if (!now.empty() && now.back().ended_ns == 0)
            now.back().state = mark.state, now.back().ended_ns = mark.time_ns;
    }
    constexpr const char* kRemedy = "it was changed since, or another program recorded it: replay it with that one";
    for (std::size_t i = 0; i < recorded->size(); ++i) {
        const record::TrialRecord& was = (*recorded)[i];
        const std::string which = "trial " + std::to_string(i + 1) + " (" + was.name + ")";
        if (i >= now.size() && !whole) return {};
        if (i >= now.size()) return fail(reader.path(), which + " is not there when it is done again", kRemedy);
        const record::TrialRecord& is = now[i];
        const bool open = !whole && (was.ended_ns == 0 || is.ended_ns == 0);
        if (is.name != was.name) return fail(reader.path(), which + " is done again as " + is.name, kRemedy);
        if (is.begun_ns != was.begun_ns)
            return fail(
                reader.path(),
                which + " began at " + std::to_string(was.begun_ns) + " ns, again at " + std::to_string(is.begun_ns),
                kRemedy);
        if (!open && (is.ended_ns != was.ended_ns || is.state != was.state))
            return fail(reader.path(),
                        which + " ended as '" + was.state + "' at " + std::to_string(was.ended_ns) + " ns, again as '" +
                            is.state + "' at " + std::to_string(is.ended_ns),
                        kRemedy);
    }
    if (whole && now.size() > recorded->size())
        return fail(reader.path(),
                    "has " + std::to_string(recorded->size()) + " trials, and " + std::to_string(now.size()) +
                        " when it is done again",
                    kRemedy);
    return {};
}

Result<void> compare_events(record::RecordReader& reader, std::span<const EventMark> again, bool whole) {
    if (!reader.facts().contains(kEventsFact)) return {};
    Result<std::vector<record::EventRecord>> recorded = reader.events();
    if (!recorded) return std::unexpected(recorded.error());
    // Markers came from outside: what is done again hears none.
    std::erase_if(*recorded, [](const record::EventRecord& event) {
        return event.name == kLogEndedEvent || event.name == kMarkerEvent;
    });
    const auto text = [](const auto& event) {
        return "'" + event.name + (event.value.empty() ? "" : " " + event.value) + "' at " +
               std::to_string(event.time_ns) + " ns";
    };
    constexpr const char* kRemedy = "it was changed since, or another program recorded it: replay it with that one";
    const std::size_t both = std::min(recorded->size(), again.size());
    for (std::size_t i = 0; i < both; ++i) {
        const record::EventRecord& was = (*recorded)[i];
        if (EventMark{was.time_ns, was.name, was.value} == again[i]) continue;
        return fail(reader.path(),
                    "event " + std::to_string(i + 1) + " is " + text(was) + ", and done again " + text(again[i]),
                    kRemedy);
    }
    if (!whole || recorded->size() == again.size()) return {};
    return fail(reader.path(),
                "has " + std::to_string(recorded->size()) + " events, and " + std::to_string(again.size()) +
                    " when it is done again",
                kRemedy);
}

Result<void> check_unchanged(record::RecordReader& reader) {
    BURIN_TRY(chain, reader.examine_chain());
    if (!chain.is_there || chain.faults.empty()) return {};
    return fail(reader.path(), "its ticks are done again equal to the bit, but " + chain.faults.front(),
                "burin session check names all that was changed since it was recorded");
}

}  // namespace burin::session
