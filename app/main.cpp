// SPDX-License-Identifier: MIT
// The burin command. Exit status: 0 done, 1 failed (one line on standard error says why), 2 wrong usage.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <map>

#include "app/bench_command.hpp"
#include "app/combine.hpp"
#include "app/sculpt.hpp"
#include "compute/lattice.hpp"

namespace {

using burin::EngineChoice;
using burin::HandChoice;
using burin::Operation;
using burin::SculptOptions;

void add_sculpt_options(CLI::App& command, SculptOptions& options) {
    static const std::map<std::string, EngineChoice> engines{
        {"auto", EngineChoice::automatic}, {"cpu", EngineChoice::cpu}, {"vulkan", EngineChoice::vulkan}};
    static const std::map<std::string, HandChoice> hands{{"rigid", HandChoice::rigid},
                                                         {"simulated", HandChoice::simulated}};
    static const std::map<std::string, Operation> operations{
        {"cut", Operation::cut}, {"fill", Operation::fill}, {"paint", Operation::paint}, {"smooth", Operation::smooth}};
    command
        .add_option("--workpiece", options.workpiece.source,
                    "FILE (STL, OBJ, PLY, OFF), block:X,Y,Z or ball:R, in metres")
        ->required();
    command.add_flag("--close-holes", options.workpiece.close_holes, "Fill the holes of a mesh that is not closed");
    command
        .add_option("--tool", options.tool.shape,
                    "ball:R, cylinder:R,L, cone:R0,R1,L, bullnose:R,C,L, box:X,Y,Z or mesh:FILE, in metres")
        ->capture_default_str();
    command.add_option("--operation", options.tool.operation, "cut, fill, paint or smooth")
        ->transform(CLI::CheckedTransformer(operations));
    command.add_option("--material", options.tool.material, "R,G,B, the colour of the surface that the tool leaves");
    command
        .add_option("--sweep-tolerance", options.tool.sweep_tolerance_cells,
                    "Largest error of a swept surface that has no closed form, in lattice cells")
        ->check(CLI::Range(0.001, 1000.0))
        ->capture_default_str();
    command
        .add_option("--smooth-strength", options.tool.smooth_strength,
                    "With --operation smooth: 0 does nothing, 1 all at once")
        ->check(CLI::Range(0.0, 1.0))
        ->capture_default_str();
    command.add_flag("!--no-merge", options.merge_rows,
                     "One update for each row of the stroke, instead of one for a straight run of rows");
    command.add_option("--stroke", options.stroke, "CSV with the columns time_s,x_m,y_m,z_m,qx,qy,qz,qw,button");
    command.add_option("--resolution", options.workpiece.resolution, "Lattice cells along the longest side")
        ->check(CLI::Range(burin::kMinResolution, burin::kMaxResolution))
        ->capture_default_str();
    command.add_option("--engine", options.engine, "auto, cpu or vulkan")->transform(CLI::CheckedTransformer(engines));
    command
        .add_option("--hand", options.hand,
                    "rigid: the tool follows the stroke exactly; simulated: a hand feels its way")
        ->transform(CLI::CheckedTransformer(hands));
    command
        .add_option("--hardness", options.feel.hardness,
                    "With --hand simulated: soft, medium, hard, or the pressure in kPa under which a millimetre of "
                    "material a second goes away; 0 gives way, inf cannot be cut")
        ->capture_default_str();
    command.add_option("--stiffness", options.feel.stiffness_N_per_m,
                       "With --hand simulated: of the surface, N/m at the device; else the hardness' own");
    command.add_option("--friction", options.feel.friction,
                       "With --hand simulated: Coulomb's coefficient; else the hardness' own");
    command
        .add_option("--press", options.feel.press_N,
                    "With --hand simulated: the force in N with which the hand presses beyond its stroke")
        ->capture_default_str();
    command
        .add_option("--grip", options.feel.grip_N_per_m,
                    "With --hand simulated: how firmly the hand holds the tool, N/m")
        ->capture_default_str();
    command.add_flag("--real-time", options.real_time,
                     "With --hand simulated: a haptic thread at 1 kHz instead of simulated time");
    command.add_option("--export", options.exports,
                       "Where to write the carved mesh: .stl, .ply (with colour) or .obj; may be repeated");
    command.add_option("--simplify", options.simplify_m,
                       "Export fewer triangles: the surface moves at most this far, in metres");
    command.add_option("--pictures", options.pictures,
                       "A folder for before.png, after.png, left.png, right.png, stereo.png");
    command.add_option("--report", options.report, "A JSON file for all figures; plots of what was felt go beside it");
    command.add_option("--undo", options.undo, "Take back the last so many strokes, each from press to release")
        ->capture_default_str();
    command.add_option("--undo-memory", options.undo_memory_MiB, "MiB for strokes that can be taken back")
        ->check(CLI::Range(1, 1 << 20))
        ->capture_default_str();
    command.add_option("--threads", options.threads, "How many threads carve; 0: one per core")
        ->check(CLI::Range(0, 1024));
}

void add_combine_options(CLI::App& command, burin::CombineOptions& options) {
    static const std::map<std::string, burin::Combination> operations{{"union", burin::Combination::unite},
                                                                      {"difference", burin::Combination::subtract},
                                                                      {"intersection", burin::Combination::intersect}};
    command.add_option("A", options.a, "STL, OBJ, PLY or OFF")->required();
    command.add_option("B", options.b, "STL, OBJ, PLY or OFF")->required();
    command.add_option("--operation", options.operation, "union, difference (A without B) or intersection")
        ->required()
        ->transform(CLI::CheckedTransformer(operations));
    command.add_option("--resolution", options.resolution, "Lattice cells along the longest side of both together")
        ->check(CLI::Range(burin::kMinResolution, burin::kMaxResolution))
        ->capture_default_str();
    command.add_flag("--close-holes", options.close_holes, "Fill the holes of meshes that are not closed");
    command.add_option("--export", options.exports,
                       "Where to write the result: .stl, .ply (with colour) or .obj; may be repeated");
    command.add_option("--report", options.report, "A JSON file for all figures");
    command.add_option("--threads", options.threads, "How many threads work; 0: one per core")
        ->check(CLI::Range(0, 1024));
}

int finish(const burin::Result<void>& outcome) {
    if (outcome) return 0;
    std::fprintf(stderr, "burin: %s\n", outcome.error().line().c_str());
    return 1;
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app{"Burin, an immersive haptic workbench"};
    app.require_subcommand(0, 1);
    bool version = false;
    app.add_flag("--version", version, "The version, and the Vulkan devices found");

    SculptOptions sculpt_options;
    CLI::App* sculpt = app.add_subcommand("sculpt", "Carve a workpiece along a stroke");
    add_sculpt_options(*sculpt, sculpt_options);

    burin::ConvertOptions convert_options;
    CLI::App* convert = app.add_subcommand("convert", "Convert a mesh file to STL, PLY or OBJ and print its health");
    convert->add_option("IN", convert_options.in, "STL, OBJ, PLY or OFF")->required();
    convert->add_option("OUT", convert_options.out, ".stl, .ply or .obj")->required();
    convert->add_flag("--close-holes", convert_options.close_holes, "Fill holes and turn the triangles outwards");
    convert->add_option("--simplify", convert_options.simplify_m,
                        "Fewer triangles: the surface moves at most this far, in metres");

    burin::CombineOptions combine_options;
    CLI::App* combine = app.add_subcommand("combine", "Unite, subtract or intersect two closed meshes");
    add_combine_options(*combine, combine_options);

    const burin::BenchCommand bench(app);

    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() == 0) return app.exit(error);  // --help
        std::fprintf(stderr, "burin: %s; see burin %s--help\n", error.what(),
                     sculpt->parsed() ? "sculpt "
                                      : (convert->parsed()   ? "convert "
                                         : combine->parsed() ? "combine "
                                                             : (bench.parsed() ? "bench " : "")));
        return 2;
    }
    if (version) {
        burin::print_version();
        return 0;
    }
    if (sculpt->parsed()) return finish(burin::sculpt(sculpt_options));
    if (bench.parsed()) return finish(bench.run());
    if (convert->parsed()) return finish(burin::convert(convert_options));
    if (combine->parsed()) return finish(burin::combine_files(combine_options));
    std::fputs(app.help().c_str(), stdout);
    return 2;
}
