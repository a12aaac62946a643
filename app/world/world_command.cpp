// SPDX-License-Identifier: MIT
#include "app/world/world_command.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
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
#include "compute/rays/lattice.hpp"
#include "devices/haptic/wand_choice.hpp"
#include "devices/registry/device_registry.hpp"
#include "session/drive/session.hpp"
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

}  // namespace

struct WorldCommand::Options {
    std::vector<std::string> files;  // to check
    std::string unit, root;          // of these
    WorldExploration exploration;
    session::SculptOptions session;  // live
    std::string json;

    [[nodiscard]] Result<void> check_files() const;
};

Result<void> WorldCommand::Options::check_files() const {
    session::InputFiles inputs;
    for (const std::string& file : files) inputs.world(file);
    if (const auto ok = make_folder_of(json); !ok) return ok;
    if (const auto ok = check_places(std::array{json}, inputs.list()); !ok) return ok;
    Json report{{"files", Json::array()}};
    std::size_t faults = 0, faulty_files = 0;
    for (const std::string& file : files) {
        const CheckedWorld checked = check_world(file, {unit, root}, json != kStandardOutput);
        faults += checked.faults;
        faulty_files += checked.faults > 0 ? 1 : 0;
        report["files"].push_back(checked.json);
    }
    if (const auto ok = write_output(json, json_text(report)); !ok) return ok;
    if (faults == 0) return {};
    std::fflush(stdout);
    return fail(faulty_files == 1 && files.size() == 1
                    ? files[0]
                    : std::to_string(faulty_files) + " of " + std::to_string(files.size()) + " files",
                std::to_string(faults) + (faults == 1 ? " fault" : " faults"), "correct them and check again");
}

WorldCommand::WorldCommand(Command app)
    : options_(std::make_unique<Options>()),
      command_(app.subcommand("world", "Explore a world by touch, and check worlds")) {
    Options& o = *options_;
    o.session.workpiece.source.clear();
    command_
        .option("FILE", o.exploration.world, "A world: .toml, .wrl for VRML 2.0, a mesh (STL, OBJ, PLY, OFF), .burin")
        .asset(AssetRoom::worlds);
    command_.option("--units", o.session.world_reading.unit,
                    "What a number of the world's file is: m, cm, mm, in, ft, or 2.54mm; else as it states");
    command_.option("--root", o.session.world_reading.root,
                    "A folder around a world in VRML, of which it may inline files; else its own");
    command_
        .option("--workpiece", o.session.workpiece.source,
                "A workpiece that stands in the world and is carved: FILE, block:X,Y,Z or ball:R; else none")
        .asset(AssetRoom::workpieces);
    command_.option("--resolution", o.session.workpiece.resolution, "Of the workpiece: cells along its longest side")
        .within(session::kResolutionBounds)
        .show_default();
    command_
        .option("--tool", o.session.tool.shape,
                sculpt::alternatives(sculpt::tool_synopses()) +
                    ", in metres; else a ball whose radius is 1.5 % of the world's longest side")
        .asset(AssetRoom::tools);
    add_mirror_option(command_, o.session);
    command_
        .option("--stroke", o.exploration.stroke,
                "CSV with the columns time_s,x_m,y_m,z_m,qx,qy,qz,qw,button, along which a simulated hand goes")
        .asset(AssetRoom::strokes);
    command_.option("--radius", o.exploration.radius_m, "Radius of the ball that touches, in metres")
        .within(1e-5, 1.0)
        .show_default();
    command_.option(
        "--points", o.exploration.points,
        std::string("With a wand: which of its points touch, names with commas between them, centre, or how "
                    "many; else ") +
            devices::kUsualPoints + ", or all that its description names where it has not both");
    command_.option("--pictures", o.exploration.pictures,
                    "A folder for pictures: the world, each object when it is first touched, both eyes at the end");
    command_.option("--report", o.exploration.report,
                    "A JSON file for what was felt of each object; plots lie beside it");
    add_live_options(command_, o.session.live);
    check_ = command_.subcommand(
        "check", "What is in each file, or all that is wrong with it; exit status 1 when one cannot be used");
    check_.option("FILE", o.files, "Worlds (.toml, .wrl for VRML 2.0, or a mesh), see docs/formats.md")
        .asset(AssetRoom::worlds)
        .required();
    check_.option("--units", o.unit, "What a number of the files is: m, cm, mm, in, ft, or 2.54mm");
    check_.option("--root", o.root, "A folder around a world in VRML, of which it may inline files");
    check_.option("--json", o.json, "A file for all figures and faults; - for standard output");
}

