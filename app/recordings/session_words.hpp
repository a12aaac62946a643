// SPDX-License-Identifier: MIT
// Words for the counts of a recording. Any thread.
#pragma once

#include <cstdint>
#include <string>

namespace burin::app {

// "1 tick", "2 ticks".
[[nodiscard]] inline std::string counted(std::uint64_t count, const char* one, const char* many) {
    return std::to_string(count) + " " + (count == 1 ? one : many);
}

}  // namespace burin::app
