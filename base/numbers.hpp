// SPDX-License-Identifier: MIT
// Numbers as people write them on a command line and in facts of a file. Pure; any thread; allocates.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"

namespace burin {

// Parses numbers separated by commas: exactly `count`, all finite. An Error names `what`.
[[nodiscard]] Result<std::vector<double>> parse_numbers(std::string_view text, std::size_t count,
                                                        const std::string& what);

}  // namespace burin
