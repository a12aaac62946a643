// SPDX-License-Identifier: MIT
// Reads what Burin wrote, with a parser that is not Burin's. Throws where the text is no JSON.
#pragma once

#include <string>

#include "base/json.hpp"

namespace burin {

[[nodiscard]] Json read_json(const std::string& text);

}  // namespace burin
