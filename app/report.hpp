// SPDX-License-Identifier: MIT
// The figures of a session: as JSON for --report and as a short table for the terminal.
// All keys but those under "timing" and "machine" are the same whenever the same command runs.
#pragma once

#include <span>
#include <string>

#include "app/carving.hpp"
#include "app/felt_stroke.hpp"
#include "base/json.hpp"

namespace burin {

// The q-quantile of the values (nearest rank); 0 when there are none.
[[nodiscard]] double quantile(std::vector<double> values, double q);

[[nodiscard]] Json describe_carving(const Carving& carving);
[[nodiscard]] Json describe_mesh(const TriangleMesh& mesh);
[[nodiscard]] Json describe_feel(const FeltFigures& felt, const Feel& feel);
// Wall-clock figures: these differ from run to run.
[[nodiscard]] Json describe_timing(const Carving& carving, const FeltFigures* felt);

// The table of docs and demo, from a finished report.
void print_table(const Json& report);

}  // namespace burin
