// SPDX-License-Identifier: MIT
// Whose turn it is when pictures are shown by turns without the driver's help (StereoMode::frame_sequential): shutter glasses
// open the left eye in every other refresh of the display, whatever is shown in it. The eye is therefore never "the other
// than before", but the one whose field comes next, by the display's own count of refreshes (Swapchain::vblank_count).
//
// What can be promised. While a picture that was handed over in time is shown in the next refresh, no eye sees the other's
// picture in two refreshes on end: a missed refresh shows the old picture once more, in the other eye's field, and the next
// picture is chosen for the field it will fall into. A picture that itself comes a refresh late, right after such a one, makes
// it two; then the order is right again. Nothing here can stay wrong, as taking turns blindly does.
// To be asked when both pictures are drawn and only the choice is left. Pure; any thread.
#pragma once

#include <cstdint>

#include "renderer/output/stereo_mode.hpp"

namespace burin {

struct FieldParity {
    std::uint64_t next_vblank = 0;  // the refresh for which the last picture was chosen; 0: none yet
    Eye last_eye = Eye::right;
    std::uint64_t pictures = 0;
    std::uint64_t repairs = 0;  // pictures that broke the turn to put it right
    std::uint64_t missed = 0;   // refreshes for which there was no picture
};

struct FieldChoice {
    Eye eye = Eye::left;
    std::uint64_t vblank = 0;  // the refresh it is meant for
    bool repaired = false;     // the same eye as last time
    FieldParity state;         // give it back next time
};

// vblank_now: the display's count. queued: pictures handed over that are not shown yet (best 0: then a late one spoils no
// other). A count that goes back (another display) starts anew.
[[nodiscard]] FieldChoice choose_field(const FieldParity& state, std::uint64_t vblank_now, Eye eye_of_even_vblanks,
                                       std::uint64_t queued = 0);

}  // namespace burin
