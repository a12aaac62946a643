// SPDX-License-Identifier: MIT
// The figures of a session: as JSON for --report and as a short table for the terminal.
// All keys but those under "timing" and "machine" are the same whenever the same command runs.
#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <string>

#include "app/carving.hpp"
#include "app/felt_stroke.hpp"

namespace burin {

// The q-quantile of the values (nearest rank); 0 when there are none.
[[nodiscard]] double quantile(std::vector<double> values, double q);

[[nodiscard]] nlohmann::ordered_json describe_carving(const Carving& carving);
[[nodiscard]] nlohmann::ordered_json describe_mesh(const TriangleMesh& mesh);
[[nodiscard]] nlohmann::ordered_json describe_feel(const FeltFigures& felt, const Feel& feel);
// Wall-clock figures: these differ from run to run.
[[nodiscard]] nlohmann::ordered_json describe_timing(const Carving& carving, const FeltFigures* felt);

// The table of docs and demo, from a finished report.
void print_table(const nlohmann::ordered_json& report);

}  // namespace burin
