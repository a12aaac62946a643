// SPDX-License-Identifier: MIT
#include <array>
#include <cstdio>
#include <memory>

#include "app/commands.hpp"
#include "app/output_files.hpp"
#include "bench/body/body_bench.hpp"

namespace burin::app {

BenchSubcommand add_bench_body(Command bench) {
    struct BodyBench {
        bench::BodyBenchTask task;
        std::string json;
    };
    Command command = bench.subcommand("body", "A soft ball between plates, beside Tatara's theory");
    const auto options = std::make_shared<BodyBench>();
    command.option("--young", options->task.young_Pa, "Young's modulus, Pa").show_default();
    command.option("--poisson", options->task.poisson, "Poisson's ratio").show_default();
    command.option("--along-radius", options->task.elements_along_radius, "Cells of the lattice along the radius")
        .show_default();
    command.flag("--quick", options->task.quick, "Leave the table over sweeps and steps out");
    command.option("--json", options->json, "A file for the figures; - for standard output");
    const auto run = [options]() -> Result<void> {
        if (const auto ok = check_places(std::array{options->json}); !ok) return ok;
        const auto figures = bench::measure_body(options->task);
        if (!figures) return std::unexpected(figures.error());
        if (options->json != kStandardOutput) std::fputs(bench::body_bench_table(*figures).c_str(), stdout);
        return write_output(options->json, json_text(bench::body_bench_json(*figures)));
    };
    return {command, run};
}

}  // namespace burin::app
