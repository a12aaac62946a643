// SPDX-License-Identifier: MIT
#include "app/world/world_command.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "app/cli/live_options.hpp"
#include "app/cli/output_files.hpp"
#include "app/recordings/live_replay.hpp"
#include "app/world/world_check.hpp"
#include "app/world/world_explore.hpp"
#include "app/world/world_wand.hpp"
#include "base/text.hpp"
#include "base/try.hpp"
#include "compute/rays/lattice.hpp"
#include "desk/run/session.hpp"
#include "devices/haptic/wand_choice.hpp"
#include "devices/registry/device_nature.hpp"
#include "devices/registry/device_registry.hpp"
#include "session/options/option_bounds.hpp"
#include "session/record/input_files.hpp"
#include "session/record/recordings.hpp"
#include "session/record/session_log.hpp"

namespace burin::app {
namespace {

// Returns whether a log holds what the threads of a session did: a session file, or by its first line
// (docs/formats.md).
bool is_recording(const std::string& log) {
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(log, ignored)) return false;  // a pipe would be waited for
    if (session::is_database(log)) return true;
    std::ifstream file(log, std::ios::binary);
    std::string first;
    return static_cast<bool>(std::getline(file, first)) && first.find("burin-input 2") != std::string::npos;
}

// Options of burin world check.
struct CheckedFiles {
    std::vector<std::string> files;
    std::string unit, root;  // of these
    std::string json;
};

Result<void> check_worlds(const CheckedFiles& asked) {
    session::InputFiles inputs;
    for (const std::string& file : asked.files) inputs.world(file);
    BURIN_TRY_DO(make_folder_of(asked.json));
    BURIN_TRY_DO(check_places(std::array{asked.json}, inputs.list()));
    Json report{{"files", Json::array()}};
    std::size_t faults = 0, faulty_files = 0;
    for (const std::string& file : asked.files) {
        const CheckedWorld checked = check_world(file, {asked.unit, asked.root}, asked.json != kStandardOutput);
        faults += checked.faults;
        faulty_files += checked.faults > 0 ? 1 : 0;
        report["files"].push_back(checked.json);
    }
    BURIN_TRY_DO(write_output(asked.json, json_text(report)));
    if (faults == 0) return {};
    std::fflush(stdout);
    return fail(faulty_files == 1 && asked.files.size() == 1
                    ? asked.files[0]
                    : std::to_string(faulty_files) + " of " + std::to_string(asked.files.size()) + " files",
                std::to_string(faults) + (faults == 1 ? " fault" : " faults"), "correct them and check again");
}

CommandAction add_world_check(Command command) {
    const auto options = std::make_shared<CheckedFiles>();
    command.option("FILE", options->files, "Worlds (.toml, .wrl for VRML 2.0, or a mesh), see docs/formats.md")
        .asset(AssetRoom::worlds)
        .required();
    command.option("--units", options->unit, "What a number of the files is: m, cm, mm, in, ft, or 2.54mm");
    command.option("--root", options->root, "A folder around a world in VRML, of which it may inline files");
    command.option("--json", options->json, "A file for all figures and faults; - for standard output");
    return action([options] { return check_worlds(*options); });
}

// Options of a world that is opened, in a live session or along a stroke.
struct WorldVisit {
    WorldExploration exploration;
    session::SessionSetup session;  // live
};

// Returns what is wrong with options that belong to a session and were given along a stroke; empty where nothing is.
std::string misuse_along_a_stroke(const WorldVisit& visit) {
    const session::SessionSetup& session = visit.session;
    if (!session.carve.workpiece.source.empty())
        return "--workpiece belongs to a session, and along a --stroke nothing is carved";
    if (session.carve.mirror.any()) return "--mirror belongs to a session, and along a --stroke nothing is carved";
    if (!session.hands.tool.shape.empty())
        return "--tool belongs to a session: along a --stroke a ball touches, of --radius";
    if (!session.scene.reading.unit.empty())
        return "--units belongs to a session: along a --stroke [world] unit in the settings beside the world says it";
    if (!session.scene.reading.root.empty())
        return "--root belongs to a session: for a --stroke, copy what the world inlines into its folder";
    if (session::wants_streams(session.record))
        return "--lsl and --lsl-markers belong to a session in real time, and a --stroke is felt in simulated time";
    if (!session.record.input.empty()) return "--input leads a session and --stroke a simulated hand: give one";
    return "";
}

// Returns what is wrong with the devices along a stroke, which one hand follows; empty where nothing is.
std::string misuse_of_devices(const session::SessionSetup& setup) {
    if (!setup.hands.named.empty()) return "world explores with one hand: name one --device";
    if (setup.hands.device == devices::kDefaultHapticDevice ||
        devices::has_handle(setup.hands.device, &session::session_recordings()))
        return "";
    return "world explores with --device " + std::string(devices::kDefaultHapticDevice) + " or " +
           devices::devices_with_handles() + ", not " + setup.hands.device;
}

// Returns what is wrong with the usage; empty where nothing is.
std::string misuse_of(const WorldVisit& visit) {
    const session::SessionSetup& setup = visit.session;
    const WorldExploration& exploration = visit.exploration;
    if (exploration.world.empty() && setup.record.input.empty())
        return "world needs a file, or the word check and files";
    const bool along_a_stroke = !exploration.stroke.empty();
    if (along_a_stroke)
        if (const std::string misuse = misuse_along_a_stroke(visit); !misuse.empty()) return misuse;
    if (!along_a_stroke && !(exploration.report.empty() && exploration.pictures.empty()))
        return std::string(exploration.report.empty() ? "--pictures" : "--report") + " belongs to a --stroke";
    const bool has_points = std::ranges::any_of(session::devices_of(setup.hands), [](const auto& hand) {
        return devices::has_handle(hand.device, &session::session_recordings());
    });
    if (!exploration.points.empty() && !has_points)
        return "--points belongs to a wand: give --device " + devices::devices_with_handles();
    return along_a_stroke ? misuse_of_devices(setup) : "";
}

// Explores along a stroke by a simulated hand.
Result<void> explore(const WorldVisit& visit) {
    WorldExploration exploration = visit.exploration;
    exploration.record = visit.session.record.path;
    exploration.device = visit.session.hands.device;
    if (devices::has_handle(exploration.device, &session::session_recordings()))
        return explore_world_with_wand(exploration);
    return explore_world(exploration);
}

// Opens the world in a live session.
Result<void> open_session(const WorldVisit& visit) {
    session::SessionSetup session = visit.session;
    session.scene.world = visit.exploration.world;
    if (devices::has_handle(session.hands.device, &session::session_recordings())) {
        session.hands.points = visit.exploration.points;
        if (session.hands.points.empty()) {
            BURIN_TRY(nature, devices::nature_of_device(session.hands.device, &session::session_recordings()));
            session.hands.points = devices::usual_points(*nature.handle);
        }
        if (session.hands.tool.shape.empty())
            session.hands.tool.shape = formatted("ball:%g", visit.exploration.radius_m);
    }
    // A recording says itself what it was of; a script does not.
    const bool says_itself = session.scene.world.empty() && is_recording(session.record.input);
    session.scene.no_workpiece = !says_itself && session.carve.workpiece.source.empty();
    const workpiece::WorkpieceOptions usual;
    if (session.carve.workpiece.source.empty()) session.carve.workpiece.source = usual.source;
    return run_recorded_session(session, "world");
}

// Adds what says of which world, workpiece and tool the session is.
void add_opened_options(Command command, WorldVisit& o) {
    command
        .option("FILE", o.exploration.world, "A world: .toml, .wrl for VRML 2.0, a mesh (STL, OBJ, PLY, OFF), .burin")
        .asset(AssetRoom::worlds);
    command.option("--units", o.session.scene.reading.unit,
                   "What a number of the world's file is: m, cm, mm, in, ft, or 2.54mm; else as it states");
    command.option("--root", o.session.scene.reading.root,
                   "A folder around a world in VRML, of which it may inline files; else its own");
    command
        .option("--workpiece", o.session.carve.workpiece.source,
                "A workpiece that stands in the world and is carved: FILE, block:X,Y,Z or ball:R; else none")
        .asset(AssetRoom::workpieces);
    command
        .option("--resolution", o.session.carve.workpiece.resolution, "Of the workpiece: cells along its longest side")
        .within(session::kResolutionBounds)
        .show_default();
    command
        .option("--tool", o.session.hands.tool.shape,
                alternatives(toolbox::tool_synopses()) +
                    ", in metres; else a ball whose radius is 1.5 % of the world's longest side")
        .asset(AssetRoom::tools);
    add_mirror_option(command, o.session);
}

// Adds what says how a simulated hand explores.
void add_exploration_options(Command command, WorldExploration& exploration) {
    command
        .option("--stroke", exploration.stroke,
                "CSV with the columns time_s,x_m,y_m,z_m,qx,qy,qz,qw,button, along which a simulated hand goes")
        .asset(AssetRoom::strokes);
    command.option("--radius", exploration.radius_m, "Radius of the ball that touches, in metres")
        .within(1e-5, 1.0)
        .show_default();
    command.option("--points", exploration.points,
                   std::string("With a wand: which of its points touch, names with commas between them, centre, or how "
                               "many; else ") +
                       devices::kUsualPoints + ", or all that its description names where it has not both");
    command.option("--pictures", exploration.pictures,
                   "A folder for pictures: the world, each object when it is first touched, both eyes at the end");
    command.option("--report", exploration.report, "A JSON file for what was felt of each object; plots lie beside it");
}

CommandAction add_world(Command command) {
    const auto visit = std::make_shared<WorldVisit>();
    visit->session.carve.workpiece.source.clear();
    add_opened_options(command, *visit);
    add_exploration_options(command, visit->exploration);
    add_live_options(command, visit->session);
    const CommandAction opens = [visit]() -> Result<int> {
        if (const std::string misuse = misuse_of(*visit); !misuse.empty()) return wrong_usage("world", misuse);
        return action([&] { return visit->exploration.stroke.empty() ? open_session(*visit) : explore(*visit); })();
    };
    return add_commands(
        command,
        {{"check", "What is in each file, or all that is wrong with it; exit status 1 when one cannot be used",
          add_world_check}},
        opens);
}

}  // namespace

CommandRow world_row() { return {"world", "Explore a world by touch, and check worlds", add_world}; }

}  // namespace burin::app
