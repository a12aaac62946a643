// SPDX-License-Identifier: MIT
// Hosts the panel in a live session: gives it its share of the input, lays it out with the session's state and measured
// times, and has its picture ready for the screens. Over a desktop window's picture it lies at the right; before a wall
// it stands in the scene. Or it fills a window of its own: then the pictures have the activity's page in its place, and
// nothing where there is none.
// Thread: the frame's.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "desk/draw/session_picture.hpp"
#include "desk/panel/device_look.hpp"
#include "desk/panel/panel.hpp"
#include "desk/panel/panel_feed.hpp"
#include "desk/panel/panel_pointer.hpp"
#include "desk/viewer/viewer_lead.hpp"
#include "session/live/session.hpp"
#include "session/notices/message_log.hpp"
#include "session/record/input_source.hpp"
#include "wall/head_prediction.hpp"

namespace burin::session {

// Inputs of the panel in a step: the session and its viewer, and where the panel is shown.
struct PanelContext {
    ViewedSession seen;
    const Session& session;
    const wall::TrackerReport& tracker;  // meaningless without a tracker
    ToolSizeRange tool_sizes = {};
    const SessionTimes& times;
    wall::OutputSettings shown;  // how the main screen is shown
    wall::OutputPlace output;    // of the main screen
    ImageSize panel_output;      // of the panel's own window; empty: it has none
    // PanelFacts
    std::optional<std::uint64_t> acknowledged = std::nullopt;
    bool recording_ended = false;
    // Somebody feels the hand, or is tracked, and notices what is late.
    bool tells_late_pictures = true;
    [[nodiscard]] ImageSize eye() const { return wall::eye_size(shown.mode, output.size); }
};

// What the panel leaves of a step's input to the scene: events without the presses and turns of wheel and stick that
// met a panel in the scene, and what it captures of the others.
struct SceneInput {
    std::vector<InputEvent> events;
    Captured captured;
};

// Says of a part of the hands what holds it, or why it gets no force. led_hand: which mouse and keys lead.
[[nodiscard]] PanelSource hand_source(const SessionHands& hands, std::size_t part, haptics::GateCause cause,
                                      std::size_t led_hand);

// Returns how wide the panel is at the right of a desktop window's picture; 0 where the window is too narrow for both,
// or where it has a window of its own. In modes that halve the picture it covers more of each half. And the share of
// the picture that it leaves free.
[[nodiscard]] std::uint32_t panel_width(const DeskRoom& room, ImageSize eye, ImageSize window);
// Returns the scale of its letters there: smaller than asked for where the panel would cover more than half the window.
[[nodiscard]] double panel_scale_in(const DeskRoom& room, ImageSize window);
[[nodiscard]] double beside_panel(const DeskRoom& room, ImageSize eye, ImageSize window);

class LivePanel {
public:
    // Feeds a step's events and lays the panel out, with the log's messages on it; an Error where there can be no
    // panel.
    [[nodiscard]] Result<SceneInput> feed(const FrameInput& input, const PanelContext& context, MessageLog& log);
    // Lays nothing out from now on. All else is as if it were there: how much of the picture it leaves free.
    void leave_out() { left_out_ = true; }
    // Returns the commands that its widgets gave in the last step.
    [[nodiscard]] const std::vector<CommandInput>& actions() const { return actions_; }
    // Returns its picture for a screen, as laid out in the last step; nothing where it is not shown.
    [[nodiscard]] std::optional<PanelPicture> picture_on(std::size_t screen, const DeskRoom& room) const;

    // Returns the share of the main screen's picture that the panel left free in the last step, at its left.
    [[nodiscard]] double free_width(const DeskRoom& room, ImageSize eye, ImageSize window) const;
    // Returns when it changes by itself, in session time; nothing where it does not.
    [[nodiscard]] std::optional<Nanoseconds> changes_ns() const {
        return layout_ != nullptr ? layout_->changes_ns : std::nullopt;
    }

    // Returns where a widget with this label lies over the main screen's picture, in its pixels; nothing where it is
    // scrolled away, does not exist, or the panel stands elsewhere. For scripts and tests that press it.
    [[nodiscard]] std::optional<PixelRect> place_of(std::string_view label) const {
        return panel_ && layout_ != nullptr ? panel_->place_over_picture(label) : std::nullopt;
    }

    // Records what the main screen's frame drew and left out, which the next steps' figures show.
    void note_drawn(const renderer::RenderStats& stats) { drawn_ = stats; }
    // Returns the measured times that the panel was given in the last step; measure_again() supplies those of the next
    // step in a replay.
    [[nodiscard]] const PanelMeasured& measured() const { return feed_.measured(); }
    void measure_again(const PanelMeasured& recorded) { recorded_ = recorded; }

private:
    void add_devices(PanelModel& model, bool follows_recording);
    void feed_times(const FrameInput& input, const PanelContext& context);
    [[nodiscard]] static Result<void> open(std::optional<Panel>& panel, ImageSize size, double scale);
    [[nodiscard]] SceneInput feed_over_picture(const FrameInput& input, const PanelContext& context, ImageSize size);
    [[nodiscard]] SceneInput feed_in_window(const FrameInput& input, ImageSize window);
    [[nodiscard]] Result<void> lay_out_page(const PanelContext& context, Nanoseconds time_ns);
    [[nodiscard]] PanelModel model_of(const PanelContext& context, const MessageLog& log) const;

    std::optional<Panel> panel_;          // created when it is first shown
    const PanelFrame* layout_ = nullptr;  // of the last step; null while there is nothing of it
    std::string told_notice_;             // about fonts
    bool left_out_ = false;
    bool column_shown_ = false;  // and not only what lies over the picture
    std::optional<Panel> page_;  // beside a panel in its own window
    const PanelFrame* page_layout_ = nullptr;
    bool mouse_on_window_ = false;  // the panel's own
    std::vector<CommandInput> actions_;
    PanelPointer pointer_;
    PanelFeed feed_;
    DeviceLook look_;
    std::optional<PanelMeasured> recorded_;
    renderer::RenderStats drawn_;
};

}  // namespace burin::session
