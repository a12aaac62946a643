// SPDX-License-Identifier: MIT
#include <array>
#include <cstdio>
#include <memory>

#include "app/bench/bench_command.hpp"
#include "app/bench/bench_limits.hpp"
#include "app/cli/output_files.hpp"
#include "base/try.hpp"
#include "bench/stroke/pareto.hpp"
#include "compute/rays/lattice.hpp"

namespace burin::app {
namespace {

struct ParetoBench {
    bench::ParetoOptions pareto;
    std::string csv, svg, json;
};

Result<void> run_pareto_bench(const ParetoBench& options) {
    BURIN_TRY_DO(check_places(std::array{options.csv, options.svg, options.json}));
    BURIN_TRY(compared, bench::run_pareto(options.pareto, [](const std::string& line) {
                  std::fprintf(stderr, "measured: %s\n", line.c_str());
              }));
    Json report = {{"machine", compared.machine}, {"rows", compared.rows}, {"left_out", compared.left_out}};
    if (options.json != kStandardOutput && options.csv != kStandardOutput && options.svg != kStandardOutput) {
        std::fputs(bench::pareto_table(compared).c_str(), stdout);
    }
    BURIN_TRY_DO(write_output(options.csv, bench::pareto_csv(compared)));
    BURIN_TRY_DO(write_output(options.svg, bench::pareto_svg(compared)));
    return write_output(options.json, json_text(report));
}

CommandAction add_pareto_bench(Command command) {
    const auto options = std::make_shared<ParetoBench>();
    command.option("--smallest", options->pareto.smallest, "The coarsest resolution")
        .within(compute::kMinResolution, compute::kMaxResolution)
        .show_default();
    command.option("--largest", options->pareto.largest, "The finest; each is twice the one before")
        .within(compute::kMinResolution, compute::kMaxResolution)
        .show_default();
    command
        .option("--largest-on-software-vulkan", options->pareto.largest_on_software_vulkan,
                "The finest for the Vulkan engine where its device is a software one; 0: none")
        .within(0, compute::kMaxResolution)
        .show_default();
    command.option("--threads", options->pareto.threads, kBenchThreadsHelp).within(0, kMostBenchThreads);
    command.option("--updates", options->pareto.updates, "Only so many of the cuts")
        .within(1, kMostBenchUpdates)
        .show_default();
    command.option("--cgal-updates", options->pareto.cgal_updates, "Only so many of the cuts with CGAL, which is slow")
        .within(1, kMostBenchUpdates)
        .show_default();
    command.option("--csv", options->csv, "A file for the table; - for standard output");
    command.option("--svg", options->svg, "A file for the figure");
    command.option("--json", options->json, "A file for every figure of every run; - for standard output");
    return action([options] { return run_pareto_bench(*options); });
}

}  // namespace

CommandRow bench_pareto_row() {
    return {"pareto", "Time against error over resolutions, for both engines and the peers", add_pareto_bench};
}

}  // namespace burin::app
