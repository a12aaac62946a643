// SPDX-License-Identifier: MIT
#include "app/bench/bench_command.hpp"

namespace burin::app {
namespace {

CommandAction add_bench(Command command) {
    command.require_subcommand();
    return add_commands(
        command, {bench_stroke_row(), bench_engines_row(), bench_pareto_row(), bench_frame_row(), bench_haptics_row(),
                  bench_record_row(), bench_document_row(), bench_study_row(), bench_stability_row(), bench_glove_row(),
                  bench_workspace_row(), bench_body_row(), bench_world_row()});
}

}  // namespace

CommandRow bench_row() {
    return {"bench", "Measure carving, touching and drawing, and reaching across the wall", add_bench};
}

}  // namespace burin::app
