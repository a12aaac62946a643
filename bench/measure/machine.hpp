// SPDX-License-Identifier: MIT
// Describes the machine on which a figure was measured.
#pragma once

#include <string>

namespace burin::bench {

// Returns "2 x Intel(R) Xeon(R) Processor, load 0.1": the cores, the processor's name where the system provides it, and
// the load average of the last minute (0: quiet).
[[nodiscard]] std::string machine();

}  // namespace burin::bench
