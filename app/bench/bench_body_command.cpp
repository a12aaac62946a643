// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cstdio>
#include <memory>

#include "app/cli/commands.hpp"
#include "app/cli/output_files.hpp"
#include "base/file_io.hpp"
#include "base/text.hpp"
#include "bench/body/body_bench.hpp"

namespace burin::app {

BenchSubcommand add_bench_body(Command bench) {
    struct BodyBench {
        bench::BodyBenchTask task;
        std::string json, svg, dents, calculix;
    };
    Command command = bench.subcommand("body", "Soft bodies beside theory: a ball between plates, putty, grasps");
    const auto options = std::make_shared<BodyBench>();
    command.option("--young", options->task.young_Pa, "Young's modulus, Pa").show_default();
    command.option("--poisson", options->task.poisson, "Poisson's ratio").show_default();
    command.option("--along-radius", options->task.elements_along_radius, "Cells of the lattice along the radius")
        .show_default();
    command.flag("--quick", options->task.quick, "The ball between plates alone");
    command.option("--still", options->task.still_s, "How long fingers stay still in putty, in seconds").show_default();
    command.option("--kneads", options->task.kneads, "How often putty is kneaded").show_default();
    command.option("--grasps", options->task.grasps, "How many random grasps").show_default();
    command.option("--svg", options->svg, "A file for the plot of the force over the squeeze");
    command.option("--calculix", options->calculix, "Its forces for the plot, of scripts/ball-beside-calculix --json");
    command.option("--dents", options->dents, "A file for the dents of the paper's own model");
    command.option("--json", options->json, "A file for the figures; - for standard output");
    const auto run = [options]() -> Result<void> {
        if (const auto ok = check_places(std::array{options->json, options->svg, options->dents}); !ok) return ok;
        if (!(options->task.still_s >= 1.0 && options->task.still_s <= 3600.0))
            return fail("--still", formatted("is %g", options->task.still_s), "ask for 1 to 3600 seconds");
        Json calculix = Json::array();
        if (!options->calculix.empty()) {
            const Result<std::string> text = read_text_file(options->calculix);
            if (!text) return std::unexpected(text.error());
            calculix = Json::parse(*text, nullptr, false);
            const auto is_force = [](const Json& row) {
                return row.is_object() && row.contains("calculix_N") && row["calculix_N"].is_number() &&
                       row.contains("closed_share_of_radius") && row["closed_share_of_radius"].is_number();
            };
            if (!calculix.is_array() || !std::ranges::all_of(calculix, is_force))
                return fail(options->calculix, "is no list of forces", "write it by scripts/ball-beside-calculix");
        }
        const auto figures = bench::measure_body(options->task);
        if (!figures) return std::unexpected(figures.error());
        if (options->json != kStandardOutput) std::fputs(bench::body_bench_table(*figures).c_str(), stdout);
        if (const auto ok = write_output(options->svg, bench::body_force_svg(*figures, calculix)); !ok) return ok;
        if (const auto ok = write_output(options->dents, bench::paper_dents_svg()); !ok) return ok;
        return write_output(options->json, json_text(bench::body_bench_json(*figures)));
    };
    return {command, run};
}

}  // namespace burin::app
