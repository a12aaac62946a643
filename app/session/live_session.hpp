// SPDX-License-Identifier: MIT
// A live session: the parts and how they hang together, the same in real time and in simulated time.
//
//   input -> step() -> state -> draw() -> picture           the frame's thread
//                 |-> hand, parameters                 ->   the haptic loop (its own thread, or stepped)
//                 |-> orders                           ->   the carving desk (its own thread, or stepped)
//   the desk's news -> take() -> tiles of the picture
//
// run_session() (session.hpp) drives it. What the threads did in real time can be recorded (thread_recorder.hpp) and done again
// (thread_replay.hpp).
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <utility>

#include "app/sculpt.hpp"
#include "app/session/carving_desk.hpp"
#include "app/session/panel.hpp"
#include "app/session/panel_feed.hpp"
#include "app/session/panel_pointer.hpp"
#include "app/session/session_picture.hpp"
#include "app/session/session_state.hpp"
#include "devices/simulated_omni.hpp"
#include "haptics/haptic_loop.hpp"

namespace burin {

class LiveSession {
public:
    // Loads and meshes the workpiece. The clock, from whose present the session's time counts, must outlive it.
    [[nodiscard]] static Result<std::unique_ptr<LiveSession>> create(const SculptOptions& options,
                                                                     const SessionWall& wall, Clock& clock);

    // One frame's input, for the main screen's output, with the tool as it is drawn. What the carving side is to do goes to `carve`.
    using Carve = std::function<void(CarvingOrder)>;
    void step(const FrameInput& input, const OutputPlace& output, const ToolState& tool, const Carve& carve);
    // The tool as the haptic loop has it now.
    [[nodiscard]] const ToolState& newest_tool() { return channels_.tool.newest(); }
    // What the carving side tells.
    void take(SurfaceNews news);
    // Hands the surface's news to every picture, before the first is drawn.
    void give_news(std::span<SessionPicture* const> pictures);
    // Records the picture of a screen whose output has this size.
    [[nodiscard]] Result<void> draw(gpu::Commands& commands, std::size_t screen, SessionPicture& picture,
                                    ImageSize size);
    [[nodiscard]] OutputSettings output_on(std::size_t screen) const {
        return burin::output_on(room_.wall, screen, state_.output);
    }
    // When a screen cannot be shown in the mode asked for.
    void refuse_mode(StereoMode working, const Error& error);
    void go_back_to(StereoMode mode) { state_.output.mode = mode; }
    // Pictures asked for by command since the last call: where to write them.
    [[nodiscard]] bool wants_screenshots() const { return !screenshots_.empty(); }
    [[nodiscard]] std::vector<std::filesystem::path> take_screenshots();

    [[nodiscard]] const SessionState& state() const { return state_; }
    [[nodiscard]] const Room& room() const { return room_; }
    [[nodiscard]] HapticLoop& loop() { return *loop_; }
    [[nodiscard]] CarvingDesk& desk() { return *desk_; }
    [[nodiscard]] SessionTimes& times() { return times_; }
    [[nodiscard]] Nanoseconds start_ns() const { return start_ns_; }
    [[nodiscard]] bool wants_full_screen_exchanged() { return std::exchange(exchange_full_screen_, false); }
    void say(const std::string& message);  // what follows from the input
    // What comes from outside: of windows, files, trackers, the system. The panel shows it as well; in a session that follows a recording it
    // shows what was heard then.
    void hear(const std::string& message);
    void hear_again(std::span<const std::string> recorded);
    // What clocks told the panel in the last step; in a session that follows a recording, in the next.
    [[nodiscard]] const PanelMeasured& measured() const { return panel_feed_.measured(); }
    void measure_again(const PanelMeasured& recorded) { recorded_ = recorded; }
    // Heard and refused since the last call, for who records it.
    struct Outside {
        std::vector<std::string> heard;
        std::optional<StereoMode> refused;
    };
    [[nodiscard]] Outside take_outside() { return std::exchange(outside_, {}); }

    [[nodiscard]] const DeviceDescription& device() const { return omni_->description(); }
    [[nodiscard]] HapticChannels& channels() { return channels_; }
    // Of the surface as it is carved now.
    [[nodiscard]] const Surface& surface() const { return carving_->surface(); }

private:
    LiveSession(Clock& clock, const SculptOptions& options);
    [[nodiscard]] Result<void> load(const SculptOptions& options, const SessionWall& wall);
    [[nodiscard]] Result<void> take_up_tool(const SculptOptions& options);
    void publish_parameters();
    [[nodiscard]] std::optional<Lamp> other_lamp();
    void watch_comfort();
    void watch_tracker(Nanoseconds time_ns);
    // ---- live_panel.cpp
    [[nodiscard]] PanelModel panel_model() const;
    [[nodiscard]] PanelPlace panel_place() const;
    Captured feed_panel(const FrameInput& input);
    [[nodiscard]] PanelStand panel_stand() const;
    [[nodiscard]] Result<void> paint_panel(gpu::Commands& commands, std::size_t screen, SessionPicture& picture);
    [[nodiscard]] ImageSize main_eye() const { return eye_size(output_on(room_.wall.main).mode, output_.size); }

    Clock& clock_;
    Nanoseconds start_ns_ = 0;
    WorkerPool pool_;
    std::unique_ptr<Carving> carving_;
    HapticChannels channels_;
    bool follows_recording_ = false;
    Outside outside_;
    HandSteering steering_;
    std::optional<SimulatedOmni> omni_;
    std::optional<HapticLoop> loop_;
    std::optional<CarvingDesk> desk_;
    Room room_;
    SessionState state_;
    ToolState tool_;
    std::uint64_t hand_sequence_ = 0, parameter_sequence_ = 0;
    Nanoseconds last_step_ns_ = 0;
    Vec3 lamp_direction_object_{0.0};  // as the carving side was told; zero: not yet
    std::vector<SurfaceNews> news_;    // not given to the picture yet
    std::vector<std::string> screenshots_;
    std::string screenshot_folder_;
    OutputPlace output_;  // of the main screen
    std::optional<Panel> panel_;
    const PanelFrame* panel_frame_ = nullptr;  // of the last step; null while the panel is hidden
    std::vector<CommandInput> panel_actions_;
    PanelPointer panel_pointer_;
    std::vector<InputEvent> scene_events_;  // of this step, without those that the panel alone has
    SessionTimes times_{clock_};
    PanelFeed panel_feed_;
    std::optional<PanelMeasured> recorded_;
    RenderStats render_stats_;
    std::string workpiece_name_, message_;
    bool exchange_full_screen_ = false;
    bool strained_ = false;  // the last frame's parallax was beyond the budget
    TrackerReport tracker_;  // meaningless without a tracker
    std::size_t undoable_ = 0, redoable_ = 0;
    std::optional<double> export_progress_;
};

}  // namespace burin