WorldCommand::~WorldCommand() = default;

bool WorldCommand::parsed() const { return command_.parsed(); }

std::string WorldCommand::misuse() const {
    if (check_.parsed()) return "";
    const session::LiveOptions& live = options_->session.live;
    const WorldExploration& exploration = options_->exploration;
    if (exploration.world.empty() && live.input.empty()) return "world needs a file, or the word check and files";
    const bool along_a_stroke = !exploration.stroke.empty();
    if (along_a_stroke && !options_->session.workpiece.source.empty())
        return "--workpiece belongs to a session, and along a --stroke nothing is carved";
    if (along_a_stroke && options_->session.mirror.any())
        return "--mirror belongs to a session, and along a --stroke nothing is carved";
    if (along_a_stroke && !options_->session.tool.shape.empty())
        return "--tool belongs to a session: along a --stroke a ball touches, of --radius";
    if (along_a_stroke && !options_->session.world_reading.unit.empty())
        return "--units belongs to a session: along a --stroke [world] unit in the settings beside the world says it";
    if (along_a_stroke && !options_->session.world_reading.root.empty())
        return "--root belongs to a session: for a --stroke, copy what the world inlines into its folder";
    if (along_a_stroke && session::wants_streams(live))
        return "--lsl and --lsl-markers belong to a session in real time, and a --stroke is felt in simulated time";
    if (along_a_stroke && !live.input.empty()) return "--input leads a session and --stroke a simulated hand: give one";
    if (!along_a_stroke && !(exploration.report.empty() && exploration.pictures.empty()))
        return std::string(exploration.report.empty() ? "--pictures" : "--report") + " belongs to a --stroke";
    const bool has_points = std::ranges::any_of(session::devices_of(live), [](const auto& hand) {
        return devices::has_handle(hand.device, &session::session_recordings());
    });
    if (!options_->exploration.points.empty() && !has_points)
        return "--points belongs to a wand: give --device " + devices::devices_with_handles();
    if (!options_->exploration.stroke.empty() && !live.hands.empty())
        return "world explores with one hand: name one --device";
    if (!options_->exploration.stroke.empty() && live.device != devices::kDefaultHapticDevice &&
        !devices::has_handle(live.device, &session::session_recordings()))
        return "world explores with --device " + std::string(devices::kDefaultHapticDevice) + " or " +
               devices::devices_with_handles() + ", not " + live.device;
    return "";
}

Result<void> WorldCommand::run() const {
    if (check_.parsed()) return options_->check_files();
    if (!options_->exploration.stroke.empty()) {
        WorldExploration exploration = options_->exploration;
        exploration.record = options_->session.live.record;
        exploration.device = options_->session.live.device;
        if (devices::has_handle(exploration.device, &session::session_recordings()))
            return explore_world_with_wand(exploration);
        return explore_world(exploration);
    }
    session::SculptOptions session = options_->session;
    session.world = options_->exploration.world;
    if (devices::has_handle(session.live.device, &session::session_recordings())) {
        session.points = options_->exploration.points;
        if (session.points.empty()) {
            const Result<devices::DeviceNature> nature =
                devices::nature_of_device(session.live.device, &session::session_recordings());
            if (!nature) return std::unexpected(nature.error());
            session.points = devices::usual_points(*nature->handle);
        }
        if (session.tool.shape.empty()) session.tool.shape = formatted("ball:%g", options_->exploration.radius_m);
    }
    // A recording says itself what it was of; a script does not.
    const bool says_itself = session.world.empty() && is_recording(session.live.input);
    session.no_workpiece = !says_itself && session.workpiece.source.empty();
    const sculpt::WorkpieceOptions usual;
    if (session.workpiece.source.empty()) session.workpiece.source = usual.source;
    return run_recorded_session(session, "world");
}

}  // namespace burin::app
