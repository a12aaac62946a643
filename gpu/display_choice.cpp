// SPDX-License-Identifier: MIT
#include "gpu/display_choice.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <utility>

namespace burin::gpu {

namespace {

constexpr std::size_t kMostListed = 8;  // a display may have a hundred modes

std::string rate_of(double refresh_Hz) {
    std::array<char, 40> text{};
    std::snprintf(text.data(), text.size(), "%.4g", refresh_Hz);
    return text.data();
}

bool holds(const DisplayPlane& plane, std::uint32_t width, std::uint32_t height) {
    return (plane.most_width == 0 || width <= plane.most_width) &&
           (plane.most_height == 0 || height <= plane.most_height);
}

}  // namespace

int choose_display(const std::vector<std::string>& names, const std::string& wanted) {
    if (wanted.empty()) return names.empty() ? -1 : 0;
    const auto index_of = [&](auto found) { return static_cast<int>(found - names.begin()); };
    if (const auto whole = std::ranges::find(names, wanted); whole != names.end()) return index_of(whole);
    std::size_t place = 0;
    const char* end = wanted.data() + wanted.size();
    if (const auto [stopped, error] = std::from_chars(wanted.data(), end, place); stopped == end) {
        return error == std::errc{} && place < names.size() ? static_cast<int>(place) : -1;
    }
    const auto part = std::ranges::find_if(names, [&](const std::string& name) { return name.contains(wanted); });
    return part == names.end() ? -1 : index_of(part);
}

int choose_mode(const std::vector<DisplayMode>& modes, const DisplayChoice& choice) {
    int best = -1;
    const auto worth = [&](const DisplayMode& m) {
        return choice.refresh_Hz > 0.0 ? -std::abs(m.refresh_Hz - choice.refresh_Hz) : m.refresh_Hz;
    };
    for (std::size_t i = 0; i < modes.size(); ++i) {
        const bool right_size = (choice.width == 0 || modes[i].width == choice.width) &&
                                (choice.height == 0 || modes[i].height == choice.height);
        if (!right_size || (choice.stereo == DisplayStereo::hdmi_3d && !modes[i].hdmi_3d)) continue;
        if (best < 0 || worth(modes[i]) > worth(modes[static_cast<std::size_t>(best)])) best = static_cast<int>(i);
    }
    return best;
}

int choose_plane(const std::vector<DisplayPlane>& planes, std::uint32_t width, std::uint32_t height) {
    int best = -1;
    for (std::size_t i = 0; i < planes.size(); ++i) {
        const DisplayPlane& plane = planes[i];
        if (!plane.reaches || plane.taken || !holds(plane, width, height)) continue;
        if (plane.shows) return static_cast<int>(i);
        if (best < 0) best = static_cast<int>(i);
    }
    return best;
}

std::uint32_t choose_alpha(std::uint32_t supported) {
    // Tries opaque, one alpha for all, then that of each pixel: the last ones are right for images whose alpha is 1
    // everywhere, as ours is.
    for (const std::uint32_t bit : {1u, 2u, 4u, 8u})
        if ((supported & bit) != 0) return bit;
    return 1u;
}

std::string listed(const std::vector<DisplayMode>& modes) {
    using Size = std::pair<std::uint32_t, std::uint32_t>;
    std::vector<Size> sizes;
    for (const DisplayMode& m : modes)
        if (std::ranges::find(sizes, Size{m.width, m.height}) == sizes.end()) sizes.emplace_back(m.width, m.height);
    std::string text;
    for (std::size_t i = 0; i < std::min(sizes.size(), kMostListed); ++i) {
        std::string rates, rates_3d;
        for (const DisplayMode& m : modes) {
            if (Size{m.width, m.height} != sizes[i]) continue;
            rates += (rates.empty() ? "" : ", ") + rate_of(m.refresh_Hz);
            if (m.hdmi_3d) rates_3d += (rates_3d.empty() ? "" : ", ") + rate_of(m.refresh_Hz);
        }
        text += (i == 0 ? "" : "; ") + std::to_string(sizes[i].first) + " x " + std::to_string(sizes[i].second) +
                " at " + rates + " Hz";
        if (!rates_3d.empty()) text += " (HDMI 3D at " + rates_3d + " Hz)";
    }
    if (sizes.size() > kMostListed) text += "; and " + std::to_string(sizes.size() - kMostListed) + " more sizes";
    return text;
}

}  // namespace burin::gpu
