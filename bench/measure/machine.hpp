// SPDX-License-Identifier: MIT
// What a recorded figure was measured on.
#pragma once

#include <string>

namespace burin::bench {

// "2 x Intel(R) Xeon(R) Processor, load 0.1": the cores, the processor's name where the system tells it, and how busy the
// machine has been in the last minute (0: quiet).
[[nodiscard]] std::string machine();

}  // namespace burin::bench
