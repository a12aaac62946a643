// SPDX-License-Identifier: MIT
// Position, proxy and force over time of a session that was felt: as a figure (SVG) and as a table (CSV) beside the report.
#pragma once

#include <string>

#include "app/felt_figures.hpp"

namespace burin {

// Left the whole session, right the first second in which the tool cuts, with heights along its mean contact
// normal across the way that it goes.
[[nodiscard]] std::string felt_figure(const FeltFigures& felt);

// The trace's points, one a line: time_s, HIP, proxy and cutting point in the object frame (metres), force at the device
// (newtons), penetration (metres), in_contact and cutting (0 or 1).
[[nodiscard]] std::string felt_table(const FeltFigures& felt);

// report.json -> report-felt.svg, report-felt.csv
[[nodiscard]] std::string felt_figure_path(const std::string& report);
[[nodiscard]] std::string felt_table_path(const std::string& report);

}  // namespace burin
