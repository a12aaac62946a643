// SPDX-License-Identifier: MIT
#include "activities/replay/through_table.hpp"

#include <bit>
#include <filesystem>
#include <system_error>
#include <utility>

#include "activities/replay/device_as_recorded.hpp"
#include "base/json.hpp"
#include "base/try.hpp"
#include "record/compare.hpp"
#include "record/derived.hpp"
#include "record/examination.hpp"
#include "record/motion.hpp"
#include "record/row_walk.hpp"

namespace burin::activities {
namespace {

// Takes the rows of a derived table: keeps them, or compares them with those that are there.
class ThroughSink {
public:
    static Result<ThroughSink> create(record::RecordReader& reader, record::DerivedTable table) {
        ThroughSink sink;
        for (std::size_t t = reader.hands().size(); t < reader.tables(); ++t) {
            const record::HandRecord& there = reader.table(t);
            if (there.name != table.name || there.program != table.program) continue;
            if (there.columns != table.columns)
                return fail(reader.path(), "has the derived table " + table.name + " with other columns",
                            "it is of another build of " + table.program);
            sink.there_.emplace(reader, t);
        }
        sink.columns_ = table.columns;
        sink.name_ = table.name;
        if (sink.there_) return sink;
        BURIN_TRY(writer, record::DerivedWriter::create(std::move(table)));
        sink.writer_.emplace(std::move(writer));
        return sink;
    }
    [[nodiscard]] bool compares() const { return there_.has_value(); }

    Result<void> take(const record::RecordedTick& tick, const std::vector<record::Word>& row) {
        if (writer_) return writer_->add(tick.tick, tick.time_ns, row);
        BURIN_TRY(more, there_->next());
        if (!more) return fail(name_, "has no tick " + std::to_string(tick.tick), "it is there from another range");
        for (std::size_t c = 0; c < row.size(); ++c) {
            if (there_->at(c) == row[c]) continue;
            const auto d = record::difference_of(name_, columns_[c], tick.tick, there_->at(c), row[c]);
            return fail(name_, "differs from the table that is there: tick " + std::to_string(tick.tick) + ", " +
                                   d.column + ": " + d.first + " there, " + d.second + " now");
        }
        return {};
    }
    Result<void> finish(const std::string& path) {
        if (writer_) return writer_->finish(path);
        BURIN_TRY(more, there_->next());
        if (more) return fail(name_, "has more ticks than were computed", "it is there from another range");
        return {};
    }

private:
    std::optional<record::RowWalk> there_;
    std::optional<record::DerivedWriter> writer_;
    std::vector<record::Column> columns_;
    std::string name_;
};

record::DerivedTable table_of(const ThroughOptions& options, const OpenedWorld& world, const ThroughProbe& probe) {
    record::DerivedTable table;
    table.program = options.program;
    table.columns = through_columns(probe.device);
    table.objects = world.objects;
    // Device and points are the recording's own, so the name need not have them.
    table.name = "through " + world.digest + ", ball of " +
                 record::text_of(std::bit_cast<record::Word>(probe.radius_m), record::ColumnType::f64) + " m";
    const record::TickRange all;
    if (options.range.from != all.from) table.name += ", from tick " + std::to_string(options.range.from);
    if (options.range.to != all.to) table.name += ", to tick " + std::to_string(options.range.to);
    Json settings{
        {"world", options.world}, {record::kWorldDigestFact, world.digest}, {"tool_radius_m", probe.radius_m}};
    settings["materials_changed"] = options.materials.is_any();
    settings["device"] = probe.device.wand ? probe.device.wand->name : std::string();
    settings["points"] = Json::array();
    for (const devices::WandPoint& point : probe.device.points) settings["points"].push_back(point.name);
    table.settings = settings.dump(-1, ' ', false, Json::error_handler_t::replace);
    return table;
}

}  // namespace

// A study's journal knows its recordings byte by byte, and a table added to one makes it another file.
Result<void> check_is_of_no_study(const std::string& file) {
    std::error_code ignored;
    const std::filesystem::path study = std::filesystem::weakly_canonical(file, ignored) / "../../..";
    if (!std::filesystem::exists(study.lexically_normal() / "journal.jsonl", ignored)) return {};
    return fail(file, "belongs to the study " + study.lexically_normal().string() + ", which keeps it as it is",
                "copy the file elsewhere, and feel the copy through the world");
}

Result<ThroughTable> feel_into_table(record::RecordReader& reader, const ThroughOptions& options) {
    BURIN_TRY(device, device_as_recorded(reader));
    const ThroughProbe probe{std::move(device), options.radius_m};
    BURIN_TRY(world, open_world(options.world, options.materials));
    record::DerivedTable table = table_of(options, *world, probe);
    ThroughTable made;
    made.name = table.name;
    made.columns = table.columns.size();
    made.has_torque = probe.device.wand.has_value();
    BURIN_TRY(sink, ThroughSink::create(reader, std::move(table)));
    made.was_there = sink.compares();
    BURIN_TRY(figures, feel_through(reader, {.scene = world->scene}, probe, options.range,
                                    [&](const record::RecordedTick& tick, const std::vector<record::Word>& row) {
                                        return sink.take(tick, row);
                                    }));
    if (figures.ticks == 0)
        return fail(reader.path(), "has no ticks in this range", "burin session info tells which there are");
    BURIN_TRY_DO(sink.finish(reader.path()));
    made.figures = std::move(figures);
    return made;
}

}  // namespace burin::activities
