// SPDX-License-Identifier: MIT
#include "app/recordings/replay_command.hpp"

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>

#include "activities/world/opened_world.hpp"
#include "app/cli/output_files.hpp"
#include "app/recordings/recording_kinds.hpp"
#include "app/recordings/through_report.hpp"
#include "base/try.hpp"
#include "record/examination.hpp"
#include "record/motion.hpp"
#include "session/drive/tick_comparison.hpp"
#include "session/record/input_files.hpp"

namespace burin::app {
namespace {

// Exact again is only what the same program computes: another one adds up in another order.
Result<void> check_build(const record::RecordReader& reader) {
    const std::string version = reader.fact("version"), compiler = reader.fact("compiler");
    if (version == BURIN_VERSION && compiler == __VERSION__) return {};
    const std::string by = version.empty() ? "a program that did not name itself"
                                           : "Burin " + version + ", compiler " + (compiler.empty() ? "?" : compiler);
    return fail(reader.path(),
                "was recorded by " + by +
                    ", and this is Burin " BURIN_VERSION ", compiler " __VERSION__
                    ": its ticks would not be the same to the bit",
                "replay it with that program; with this one read, convert, or feel it --through a world");
}

Result<void> tell(const record::RecordReader& reader, const record::Comparison& found, double took_s,
                  const std::string& json_path) {
    Json json{{"file", reader.path()}, {"ticks", found.ticks}, {"columns", found.columns}, {"seconds", took_s}};
    json["difference"] = Json();
    if (found.difference)
        json["difference"] = {{"hand", found.difference->hand},
                              {"tick", found.difference->tick},
                              {"column", found.difference->column},
                              {"recorded", found.difference->first},
                              {"again", found.difference->second}};
    BURIN_TRY_DO(write_output(json_path, json_text(json)));
    if (found.difference) {
        const record::Difference& d = *found.difference;
        const std::string whose = reader.hands().size() > 1 ? d.hand + ", " : "";
        const std::string where = whose + "tick " + std::to_string(d.tick) + (d.column.empty() ? "" : ", " + d.column);
        return fail(reader.path(), "differs after " + std::to_string(found.ticks) + " equal ticks: " + where +
                                       ": recorded " + d.first + ", again " + d.second);
    }
    if (found.ticks == 0)
        return fail(reader.path(), "no tick in this range was compared: they are missing, or its log ends before them",
                    "burin session check names what is missing");
    if (json_path != kStandardOutput)
        std::printf("%s: %s ticks, %zu columns: equal to the bit\n", reader.path().c_str(),
                    std::to_string(found.ticks).c_str(), found.columns);
    return {};
}

struct AskedReplay {
    std::string file, through, world, stroke, workpiece, json;
    std::vector<std::string> sets;
    std::string pictures;
    double every_s = 1.0;
    std::optional<double> radius_m;
    activities::MaterialOverride materials;
    std::optional<std::uint64_t> from, to;  // ticks; none: all

