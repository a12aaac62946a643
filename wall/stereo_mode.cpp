// SPDX-License-Identifier: MIT
#include "wall/stereo_mode.hpp"

#include <algorithm>
#include <array>
#include <cctype>

#include "base/text.hpp"

namespace burin::wall {

namespace {

struct Description {
    StereoMode mode;
    std::string_view file_name, title, purpose;
};

constexpr std::array<Description, kStereoModes> kModes{{
    {StereoMode::side_by_side, "side_by_side", "side by side",
     "Projectors and head-mounted displays that take a picture of double width; parallel viewing."},
    {StereoMode::side_by_side_half, "side_by_side_half", "side by side, half width",
     "3D televisions and projectors set to 'side by side'."},
    {StereoMode::top_bottom, "top_bottom", "top and bottom", "Displays that take a picture of double height."},
    {StereoMode::top_bottom_half, "top_bottom_half", "top and bottom, half height",
     "3D televisions and projectors set to 'top and bottom'."},
    {StereoMode::row_interlaced, "row_interlaced", "interlaced rows", "Polarised monitors, passive glasses."},
    {StereoMode::column_interlaced, "column_interlaced", "interlaced columns",
     "Parallax-barrier and lenticular monitors."},
    {StereoMode::checkerboard, "checkerboard", "checkerboard", "DLP televisions set to 'checkerboard'."},
    {StereoMode::anaglyph_red_cyan, "anaglyph_red_cyan", "anaglyph red-cyan",
     "Any display; glasses with a red left and a cyan right filter."},
    {StereoMode::anaglyph_green_magenta, "anaglyph_green_magenta", "anaglyph green-magenta",
     "Any display; glasses with a green left and a magenta right filter."},
    {StereoMode::anaglyph_amber_blue, "anaglyph_amber_blue", "anaglyph amber-blue",
     "Any display; glasses with an amber left and a blue right filter."},
    {StereoMode::left, "left", "left eye only", "Any display, no glasses."},
    {StereoMode::right, "right", "right eye only", "Any display, no glasses."},
    {StereoMode::mono, "mono", "mono", "Any display, no glasses: seen from between the eyes."},
    {StereoMode::frame_sequential, "frame_sequential", "frame sequential (last resort)",
     "Shutter glasses on a display that knows nothing of stereo; eyes can be exchanged when a frame is missed."},
    {StereoMode::two_layers, "two_layers", "quad buffer", "Active stereo through the driver: stereo walls."},
    {StereoMode::two_windows, "two_windows", "two windows", "Two projectors or displays, one for each eye."},
}};

constexpr std::array<std::string_view, 4> kPatterns{"none", "eye_order", "ghosting", "geometry"};

const Description& description(StereoMode mode) { return kModes[static_cast<std::size_t>(mode)]; }

std::string normal_form(std::string_view text) {
    std::string name;
    for (const char c : text) {
        const bool separates = c == '-' || c == ' ';
        name += separates ? '_' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    }
    return name;
}

std::unexpected<Error> unknown(const char* where, std::string_view text, std::span<const std::string_view> names) {
    // Limits the length: a whole file pasted here is not a name.
    const std::string wanted = normal_form(text.substr(0, 40));
    return fail(where, "'" + std::string(text.substr(0, 40)) + "' is unknown",
                "did you mean " + std::string(nearest_name(wanted, names)) + "? There are: " + joined(names));
}

}  // namespace

std::span<const StereoMode> stereo_modes() {
    static constexpr auto kAll = [] {
        std::array<StereoMode, kStereoModes> all{};
        for (std::size_t i = 0; i < kStereoModes; ++i) all[i] = kModes[i].mode;
        return all;
    }();
    return kAll;
}

std::string_view file_name_of(StereoMode mode) { return description(mode).file_name; }
std::string_view title_of(StereoMode mode) { return description(mode).title; }
std::string_view purpose_of(StereoMode mode) { return description(mode).purpose; }

Result<StereoMode> parse_stereo_mode(std::string_view text) {
    const std::string name = normal_form(text);
    std::array<std::string_view, kStereoModes> names;
    for (std::size_t i = 0; i < kStereoModes; ++i) {
        if (kModes[i].file_name == name) return kModes[i].mode;
        names[i] = kModes[i].file_name;
    }
    return unknown("stereo mode", text, names);
}

ModeNeeds needs_of(StereoMode mode) {
    ModeNeeds needs;
    switch (mode) {
        case StereoMode::two_layers: needs.two_layers = true; break;
        case StereoMode::two_windows: needs.two_windows = true; break;
        case StereoMode::frame_sequential: needs.vblank_count = true; break;
        case StereoMode::row_interlaced:
        case StereoMode::column_interlaced:
        case StereoMode::checkerboard: needs.monitor_pixels = true; break;
        case StereoMode::left:
        case StereoMode::right: needs.both_eyes = false; break;
        case StereoMode::mono:
            needs.both_eyes = false;
            needs.one_eye_point = true;
            break;
        default: break;
    }
    return needs;
}

bool shows_one_eye_at_a_time(StereoMode mode) {
    return mode == StereoMode::frame_sequential || mode == StereoMode::two_layers || mode == StereoMode::two_windows;
}

ImageSize output_size(StereoMode mode, ImageSize eye) {
    if (mode == StereoMode::side_by_side) return {2 * eye.width, eye.height};
    if (mode == StereoMode::top_bottom) return {eye.width, 2 * eye.height};
    return eye;
}

ImageSize eye_size(StereoMode mode, ImageSize output) {
    if (mode == StereoMode::side_by_side) return {std::max(1u, output.width / 2), output.height};
    if (mode == StereoMode::top_bottom) return {output.width, std::max(1u, output.height / 2)};
    return output;
}

std::string_view file_name_of(TestPattern pattern) { return kPatterns[static_cast<std::size_t>(pattern)]; }

Result<TestPattern> parse_test_pattern(std::string_view text) {
    const std::string name = normal_form(text);
    const auto found = std::ranges::find(kPatterns, name);
    if (found != kPatterns.end()) return static_cast<TestPattern>(found - kPatterns.begin());
    return unknown("test pattern", text, kPatterns);
}

}  // namespace burin::wall
