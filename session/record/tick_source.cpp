// SPDX-License-Identifier: MIT
#include "session/record/tick_source.hpp"

#include "base/try.hpp"
#include "haptics/tick_flag.hpp"

#include <utility>

namespace burin::session {
namespace {

class TicksOfLines final : public TickSource {
public:
    TicksOfLines(const ThreadLog& log, std::string name)
        : left_(log.ticks.count), lines_(log.clock, log.ticks), name_(std::move(name)) {}

    [[nodiscard]] std::size_t parts() const override { return 1; }
    [[nodiscard]] Result<std::optional<TickSeen>> next(std::size_t) override {
        if (left_ == 0) return std::nullopt;
        --left_;
        return lines_.next();  // all lines were checked when the log was read
    }
    [[nodiscard]] std::string place(std::size_t) const override { return name_ + ":" + std::to_string(lines_.line()); }

private:
    std::size_t left_;
    ThreadLinesReader<TickText> lines_;
    std::string name_;
};

// Which of a tick's columns are read besides its motion.
struct TickColumns {
    record::MotionColumns motion;
    std::size_t flags = 0;
};

class TicksOfColumns final : public TickSource {
public:
    TicksOfColumns(record::RecordReader& reader, std::vector<TickColumns> columns) : reader_(reader) {
        for (std::size_t part = 0; part < columns.size(); ++part)
            parts_.push_back({std::move(columns[part]), record::RowWalk(reader, part)});
    }

    [[nodiscard]] std::size_t parts() const override { return parts_.size(); }
    [[nodiscard]] Result<std::optional<TickSeen>> next(std::size_t part) override {
        Part& own = parts_[part];
        if (own.over) return std::nullopt;
        BURIN_TRY(more, own.walk.next());
        if (!more) return end(own);
        const record::RecordedTick tick = own.columns.motion.at(own.walk.block(), own.walk.row());
        const auto flags = static_cast<std::uint32_t>(own.walk.at(own.columns.flags));
        if (tick.tick != own.tick + 1)
            own.hole = "tick " + std::to_string(own.tick) + " of " + reader_.table(part).name +
                       " is followed by tick " + std::to_string(tick.tick);
        if (own.hole || (flags & haptics::kTickSampleDropped) != 0) return end(own);
        own.tick = tick.tick;
        return TickSeen{tick.time_ns,
                        tick.sample,
                        tick.surface_sequence,
                        tick.parameter_sequence,
                        (flags & haptics::kTickLate) != 0,
                        tick.lateness_ns};
    }
    [[nodiscard]] std::optional<std::string> hole(std::size_t part) const override { return parts_[part].hole; }
    [[nodiscard]] std::string place(std::size_t part) const override {
        return reader_.path() + ": " + reader_.table(part).name + ", tick " + std::to_string(parts_[part].tick);
    }

private:
    struct Part {
        TickColumns columns;
        record::RowWalk walk;
        std::int64_t tick = 0;  // the last
        bool over = false;
        std::optional<std::string> hole = {};
    };
    static Result<std::optional<TickSeen>> end(Part& part) {
        part.over = true;
        return std::nullopt;
    }

    record::RecordReader& reader_;
    std::vector<Part> parts_;
};

}  // namespace

std::unique_ptr<TickSource> ticks_of_lines(const ThreadLog& log, std::string name) {
    return std::make_unique<TicksOfLines>(log, std::move(name));
}

Result<std::unique_ptr<TickSource>> ticks_of_columns(record::RecordReader& reader) {
    std::vector<TickColumns> columns;
    for (std::size_t part = 0; part < reader.hands().size(); ++part) {
        BURIN_TRY(motion, record::MotionColumns::find(reader, part));
        const record::HandRecord& table = reader.table(part);
        const std::size_t flags = record::find_column(table, "flags", record::ColumnType::u32);
        if (flags == table.columns.size())
            return fail(reader.path(), "has no column flags for " + table.name,
                        "replay a recording that has all columns");
        columns.push_back({std::move(motion), flags});
    }
    return std::make_unique<TicksOfColumns>(reader, std::move(columns));
}

}  // namespace burin::session
