// SPDX-License-Identifier: MIT
#include <array>
#include <cstdio>
#include <memory>

#include "app/commands.hpp"
#include "app/output_files.hpp"
#include "bench/haptics/haptics.hpp"

namespace burin::app {
namespace {

struct HapticsBench {
    bool quick = false;
    std::uint64_t contact_ticks = 0, paced_ticks = 0;  // 0: the default number
    std::string models, csv, svg, json;
};

bench::HapticsOptions haptics_options(const HapticsBench& options) {
    bench::HapticsOptions wanted = options.quick ? bench::quick_haptics() : bench::HapticsOptions{};
    if (options.contact_ticks > 0) wanted.contact_ticks = options.contact_ticks;
    if (options.paced_ticks > 0) wanted.paced_ticks = options.paced_ticks;
    wanted.scenes.models = options.models;
    return wanted;
}

Result<void> run_haptics_bench(const HapticsBench& options) {
    if (const auto ok = check_places(std::array{options.csv, options.svg, options.json}); !ok) return ok;
    const auto all = bench::run_haptics(haptics_options(options), [](const std::string& part) {
        std::fprintf(stderr, "measuring: %s\n", part.c_str());
    });
    if (!all) return std::unexpected(all.error());
    if (options.json != kStandardOutput && options.csv != kStandardOutput && options.svg != kStandardOutput) {
        std::fputs(bench::haptics_table(*all).c_str(), stdout);
    }
    if (const auto done = write_output(options.csv, bench::haptics_csv(*all)); !done) return done;
    if (const auto done = write_output(options.svg, bench::haptics_svg(*all)); !done) return done;
    return write_output(options.json, json_text(bench::haptics_json(*all)));
}

}  // namespace

BenchSubcommand add_bench_haptics(Command bench) {
    Command command = bench.subcommand(
        "haptics",
        "Ticks of the haptic loop: their cost, parts, the proxy's error, lost contact, edits, the force's jumps");
    const auto options = std::make_shared<HapticsBench>();
    command.flag("--quick", options->quick, "Small meshes and few ticks: whether it works, in seconds");
    command.option("--ticks", options->contact_ticks, "How many ticks are looked at for lost contact (1000000)")
        .within(std::uint64_t{1}, std::uint64_t{1'000'000'000});
    command
        .option("--paced-ticks", options->paced_ticks,
                "How many ticks of each scene and probe, 1 ms each, cold, and as many rehearsed (2000)")
        .within(std::uint64_t{1}, std::uint64_t{10'000'000});
    command.option("--models", options->models,
                   "A folder of meshes (STL, OBJ, PLY, OFF) to be touched besides, each scaled to 100 mm");
    command.option("--csv", options->csv, "A file for the table of ticks; - for standard output");
    command.option("--svg", options->svg, "A file for the figure");
    command.option("--json", options->json, "A file for every figure; - for standard output");
    return {command, [options] { return run_haptics_bench(*options); }};
}

}  // namespace burin::app
