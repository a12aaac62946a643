// SPDX-License-Identifier: MIT
// burin bench frame: what drawing costs, beside other libraries (bench/frame.hpp).
#pragma once

#include "app/bench_files.hpp"

namespace burin {

// The command line must outlive what is returned.
[[nodiscard]] BenchSubcommand add_bench_frame(Command bench);

}  // namespace burin
