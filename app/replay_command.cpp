// SPDX-License-Identifier: MIT
#include "app/replay_command.hpp"

#include <array>
#include <bit>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <optional>

#include "activities/world/world_replay.hpp"
#include "app/felt_recording.hpp"
#include "app/live_replay.hpp"
#include "app/output_files.hpp"
#include "app/world_digest.hpp"
#include "app/world_explore.hpp"
#include "app/world_wand.hpp"
#include "base/text.hpp"
#include "record/derived.hpp"
#include "session/live/world_side.hpp"
#include "session/record/session_recording.hpp"

namespace burin::app {

// Values that all objects of a world get instead of their own.
struct MaterialOverride {
    std::optional<double> stiffness_N_per_m, damping_Ns_per_m, static_friction, dynamic_friction;

    void apply(scene::HapticMaterial& material) const {
        material.stiffness_N_per_m = stiffness_N_per_m.value_or(material.stiffness_N_per_m);
        material.damping_Ns_per_m = damping_Ns_per_m.value_or(material.damping_Ns_per_m);
        material.static_friction = static_friction.value_or(material.static_friction);
        material.dynamic_friction = dynamic_friction.value_or(material.dynamic_friction);
    }
    [[nodiscard]] bool is_any() const {
        return stiffness_N_per_m || damping_Ns_per_m || static_friction || dynamic_friction;
    }
};

namespace {

constexpr const char* kProgram = "burin " BURIN_VERSION;

std::string fact_of(const record::RecordReader& reader, const char* key) {
    const auto at = reader.facts().find(key);
    return at == reader.facts().end() ? std::string() : at->second;
}

// Exact again is only what the same program computes: another one adds up in another order.
Result<void> check_build(const record::RecordReader& reader) {
    const std::string version = fact_of(reader, "version"), compiler = fact_of(reader, "compiler");
    if (version == BURIN_VERSION && compiler == __VERSION__) return {};
    const std::string by = version.empty() ? "a program that did not name itself"
                                           : "Burin " + version + ", compiler " + (compiler.empty() ? "?" : compiler);
    return fail(reader.path(),
                "was recorded by " + by +
                    ", and this is Burin " BURIN_VERSION ", compiler " __VERSION__
                    ": its ticks would not be the same to the bit",
                "replay it with that program; with this one read, convert, or feel it --through a world");
}

// A world that can be touched.
struct OpenedWorld {
    scene::MaterialTable materials;
    std::unique_ptr<scene::MeshPart> part;
    std::vector<scene::ObjectId> ids;
    std::vector<record::RecordedObject> objects;
    std::string digest;
};

Result<std::unique_ptr<OpenedWorld>> open_world(const std::string& path, const MaterialOverride& materials) {
    Result<scene::World> world = session::read_sound_world(path);
    if (!world) return std::unexpected(world.error());
    auto opened = std::make_unique<OpenedWorld>();
    for (scene::SceneObject& object : world->objects) {
        materials.apply(object.material);
        opened->ids.push_back(object.id);
        opened->objects.push_back({static_cast<std::int64_t>(object.id), object.name});
    }
    opened->digest = world_digest(world->objects);
    auto part = scene::MeshPart::create(std::move(world->objects), opened->materials);
    if (!part) return std::unexpected(part.error());
    opened->part = std::move(*part);
    return opened;
}

Result<record::Comparison> replay_world(record::RecordReader& reader, const std::string& given,
                                        const record::TickRange& range) {
    const std::string path = given.empty() ? fact_of(reader, "world") : given;
    if (path.empty()) return fail(reader.path(), "does not name its world", "name it by --world FILE");
    if (std::error_code ignored; !std::filesystem::exists(path, ignored))
        return fail(path, "is the world of the recording, and is not there", "say where it is now by --world FILE");
    Result<std::unique_ptr<OpenedWorld>> world = open_world(path, {});
    if (!world) return std::unexpected(world.error());
    const std::string recorded = fact_of(reader, kWorldDigestFact);
    if ((*world)->digest != recorded)
        return fail(path,
                    "is another world than the one that was recorded: SHA-256 " + (*world)->digest +
                        ", recorded: " + (recorded.empty() ? "none" : recorded),
                    "name the same world by --world, or feel the motion in this one by --through");
    return activities::repeat_world(reader, *(*world)->part, (*world)->materials, range);
}

Result<void> tell(const record::RecordReader& reader, const record::Comparison& found, double took_s,
                  const std::string& json_path) {
    Json json{{"file", reader.path()}, {"ticks", found.ticks}, {"columns", found.columns}, {"seconds", took_s}};
    json["difference"] = Json();
    if (found.difference)
        json["difference"] = {{"tick", found.difference->tick},
                              {"column", found.difference->column},
                              {"recorded", found.difference->first},
                              {"again", found.difference->second}};
    if (const auto ok = write_output(json_path, json_text(json)); !ok) return ok;
    if (found.difference) {
        const record::Difference& d = *found.difference;
        const std::string where = "tick " + std::to_string(d.tick) + (d.column.empty() ? "" : ", " + d.column);
        return fail(reader.path(), "differs after " + std::to_string(found.ticks) + " equal ticks: " + where +
                                       ": recorded " + d.first + ", again " + d.second);
    }
    if (json_path != kStandardOutput)
        std::printf("%s: %s ticks, %zu columns: equal to the bit\n", reader.path().c_str(),
                    std::to_string(found.ticks).c_str(), found.columns);
    return {};
}

// ---- Through another world

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
        Result<record::DerivedWriter> writer = record::DerivedWriter::create(std::move(table));
        if (!writer) return std::unexpected(writer.error());
        sink.writer_.emplace(std::move(*writer));
        return sink;
    }
    [[nodiscard]] bool compares() const { return there_.has_value(); }

