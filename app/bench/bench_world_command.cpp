// SPDX-License-Identifier: MIT
#include <array>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "app/bench/bench_command.hpp"
#include "app/cli/output_files.hpp"
#include "base/try.hpp"
#include "bench/world/world_bench.hpp"
#include "session/record/input_files.hpp"

namespace burin::app {
namespace {

struct WorldBench {
    bench::WorldBenchTask task;
    bool without_coin = false;
    std::string json;
};

Result<void> run_world_bench(const WorldBench& options) {
    if (const auto ok = check_places(std::array{options.json}, session::InputFiles().world(options.task.world).list());
        !ok)
        return ok;
    bench::WorldBenchTask task = options.task;
    if (!options.without_coin) task.coin = bench::coin_reader_beside_burin();
    BURIN_TRY(figures, bench::measure_world(task));
    if (options.json != kStandardOutput) std::fputs(bench::world_bench_table(figures).c_str(), stdout);
    return write_output(options.json, json_text(bench::world_bench_json(figures)));
}

CommandAction add_world_bench(Command command) {
    const auto options = std::make_shared<WorldBench>();
    std::error_code ignored;
    options->task.folder = std::filesystem::temp_directory_path(ignored).string();
    command.option("FILE", options->task.world, "A world (.wrl); else one is made").asset(AssetRoom::worlds);
    command.option("--objects", options->task.objects, "Named nodes of the made world")
        .within(1, 100'000)
        .show_default();
    command.option("--triangles", options->task.triangles_each, "Of each of them").within(1, 100'000).show_default();
    command.option("--runs", options->task.runs, "How often it is read").within(1, 1000).show_default();
    command.option("--folder", options->task.folder, "Where the made world is written for Coin").show_default();
    command.flag("--without-coin", options->without_coin, "Read it without Coin");
    command.option("--json", options->json, "A file for the figures; - for standard output");
    return action([options] { return run_world_bench(*options); });
}

}  // namespace

CommandRow bench_world_row() {
    return {"world", "From a VRML world's text to its triangles, beside Coin", add_world_bench};
}

}  // namespace burin::app
