// SPDX-License-Identifier: MIT
// The burin command. Exit status: 0 done, 1 failed (one line on standard error says why), 2 wrong usage, 3 a check that
// could not tell (burin devices test).
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "app/bench/bench_command.hpp"
#include "app/bench/profile.hpp"
#include "app/carve/sculpt_options.hpp"
#include "app/cli/command_line.hpp"
#include "app/cli/commands.hpp"
#include "app/cli/live_options.hpp"
#include "app/cli/output_files.hpp"
#include "app/cli/version_report.hpp"
#include "app/demo_command.hpp"
#include "app/devices/devices_command.hpp"
#include "app/devices/glove_command.hpp"
#include "app/meshes/convert_placing.hpp"
#include "app/meshes/document_command.hpp"
#include "app/recordings/live_replay.hpp"
#include "app/recordings/replay_command.hpp"
#include "app/recordings/session_command.hpp"
#include "app/rehab/rehab_command.hpp"
#include "app/study/study_command.hpp"
#include "app/walls/wall_commands.hpp"
#include "app/world/world_command.hpp"
#include "session/drive/session.hpp"

namespace burin::app {
namespace {

Result<void> write_manual(const std::vector<ManualFile>& files, const std::string& folder) {
    for (const ManualFile& file : files) {
        const std::string path = (std::filesystem::path(folder) / file.name).string();
        if (const auto made = make_folder_of(path); !made) return made;
        if (const auto written = write_text(path, file.text); !written) return written;
    }
    return {};
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

// Returns the exit status that a command chose for itself, or that of its Error.
int finish(const Result<int>& outcome) {
    const int done = finish(outcome ? Result<void>{} : Result<void>(std::unexpected(outcome.error())));
    return done == 0 ? *outcome : done;
}

}  // namespace

int run(int argc, char** argv) {
    CommandLine line("Burin, an immersive haptic workbench");
    Command app = line.program();
    bool version = false;
    app.flag("--version", version, "The version, where the assets lie, engines, drivers, libraries and devices found");
    std::string manual_folder;
    app.option("--write-manual", manual_folder, "Write the manual's pages and bash's completion into this folder");

    session::SculptOptions sculpt_options;
    Command sculpt = app.subcommand("sculpt", "Carve a workpiece, in a window or along a stroke");
    add_sculpt_options(sculpt, sculpt_options);
    add_live_options(sculpt, sculpt_options.live);

    ConvertOptions convert_options;
    Command convert = app.subcommand(
        "convert",
        "Convert a mesh file or a document to STL, PLY or OBJ, or a session file to what other programs read");
    convert.option("IN", convert_options.in, "STL, OBJ, PLY, OFF, or a document (.burin); with --to a session file")
        .asset(AssetRoom::workpieces)
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
    add_placing_options(convert, convert_options);

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
    if (!manual_folder.empty()) return finish(write_manual(line.manual(version_text()), manual_folder));
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
