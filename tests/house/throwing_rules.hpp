// SPDX-License-Identifier: MIT
// The rule on calls that throw: a function of std::filesystem gets a std::error_code, since the program has no handler
// and a folder may vanish at any time; a loop over a folder steps with increment(). base/places.hpp has what is needed
// most. Pure reading; any thread.
#pragma once

#include <string>
#include <vector>

namespace burin::house {

// One line for each such call of a source: "line 7: exists() throws". An error code is a name that the source declares
// as one.
[[nodiscard]] std::vector<std::string> throwing_calls(const std::string& source);

}  // namespace burin::house