    [[nodiscard]] record::TickRange range() const {
        record::TickRange range;
        if (from.value_or(0) > 0) range.from = static_cast<std::int64_t>(*from);
        if (to) range.to = static_cast<std::int64_t>(*to);
        return range;
    }
    [[nodiscard]] bool is_whole() const { return !from && !to; }
    [[nodiscard]] Result<void> replay() const;
};

Result<void> AskedReplay::replay() const {
    BURIN_TRY(reader, record::RecordReader::open(file));
    BURIN_TRY_DO(record::check_ticks(reader, range()));
    BURIN_TRY(kind, kind_of(reader));
    BURIN_TRY_DO(check_build(reader));
    const auto begun = std::chrono::steady_clock::now();
    BURIN_TRY(found, kind->replay(reader, {{world, workpiece, sets, pictures, every_s}, stroke, range()}));
    const bool is_equal = !found.comparison.difference;
    if (is_equal && found.comparison.ticks > 0 && is_whole()) BURIN_TRY_DO(session::check_unchanged(reader));
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begun;
    if (is_equal && found.unrecorded > 0)
        std::fprintf(stderr, "burin: %s: %llu ticks of its log have no columns: they were lost\n", file.c_str(),
                     static_cast<unsigned long long>(found.unrecorded));
    if (is_equal && found.left > 0)
        std::fprintf(stderr, "burin: %s: its log was torn off: the last %llu ticks are not compared\n", file.c_str(),
                     static_cast<unsigned long long>(found.left));
    return tell(reader, found.comparison, took.count(), json);
}

// Returns what is wrong with the usage; empty where nothing is.
std::string misuse_of(const AskedReplay& o) {
    if (o.through.empty() && (o.radius_m || o.materials.is_any()))
        return "--radius and materials need --through a world: a replay is with the recorded ones";
    if (!o.through.empty() &&
        !(o.world.empty() && o.stroke.empty() && o.workpiece.empty() && o.sets.empty() && o.pictures.empty()))
        return "--through needs no file of the recorded session";
    if (o.from && o.to && *o.from > *o.to) return "--from is behind --to";
    constexpr auto kMostTick = static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max());
    if (o.from.value_or(0) > kMostTick || o.to.value_or(0) > kMostTick) return "no tick has so large a number";
    if (o.radius_m && !(*o.radius_m >= 1e-5 && *o.radius_m <= 1.0)) return "--radius is from 1e-5 to 1";
    return "";
}

Result<void> run_replay(const AskedReplay& o) {
    session::InputFiles inputs;
    inputs.file(o.file).world(o.through).world(o.world).file(o.stroke).mesh(o.workpiece);
    BURIN_TRY_DO(check_outputs({}, o.json == kStandardOutput ? "" : o.json, inputs.list()));
    return o.through.empty() ? o.replay()
                             : replay_through({o.file, o.through, o.radius_m, o.materials, o.range(), o.json});
}

// Adds which ticks are done again, and what of the recorded session is elsewhere or is changed.
void add_repeat_options(Command command, AskedReplay& o) {
    command.option("FILE", o.file, "A session file, which --record has written").required();
    command.option("--from", o.from, "The first tick that is compared; with --through the first that is felt");
    command.option("--to", o.to, "The last tick; they are counted from 1");
    command.option("--world", o.world, "Where the recorded world's file is now").asset(AssetRoom::worlds);
    command.option("--stroke", o.stroke, "Where the stroke's file is now").asset(AssetRoom::strokes);
    command.option("--workpiece", o.workpiece, "Where the workpiece's file is now").asset(AssetRoom::workpieces);
    command.option("--set", o.sets,
                   "Of a live session: a setting that is changed, OPTION=VALUE as burin sculpt takes it, such as "
                   "friction=0.3 or swap-eyes=on; may be repeated. The first difference then tells what that changes. "
                   "Of a felt stroke: engine=cpu or engine=vulkan");
    command.option("--pictures", o.pictures, "Of a live session: a folder for pictures of it, named by their seconds");
    command.option("--every", o.every_s, "With --pictures: seconds of the session from one to the next")
        .within(0.001, 1e6)
        .show_default();
}

// Adds in which world a motion is felt, and how.
void add_through_options(Command command, AskedReplay& o) {
    command
        .option("--through", o.through,
                "A world (.toml, .wrl) in which the recorded motion is felt: adds a table of proxies, forces and "
                "deviations to FILE")
        .asset(AssetRoom::worlds);
    command.option("--radius", o.radius_m, "With --through: of the ball that touches, in metres; else as recorded");
    command.option("--stiffness", o.materials.stiffness_N_per_m, "With --through: of all objects, N/m");
    command.option("--damping", o.materials.damping_Ns_per_m, "With --through: of all objects, N s/m");
    command.option("--static-friction", o.materials.static_friction, "With --through: of all objects");
    command.option("--dynamic-friction", o.materials.dynamic_friction, "With --through: of all objects");
    command.option("--coulomb-velocity", o.materials.coulomb_velocity_m_per_s, "With --through: of all objects, m/s");
}

CommandAction add_replay(Command command) {
    const auto options = std::make_shared<AskedReplay>();
    add_repeat_options(command, *options);
    add_through_options(command, *options);
    command.option("--json", options->json, "A file for all figures; - for standard output");
    return [options]() -> Result<int> {
        if (const std::string misuse = misuse_of(*options); !misuse.empty()) return wrong_usage("replay", misuse);
        return action([&] { return run_replay(*options); })();
    };
}

}  // namespace

CommandRow replay_row() {
    return {"replay", "Do a recording again and compare every tick, or feel its motion elsewhere", add_replay};
}

}  // namespace burin::app
