// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cstdio>
#include <memory>

#include "app/bench/bench_command.hpp"
#include "app/cli/output_files.hpp"
#include "base/file_io.hpp"
#include "base/text.hpp"
#include "base/try.hpp"
#include "bench/body/body_bench.hpp"

namespace burin::app {

namespace {

struct BodyBench {
    bench::BodyBenchTask task;
    std::string json, svg, dents, calculix;
};

// Reads the forces that another program has computed; an empty list where no file is named.
Result<Json> calculix_forces(const std::string& path) {
    if (path.empty()) return Json::array();
    BURIN_TRY(text, read_text_file(path));
    Json forces = Json::parse(text, nullptr, false);
    const auto is_force = [](const Json& row) {
        return row.is_object() && row.contains("calculix_N") && row["calculix_N"].is_number() &&
               row.contains("closed_share_of_radius") && row["closed_share_of_radius"].is_number();
    };
    if (!forces.is_array() || !std::ranges::all_of(forces, is_force))
        return fail(path, "is no list of forces", "write it by scripts/ball-beside-calculix");
    return forces;
}

Result<void> run_body_bench(const BodyBench& options) {
    BURIN_TRY_DO(check_places(std::array{options.json, options.svg, options.dents}));
    if (!(options.task.still_s >= 1.0 && options.task.still_s <= 3600.0))
        return fail("--still", formatted("is %g", options.task.still_s), "ask for 1 to 3600 seconds");
    BURIN_TRY(calculix, calculix_forces(options.calculix));
    BURIN_TRY(figures, bench::measure_body(options.task));
    if (options.json != kStandardOutput) std::fputs(bench::body_bench_table(figures).c_str(), stdout);
    BURIN_TRY_DO(write_output(options.svg, bench::body_force_svg(figures, calculix)));
    BURIN_TRY_DO(write_output(options.dents, bench::paper_dents_svg()));
    return write_output(options.json, json_text(bench::body_bench_json(figures)));
}

CommandAction add_body_bench(Command command) {
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
    return action([options] { return run_body_bench(*options); });
}

}  // namespace

CommandRow bench_body_row() {
    return {"body", "Soft bodies beside theory: a ball between plates, putty, grasps", add_body_bench};
}

}  // namespace burin::app
