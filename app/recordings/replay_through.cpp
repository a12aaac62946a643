// SPDX-License-Identifier: MIT
#include "app/recordings/replay_through.hpp"

#include <algorithm>
#include <bit>
#include <cstdio>
#include <filesystem>
#include <utility>

#include "activities/world/felt_through.hpp"
#include "activities/world/world_replay.hpp"
#include "app/cli/output_files.hpp"
#include "app/recordings/felt_recording.hpp"
#include "app/recordings/live_replay.hpp"
#include "app/recordings/recorded_device.hpp"
#include "app/recordings/wand_stroke.hpp"
#include "base/text.hpp"
#include "base/try.hpp"
#include "record/derived.hpp"
#include "record/examination.hpp"
#include "record/motion.hpp"
#include "scene/world_digest.hpp"
#include "session/live/world_side.hpp"
#include "session/record/session_recording.hpp"

namespace burin::app {
namespace {

constexpr const char* kProgram = "burin " BURIN_VERSION;

// Takes the rows of a derived table: keeps them, or compares them with those that are there.
class DerivedSink {
public:
    static Result<DerivedSink> create(record::RecordReader& reader, record::DerivedTable table) {
        DerivedSink sink;
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

std::string place_mm(const Vec3& p) { return formatted("(%g, %g, %g) mm", 1e3 * p.x, 1e3 * p.y, 1e3 * p.z); }

// Says how near a point came that touched nothing, and why it may have touched nothing where it came to a surface.
std::string why_nothing(const activities::ThroughPoint& point) {
    if (point.came_nearest.empty()) return "";
    if (point.came_nearest_m > 0.0)
        return formatted("; it came within %.3g mm of %s", 1e3 * point.came_nearest_m, point.came_nearest.c_str());
    return "; it came to " + point.came_nearest +
           ", and a proxy that begins outside a surface does not touch it from inside";
}

void print_point(const activities::ThroughFigures& f, const activities::ThroughPoint& point) {
    const std::string proxy = point.name.empty() ? "the proxy" : "the proxy of " + point.name;
    std::printf("  %s begins at the hand, at tick %lld, %s", proxy.c_str(), static_cast<long long>(f.first_tick),
                place_mm(point.begins_scene_m).c_str());
    if (point.begins_inside) std::printf(", inside material, and is moved out");
    if (!point.nearest.empty() && !point.begins_inside) {
        if (point.nearest_m < 0.0)
            std::printf(", where the ball overlaps %s by %.3g mm", point.nearest.c_str(), -1e3 * point.nearest_m);
        else
            std::printf(", outside, %.3g mm from %s", 1e3 * point.nearest_m, point.nearest.c_str());
    }
    std::printf("\n    ");
    if (point.first_contact_tick)
        std::printf("touches %s first, at tick %lld; in contact for %llu of %llu ticks\n",
                    point.first_contact.empty() ? "a surface" : point.first_contact.c_str(),
                    static_cast<long long>(*point.first_contact_tick),
                    static_cast<unsigned long long>(point.ticks_in_contact), static_cast<unsigned long long>(f.ticks));
    else
        std::printf("touches nothing%s\n", why_nothing(point).c_str());
}

void print_through(const activities::ThroughFigures& f, bool has_torque) {
    double proxies_m = 0.0;
    for (const activities::ThroughPoint& point : f.points) {
        print_point(f, point);
        proxies_m = std::max(proxies_m, point.proxy_deviation_max_m);
    }
    std::printf("  largest force %.3g N; from the recording at most %.3g N and %s %.3g mm away\n", f.force_max_N,
                f.force_deviation_max_N, f.points.size() > 1 ? "a proxy" : "the proxy", 1e3 * proxies_m);
    if (has_torque)
        std::printf("  largest torque %.3g N mm; from the recording at most %.3g N mm\n", 1e3 * f.torque_max_Nm,
                    1e3 * f.torque_deviation_max_Nm);
}

Json point_json(const activities::ThroughPoint& point) {
    const Vec3& begins = point.begins_scene_m;
    Json json{{"name", point.name},
              {"begins_scene_m", Json::array({begins.x, begins.y, begins.z})},
              {"begins_inside", point.begins_inside},
              {"nearest", point.nearest},
              {"nearest_m", point.nearest_m},
              {"ticks_in_contact", point.ticks_in_contact},
              {"first_contact", point.first_contact},
              {"force_max_N", point.force_max_N},
              {"proxy_deviation_max_m", point.proxy_deviation_max_m}};
    json["came_nearest"] = point.first_contact_tick ? Json() : Json(point.came_nearest);
    json["came_nearest_m"] = point.first_contact_tick ? Json() : Json(point.came_nearest_m);
    json["first_contact_tick"] = point.first_contact_tick ? Json(*point.first_contact_tick) : Json();
    return json;
}

Json through_json(const activities::ThroughFigures& f, bool has_torque) {
    Json json{{"ticks", f.ticks},
              {"ticks_in_contact", f.ticks_in_contact},
              {"ticks_pushed_out", f.ticks_pushed_out},
              {"first_tick", f.first_tick},
              {"force_max_N", f.force_max_N},
              {"force_deviation_max_N", f.force_deviation_max_N},
              {"points", Json::array()}};
    if (has_torque) {
        json["torque_max_Nm"] = f.torque_max_Nm;
        json["torque_deviation_max_Nm"] = f.torque_deviation_max_Nm;
    }
    for (const activities::ThroughPoint& point : f.points) json["points"].push_back(point_json(point));
    return json;
}

// ---- What it is felt with

// Returns the radius of the balls that touched.
Result<double> recorded_radius_m(const record::RecordReader& reader) {
    const std::string activity = reader.fact(activities::kActivityFact);
    std::optional<double> ball_m;
    if (activity == activities::kWorldActivity) {
        BURIN_TRY(own, activities::recorded_settings(reader));
        ball_m = own.tool_radius_m;
    } else if (activity == kWandActivity) {
        BURIN_TRY(stroke, recorded_wand_stroke(reader));
        ball_m = stroke.radius_m;
    } else if (activity == kFeltActivity) {
        ball_m = felt_ball_radius_m(reader.fact(activities::kSettingsFact));
    } else if (activity == session::kLiveActivity) {
        ball_m = live_ball_radius_m(reader);
    }
    if (ball_m) return *ball_m;
    return fail(reader.path(), "does not say how large the ball was that touched", "give it by --radius METRES");
}

Result<activities::ThroughProbe> probe_of(const record::RecordReader& reader, const std::optional<double>& radius_m) {
    BURIN_TRY(ball_m, radius_m ? Result<double>(*radius_m) : recorded_radius_m(reader));
    BURIN_TRY(device, recorded_device(reader));
    return activities::ThroughProbe{std::move(device), ball_m};
}

record::DerivedTable table_of(const ThroughOptions& options, const OpenedWorld& world,
                              const activities::ThroughProbe& probe) {
    record::DerivedTable table;
    table.program = kProgram;
    table.columns = activities::through_columns(probe.device);
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

Result<std::unique_ptr<OpenedWorld>> open_world(const std::string& path, const MaterialOverride& materials) {
    BURIN_TRY(world, session::read_sound_world(path));
    auto opened = std::make_unique<OpenedWorld>();
    for (scene::SceneObject& object : world.objects) {
        materials.apply(object.material);
        opened->ids.push_back(object.id);
        opened->objects.push_back({static_cast<std::int64_t>(object.id), object.name});
    }
    opened->digest = scene::world_digest(world.objects);
    BURIN_TRY(part, scene::MeshPart::create(std::move(world.objects), opened->materials));
    opened->part = std::move(part);
    return opened;
}

namespace {

// A study's journal knows its recordings byte by byte, and a table added to one makes it another file.
Result<void> check_is_of_no_study(const std::string& file) {
    std::error_code ignored;
    const std::filesystem::path study = std::filesystem::weakly_canonical(file, ignored) / "../../..";
    if (!std::filesystem::exists(study.lexically_normal() / "journal.jsonl", ignored)) return {};
    return fail(file, "belongs to the study " + study.lexically_normal().string() + ", which keeps it as it is",
                "copy the file elsewhere, and feel the copy through the world");
}

}  // namespace

Result<void> replay_through(const ThroughOptions& options) {
    BURIN_TRY_DO(check_is_of_no_study(options.file));
    BURIN_TRY(reader, record::RecordReader::open(options.file));
    BURIN_TRY_DO(record::check_ticks(reader, options.range));
    BURIN_TRY(probe, probe_of(reader, options.radius_m));
    BURIN_TRY(world, open_world(options.world, options.materials));
    record::DerivedTable table = table_of(options, *world, probe);
    const std::string name = table.name;
    const std::size_t columns = table.columns.size();
    BURIN_TRY(sink, DerivedSink::create(reader, std::move(table)));
    BURIN_TRY(figures,
              activities::feel_through(reader, *(world)->part, (world)->ids, (world)->materials, probe, options.range,
                                       [&](const record::RecordedTick& tick, const std::vector<record::Word>& row) {
                                           return sink.take(tick, row);
                                       }));
    if (figures.ticks == 0)
        return fail(options.file, "has no ticks in this range", "burin session info tells which there are");
    BURIN_TRY_DO(sink.finish(options.file));
    const bool has_torque = probe.device.wand.has_value();
    Json report{{"file", options.file}, {"through", options.world}, {"table", name}, {"program", kProgram}};
    report["was_there"] = sink.compares();
    report["figures"] = through_json(figures, has_torque);
    BURIN_TRY_DO(write_output(options.json, json_text(report)));
    if (options.json == kStandardOutput) return {};
    std::printf("%s: %llu ticks, %zu columns: %s\n", options.file.c_str(),
                static_cast<unsigned long long>(figures.ticks), columns,
                sink.compares() ? "equal to the bit with the derived table that is there" : "a new derived table");
    std::printf("  %s, by %s\n", name.c_str(), kProgram);
    print_through(figures, has_torque);
    return {};
}

}  // namespace burin::app
