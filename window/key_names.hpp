// SPDX-License-Identifier: MIT
// Names of keys that do not depend on the window library. Pure functions; any thread.
#pragma once

#include <string_view>

namespace burin::window {

// Returns the name of one of GLFW's key numbers; "unknown" for keys without a name here.
[[nodiscard]] std::string_view key_name(int glfw_key);

}  // namespace burin::window
