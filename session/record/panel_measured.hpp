// SPDX-License-Identifier: MIT
// Measured times as a panel shows them, plain data: a recording keeps them, so that a replay's panel shows what was
// measured then (desk/panel/panel_feed.hpp).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace burin::session {

// Measured figures; none where no frame has the figure, and in simulated time.
struct PanelFigures {
    double frames_per_s = 0.0;  // 0: at rest
    std::optional<double> head_age_ms, motion_to_photon_ms, touch_before_sight_ms, draw_ms;
    std::optional<double> tick_us;  // the longest
    std::optional<double> frame_ms, carve_age_ms;

    bool operator==(const PanelFigures&) const = default;
};

// Work that the renderer saved in the last frame (RenderStats).
struct PanelSavings {
    std::uint32_t patches = 0, drawn = 0, beside = 0, turned_away = 0, behind = 0, coarser = 0;
    double redrawn_percent = 0.0;  // of the picture
    std::uint64_t frames_skipped = 0;

    bool operator==(const PanelSavings&) const = default;
};

// Measured times of one step of the session: new plot points and new numbers, each only when it is due.
struct PanelPlotted {
    double tick_us = 0.0, frame_ms = 0.0;  // maxima since the previous points
    double frame_limit_ms = 0.0;
};
struct PanelNumbers {
    PanelFigures figures;
    PanelSavings savings;
    std::vector<std::string> warnings;
};
struct PanelMeasured {
    std::optional<PanelPlotted> plotted;
    std::optional<PanelNumbers> numbers;
    std::optional<std::uint64_t> acknowledged;  // PanelFacts::acknowledged, where the numbers were renewed
};

}  // namespace burin::session
