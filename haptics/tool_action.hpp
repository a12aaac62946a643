// SPDX-License-Identifier: MIT
// What a tool does while its button is down, and where one that fills is meanwhile.
#pragma once

#include <cstdint>

namespace burin::haptics {

// The action of the tool while its button (bit 0) is pressed.
enum class ToolAction : std::uint8_t {
    touch,  // feels the surface without changing it
    cut,    // resisted by hardness and engagement
    fill,   // deposits material at the proxy; felt as touch, or not at all in free flight (FillPlace)
    paint,  // felt without friction: painting has no resistance
};

// Where a tool that fills is while its button is down. On the surface it rests on what is there. In free flight it is
// with the hand and touches nothing: it would rest on what it has just added, be pushed off its way by that, and heap
// up beads beside it. Once the button is up it touches again when it has come out of the material.
enum class FillPlace : std::uint8_t {
    surface,  // on the surface, and in the air as long as nothing is touched
    begun,    // in free flight where the button goes down in the air, else on the surface
    hand,     // in free flight always: for a hand that feels nothing
};

}  // namespace burin::haptics
