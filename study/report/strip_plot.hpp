// SPDX-License-Identifier: MIT
// Strip plots: every value of each group as a dot over the group's name, with a bar at the group's median. Readable
// without colour. The same values give the same text. Pure; any thread.
#pragma once

#include <string>
#include <vector>

namespace burin::study {

struct Strip {
    std::string name;
    std::vector<double> values;       // others than finite ones are left out
    std::vector<std::string> labels;  // shown where the mouse rests on the dot; as many as values
};

// Lengths on the axis begin at 0, for times and deviations do. SVG of 420 by 300 pixels that scales with its place.
[[nodiscard]] std::string strip_plot(const std::string& title, const std::string& axis,
                                     const std::vector<Strip>& strips);

}  // namespace burin::study
