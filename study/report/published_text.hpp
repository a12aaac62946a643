// SPDX-License-Identifier: MIT
// Published figures beside what the data give, as text for the terminal. Pure; any thread.
#pragma once

#include <string>

#include "study/published/published.hpp"

namespace burin::study {

// Lists each figure that differs, with what the data give and what the printed one may come from.
[[nodiscard]] std::string published_text(const PublishedComparison& comparison);

}  // namespace burin::study
