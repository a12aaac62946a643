// SPDX-License-Identifier: MIT
// The burin command. Exit status: 0 done, 1 failed (one line on standard error says why), 2 wrong usage.
#include <cstdio>

#include "app/bench_command.hpp"
#include "app/command_line.hpp"
#include "app/commands.hpp"
#include "app/demo_command.hpp"
#include "app/devices_command.hpp"
#include "app/document_command.hpp"
#include "app/glove_command.hpp"
#include "app/live_options.hpp"
#include "app/live_replay.hpp"
#include "app/profile.hpp"
#include "app/rehab_command.hpp"
#include "app/replay_command.hpp"
#include "app/session_command.hpp"
#include "app/study_command.hpp"
#include "app/wall_commands.hpp"
#include "app/world_command.hpp"
#include "base/text.hpp"
#include "compute/rays/lattice.hpp"
#include "gpu/device.hpp"
#include "sculpt/crumbs.hpp"
#include "session/drive/session.hpp"

namespace burin::app {
namespace {

constexpr const char* kUnitsHelp =
    "Unit of the numbers in a mesh file that is read; else as the file states, else mm where its longest side is above "
    "5, and m where not";

constexpr const char* kWeldHelp =
    "Join corners at open edges that lie up to this far apart, in metres; else as far as the file's numbers are "
    "precise";

void add_sculpt_options(Command command, session::SculptOptions& options) {
    command
        .option("WORKPIECE,--workpiece", options.workpiece.source,
                "FILE (STL, OBJ, PLY, OFF, or a document .burin), block:X,Y,Z from the origin on, or ball:R about it, "
                "in metres")
        .show_default();
    command.option(
        "--world", options.world,
        "Objects that stand with the workpiece, and are touched and not carved: .toml, .wrl, STL, OBJ, PLY, OFF");
    command.flag("--no-workpiece", options.no_workpiece, "With --world: its objects alone, as burin world opens them");
    command.option("--points", options.points,
                   "With a wand: which of its points touch, each with the tool's ball; else the tool is in its middle");
    command.unit("--units", options.workpiece.units, kUnitsHelp);
    command.unit("--export-units", options.export_units,
                 "Unit of the numbers in exported files; else that of the workpiece's file, or m");
    command.flag("--close-holes", options.workpiece.close_holes, "Fill the holes of a mesh that is not closed");
    command.option("--weld", options.workpiece.weld_m, kWeldHelp);
    command.option("--tool", options.tool.shape,
                   sculpt::alternatives(sculpt::tool_synopses()) +
                       ", in metres; else a ball whose radius is 5 % of the workpiece's longest side");
    std::vector<std::pair<std::string, compute::Operation>> operations;
    for (const sculpt::OperationDescriptor& known : sculpt::operations())
        operations.emplace_back(known.name, known.operation);
    command.choice("--operation", options.tool.operation, sculpt::alternatives(sculpt::names_in(sculpt::operations())),
                   operations);
    command.option("--material", options.tool.material, "R,G,B, the colour of the surface that the tool leaves");
    command
        .option("--sweep-tolerance", options.tool.sweep_tolerance_cells,
                "Largest error of a swept surface that has no closed form, in lattice cells")
        .within(session::kSweepToleranceBounds)
        .show_default();
    command
        .option("--smooth-strength", options.tool.smooth_strength, "With --operation smooth: 0 does nothing, 1 is most")
        .within(session::kSmoothStrengthBounds)
        .show_default();
    add_mirror_option(command, options);
    command.flag("!--no-merge", options.merge_rows,
                 "One update for each row of the stroke, instead of one for a straight run of rows");
    command.option("--stroke", options.stroke, "CSV with the columns time_s,x_m,y_m,z_m,qx,qy,qz,qw,button");
    command.option("--resolution", options.workpiece.resolution, "Lattice cells along the longest side")
        .within(session::kResolutionBounds)
        .show_default();
    command
        .option(
            "--room", options.workpiece.room,
            formatted("Empty room on every side of the workpiece for what is added, as a share of its longest side; "
                      "else %g for a person, and where a --stroke adds material, or 0",
                      sculpt::kUsualRoom))
        .within(session::kRoomBounds);
    command.choice("--engine", options.engine, "auto, cpu or vulkan",
                   {{"auto", sculpt::EngineChoice::automatic},
                    {"cpu", sculpt::EngineChoice::cpu},
                    {"vulkan", sculpt::EngineChoice::vulkan}});
    command.choice("--hand", options.hand,
                   "rigid: the tool follows the stroke exactly; simulated: a hand feels its way",
                   {{"rigid", session::HandChoice::rigid}, {"simulated", session::HandChoice::simulated}});
    command
        .option("--hardness", options.feel.hardness,
                "With --hand simulated: soft, medium, hard, lime, maple, oak, mdf, beech-lvl, ptfe, or the pressure in "
                "kPa under which a millimetre of material a second goes away; 0 gives way, inf cannot be cut")
        .show_default();
    command.option("--yield", options.feel.yield_kPa,
                   "With --hand simulated: the pressure in kPa below which nothing goes away; else the hardness' own");
    command.option("--grain", options.feel.grain_mm,
                   "With --hand simulated: hard and soft rings across x with this spacing in mm; else none");
    command.option("--stiffness", options.feel.stiffness_N_per_m,
                   "With --hand simulated: of the surface, N/m at the device; else the hardness' own");
    command.option("--friction", options.feel.friction,
                   "With --hand simulated: Coulomb's coefficient; else the hardness' own");
    command
        .option("--press", options.feel.press_N,
                "With --hand simulated: the force in N with which the hand presses beyond its stroke")
        .show_default();
    command
        .option("--grip", options.feel.grip_N_per_m, "With --hand simulated: how firmly the hand holds the tool, N/m")
        .show_default();
    command.flag("--real-time", options.real_time,
                 "With --hand simulated: a haptic thread at 1 kHz instead of simulated time");
    command.option("--export", options.exports,
                   "Where to write the carved mesh: .stl, .ply (with colour) or .obj; may be repeated");
    command.option("--simplify", options.simplify_m,
                   "Export fewer triangles: the surface moves at most this far, in metres");
    command.option("--crumbs", options.crumbs_m,
                   formatted("Export no loose pieces below this size, in metres; 0 keeps all; else %g cells",
                             sculpt::kCrumbCells));
    command.option("--pictures", options.pictures,
                   "A folder for before.png, after.png, left.png, right.png, stereo.png");
    command.option("--report", options.report, "A JSON file for all figures; plots of what was felt go beside it");
    command.option("--undo", options.undo, "Take back the last so many strokes, each from press to release")
        .show_default();
    command.option("--undo-memory", options.undo_memory_MiB, "MiB for strokes that can be taken back")
        .within(session::kUndoMemoryBounds)
        .show_default();
    command.option("--threads", options.threads, "How many threads carve; 0: one per core").within(0, 1024);
}

void add_combine_options(Command command, CombineOptions& options) {
    command.option("A", options.a, "STL, OBJ, PLY or OFF").required();
    command.option("B", options.b, "STL, OBJ, PLY or OFF").required();
    command
        .choice("--operation", options.operation, "union, difference (A without B) or intersection",
                {{"union", compute::Combination::unite},
                 {"difference", compute::Combination::subtract},
                 {"intersection", compute::Combination::intersect}})
        .required();
    command.option("--resolution", options.resolution, "Lattice cells along the longest side of both together")
        .within(compute::kMinResolution, compute::kMaxResolution)
        .show_default();
    command.unit("--units", options.units, std::string("Of both files: ") + kUnitsHelp);
    command.unit("--export-units", options.export_units, "Unit of the numbers in exported files; else that of A");
    command.flag("--close-holes", options.close_holes, "Fill the holes of meshes that are not closed");
    command.option("--weld", options.weld_m, kWeldHelp);
    command.option("--export", options.exports,
                   "Where to write the result: .stl, .ply (with colour) or .obj; may be repeated");
    command.option("--report", options.report, "A JSON file for all figures");
    command.option("--threads", options.threads, "How many threads work; 0: one per core").within(0, 1024);
}

// burin --version: prints the version and the Vulkan devices found.
void print_version() {
    std::printf("burin %s\n", BURIN_VERSION);
    const auto devices = gpu::list_devices();
    if (!devices) {
        std::printf("Vulkan: %s\n", devices.error().line().c_str());
        return;
    }
    std::printf("Vulkan devices:\n");
    for (const gpu::DeviceInfo& device : *devices) {
        std::printf("  %s%s%s\n", device.line().c_str(),
                    device.unusable.empty() ? "" : " - not usable: ", device.unusable.c_str());
    }
}

int finish(const Result<void>& outcome) {
    if (outcome && std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return 0;
    if (outcome) {
        std::fprintf(stderr, "burin: standard output: not all could be written; is it closed, or its disk full?\n");
        return 1;
    }
    std::fprintf(stderr, "burin: %s\n", outcome.error().line().c_str());
    return 1;
}

}  // namespace

int run(int argc, char** argv) {
    CommandLine line("Burin, an immersive haptic workbench");
    Command app = line.program();
    bool version = false;
    app.flag("--version", version, "The version, and the Vulkan devices found");

    session::SculptOptions sculpt_options;
    Command sculpt = app.subcommand("sculpt", "Carve a workpiece, in a window or along a stroke");
    add_sculpt_options(sculpt, sculpt_options);
    add_live_options(sculpt, sculpt_options.live);

    ConvertOptions convert_options;
    Command convert = app.subcommand(
        "convert",
        "Convert a mesh file or a document to STL, PLY or OBJ, or a session file to what other programs read");
    convert.option("IN", convert_options.in, "STL, OBJ, PLY, OFF, or a document (.burin); with --to a session file")
        .required();
    convert.option("OUT", convert_options.out,
                   ".stl, .ply or .obj; with --to any name, - for standard output, or none: IN with another ending");
    convert
        .option("--to", convert_options.to,
                "csv, npy, hdf5, mat: the ticks of a session file as a table; bids: as a folder of motion data; log: "
                "what was noted, as text")
        .one_of({"csv", "npy", "hdf5", "mat", "bids", "log"});
    convert.option("--columns", convert_options.columns,
                   "With --to: names with commas between them, a star at the end for all that begin so; else all");
    convert.option(
        "--part", convert_options.part,
        "With --to: which hand, where the recording has several, or a derived table by its name's beginning");
    convert.option("--trials", convert_options.trials,
                   "With --to: the ticks of these trials alone: numbers or names with commas between them, a star at "
                   "the end for all that begin so");
    convert.option("--subject", convert_options.subject, "With --to bids: its label").show_default();
    convert.option("--task", convert_options.task, "With --to bids: its label").show_default();
    convert.unit("--units", convert_options.units, kUnitsHelp);
    convert.unit("--export-units", convert_options.export_units, "Unit of the numbers in OUT; else that of IN");
    convert.flag("--close-holes", convert_options.close_holes, "Fill holes and turn the triangles outwards");
    convert.option("--weld", convert_options.weld_m,
                   "Join corners at open edges that lie up to this far apart, in metres; with --close-holes at least "
                   "as far as the file's numbers are precise");
    convert.option("--simplify", convert_options.simplify_m,
                   "Fewer triangles: the surface moves at most this far, in metres");

    InfoOptions info_options;
    Command info = app.subcommand("info", "What is in a document, and from where it came");
    add_info_options(info, info_options);

    CombineOptions combine_options;
    Command combine = app.subcommand("combine", "Unite, subtract or intersect two closed meshes");
    add_combine_options(combine, combine_options);

    HandSession hand_options;
    Command hand = app.subcommand("hand", "Close, feel, grasp, carry and point with a drawn hand");
    add_hand_options(hand, hand_options);

    FilmOptions film_options;
    Command film = app.subcommand("film", "Join a folder's pictures into one that moves (animated PNG)");
    add_film_options(film, film_options);

    SeekSession seek_options;
    Command seek = app.subcommand("seek", "Touch the objects of a world as they are named, against the clock");
    add_seek_options(seek, seek_options);

    const BenchCommand bench(app);
    const WallCommand wall(app);
    const WorldCommand world(app);
    const DemoCommand demo(app);
    const ProfileCommand profile(app);
    const SessionCommand recordings(app);
    const ReplayCommand replay(app);
    const DevicesCommand devices(app);
    const GloveCommand glove(app);
    const StudyCommand study(app);
    const RehabCommand rehab(app);

    if (const auto status = line.parse(argc, argv)) return *status;
    if (version) {
        print_version();
        return 0;
    }
    const bool felt_recording = records_a_felt_stroke(sculpt_options);
    if (sculpt.parsed() && !felt_recording && session::wants_session(sculpt_options))
        return finish(run_recorded_session(sculpt_options, "sculpt"));
    if (sculpt.parsed()) {
        session::settle_room(sculpt_options, false);
        return finish(app::sculpt(sculpt_options));
    }
    if (bench.parsed()) return finish(bench.run());
    if (wall.parsed()) return finish(wall.run());
    if (world.parsed() && !world.misuse().empty()) {
        std::fprintf(stderr, "burin: %s; see burin world --help\n", world.misuse().c_str());
        return 2;
    }
    if (world.parsed()) return finish(world.run());
    if (hand.parsed()) return finish(app::hand(hand_options));
    if (film.parsed()) return finish(app::film(film_options));
    if (seek.parsed()) return finish(app::seek(seek_options));
    if (demo.parsed()) return finish(demo.run());
    if (profile.parsed()) return finish(profile.run());
    if (study.parsed()) return finish(study.run());
    if (recordings.parsed()) return finish(recordings.run());
    if (devices.parsed()) return finish(devices.run());
    if (glove.parsed()) return finish(glove.run());
    if (rehab.parsed()) return finish(rehab.run());
    if (replay.parsed() && !replay.misuse().empty()) {
        std::fprintf(stderr, "burin: %s; see burin replay --help\n", replay.misuse().c_str());
        return 2;
    }
    if (replay.parsed()) return finish(replay.run());
    if (convert.parsed() && convert_options.is_misused()) {
        std::fprintf(stderr, "burin: OUT is required; see burin convert --help\n");
        return 2;
    }
    if (convert.parsed())
        return finish(convert_options.is_of_session()    ? convert_session(convert_options)
                      : convert_options.is_of_document() ? convert_document(convert_options)
                                                         : app::convert(convert_options));
    if (info.parsed()) return finish(document_info(info_options));
    if (combine.parsed()) return finish(combine_files(combine_options));
    std::fputs(line.help().c_str(), stdout);
    return 2;
}

}  // namespace burin::app

int main(int argc, char** argv) { return burin::app::run(argc, argv); }
