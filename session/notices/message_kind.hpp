// SPDX-License-Identifier: MIT
// How much a message to the user weighs, which says how long it is shown.
#pragma once

#include <cstdint>

namespace burin::session {

enum class MessageKind : std::uint8_t {
    info,     // something was done
    warning,  // something was not done, or is not as it should be
    error,    // something is lost or out of order; stays until it has been seen
};

}  // namespace burin::session
