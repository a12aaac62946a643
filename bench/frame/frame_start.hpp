// SPDX-License-Identifier: MIT
// The start time of this process.
#pragma once

namespace burin::bench {

// Returns the wall time since the system started this process, ms, to 10 ms: from /proc/self/stat, which counts in
// hundredths of a second. 0 where the system does not provide it.
[[nodiscard]] double wall_since_start_ms();

}  // namespace burin::bench
