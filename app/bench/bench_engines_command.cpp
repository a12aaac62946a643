// SPDX-License-Identifier: MIT
#include <cstdio>
#include <memory>
#include <string>

#include "app/bench/bench_command.hpp"
#include "app/bench/bench_limits.hpp"
#include "app/cli/output_files.hpp"
#include "base/try.hpp"
#include "bench/engines/engine_check.hpp"
#include "bench/measure/timing.hpp"
#include "compute/rays/lattice.hpp"

namespace burin::app {
namespace {

struct EnginesBench {
    bench::EngineCheckOptions check;
    std::string json;
};

// Returns the exit status: 1 where anything differs.
Result<int> run_engines_bench(const EnginesBench& options) {
    BURIN_TRY_DO(check_place(options.json));
    const std::string on = bench::machine();
    BURIN_TRY(check, bench::check_device(options.check));
    if (options.json != kStandardOutput) std::fputs(bench::engine_check_table(check).c_str(), stdout);
    Json json = bench::engine_check_json(check);
    json["machine"] = on;
    BURIN_TRY_DO(write_output(options.json, json_text(json)));
    return check.all.ends_that_differ + check.all.elements_that_differ == 0 ? 0 : 1;
}

CommandAction add_engines_bench(Command command) {
    const auto options = std::make_shared<EnginesBench>();
    command.option("--seed", options->check.seed, "Of the sequence: the same again, on any machine").show_default();
    command.option("--operations", options->check.operations, "How many updates, undos and redos")
        .within(std::uint64_t{1}, std::uint64_t{100'000'000})
        .show_default();
    command.option("--resolution", options->check.resolution, "Lattice cells along the longest side of each solid")
        .within(compute::kMinResolution, compute::kMaxResolution)
        .show_default();
    command.option("--threads", options->check.threads, kBenchThreadsHelp).within(0, kMostBenchThreads);
    command.option("--device", options->check.device, "Which Vulkan device, by its number in burin --version");
    command.option("--json", options->json, "A file for all counts; - for standard output");
    return action([options] { return run_engines_bench(*options); });
}

}  // namespace

CommandRow bench_engines_row() {
    return {"engines", "Whether a Vulkan device carves what the processor carves, to the last bit", add_engines_bench};
}

}  // namespace burin::app
