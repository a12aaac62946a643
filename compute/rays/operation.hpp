// SPDX-License-Identifier: MIT
// Operations: what a tool does to the rays that it sweeps.
#pragma once

#include <cstdint>

namespace burin::compute {

enum class Operation : std::uint8_t {
    cut,    // removes the material within the tool
    fill,   // turns the tool's volume into material
    paint,  // gives the surface within the tool the tool's material; shape is unchanged
    smooth  // smooths the surface within the tool, more at its centre than at its border
};

}  // namespace burin::compute
