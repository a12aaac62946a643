// SPDX-License-Identifier: MIT
// burin bench haptics: what touching costs and how true it is (bench/haptics.hpp).
#pragma once

#include "app/bench_files.hpp"

namespace burin {

// The command line must outlive what is returned.
[[nodiscard]] BenchSubcommand add_bench_haptics(Command bench);

}  // namespace burin
