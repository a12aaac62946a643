// SPDX-License-Identifier: MIT
// Measures run time against error over the resolution: STROKE-1000 by Burin's engines and, where they are built in, by
// OpenVDB and CGAL, one after the other in one run on one machine, with the same measures for all.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "base/json.hpp"

namespace burin::bench {

struct ParetoOptions {
    int smallest = 32;  // resolutions double from here
    int largest = 512;
    int largest_on_software_vulkan = 256;  // a software device takes minutes beyond; 0: do not run it
    unsigned threads = 0;                  // 0: one a core; OpenVDB uses as many
    std::size_t updates = 1000;            // of the scene's; fewer for a quick run
    std::size_t cgal_updates = 40;         // its cost grows with every cut
};

// One row a run, with the keys of stroke_report.hpp, "series" and, for a peer, "burin_cpu_faster_at_equal_cut_error".
struct Pareto {
    std::string machine;  // recorded before the first run
    std::vector<Json> rows;
    std::vector<std::string> left_out;  // what could not run, with the reason
};

// notify(line) is called after each run, with what was measured.
[[nodiscard]] Result<Pareto> run_pareto(const ParetoOptions& options,
                                        const std::function<void(const std::string&)>& notify);

struct TimeAndError {
    double update_ms = 0.0, error = 0.0;
};
// Returns the time that a method needs for an error, from measured points in order of resolution: along the straight
// line between two of them on logarithmic axes. An error that even the coarsest point beats gives the coarsest point's
// time, which is more than needed; nullopt if the finest point does not reach it.
[[nodiscard]] std::optional<double> time_at_error(const std::vector<TimeAndError>& points, double error);

[[nodiscard]] std::string pareto_table(const Pareto& pareto);
// Returns a comment line that names the machine, one of column names, and a row for each run.
[[nodiscard]] std::string pareto_csv(const Pareto& pareto);
[[nodiscard]] std::string pareto_svg(const Pareto& pareto);

}  // namespace burin::bench
