// SPDX-License-Identifier: MIT
// All that the panel shows, as plain data: the session fills it, the panel asks nothing. Equal models give equal pictures.
// Units are in the names. Plots hold the newest last. panel_feed.hpp fills what changes by itself, seldom enough to be read.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "app/session/command_table.hpp"
#include "haptics/stability/safety_gate.hpp"

namespace burin {

enum class Condition : std::uint8_t { good, idle, warning, fault };

// A device, a tracker or anything else that may be there or not.
struct PanelSource {
    std::string name;    // "Haptic device"
    std::string detail;  // "simulated hand, 1000 Hz"
    Condition condition = Condition::idle;

    bool operator==(const PanelSource&) const = default;
};

// The last ten seconds or so of a figure. Nothing where there is no device.
struct PanelPlot {
    std::vector<float> values;
    float limit = 0.0f;  // drawn as a line: a tick's period, a frame's; 0: none

    bool operator==(const PanelPlot&) const = default;
};

struct PanelTouch {
    bool force_on = true;               // as the user wants it
    bool in_contact = false;            // kTickInContact
    GateCause cause = GateCause::none;  // ToolState::cause: why there is no force though it is wanted
    std::uint32_t flags = 0;            // ToolState::flags, TickFlag bits
    std::uint64_t late_ticks = 0, dropped_samples = 0;
    double force_N = 0.0;

    bool operator==(const PanelTouch&) const = default;
};

// Nothing where no frame has the figure, and in simulated time.
struct PanelFigures {
    double frames_per_s = 0.0;  // 0: at rest
    std::optional<double> head_age_ms, motion_to_photon_ms, touch_before_sight_ms, draw_ms;
    std::optional<double> tick_us;  // the longest
    std::optional<double> frame_ms, carve_age_ms;

    bool operator==(const PanelFigures&) const = default;
};

// What the renderer spared in the last frame (RenderStats).
struct PanelSavings {
    std::uint32_t patches = 0, drawn = 0, beside = 0, turned_away = 0, behind = 0, coarser = 0;
    double redrawn_percent = 0.0;  // of the picture
    std::uint64_t frames_skipped = 0;

    bool operator==(const PanelSavings&) const = default;
};

struct PanelModel {
    bool visible = true, show_help = false, show_figures = false;  // Tab, F1, F2
    std::string title = "Burin", workpiece;                        // "soccer ball, 256 cells"

    ToolSpec tool;
    Operation operation = Operation::cut;
    std::array<double, 3> colour_srgb{0.88, 0.56, 0.21};
    double hardness_Ns_per_m3 = 1e6;
    double friction = 0.3;
    double stiffness_N_per_m = 600.0;
    double velocity_filter = 0.0, force_filter = 0.0;  // a of the moving average; 0: none

    WorkspaceTechnique technique = WorkspaceTechnique::moving;
    WorkspacePhase phase = WorkspacePhase::editing;
    double scale = 1.0;

    StereoMode stereo_mode = StereoMode::mono;
    bool eyes_swapped = false;
    TestPattern test_pattern = TestPattern::none;
    double eye_distance_m = 0.063;
    bool force_shown = false;  // the arrow

    std::uint32_t undo_count = 0, redo_count = 0;
    std::string export_path = "part.stl";
    std::optional<double> export_progress;  // 0 to 1; nothing: none is under way
    std::string message;                    // the last one: "Saved part.stl, 983328 triangles"

    PanelTouch touch;
    std::vector<PanelSource> sources;   // device, tracker
    std::vector<std::string> warnings;  // FrameWarning::title
    std::vector<std::string> notices;
    PanelPlot force_N, tick_us, frame_ms;
    PanelFigures figures;
    std::optional<PanelSavings> savings;

    bool operator==(const PanelModel&) const = default;
};

}  // namespace burin
