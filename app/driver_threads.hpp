// SPDX-License-Identifier: MIT
// How many threads a software Vulkan or OpenGL driver draws with. It takes the cores that touch needs, so a session leaves it one less than
// there are; the variable that Mesa's driver reads, LP_NUM_THREADS, counts where it is set already.
// Before the first device is opened; main thread, while there is no other.
#pragma once

namespace burin {

void leave_a_core_to_touch();
// As the driver will read it: a number.
[[nodiscard]] const char* driver_threads();

}  // namespace burin
