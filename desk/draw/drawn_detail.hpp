// SPDX-License-Identifier: MIT
// Decides with how many pixels a frame's picture is drawn. On a device that is a processor a whole picture takes
// longer than a moving view can wait for: while the view moves, one is drawn with larger pixels and magnified; when it
// has rested for a moment, the full picture is drawn, once.
//
// A pure step: what the last frame took, what moves and what is asked for come in; the side of a drawn pixel comes
// out. It knows neither clock nor device. Within one motion pixels only grow, and the next motion begins as the last
// one ended: so the picture never goes back and forth between two sizes of pixels.
// Pictures to keep and frames whose results must depend on no machine (off-screen pictures, scripts, replays) are
// full.
// Units: nanoseconds on one monotonic clock; pixels of the picture.
#pragma once

#include <cstdint>
#include <optional>

#include "base/clock.hpp"

namespace burin::session {

// What a frame took that drew all of its picture anew.
struct WholePicture {
    std::uint32_t pixel = 1;
    Nanoseconds took_ns = 0;
};

struct DetailView {
    Nanoseconds now_ns = 0;
    bool in_full = false;              // nothing is left out, whatever it takes
    bool moves = false;                // all of the picture has changed since the frame before
    std::optional<WholePicture> last;  // the frame before, if it drew all of its picture
};

struct DetailState {
    std::uint32_t pixel = 1;              // of the frame before
    std::uint32_t moving_pixel = 2;       // with which a motion begins
    std::uint32_t late = 0;               // frames of this motion in a row that took too long
    std::optional<Nanoseconds> moved_ns;  // when the last frame of a moving view was done; none: the view rests
    std::optional<Nanoseconds> full_ns;   // what a full picture took last
};

struct DetailStep {
    DetailState state;
    std::uint32_t pixel = 1;  // side of what is drawn as one; 1: the full picture
};

// A frame of a moving view aims at this, so that 30 a second leave time for all else; beyond the second it is late.
inline constexpr Nanoseconds kMovingFrame_ns = 25'000'000, kLateFrame_ns = 33'000'000;
// How long a view that moved must rest before the full picture is drawn: longer than a hand that drags slowly pauses.
inline constexpr Nanoseconds kSettles_ns = 200'000'000;
inline constexpr std::uint32_t kMostPixel = 3;

[[nodiscard]] DetailStep step_detail(DetailState state, const DetailView& view);

// Returns whether a full picture is still to come, though nothing else may happen.
[[nodiscard]] inline bool owes_full_picture(const DetailState& state) { return state.pixel > 1; }

}  // namespace burin::session
