// SPDX-License-Identifier: MIT
// Sessions as the panel might see them, for its tests and pictures.
#pragma once

#include <cmath>

#include "desk/panel/panel.hpp"
#include "haptics/tick_record.hpp"

namespace burin::session {

inline PanelModel idle_model() {
    PanelModel model;
    model.workpiece = {"soccer-ball.obj", "220.4 x 219.8 x 220.1 mm, 256 cells"};
    model.tool = {toolbox::ToolKind::ball, {0.004, 0.0, 0.0}, {}};
    model.sources = {{"Haptic device", "simulated hand, 1000 Hz", Condition::good},
                     {"Head tracker", "mouse and keys", Condition::idle}};
    model.figures.frames_per_s = 60.0;
    model.figures.tick_us = 24.0;
    model.figures.frame_ms = 16.7;
    model.force_N = {std::vector<float>(200, 0.0f), 3.3f};
    model.tick_us = {std::vector<float>(200, 24.0f), 1000.0f};
    model.frame_ms = {std::vector<float>(200, 16.7f), 16.7f};
    return model;
}

inline PanelModel carving_model() {
    PanelModel model = idle_model();
    model.operation = compute::Operation::paint;
    model.colour_srgb = {0.26, 0.41, 0.77};
    model.undo_count = 12;
    model.redo_count = 2;
    model.stereo_mode = wall::StereoMode::anaglyph_red_cyan;
    model.velocity_filter = 0.9;
    model.show_figures = true;
    model.touch.in_contact = true;
    model.touch.flags = haptics::kTickInContact | haptics::kTickCutting;
    model.touch.force_N = 0.82;
    for (std::size_t i = 0; i < 200; ++i) {
        const auto t = static_cast<float>(i);
        model.force_N.values[i] = i < 60 ? 0.0f : 0.8f + 0.35f * std::sin(0.21f * t) + 0.12f * std::sin(1.7f * t);
        model.tick_us.values[i] = 26.0f + 9.0f * std::fabs(std::sin(2.1f * t)) + (i == 140 ? 380.0f : 0.0f);
        model.frame_ms.values[i] = 16.7f + (i % 37 == 5 ? 8.0f : 0.3f * std::sin(t));
    }
    model.figures = {59.8, 18.3, 31.2, 12.4, 6.1, 26.5, 16.7, 35.8};
    model.savings = PanelSavings{412, 173, 104, 98, 37, 61, 3.4, 1204};
    model.log = {{"Saved part.stl: 983328 triangles, closed", MessageKind::info, 1, 61'000'000'000}};
    model.notes = model.log;
    return model;
}

inline PanelModel no_force_model() {
    PanelModel model = carving_model();
    model.show_figures = false;
    model.phase = haptics::WorkspacePhase::jumping;
    model.touch.cause = haptics::GateCause::stale_sample;
    model.touch.flags = haptics::kTickFault;
    model.touch.in_contact = false;
    model.touch.force_N = 0.0;
    model.sources[0] = {"Haptic device", "silent for 1.2 s", Condition::fault};
    model.warnings = {"Picture 61 ms behind the hand; 15 is noticed"};
    return model;
}

inline PanelModel export_model() {
    PanelModel model = idle_model();
    model.tool = {toolbox::ToolKind::bullnose, {0.006, 0.0015, 0.024}, {}};
    model.undo_count = 3;
    model.exporting = true;
    model.log = model.notes = {{"Writing part.stl", MessageKind::info, 1, 12'000'000'000}};
    return model;
}

// As the operator of a study sees it, in training whose hand is near the wall.
inline PanelModel study_model() {
    PanelModel model = idle_model();
    model.carves = false;
    model.workpiece = {"world.toml", "320 x 130 x 90 mm, 6 objects"};
    model.activity = ActivityPanel{.title = "Study", .aside = "p07, touch", .governs = true};
    model.activity->add<ActivityPanel::Row>({{"stage", "practice (day 1, stage 3)"},
                                             {"now", "runs"},
                                             {"left", "43 s of 300"},
                                             {"clock", "257.3 s"},
                                             {"path", "112 mm along, 18 mm off the axis"},
                                             {"force", "0.61 N, largest 1.90 N"},
                                             {"caps", "in none"},
                                             {"saturated", "0.4 % of ticks"},
                                             {"missed ticks", "0"}});
    model.activity->add<ActivityPanel::Button>({{"Start", {"start"}, false},
                                                {"Next", {"next"}, false},
                                                {"Pause", {"pause"}},
                                                {"Go on", {"go-on"}, false},
                                                {"Repeat", {"repeat"}, false},
                                                {"In the jig", {"jig"}},
                                                {"Stop", {"stop"}, true, "End the visit for good?"}});
    model.activity->widgets.push_back(ActivityPanel::Field{"Note", {"note"}, "a note that names nobody"});
    model.touch.in_contact = true;
    model.touch.force_N = 0.61;
    return model;
}

// An activity with one widget of each kind.
inline PanelModel all_widgets_model() {
    using Widgets = ActivityPanel;
    PanelModel model = idle_model();
    Widgets::Plot plot{.name = "Force", .value = "0.82 N", .limit = 1.2f};
    for (int i = 0; i < 120; ++i) plot.values.push_back(0.7f + 0.3f * std::sin(0.2f * static_cast<float>(i)));
    model.activity = ActivityPanel{
        .title = "Trail",
        .aside = "41 beads",
        .page = "Hold the button down and draw.",
        .widgets = {Widgets::Row{"Length", "164 mm"}, plot,
                    Widgets::Slider{.name = "Apart",
                                    .value = 0.004,
                                    .from = 0.001,
                                    .to = 0.02,
                                    .step = 0.0005,
                                    .unit = "mm",
                                    .units_in_one = 1000.0,
                                    .act = {"apart"}},
                    Widgets::Choice{.name = "Shape", .values = {{"Ball", "ball"}, {"Cube", "cube"}}, .act = {"shape"}},
                    Widgets::Choice{.name = "Exercise",
                                    .values = {{"Squeeze the ball", "squeeze"},
                                               {"Spread the fingers", "spread"},
                                               {"Follow the tapping", "tap"}},
                                    .chosen = 1,
                                    .act = {"kind"}},
                    Widgets::Swatches{.name = "Colour",
                                      .colours = {{0.8, 0.3, 0.2}, {0.9, 0.6, 0.2}, {0.2, 0.4, 0.8}, {0.9, 0.9, 0.9}},
                                      .act = {"colour"}},
                    Widgets::Page{"Beads that touch each other are one string."}, Widgets::Button{"Clear", {"clear"}},
                    Widgets::Button{"Undo", {"back"}, false}, Widgets::Button{"Stop", {"stop"}, true, "End the trail?"},
                    Widgets::Field{"Note", {"note"}, "a note that names nobody"}}};
    return model;
}

inline PanelModel help_model() {
    PanelModel model = idle_model();
    model.show_help = true;
    return model;
}

}  // namespace burin::session
