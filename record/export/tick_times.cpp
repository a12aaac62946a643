// SPDX-License-Identifier: MIT
#include <algorithm>
#include <limits>
#include <optional>

#include "base/text.hpp"
#include "base/try.hpp"
#include "record/export/table_export.hpp"
#include "record/row_walk.hpp"

namespace burin::record {
namespace {

bool is_named(const TrialRecord& trial, std::string_view wanted) {
    if (wanted.ends_with('*')) return trial.name.starts_with(wanted.substr(0, wanted.size() - 1));
    return trial.name == wanted || std::to_string(trial.id) == wanted;
}

// Returns the block's rows that the times hold, where these are not all; nothing where they are.
std::optional<Block> rows_within(const Block& block, std::size_t time_column, const TickTimes& times) {
    std::vector<ColumnType> types;
    for (std::size_t c = 0; c < block.columns(); ++c) types.push_back(block.type(c));
    Block held(types);
    std::vector<Word> words(types.size());
    for (std::uint32_t row = 0; row < block.rows(); ++row) {
        if (!times.hold(static_cast<std::int64_t>(block.at(time_column, row)))) continue;
        for (std::size_t c = 0; c < words.size(); ++c) words[c] = block.at(c, row);
        held.add(words);
    }
    return held.rows() == block.rows() ? std::nullopt : std::optional(std::move(held));
}

}  // namespace

bool TickTimes::hold(std::int64_t time_ns) const {
    return std::ranges::any_of(stretches,
                               [&](const Stretch& one) { return time_ns >= one.from_ns && time_ns <= one.to_ns; });
}

Result<TickTimes> times_of_trials(RecordReader& reader, std::string_view list) {
    const Result<std::vector<TrialRecord>> trials = reader.trials();
    if (!trials) return std::unexpected(trials.error());
    TickTimes times;
    for (std::size_t begin = 0; begin <= list.size();) {
        const std::size_t end = std::min(list.find(',', begin), list.size());
        const std::string_view wanted = list.substr(begin, end - begin);
        const std::size_t before = times.stretches.size();
        for (const TrialRecord& trial : *trials) {
            if (!is_named(trial, wanted)) continue;
            const bool is_open = trial.state == "open";
            times.stretches.push_back(
                {trial.begun_ns, is_open ? std::numeric_limits<std::int64_t>::max() : trial.ended_ns});
        }
        if (times.stretches.size() == before) {
            std::string there;
            for (std::size_t i = 0; i < std::min<std::size_t>(trials->size(), 10); ++i)
                there += (i == 0 ? "" : ", ") + std::to_string((*trials)[i].id) + " " + (*trials)[i].name;
            return fail("trial '" + std::string(wanted) + "'", "is not in the recording",
                        there.empty() ? "it has no trials: leave --trials out" : "it has: " + there);
        }
        begin = end + 1;
    }
    return times;
}

Result<void> each_block(RecordReader& reader, std::size_t table, const TickTimes& times, ExportReport& report,
                        const std::function<Result<void>(const Block&)>& take) {
    const std::size_t time_column = find_column(reader.table(table), "time_ns", ColumnType::i64);
    const bool chooses = !times.stretches.empty();
    if (chooses && time_column == reader.table(table).columns.size())
        return fail(reader.table(table).name, "has no column time_ns to choose its ticks by", "leave --trials out");
    for (std::size_t number = 0; number < reader.table(table).blocks.size(); ++number) {
        const Result<Block> block = reader.block(table, number);
        if (!block) {
            report.damaged.push_back(block.error());
            continue;
        }
        const std::optional<Block> held = chooses ? rows_within(*block, time_column, times) : std::nullopt;
        const Block& rows = held ? *held : *block;
        if (rows.rows() == 0) continue;
        BURIN_TRY_DO(take(rows));
        report.rows += rows.rows();
    }
    return {};
}

}  // namespace burin::record
