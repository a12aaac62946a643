// SPDX-License-Identifier: MIT
// Names of keys that do not depend on the window library. Pure; any thread.
#pragma once

#include <string_view>

namespace burin::window {

// For one of GLFW's key numbers; "unknown" for keys that it does not know.
[[nodiscard]] std::string_view key_name(int glfw_key);

}  // namespace burin::window
