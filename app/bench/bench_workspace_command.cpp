// SPDX-License-Identifier: MIT
#include <array>
#include <cstdio>
#include <memory>

#include "app/bench/bench_command.hpp"
#include "app/cli/output_files.hpp"
#include "base/try.hpp"
#include "bench/workspace/workspace.hpp"

namespace burin::app {
namespace {

struct WorkspaceBench {
    bench::WorkspaceTask task;
    std::string csv, svg, json;
};

Result<void> run_workspace_bench(const WorkspaceBench& options) {
    BURIN_TRY_DO(check_places(std::array{options.csv, options.svg, options.json}));
    std::vector<bench::WorkspaceFigures> figures;
    for (const bench::Approach& approach : bench::all_approaches()) {
        std::fprintf(stderr, "reaching: %s\n", approach.name.c_str());
        figures.push_back(bench::reach_targets(approach, options.task));
    }
    if (options.json != kStandardOutput && options.csv != kStandardOutput && options.svg != kStandardOutput) {
        std::fputs((bench::assumptions(options.task) + "\n" + bench::workspace_table(figures)).c_str(), stdout);
    }
    BURIN_TRY_DO(write_output(options.csv, bench::workspace_csv(figures)));
    BURIN_TRY_DO(write_output(options.svg, bench::workspace_svg(figures, options.task)));
    return write_output(options.json, json_text(bench::workspace_json(figures, options.task)));
}

CommandAction add_workspace_bench(Command command) {
    const auto options = std::make_shared<WorkspaceBench>();
    command.option("--targets", options->task.targets, "How many targets each technique reaches for")
        .within(1, 10'000)
        .show_default();
    command.option("--seed", options->task.seed, "Where the targets lie, and how the hand misses").show_default();
    command.option("--csv", options->csv, "A file for the table; - for standard output");
    command.option("--svg", options->svg, "A file for the figure");
    command.option("--json", options->json, "A file for the figures of every target; - for standard output");
    return action([options] { return run_workspace_bench(*options); });
}

}  // namespace

CommandRow bench_workspace_row() {
    return {"workspace", "Reach across the wall with a small device, by each workspace technique", add_workspace_bench};
}

}  // namespace burin::app
