// SPDX-License-Identifier: MIT
// burin bench: what Burin does in numbers (bench/), as tables, JSON, CSV and a figure.
//   burin bench stroke     one engine and resolution through STROKE-1000, with every figure
//   burin bench engines    whether a Vulkan device carves what the processor carves
//   burin bench pareto     time against error over resolutions, engines and peers
//   burin bench haptics    what a tick costs, and how true the proxy is
//   burin bench stability  how stiff a wall may be before a simulated device shakes
//   burin bench workspace  each workspace technique across the wall, in a simulated hand
//   burin bench record     what it costs to keep every tick
//   burin bench document   what it costs to keep the work: journal, save, open, size
//   burin bench study      a whole simulated study against real time
//   burin bench world      from a VRML world's text to its triangles, beside Coin
#pragma once

#include "app/cli/command_table.hpp"

namespace burin::app {

[[nodiscard]] CommandRow bench_row();

// ---- Its commands. Places for output are looked at before the first long step.

[[nodiscard]] CommandRow bench_stroke_row();     // bench/stroke/stroke_report.hpp
[[nodiscard]] CommandRow bench_engines_row();    // bench/engines/engine_check.hpp
[[nodiscard]] CommandRow bench_pareto_row();     // bench/stroke/pareto.hpp
[[nodiscard]] CommandRow bench_frame_row();      // bench/frame/frame.hpp
[[nodiscard]] CommandRow bench_haptics_row();    // bench/haptics/haptics.hpp
[[nodiscard]] CommandRow bench_record_row();     // bench/recording/recording.hpp
[[nodiscard]] CommandRow bench_document_row();   // bench/document/document_bench.hpp
[[nodiscard]] CommandRow bench_study_row();      // activities/train/simulated_study.hpp
[[nodiscard]] CommandRow bench_stability_row();  // bench/stability/stability.hpp
[[nodiscard]] CommandRow bench_glove_row();      // bench/glove/glove_output.hpp
[[nodiscard]] CommandRow bench_workspace_row();  // bench/workspace/workspace.hpp
[[nodiscard]] CommandRow bench_body_row();       // bench/body/body_bench.hpp
[[nodiscard]] CommandRow bench_world_row();      // bench/world/world_bench.hpp

}  // namespace burin::app
