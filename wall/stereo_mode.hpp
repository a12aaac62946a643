// SPDX-License-Identifier: MIT
// Stereo modes: the ways in which the two eyes' pictures reach a display. Pure data and functions; any thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "base/error.hpp"
#include "base/image.hpp"

namespace burin::wall {

enum class Eye : std::uint8_t { left, right };
[[nodiscard]] constexpr Eye other(Eye eye) { return eye == Eye::left ? Eye::right : Eye::left; }

// In the order in which lists show them. The shader uses the same numbers (shaders/shared/output_constants.h).
enum class StereoMode : std::uint8_t {
    side_by_side,       // left eye's picture on the left, each of full width
    side_by_side_half,  // the same in one picture's width: two pixels of an eye are merged into one
    top_bottom,         // left eye's picture above, each of full height
    top_bottom_half,
    row_interlaced,  // alternate rows: polarised monitors
    column_interlaced,
    checkerboard,       // alternate pixels: DLP televisions
    anaglyph_red_cyan,  // coloured glasses, left eye first
    anaglyph_green_magenta,
    anaglyph_amber_blue,
    left,              // only the left eye's picture
    right,             // only the right eye's picture
    mono,              // one picture for both eyes; draw both from the point between them
    frame_sequential,  // alternate pictures without the driver's help: last resort
    two_layers,        // quad buffer: the driver gets both pictures
    two_windows,       // one window, display or projector an eye
};
inline constexpr std::size_t kStereoModes = 16;

// All modes, in order.
[[nodiscard]] std::span<const StereoMode> stereo_modes();

// Name in files and options: "side_by_side_half".
[[nodiscard]] std::string_view file_name_of(StereoMode mode);
// Name shown to people: "side by side, half width".
[[nodiscard]] std::string_view title_of(StereoMode mode);
// One sentence: which display and which glasses show it.
[[nodiscard]] std::string_view purpose_of(StereoMode mode);
// Parses a name as in files, with - or blanks for _ and in either case. The Error suggests the nearest name and lists
// all.
[[nodiscard]] Result<StereoMode> parse_stereo_mode(std::string_view text);

struct ModeNeeds {
    bool two_layers = false;   // a swapchain with two layers (gpu/swapchain.hpp)
    bool two_windows = false;  // one for each eye
    // Which eye's turn it is; without it eyes may stay exchanged (wall/parity.hpp).
    bool vblank_count = false;
    // Unscaled pixels of the monitor, counted from its own row and column 0.
    bool monitor_pixels = false;
    bool one_eye_point = false;  // both pictures drawn from between the eyes
    // False: one of the two pictures is not used.
    bool both_eyes = true;
};
[[nodiscard]] ModeNeeds needs_of(StereoMode mode);

// Whether a target shows one eye at a time; then OutputPlace::eye says which.
[[nodiscard]] bool shows_one_eye_at_a_time(StereoMode mode);

// The size of the output that a mode makes of two pictures of the given size; in two_layers and two_windows, of each
// output.
[[nodiscard]] ImageSize output_size(StereoMode mode, ImageSize eye);
// The size of an eye's picture that fills a window or display of this size, pixel for pixel. Of an odd number of
// columns (or rows) that two pictures share, the last stays black.
[[nodiscard]] ImageSize eye_size(StereoMode mode, ImageSize output);

enum class TestPattern : std::uint8_t { none, eye_order, ghosting, geometry };
[[nodiscard]] std::string_view file_name_of(TestPattern pattern);
[[nodiscard]] Result<TestPattern> parse_test_pattern(std::string_view text);

}  // namespace burin::wall
