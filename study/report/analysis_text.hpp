// SPDX-License-Identifier: MIT
// An analysis as text for the terminal. Every figure stands with its method, and with "undefined: why" where there is
// none. Pure; any thread.
#pragma once

#include <string>

#include "study/analysis/analysis.hpp"

namespace burin::study {

[[nodiscard]] std::string analysis_text(const Analysis& analysis);

// A number for people: six significant digits, or "undefined".
[[nodiscard]] std::string number_text(double value);
// A probability for people: four decimals, or "< 0.0001".
[[nodiscard]] std::string p_text(double p);

}  // namespace burin::study
