// SPDX-License-Identifier: MIT
// What a live session shows on its panel, and what the panel asks of it.
#include <algorithm>
#include <cstdio>

#include "app/session/live_session.hpp"

namespace burin {
namespace {

// Of the panel that stands in the scene: its picture, and its width in the screen's height, so that its letters are as large as beside a
// desk's picture.
constexpr ImageSize kStanding_px{static_cast<std::uint32_t>(kPanelWidth_px), 680};
constexpr double kStandingWidth = 0.34, kStandingTurn_rad = 0.3;
constexpr double kOfScreensWidth = 0.26;  // at most: the workpiece stands in its middle

PanelSource hand_source(const ToolState& tool) {
    const bool silent = tool.cause != GateCause::none;
    return {"Hand", silent ? text(tool.cause) : "simulated, steered by the mouse",
            silent ? Condition::fault : Condition::good};
}

PanelSource tracker_source(const TrackerReport& report) {
    if (report.state == TrackerState::ok) return {"Head tracker", "follows the head", Condition::good};
    return {"Head tracker", report.cause, report.state == TrackerState::lost ? Condition::fault : Condition::warning};
}

}  // namespace

PanelModel LiveSession::panel_model() const {
    PanelModel m;
    m.visible = state_.panel;
    m.show_help = state_.help;
    m.show_figures = state_.figures;
    m.workpiece = workpiece_name_;
    if (const auto tool = parse_tool_spec(state_.tool.shape)) m.tool = *tool;
    m.operation = state_.tool.operation;
    if (const auto material = parse_tool_material(state_.tool)) {
        for (std::size_t i = 0; i < 3; ++i) m.colour_srgb[i] = material->colour[i] / 255.0;
    }
    if (const auto feel = parse_feel(state_.feel)) {
        m.hardness_Ns_per_m3 = feel->material.hardness_Ns_per_m3;
        m.friction = feel->material.dynamic_friction;
        m.stiffness_N_per_m = feel->material.stiffness_N_per_m;
    }
    m.velocity_filter = state_.velocity_filter;
    m.force_filter = state_.force_filter;
    m.technique = state_.technique;
    m.phase = tool_.workspace.phase;
    m.scale = state_.workspace_gain;
    m.stereo_mode = state_.output.mode;
    m.eyes_swapped = state_.output.swap_eyes;
    m.test_pattern = state_.output.test_pattern;
    m.eye_distance_m = state_.interpupillary_m;
    m.force_shown = state_.force_shown;
    m.undo_count = static_cast<std::uint32_t>(undoable_);
    m.redo_count = static_cast<std::uint32_t>(redoable_);
    m.export_path = state_.export_path;
    m.export_progress = export_progress_;
    m.message = message_;
    m.touch.force_on = state_.force_on;
    m.touch.in_contact = (tool_.flags & kTickInContact) != 0;
    m.touch.cause = tool_.cause;
    m.touch.flags = tool_.flags & kTickInContact;
    m.sources = {hand_source(tool_)};
    if (state_.head.tracked) m.sources.push_back(tracker_source(tracker_));
    panel_feed_.show_on(m);
    return m;
}

// In pixels of an eye's picture.
PanelPlace LiveSession::panel_place() const {
    return {{static_cast<double>(main_eye().width) - panel_->size().width, 0.0}, {1.0, 1.0}};
}

// At the right of the screen that the viewer faces and turned towards them.
PanelStand LiveSession::panel_stand() const {
    const Screen s = room_.screen();
    const Vec3 across = s.lower_right_world - s.lower_left_world, upright = s.upper_left_world - s.lower_left_world;
    const double width_m = std::min(kStandingWidth * glm::length(upright), kOfScreensWidth * glm::length(across));
    const Vec3 place = s.lower_right_world - (0.6 * width_m) * glm::normalize(across) + 0.55 * upright;
    const Quat turned = world_from_screen(s) * glm::angleAxis(-kStandingTurn_rad, Vec3(0.0, 1.0, 0.0));
    return stand_of_width({place, turned}, width_m, kStanding_px);
}

Captured LiveSession::feed_panel(const FrameInput& input) {
    panel_actions_.clear();
    panel_frame_ = nullptr;
    scene_events_.assign(input.events.begin(), input.events.end());
    const bool stirring = !input.events.empty() || (tool_.flags & kTickInContact) != 0 ||
                          tool_.workspace.phase != WorkspacePhase::editing;
    panel_feed_.feed({input.time_ns, glm::length(tool_.given.force_device_N), tool_.late_ticks, tool_.dropped_samples,
                      stirring, times_, loop_->duration(), render_stats_, main_eye(),
                      recorded_ ? &*recorded_ : nullptr});
    for (const std::string& line : times_.take_new_warnings()) std::fprintf(stderr, "burin: %s\n", line.c_str());
    const ImageSize eye = main_eye();
    const OutputSettings shown = output_on(room_.wall.main);
    OnPicture on = mouse_on_picture(panel_pointer_, input.events, shown, output_);
    const PanelPointer pointer = std::exchange(panel_pointer_, {.mouse_px = on.pointer.mouse_px});
    const bool stands = !room_.wall.desk;
    const auto width = static_cast<std::uint32_t>(kPanelWidth_px);
    // A window too narrow for both shows the scene alone.
    if (!state_.panel || eye.height == 0 || (!stands && eye.width < 2 * width)) return {};
    const ImageSize size = stands ? kStanding_px : ImageSize{width, eye.height};
    if (!panel_) {
        auto made = Panel::create({.size = size});
        if (!made) {
            say(made.error().line());
            state_.panel = false;
            return {};
        }
        panel_.emplace(std::move(*made));
        if (!panel_->notice().empty()) say(panel_->notice());
    }
    panel_->resize(size);
    if (stands) {
        const Sight sight = sight_of(room_.wall.setup, room_.wall.main, state_.head, state_.interpupillary_m);
        const MouseView mouse{sight.screen, eyes_of(sight.viewer), shown, output_};
        Pointed pointed = point_at_panel(pointer, input.events, panel_stand(), size, mouse);
        panel_pointer_ = pointed.pointer;
        scene_events_ = std::move(pointed.rest);
        panel_->feed(pointed.panel);
    } else {
        panel_pointer_ = on.pointer;
        panel_->feed(on.events, panel_place());
    }
    panel_frame_ = &panel_->show(panel_model(), input.time_ns);
    panel_actions_ = panel_frame_->actions;
    return {panel_frame_->wants_mouse, panel_frame_->wants_keyboard};
}

Result<void> LiveSession::paint_panel(gpu::Commands& commands, std::size_t screen, SessionPicture& picture) {
    const bool stands = !room_.wall.desk;
    if (panel_frame_ == nullptr || (!stands && screen != room_.wall.main)) {
        picture.hide_panel();
        return {};
    }
    return picture.paint(commands, panel_frame_->mesh, panel_->atlas(), panel_->size(),
                         stands ? std::optional(panel_stand()) : std::nullopt);
}

}  // namespace burin
