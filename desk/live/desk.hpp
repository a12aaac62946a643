// SPDX-License-Identifier: MIT
// The desk of a session: who sees it and leads it, whatever the window. It gives the session its steps, with what
// panel, keys, mouse and trackers ask for, and has the pictures of its screens.
//
//   input -> the panel's share, and the rest -> Session::step(), led by the viewer -> scene_on(), panel_on() -> picture
//   what the scene's parts report -> take_news() -> take_surface_updates() -> tiles of the picture
//
// A driver gives it its frames (desk/run/session.hpp), the Presenter draws them. Offscreen and without pictures it lays
// out no panel; a session of commands alone needs no desk (session/live/session.hpp). Thread: the frame's.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "desk/panel/live_panel.hpp"
#include "desk/viewer/state_words.hpp"
#include "desk/viewer/viewer_lead.hpp"
#include "desk/viewer/viewer_watch.hpp"
#include "session/live/session.hpp"
#include "session/record/input_source.hpp"
#include "session/record/thread_log.hpp"
#include "workpiece/workpiece.hpp"

namespace burin::session {

class Desk {
public:
    // Opens a session before this wall; as Session::create().
    [[nodiscard]] static Result<std::unique_ptr<Desk>> create(const SessionSetup& options, const SessionWall& wall,
                                                              Clock& clock, double pace = 1.0,
                                                              std::unique_ptr<workpiece::Workpiece> made = {});
    // Opens the session that a log was recorded of: with its start on the clock, so that all times are equal to the
    // bit, and with its machine's pace. Fails where the options do not open, or its device ticks at another rate. name:
    // the log's file name.
    [[nodiscard]] static Result<std::unique_ptr<Desk>> create_as_recorded(const SessionSetup& options,
                                                                          const SessionWall& wall, const ThreadLog& log,
                                                                          const std::string& name,
                                                                          SimulatedClock& clock);

    [[nodiscard]] Session& session() { return *session_; }
    [[nodiscard]] const Session& session() const { return *session_; }
    [[nodiscard]] const Viewer& viewer() const { return viewer_; }
    [[nodiscard]] const DeskRoom& room() const { return room_; }
    [[nodiscard]] ViewedSession seen() const { return {session_->state(), session_->room(), viewer_, room_}; }

    // Applies one frame's input. `output` is the main screen's output, `tools` the tools as the frame draws them, one
    // of each part of the hands. Orders to the scene's parts are passed to `give`. panel_output: size of the panel's
    // own window; empty: there is none.
    using Give = Session::Give;
    void step(const FrameInput& input, const wall::OutputPlace& output, std::span<const haptics::ToolState> tools,
              const Give& give, ImageSize panel_output = {});
    // Applies it for a session whose only hand has one part.
    void step(const FrameInput& input, const wall::OutputPlace& output, const haptics::ToolState& tool,
              const Give& give, ImageSize panel_output = {}) {
        step(input, output, std::span(&tool, 1), give, panel_output);
    }
    // Takes over what the session reports (Session::take_loaded, take_news), and keeps what is new of the surface.
    void take_loaded();
    void take_news(std::uint64_t updates);

    // ---- What the frame draws
    // Returns the surface updates since the last call, and the origin of their tiles' positions.
    [[nodiscard]] std::vector<scene::SurfaceUpdate> take_surface_updates() { return std::exchange(updates_, {}); }
    [[nodiscard]] Vec3 lattice_origin_object() const { return session_->scene_side().lattice_origin_object(); }
    // Returns the scene of a screen; nothing where it stays dark.
    [[nodiscard]] std::optional<picture::Picture> scene_on(std::size_t screen) const;
    // Returns the panel's picture on a screen, valid until the next step; nothing where it is not shown.
    [[nodiscard]] std::optional<PanelPicture> panel_on(std::size_t screen) const {
        return panel_.picture_on(screen, room_);
    }
    // See LivePanel.
    [[nodiscard]] std::optional<PixelRect> place_on_panel(std::string_view label) const {
        return panel_.place_of(label);
    }
    void leave_panel_out() { panel_.leave_out(); }
    [[nodiscard]] const PanelMeasured& measured() const { return panel_.measured(); }
    void measure_again(const PanelMeasured& recorded) { panel_.measure_again(recorded); }
    // Records what the main screen's frame drew and left out.
    void note_drawn(const renderer::RenderStats& stats) { panel_.note_drawn(stats); }
    [[nodiscard]] wall::OutputSettings output_on(std::size_t screen) const { return seen().output_on(screen); }
    // Reports that a screen cannot be shown in the requested mode, and changes it to the mode that works.
    void refuse_mode(wall::StereoMode working, const Error& error);
    void go_back_to(wall::StereoMode mode) { viewer_.output.mode = mode; }
    // Returns the mode that was gone back to since the last call, for the recorder.
    [[nodiscard]] std::optional<wall::StereoMode> take_refused() { return std::exchange(refused_, std::nullopt); }
    [[nodiscard]] bool wants_full_screen_exchanged() {
        return std::exchange(viewer_.wants_full_screen_exchanged, false);
    }

    [[nodiscard]] SessionTimes& times() { return times_; }
    // Returns when a picture changes without input, in session time: a message goes, a tool-tip comes. None: never.
    [[nodiscard]] std::optional<Nanoseconds> changes_ns() const;
    // Tells the panel the last tick that a session file has on the disk, and whether its recording goes on.
    void note_acknowledged(std::uint64_t tick, bool goes_on) {
        acknowledged_ = tick;
        recording_ended_ = !goes_on;
    }
    // Returns what a frame's checksum covers.
    [[nodiscard]] StateWords words() const { return words_of(session_->state(), viewer_); }

private:
    class StepLead;
    Desk(Clock& clock, const SessionWall& wall) : times_(clock) { room_.wall = wall; }
    [[nodiscard]] SceneInput feed_panel(const FrameInput& input);
    void note_times(const FrameInput& input);
    [[nodiscard]] std::vector<CommandInput> after(wall::StereoMode begun_in, const SessionState& state);
    void take(std::optional<scene::SurfaceUpdate> news);
    void stand_on_plinth(picture::Picture& scene) const;
    [[nodiscard]] bool tells_late_pictures() const {
        return session_->hands().felt_by_person() || viewer_.head.tracked;
    }
    [[nodiscard]] ImageSize main_eye() const { return wall::eye_size(output_on(room_.wall.main).mode, output_.size); }

    std::unique_ptr<Session> session_;
    DeskRoom room_;
    Viewer viewer_;
    LivePanel panel_;
    ToolSizeRange tool_sizes_;                   // that the panel offers
    SeenSurface surface_;                        // that the mouse points at
    wall::OutputPlace output_;                   // of the main screen
    ImageSize panel_output_;                     // of the panel's window; empty: there is none
    std::optional<wall::StereoMode> framed_;     // of the main screen, when the workpiece was last fitted into it
    std::vector<scene::SurfaceUpdate> updates_;  // not drawn yet: all of them in one, or none
    SessionTimes times_;
    ComfortWatch comfort_;
    TrackerWatch tracker_;
    WandWatch wand_;
    std::uint64_t laid_out_changes_ = 0;       // of the log, when the panel was laid out
    std::optional<wall::StereoMode> refused_;  // for the recorder
    std::optional<std::uint64_t> acknowledged_;
    bool recording_ended_ = false;
};

}  // namespace burin::session
