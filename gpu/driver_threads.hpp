// SPDX-License-Identifier: MIT
// Limits the threads of a software Vulkan or OpenGL driver, which would take the cores that the haptic thread needs: a
// session leaves the driver one core less than there are. Mesa's driver reads the limit from LP_NUM_THREADS; a value
// already set there is kept. Call before the first device is opened, on the main thread, while there is no other.
#pragma once

namespace burin::gpu {

void leave_a_core_to_touch();
// Returns the variable's value as the driver will read it; empty when it is not set.
[[nodiscard]] const char* driver_threads();

}  // namespace burin::gpu
