// SPDX-License-Identifier: MIT
// burin bench workspace: a simulated hand reaches across the wall by each workspace technique (bench/workspace.hpp).
#pragma once

#include "app/bench_files.hpp"

namespace burin {

// The command line must outlive what is returned.
[[nodiscard]] BenchSubcommand add_bench_workspace(Command bench);

}  // namespace burin
