// SPDX-License-Identifier: MIT
// When this process began.
#pragma once

namespace burin::bench {

// Wall time since the system started this process, ms, to 10 ms: from /proc/self/stat, which counts in hundredths of a second.
// 0 where the system does not tell.
[[nodiscard]] double wall_since_start_ms();

}  // namespace burin::bench
