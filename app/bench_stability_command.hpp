// SPDX-License-Identifier: MIT
// burin bench stability: how stiff a wall may be before the device shakes (bench/stability.hpp).
#pragma once

#include "app/bench_files.hpp"

namespace burin {

// The command line must outlive what is returned.
[[nodiscard]] BenchSubcommand add_bench_stability(Command bench);

}  // namespace burin