    Result<void> take(const record::RecordedTick& tick, const std::vector<record::Word>& row) {
        if (writer_) return writer_->add(tick.tick, tick.time_ns, row);
        const Result<bool> more = there_->next();
        if (!more) return std::unexpected(more.error());
        if (!*more) return fail(name_, "has no tick " + std::to_string(tick.tick), "it is there from another range");
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
        const Result<bool> more = there_->next();
        if (!more) return std::unexpected(more.error());
        if (*more) return fail(name_, "has more ticks than were computed", "it is there from another range");
        return {};
    }

private:
    std::optional<record::RowWalk> there_;
    std::optional<record::DerivedWriter> writer_;
    std::vector<record::Column> columns_;
    std::string name_;
};

std::string place_mm(const Vec3& p) { return formatted("(%g, %g, %g) mm", 1e3 * p.x, 1e3 * p.y, 1e3 * p.z); }

void print_through(const activities::ThroughFigures& f) {
    std::printf("  the proxy begins at the hand, at tick %lld, %s", static_cast<long long>(f.first_tick),
                place_mm(f.begins_scene_m).c_str());
    if (f.begins_inside) std::printf(", inside material, and is moved out");
    if (!f.nearest.empty() && !f.begins_inside) std::printf(", %.3g mm from %s", 1e3 * f.nearest_m, f.nearest.c_str());
    std::printf("\n");
    if (f.first_contact_tick)
        std::printf("  touches %s first, at tick %lld; in contact for %llu of %llu ticks\n",
                    f.first_contact.empty() ? "a surface" : f.first_contact.c_str(),
                    static_cast<long long>(*f.first_contact_tick), static_cast<unsigned long long>(f.ticks_in_contact),
                    static_cast<unsigned long long>(f.ticks));
    else
        std::printf("  touches nothing; a proxy that begins outside a surface does not touch it from inside\n");
    std::printf("  largest force %.3g N; from the recording at most %.3g N and the proxy %.3g mm away\n", f.force_max_N,
                f.force_deviation_max_N, 1e3 * f.proxy_deviation_max_m);
}

Json through_json(const activities::ThroughFigures& f) {
    Json json{{"ticks", f.ticks},
              {"ticks_in_contact", f.ticks_in_contact},
              {"ticks_pushed_out", f.ticks_pushed_out},
              {"first_tick", f.first_tick},
              {"begins_inside", f.begins_inside},
              {"nearest", f.nearest},
              {"nearest_m", f.nearest_m},
              {"force_max_N", f.force_max_N},
              {"force_deviation_max_N", f.force_deviation_max_N},
              {"proxy_deviation_max_m", f.proxy_deviation_max_m}};
    json["begins_scene_m"] = Json::array({f.begins_scene_m.x, f.begins_scene_m.y, f.begins_scene_m.z});
    json["first_contact_tick"] = f.first_contact_tick ? Json(*f.first_contact_tick) : Json();
    json["first_contact"] = f.first_contact;
    return json;
}

}  // namespace

struct ReplayCommand::Options {
    std::string file, through, world, stroke, workpiece, json;
    std::vector<std::string> sets;
    std::string pictures;
    double every_s = 1.0;
    std::optional<double> radius_m;
    MaterialOverride materials;
    std::uint64_t from = 0, to = 0;  // 0: all

