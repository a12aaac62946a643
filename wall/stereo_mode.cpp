// SPDX-License-Identifier: MIT
#include "renderer/output/stereo_mode.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <numeric>
#include <vector>

namespace burin {

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

// How many single-character edits lie between two words (Levenshtein 1966), row by row.
std::size_t edits_between(std::string_view a, std::string_view b) {
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 1; i <= a.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
            diagonal = row[j];
            row[j] = std::min({replaced, row[j] + 1, row[j - 1] + 1});
        }
    }
    return row[b.size()];
}

template <typename Names>
std::unexpected<Error> unknown(const char* where, std::string_view text, const Names& names) {
    const std::string wanted = normal_form(text.substr(0, 40));  // a whole file pasted here is no name
    std::string_view nearest = names[0];
    std::string all;
    for (const std::string_view name : names) {
        if (edits_between(wanted, name) < edits_between(wanted, nearest)) nearest = name;
        all += (all.empty() ? "" : ", ") + std::string(name);
    }
    return fail(where, "'" + std::string(text.substr(0, 40)) + "' is unknown",
                "did you mean " + std::string(nearest) + "? There are: " + all);
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

}  // namespace burin
