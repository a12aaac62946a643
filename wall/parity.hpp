// SPDX-License-Identifier: MIT
// Field parity: which eye comes next when pictures alternate without the driver's help (StereoMode::frame_sequential).
// Shutter glasses open the left eye in every other refresh of the display, whatever is shown in it. So the next eye is
// not the opposite of the last one, but the one whose field comes next by the display's own count of refreshes
// (Swapchain::vblank_count).
//
// Guarantee: while a picture that was handed over in time is shown in the next refresh, no eye sees the other's picture
// in two refreshes in a row. A missed refresh shows the old picture once more, in the other eye's field, and the next
// picture is chosen for the field it will fall into. If that picture comes a refresh late as well, it is two in a row;
// then the order is right again. An error never persists, as it does with blind alternation.
// Call choose_field() when both pictures are drawn and only the choice is left. Pure; any thread.
#pragma once

#include <cstdint>

#include "wall/stereo_mode.hpp"

namespace burin::wall {

struct FieldParity {
    std::uint64_t next_vblank = 0;  // the refresh for which the last picture was chosen; 0: none yet
    Eye last_eye = Eye::right;
    std::uint64_t pictures = 0;
    std::uint64_t repairs = 0;  // pictures for the same eye as the last one, to restore the order
    std::uint64_t missed = 0;   // refreshes for which there was no picture
};

struct FieldChoice {
    Eye eye = Eye::left;
    std::uint64_t vblank = 0;  // the refresh it is meant for
    bool repaired = false;     // the same eye as last time
    FieldParity state;         // pass it to the next call
};

// Chooses the eye of the next picture. vblank_now: the display's count. queued: pictures handed over that are not shown
// yet (best 0: then a late one delays no other). A count that goes back (another display) starts anew.
[[nodiscard]] inline FieldChoice choose_field(const FieldParity& state, std::uint64_t vblank_now,
                                              Eye eye_of_even_vblanks, std::uint64_t queued = 0) {
    FieldChoice choice;
    choice.vblank = vblank_now + 1 + queued;
    choice.eye = choice.vblank % 2 == 0 ? eye_of_even_vblanks : other(eye_of_even_vblanks);
    choice.repaired = state.pictures > 0 && choice.eye == state.last_eye;
    choice.state = state;
    choice.state.repairs += choice.repaired ? 1 : 0;
    if (state.pictures > 0 && choice.vblank > state.next_vblank) {
        choice.state.missed += choice.vblank - state.next_vblank - 1;
    }
    choice.state.next_vblank = choice.vblank;
    choice.state.last_eye = choice.eye;
    ++choice.state.pictures;
    return choice;
}

}  // namespace burin::wall
