// SPDX-License-Identifier: MIT
// Several measures of the same few things, side by side: a panel a measure, a row a thing, a dot a value with a line to its upper
// quantile, and the number beside it. SVG text; the same input gives the same text.
#pragma once

#include <string>
#include <vector>

namespace burin::bench {

struct DotValue {
    double value = 0.0;  // not finite: there is none, and the row says so
    double upper = 0.0;  // where the line ends; none if it is not above the value
};

struct DotPanel {
    std::string title;
    bool logarithmic = false;      // else from zero; a logarithmic panel leaves out what is not above zero
    int digits = 1;                // of the numbers beside the dots, after the point
    std::vector<DotValue> values;  // one for each row
};

[[nodiscard]] std::string dot_chart(const std::string& title, const std::vector<std::string>& rows,
                                    const std::vector<DotPanel>& panels, const std::vector<std::string>& notes);

}  // namespace burin::bench