    [[nodiscard]] record::TickRange range() const {
        record::TickRange range;
        if (from > 0) range.from = static_cast<std::int64_t>(from);
        if (to > 0) range.to = static_cast<std::int64_t>(to);
        return range;
    }
    [[nodiscard]] Result<void> replay() const;
    [[nodiscard]] Result<void> replay_session(record::RecordReader& reader) const;
    [[nodiscard]] Result<void> feel_through() const;
    [[nodiscard]] Result<double> tool_radius_m(const record::RecordReader& reader) const;
};

Result<void> ReplayCommand::Options::replay() const {
    Result<record::RecordReader> reader = record::RecordReader::open(file);
    if (!reader) return std::unexpected(reader.error());
    const std::string activity = fact_of(*reader, activities::kActivityFact);
    if (activity == session::kLiveActivity) return replay_session(*reader);
    if (!sets.empty() || !pictures.empty())
        return fail(sets.empty() ? "--pictures" : "--set", "is for live sessions, and " + file + " is of another kind",
                    "leave it out");
    if (activity != activities::kWorldActivity && activity != kFeltActivity && activity != kWandActivity)
        return fail(file, "does not hold what a replay needs",
                    "replay what burin world --record or burin sculpt --record has written; other "
                    "motions can be felt --through a world");
    if (const auto ok = check_build(*reader); !ok) return ok;
    const auto begun = std::chrono::steady_clock::now();
    const Result<record::Comparison> found =
        activity == activities::kWorldActivity ? replay_world(*reader, world, range())
        : activity == kWandActivity            ? replay_wand(*reader, world, stroke, range())
                                               : replay_felt(*reader, {stroke, workpiece}, range());
    if (!found) return std::unexpected(found.error());
    return tell(*reader, *found, std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count(), json);
}

// Does a live session again.
Result<void> ReplayCommand::Options::replay_session(record::RecordReader& reader) const {
    if (!stroke.empty())
        return fail("--stroke", "belongs to a felt stroke, and this is a live session", "leave it out");
    if (const auto ok = check_build(reader); !ok) return ok;
    const auto begun = std::chrono::steady_clock::now();
    const Result<LiveReplayed> found = replay_live(reader, {world, workpiece, sets, pictures, every_s}, range());
    if (!found) return std::unexpected(found.error());
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begun;
    if (!found->comparison.difference && found->unrecorded > 0)
        std::fprintf(stderr, "burin: %s: %llu ticks of its log have no columns: they were lost\n", file.c_str(),
                     static_cast<unsigned long long>(found->unrecorded));
    if (!found->comparison.difference && found->left > 0)
        std::fprintf(stderr, "burin: %s: its log was torn off: the last %llu ticks are not compared\n", file.c_str(),
                     static_cast<unsigned long long>(found->left));
    return tell(reader, found->comparison, took.count(), json);
}

Result<double> ReplayCommand::Options::tool_radius_m(const record::RecordReader& reader) const {
    if (radius_m) return *radius_m;
    const std::string activity = fact_of(reader, activities::kActivityFact),
                      settings = fact_of(reader, activities::kSettingsFact);
    if (activity == activities::kWorldActivity) {
        const auto own = activities::read_settings(settings, reader.path());
        if (!own) return std::unexpected(own.error());
        return own->tool_radius_m;
    }
    const std::optional<double> ball_m = activity == kFeltActivity            ? felt_ball_radius_m(settings)
                                         : activity == session::kLiveActivity ? live_ball_radius_m(reader)
                                                                              : std::nullopt;
    if (ball_m) return *ball_m;
    return fail(reader.path(), "does not say how large the ball was that touched", "give it by --radius METRES");
}

