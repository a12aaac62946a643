// SPDX-License-Identifier: MIT
#include <array>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "app/bench/bench_command.hpp"
#include "app/cli/output_files.hpp"
#include "base/try.hpp"
#include "bench/document/document_bench.hpp"
#include "compute/rays/lattice.hpp"

namespace burin::app {
namespace {

struct DocumentBench {
    bench::DocumentTask task;
    std::string json;
};

Result<void> run_document_bench(const DocumentBench& options) {
    BURIN_TRY_DO(check_places(std::array{options.json}, std::array{options.task.mesh}));
    BURIN_TRY(figures, bench::measure_documents(options.task));
    if (options.json != kStandardOutput) std::fputs(bench::document_table(figures).c_str(), stdout);
    return write_output(options.json, json_text(bench::document_json(figures)));
}

CommandAction add_document_bench(Command command) {
    const auto options = std::make_shared<DocumentBench>();
    std::error_code ignored;
    bench::DocumentTask& task = options->task;
    task.folder = std::filesystem::temp_directory_path(ignored).string();
    command.option("FILE", task.mesh, "A mesh that is carved; else STROKE-1000's cube");
    command
        .option("--journal-resolution", task.journal_resolution, "Lattice cells along the longest side, of the journal")
        .within(compute::kMinResolution, compute::kMaxResolution)
        .show_default();
    command.option("--resolution", task.resolution, "Likewise, of save, open and size")
        .within(compute::kMinResolution, compute::kMaxResolution)
        .show_default();
    command.option("--updates", task.updates, "How long the journal is kept, in steps of 10 ms")
        .within(1, 100'000)
        .show_default();
    command.option("--strokes", task.strokes, "How many are saved at once").within(1, 100'000).show_default();
    command.option("--runs", task.runs, "How often the document is opened, cold and warm")
        .within(1, 1000)
        .show_default();
    command.option("--folder", task.folder, "Where documents are written: the disk that is measured").show_default();
    command.option("--json", options->json, "A file for the figures; - for standard output");
    return action([options] { return run_document_bench(*options); });
}

}  // namespace

CommandRow bench_document_row() {
    return {"document", "What it costs to keep the work: journal, save, open, size", add_document_bench};
}

}  // namespace burin::app
