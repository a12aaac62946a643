// SPDX-License-Identifier: MIT
// burin bench haptics: what touching costs and how true it is (bench/haptics.hpp).
#pragma once

#include "app/bench_files.hpp"

namespace burin {

// `bench` must outlive what is returned.
[[nodiscard]] BenchSubcommand add_bench_haptics(CLI::App& bench);

}  // namespace burin
