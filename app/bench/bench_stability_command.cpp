// SPDX-License-Identifier: MIT
#include <array>
#include <cstdio>
#include <memory>

#include "app/bench/bench_command.hpp"
#include "app/cli/output_files.hpp"
#include "base/try.hpp"
#include "bench/stability/stability.hpp"

namespace burin::app {
namespace {

struct StabilityBench {
    bool quick = false;
    std::string csv, svg, figure7_svg, json;
};

Result<void> run_stability_bench(const StabilityBench& options) {
    BURIN_TRY_DO(check_places(std::array{options.csv, options.svg, options.figure7_svg, options.json}));
    const bench::Stability stability = bench::run_stability(options.quick);
    if (options.json != kStandardOutput && options.csv != kStandardOutput && options.svg != kStandardOutput &&
        options.figure7_svg != kStandardOutput) {
        std::fputs(bench::stability_table(stability).c_str(), stdout);
    }
    BURIN_TRY_DO(write_output(options.csv, bench::stability_csv(stability)));
    BURIN_TRY_DO(write_output(options.svg, bench::stability_svg(stability)));
    BURIN_TRY_DO(write_output(options.figure7_svg, bench::figure7_svg(stability.figure7)));
    return write_output(options.json, json_text(bench::stability_json(stability)));
}

CommandAction add_stability_bench(Command command) {
    const auto options = std::make_shared<StabilityBench>();
    command.flag("--quick", options->quick, "A few points of each table");
    command.option("--csv", options->csv, "A file for the figures; - for standard output");
    command.option("--svg", options->svg, "A file for the plots of the largest stable stiffness");
    command.option("--figure7-svg", options->figure7_svg, "A file for the force over time with and without a filter");
    command.option("--json", options->json, "A file for every figure; - for standard output");
    return action([options] { return run_stability_bench(*options); });
}

}  // namespace

CommandRow bench_stability_row() {
    return {"stability",
            "How stiff a wall may be before a simulated device shakes, over rate, delay, filter and controller",
            add_stability_bench};
}

}  // namespace burin::app
