// SPDX-License-Identifier: MIT
// A stroke of the mouse that smooths, whatever the tool does else: it began with Shift held.
//
// The tool is one that smooths from the press on until all of the stroke has been carved. The hand comes after the
// mouse by up to half a second, and the carving side reads its ticks some time later: were the tool changed back when
// the mouse's button comes up, the rest of the stroke would be carved by it.
// Pure data and a step function.
#pragma once

#include <cstddef>
#include <cstdint>

#include "compute/rays/operation.hpp"

namespace burin::session {

struct SmoothStroke {
    std::size_t hand = 0;                                    // whose tool smooths
    compute::Operation otherwise = compute::Operation::cut;  // what it does after the stroke
    bool only_touches = false;                               // after the stroke
    bool begun = false;                                      // the hand has pressed its button
    double released_s = 0.0;                                 // how long the mouse has had its button up
    double carved_s = 0.0;                                   // how long the hand has, since it had it down

    // Returns whether the stroke is over.
    [[nodiscard]] bool is_over() const;
};

struct SmoothStrokeStep {
    double dt_s = 0.0;
    bool mouse_pressed = false, hand_pressed = false;  // at its end
};
[[nodiscard]] SmoothStroke followed(SmoothStroke stroke, const SmoothStrokeStep& step);

}  // namespace burin::session
