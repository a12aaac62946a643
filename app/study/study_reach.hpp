// SPDX-License-Identifier: MIT
// Tells which places of a protocol's worlds the wand cannot reach, before anybody sits down.
#pragma once

#include <string>

#include "base/error.hpp"
#include "study/protocol/protocol.hpp"

namespace burin::app {

// Prints a line for each fault, and for each cap with little room; `name`: of the file or folder. Fails where there is
// a fault.
[[nodiscard]] Result<void> check_reach(const study::Protocol& protocol, const std::string& name);

}  // namespace burin::app
