// SPDX-License-Identifier: MIT
// The burin command. Exit status: 0 done, 1 failed (one line on standard error says why), 2 wrong usage.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <map>

#include "app/bench_command.hpp"
#include "app/sculpt.hpp"
#include "compute/lattice.hpp"

namespace {

using burin::EngineChoice;
using burin::HandChoice;
using burin::SculptOptions;

void add_sculpt_options(CLI::App& command, SculptOptions& options) {
    static const std::map<std::string, EngineChoice> engines{
        {"auto", EngineChoice::automatic}, {"cpu", EngineChoice::cpu}, {"vulkan", EngineChoice::vulkan}};
    static const std::map<std::string, HandChoice> hands{{"rigid", HandChoice::rigid},
                                                         {"simulated", HandChoice::simulated}};
    command
        .add_option("--workpiece", options.workpiece.source,
                    "FILE (STL, OBJ, PLY, OFF), block:X,Y,Z or ball:R, in metres")
        ->required();
    command.add_flag("--close-holes", options.workpiece.close_holes, "Fill the holes of a mesh that is not closed");
    command.add_option("--tool", options.tool, "ball:R, in metres")->capture_default_str();
    command.add_option("--stroke", options.stroke, "CSV with the columns time_s,x_m,y_m,z_m,qx,qy,qz,qw,button");
    command.add_option("--resolution", options.workpiece.resolution, "Lattice cells along the longest side")
        ->check(CLI::Range(burin::kMinResolution, burin::kMaxResolution))
        ->capture_default_str();
    command.add_option("--engine", options.engine, "auto, cpu or vulkan")->transform(CLI::CheckedTransformer(engines));
    command
        .add_option("--hand", options.hand,
                    "rigid: the tool follows the stroke exactly; simulated: a hand feels its way")
        ->transform(CLI::CheckedTransformer(hands));
    command.add_flag("--real-time", options.real_time,
                     "With --hand simulated: a haptic thread at 1 kHz instead of simulated time");
    command.add_option("--export", options.exports,
                       "Where to write the carved mesh: .stl, .ply (with colour) or .obj; may be repeated");
    command.add_option("--pictures", options.pictures,
                       "A folder for before.png, after.png, left.png, right.png, stereo.png");
    command.add_option("--report", options.report, "A JSON file for all figures");
    command.add_option("--threads", options.threads, "How many threads carve; 0: one per core")
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

    std::string in, out;
    bool close_holes = false;
    CLI::App* convert = app.add_subcommand("convert", "Convert a mesh file to STL, PLY or OBJ and print its health");
    convert->add_option("IN", in, "STL, OBJ, PLY or OFF")->required();
    convert->add_option("OUT", out, ".stl, .ply or .obj")->required();
    convert->add_flag("--close-holes", close_holes, "Fill holes and turn the triangles outwards");

    const burin::BenchCommand bench(app);

    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() == 0) return app.exit(error);  // --help
        std::fprintf(stderr, "burin: %s; see burin %s--help\n", error.what(),
                     sculpt->parsed() ? "sculpt " : (convert->parsed() ? "convert " : (bench.parsed() ? "bench " : "")));
        return 2;
    }
    if (version) {
        burin::print_version();
        return 0;
    }
    if (sculpt->parsed()) return finish(burin::sculpt(sculpt_options));
    if (bench.parsed()) return finish(bench.run());
    if (convert->parsed()) return finish(burin::convert(in, out, close_holes));
    std::fputs(app.help().c_str(), stdout);
    return 2;
}
