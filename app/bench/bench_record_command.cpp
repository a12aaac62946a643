// SPDX-License-Identifier: MIT
#include <cstdio>
#include <filesystem>
#include <memory>

#include "app/bench/bench_command.hpp"
#include "app/cli/output_files.hpp"
#include "base/try.hpp"
#include "bench/recording/recording.hpp"

namespace burin::app {
namespace {

struct RecordBench {
    bench::RecordTask task;
    std::string json;
};

Result<void> run_record_bench(const RecordBench& options) {
    BURIN_TRY_DO(check_place(options.json));
    BURIN_TRY(figures, bench::measure_recording(options.task));
    if (options.json != kStandardOutput) std::fputs(bench::recording_table(figures).c_str(), stdout);
    return write_output(options.json, json_text(bench::recording_json(figures)));
}

CommandAction add_record_bench(Command command) {
    const auto options = std::make_shared<RecordBench>();
    std::error_code ignored;
    options->task.folder = std::filesystem::temp_directory_path(ignored).string();
    command.option("FILE", options->task.session,
                   "A session file, whose ticks are packed again; else sizes and blocks are not measured");
    command.option("--seconds", options->task.seconds, "How long ticks are recorded, for each of two rings")
        .within(1, 3600)
        .show_default();
    command.option("--folder", options->task.folder, "Where they are recorded: the disk that is measured")
        .show_default();
    command.option("--json", options->json, "A file for the figures; - for standard output");
    return action([options] { return run_record_bench(*options); });
}

}  // namespace

CommandRow bench_record_row() {
    return {"record", "What it costs to keep every tick: size, blocks, transactions, tick", add_record_bench};
}

}  // namespace burin::app