Result<void> ReplayCommand::Options::feel_through() const {
    Result<record::RecordReader> reader = record::RecordReader::open(file);
    if (!reader) return std::unexpected(reader.error());
    const Result<double> ball_m = tool_radius_m(*reader);
    if (!ball_m) return std::unexpected(ball_m.error());
    Result<std::unique_ptr<OpenedWorld>> world = open_world(through, materials);
    if (!world) return std::unexpected(world.error());
    record::DerivedTable table;
    table.program = kProgram;
    table.columns = activities::through_columns();
    table.objects = (*world)->objects;
    table.name = "through " + (*world)->digest + ", ball of " +
                 record::text_of(std::bit_cast<record::Word>(*ball_m), record::ColumnType::f64) + " m";
    if (from > 0) table.name += ", from tick " + std::to_string(from);
    if (to > 0) table.name += ", to tick " + std::to_string(to);
    Json settings{{"world", through}, {kWorldDigestFact, (*world)->digest}, {"tool_radius_m", *ball_m}};
    settings["materials_changed"] = materials.is_any();
    table.settings = settings.dump(-1, ' ', false, Json::error_handler_t::replace);
    const std::string name = table.name;
    Result<DerivedSink> sink = DerivedSink::create(*reader, std::move(table));
    if (!sink) return std::unexpected(sink.error());
    const auto figures = activities::feel_through(
        *reader, *(*world)->part, (*world)->ids, (*world)->materials, *ball_m, range(),
        [&](const record::RecordedTick& tick, const std::vector<record::Word>& row) { return sink->take(tick, row); });
    if (!figures) return std::unexpected(figures.error());
    if (figures->ticks == 0)
        return fail(file, "has no ticks in this range", "burin session info tells which there are");
    if (const auto kept = sink->finish(file); !kept) return kept;
    Json report{{"file", file}, {"through", through}, {"table", name}, {"program", kProgram}};
    report["was_there"] = sink->compares();
    report["figures"] = through_json(*figures);
    if (const auto ok = write_output(json, json_text(report)); !ok) return ok;
    if (json == kStandardOutput) return {};
    std::printf("%s: %llu ticks, %zu columns: %s\n", file.c_str(), static_cast<unsigned long long>(figures->ticks),
                activities::through_columns().size(),
                sink->compares() ? "equal to the bit with the derived table that is there" : "a new derived table");
    std::printf("  %s, by %s\n", name.c_str(), kProgram);
    print_through(*figures);
    return {};
}

ReplayCommand::ReplayCommand(Command app)
    : options_(std::make_unique<Options>()),
      command_(app.subcommand("replay", "Do a recording again and compare every tick, or feel its motion elsewhere")) {
    Options& o = *options_;
    command_.option("FILE", o.file, "A session file, which --record has written").required();
    command_.option("--from", o.from, "The first tick that is compared; with --through the first that is felt");
    command_.option("--to", o.to, "The last tick");
    command_.option("--world", o.world, "Where the recorded world's file is now");
    command_.option("--stroke", o.stroke, "Where the stroke's file is now");
    command_.option("--workpiece", o.workpiece, "Where the workpiece's file is now");
    command_.option(
        "--set", o.sets,
        "Of a live session: a setting that is changed, OPTION=VALUE, such as friction=0.3; may be repeated. "
        "The first difference then tells what that changes");
    command_.option("--pictures", o.pictures, "Of a live session: a folder for pictures of it, named by their seconds");
    command_.option("--every", o.every_s, "With --pictures: seconds of the session from one to the next")
        .within(0.001, 1e6)
        .show_default();
    command_.option("--through", o.through,
                    "A world (.toml, .wrl) in which the recorded motion is felt: adds a table of proxies, forces and "
                    "deviations to FILE");
    command_.option("--radius", o.radius_m, "With --through: of the ball that touches, in metres; else as recorded");
    command_.option("--stiffness", o.materials.stiffness_N_per_m, "With --through: of all objects, N/m");
    command_.option("--damping", o.materials.damping_Ns_per_m, "With --through: of all objects, N s/m");
    command_.option("--static-friction", o.materials.static_friction, "With --through: of all objects");
    command_.option("--dynamic-friction", o.materials.dynamic_friction, "With --through: of all objects");
    command_.option("--json", o.json, "A file for all figures; - for standard output");
}

ReplayCommand::~ReplayCommand() = default;

bool ReplayCommand::parsed() const { return command_.parsed(); }

std::string ReplayCommand::misuse() const {
    const Options& o = *options_;
    if (o.through.empty() && (o.radius_m || o.materials.is_any()))
        return "--radius and materials need --through a world: a replay is with the recorded ones";
    if (!o.through.empty() &&
        !(o.world.empty() && o.stroke.empty() && o.workpiece.empty() && o.sets.empty() && o.pictures.empty()))
        return "--through needs no file of the recorded session";
    if (o.from > 0 && o.to > 0 && o.from > o.to) return "--from is behind --to";
    constexpr auto kMostTick = static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max());
    if (o.from > kMostTick || o.to > kMostTick) return "no tick has so large a number";
    if (o.radius_m && !(*o.radius_m >= 1e-5 && *o.radius_m <= 1.0)) return "--radius is from 1e-5 to 1";
    return "";
}

Result<void> ReplayCommand::run() const {
    const Options& o = *options_;
    if (const auto ok = check_outputs({}, o.json == kStandardOutput ? "" : o.json, std::array{o.file, o.through}); !ok)
        return ok;
    return o.through.empty() ? o.replay() : o.feel_through();
}

}  // namespace burin::app
