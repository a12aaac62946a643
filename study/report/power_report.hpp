// SPDX-License-Identifier: MIT
// Simulated power as text and as JSON, with the model and the method. Pure; any thread.
#pragma once

#include <string>

#include "base/json.hpp"
#include "study/statistics/power.hpp"

namespace burin::study {

// The threads in the options are no part of the report, for they do not change it.
[[nodiscard]] std::string power_text(const PowerOptions& options, const Power& power);
[[nodiscard]] Json power_json(const PowerOptions& options, const Power& power);

}  // namespace burin::study
