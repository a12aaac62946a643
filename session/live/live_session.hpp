// SPDX-License-Identifier: MIT
// Live session: its parts and how they are connected, the same in real time and in simulated time.
//
//   input -> step() -> state -> scene_on(), panel_on() -> picture       the frame's thread
//                 |-> hand, parameters                 ->   the haptic loop (its own thread, or stepped)
//                 |-> orders                           ->   the scene's parts (the scene's thread, or stepped)
//   what the parts report (scene_news.hpp) -> take_news() -> take_surface_updates() -> tiles of the picture
//
// Each role has a class of its own: HandSide, SceneSide, ActivitySide, LivePanel, MessageLog, SessionOutputs, and the
// watches of session_watch.hpp. A driver gives the session its frames (session.hpp), the Presenter draws them. What the
// threads of a real-time session did can be recorded (session/drive/thread_recorder.hpp) and replayed
// (session/drive/thread_replay.hpp).
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "desk/panel/live_panel.hpp"
#include "sculpt/made_workpiece.hpp"
#include "session/live/activity_side.hpp"
#include "session/live/asked_files.hpp"
#include "session/live/document_news.hpp"
#include "session/live/document_side.hpp"
#include "session/live/hand_side.hpp"
#include "session/live/scene_side.hpp"
#include "session/live/session_watch.hpp"
#include "session/notices/message_log.hpp"
#include "session/options/session_options.hpp"
#include "session/record/input_source.hpp"
#include "session/state/session_state.hpp"
#include "session/work/saved_world.hpp"

namespace burin::session {

class LiveSession {
public:
    // Loads and meshes the workpiece, and opens the world. Session time counts from the clock's present value; the
    // clock must outlive the session. pace: how much slower than the reference core the machine is
    // (haptics::WorkSettings); as measured where time is real (session/hands/machine_pace.hpp), as recorded in a
    // replay, and 1 where results must depend on no machine. made: the workpiece of the options, where it is ready
    // already.
    [[nodiscard]] static Result<std::unique_ptr<LiveSession>> create(const SculptOptions& options,
                                                                     const SessionWall& wall, Clock& clock,
                                                                     double pace = 1.0,
                                                                     std::optional<sculpt::MadeWorkpiece> made = {});

    // Applies one frame's input. `output` is the main screen's output, `tools` the tools as the frame draws them, one
    // of each part of the hands. Orders to the scene's parts are passed to `give`. panel_output: size of the panel's
    // own window; empty: there is none.
    using Give = SceneSide::Give;
    void step(const FrameInput& input, const wall::OutputPlace& output, std::span<const haptics::ToolState> tools,
              const Give& give, ImageSize panel_output = {});
    // Likewise of a session whose hand has one part.
    void step(const FrameInput& input, const wall::OutputPlace& output, const haptics::ToolState& tool,
              const Give& give, ImageSize panel_output = {}) {
        step(input, output, std::span(&tool, 1), give, panel_output);
    }
    // Returns the newest tool state that the haptic loop has published for the first part of the first hand.
    [[nodiscard]] const haptics::ToolState& newest_tool() { return hands().newest_tool(0); }
    // Collects what the scene's parts report of the update that has just ended; returns whether it is anything. The
    // scene's thread.
    bool collect(const scene::SceneThread::Ended& update) { return scene_.news().collect(update); }
    // Takes over what the parts report at the beginning, before the scene's thread starts.
    void take_loaded();
    // Takes over what so many of the collected updates have reported.
    void take_news(std::uint64_t updates);
    // Ends what the scene's parts do elsewhere, takes over all that is left, and has the activity end. No thread runs
    // any more.
    void finish_scene();

    // ---- What the frame draws.
    // Returns the surface updates since the last call, and the origin of their tiles' positions.
    [[nodiscard]] std::vector<sculpt::SurfaceUpdate> take_surface_updates() { return std::exchange(updates_, {}); }
    [[nodiscard]] Vec3 lattice_origin_object() const { return scene_.lattice_origin_object(); }
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
    // Records what the main screen's frame drew and left out.
    void note_drawn(const renderer::RenderStats& stats) { panel_.note_drawn(stats); }
    [[nodiscard]] wall::OutputSettings output_on(std::size_t screen) const {
        return burin::session::output_on(room_.wall, screen, state_.output);
    }
    // Reports that a screen cannot be shown in the requested mode, and changes the session to the mode that works.
    void refuse_mode(wall::StereoMode working, const Error& error);
    void go_back_to(wall::StereoMode mode) { state_.output.mode = mode; }
    // The files that were asked for, and what became of them.
    [[nodiscard]] AskedFiles& files() { return files_; }

    // Returns the options with what the session found out in place of what they leave open: the unit of the workpiece's
    // file, the tool, and the models of devices.
    [[nodiscard]] SculptOptions settled(SculptOptions options) const;
    [[nodiscard]] const SessionState& state() const { return state_; }
    [[nodiscard]] const Room& room() const { return room_; }
    [[nodiscard]] SessionHands& hands() { return hands_.all(); }
    [[nodiscard]] const SessionHands& hands() const { return hands_.all(); }
    [[nodiscard]] haptics::HapticLoop& loop() { return hands().loop(); }
    [[nodiscard]] scene::SceneService& scene() { return scene_.service(); }
    // Returns the durations of the scene's updates in which the carved surface changed.
    [[nodiscard]] const haptics::Histogram& carving_duration() const { return scene_.news().carving_duration(); }
    // After the threads have ended; null where nothing is carved.
    [[nodiscard]] const compute::CarvingEngine* engine() const {
        return scene_.workpiece() != nullptr ? &scene_.workpiece()->engine() : nullptr;
    }
    [[nodiscard]] SessionTimes& times() { return times_; }
    // Returns when a picture changes without input, in session time: a message goes, a tool-tip comes. None: never.
    [[nodiscard]] std::optional<Nanoseconds> changes_ns() const;
    // Returns the name of what is worked on: its file's, or its shape's.
    [[nodiscard]] const std::string& document_name() const { return workpiece_.name; }
    [[nodiscard]] Nanoseconds start_ns() const { return start_ns_; }
    [[nodiscard]] bool wants_full_screen_exchanged() { return std::exchange(exchange_full_screen_, false); }
    // Returns what the session is to be told of its document since the last call, as inputs of the next step; nothing
    // where an input takes a user's place.
    [[nodiscard]] std::vector<CommandInput> take_told();
    // Returns whether there will be something to tell soon.
    [[nodiscard]] bool waits_for_the_disk() const;
    // See MessageLog.
    void hear_nothing_from_outside() { log_.hear_nothing_from_outside(); }
    void notify(const std::string& message, MessageKind kind = MessageKind::warning) { log_.notify(message, kind); }
    void notify_of_event(const std::string& message, MessageKind kind = MessageKind::info) {
        log_.notify_of_event(message, kind);
    }
    [[nodiscard]] const std::vector<Message>& messages() const { return log_.all(); }
    void replay_events(std::span<const std::string> recorded) { log_.replay_events(recorded); }
    // Tells the panel the last tick that a session file has on the disk, and whether its recording goes on.
    void note_acknowledged(std::uint64_t tick, bool goes_on) {
        acknowledged_ = tick;
        recording_ended_ = !goes_on;
    }
    // Lays no panel out from now on: nobody sees it, and no input meets it.
    void leave_panel_out() { panel_.leave_out(); }
    // See LivePanel.
    [[nodiscard]] const PanelMeasured& measured() const { return panel_.measured(); }
    void measure_again(const PanelMeasured& recorded) { panel_.measure_again(recorded); }
    // Outside messages and refused modes since the last call, for the recorder.
    struct Outside {
        std::vector<std::string> heard;
        std::optional<wall::StereoMode> refused;
    };
    [[nodiscard]] Outside take_outside() { return {log_.take_events(), std::exchange(refused_, std::nullopt)}; }

    [[nodiscard]] bool has_activity() const { return activity_.is_there(); }
    // Returns the trials that the activity has begun and ended since the last call.
    [[nodiscard]] std::vector<TrialMark> take_trials() { return activity_.take_trials(); }
    // Returns what has happened since the last call, for the table of events; every frame asks for it.
    [[nodiscard]] std::vector<EventMark> take_events() { return std::exchange(events_, {}); }
    [[nodiscard]] std::uint64_t check_of_activity() const { return activity_.check(); }
    [[nodiscard]] haptics::HapticChannels& channels(std::size_t part = 0) { return hands().channels(part); }
    [[nodiscard]] std::vector<haptics::HapticChannels*> channels_of_parts() { return hands().channels_of_parts(); }
    // Returns the surface as it is carved now; null without a workpiece.
    [[nodiscard]] const compute::Surface* surface() const {
        return scene_.workpiece() != nullptr ? &scene_.workpiece()->surface() : nullptr;
    }
    // Returns the objects of the world as they are now; null without one.
    [[nodiscard]] const scene::MeshPart* objects() const {
        return scene_.world() != nullptr ? &scene_.world()->part() : nullptr;
    }

private:
    LiveSession(Clock& clock, const SculptOptions& options, double pace);
    [[nodiscard]] Result<void> load(const SculptOptions& options, const SessionWall& wall,
                                    std::optional<sculpt::MadeWorkpiece> made);
    [[nodiscard]] Result<void> take_workpiece(const SculptOptions& options, std::optional<sculpt::MadeWorkpiece> made);
    [[nodiscard]] Result<void> open_saved(const SculptOptions& options);
    [[nodiscard]] Result<sculpt::MadeWorkpiece> make_workpiece(const SculptOptions& options);
    [[nodiscard]] Result<void> load_world(const SculptOptions& options);
    [[nodiscard]] Result<void> take_up_tool(const SculptOptions& options);
    [[nodiscard]] const haptics::ToolState& tool_in_use() const { return tools_[hands().first_part(state_.hand)]; }
    SceneInput feed_panel(const FrameInput& input);
    void stand_on_plinth(picture::Picture& scene) const;
    void fit_into_mode(wall::StereoMode mode, SessionOrders& orders);
    void hold_governed(const SessionState& before, SessionOrders& orders);
    void carry_out(SessionOrders orders, const Give& give);
    void save(const AskedSave& wanted, const Give& give);
    [[nodiscard]] document::Content saved_content() const;
    [[nodiscard]] std::uint64_t work_state() const;
    void keep_journal(const std::string& folder);
    void note_edits(const WorldObjects* world, const Give& give);
    void tell_work();
    void publish_parameters() { hands_.publish_parameters(state_, room_, activity_); }
    void switch_amplifiers(const AskedAmplifiers& asked);
    void take(sculpt::SurfaceUpdate news);
    [[nodiscard]] bool tells_late_pictures() const { return hands().felt_by_person() || state_.head.tracked; }
    void watch(Nanoseconds time_ns);
    void watch_journal(const Give& give);
    void watch_misfit(const sculpt::Tool& tool);
    void tell_what_is_not_rendered();
    [[nodiscard]] ImageSize main_eye() const { return wall::eye_size(output_on(room_.wall.main).mode, output_.size); }

    Clock& clock_;
    Nanoseconds start_ns_ = 0;
    std::unique_ptr<WorkerPool> pool_;  // of the workpiece; null without one
    HandSide hands_;
    ActivitySide activity_;
    SceneSide scene_{hands_.all()};  // after what its parts refer to
    PanelWorkpiece workpiece_;
    LengthUnit unit_ = LengthUnit::m;   // of the workpiece's file
    bool holes_closed_ = false;         // of the workpiece's mesh
    sculpt::ToolOptions tool_options_;  // as the session began
    ToolSizeRange tool_sizes_;
    Room room_;
    SessionState state_;
    std::vector<haptics::ToolState> tools_;  // of each part, as the frame draws them
    SeenSurface seen_;                       // that the mouse points at
    Nanoseconds last_step_ns_ = 0;
    wall::OutputPlace output_;                    // of the main screen
    std::optional<wall::StereoMode> framed_;      // of the main screen, when the workpiece was last fitted into it
    ImageSize panel_output_;                      // of the panel's window; empty: there is none
    std::vector<sculpt::SurfaceUpdate> updates_;  // not drawn yet: all of them in one, or none
    std::size_t undoable_ = 0, redoable_ = 0;     // strokes, as of the last update
    std::uint64_t carved_state_ = 0;              // likewise (compute::History::state)
    Nanoseconds edits_noted_ns_ = 0;              // in the journal
    bool begins_journal_ = false;                 // with the first edit: who looks at a world alone needs none
    bool exporting_ = false;
    LivePanel panel_;
    MessageLog log_;
    AskedFiles files_;
    DocumentSide document_;
    DocumentNews news_of_document_;
    SavedWorld saved_world_;
    OpenedWork opened_;      // without its solid, once that is carved
    SculptOptions options_;  // as the session began, for documents
    SessionTimes times_{clock_};
    ComfortWatch comfort_;
    TrackerWatch tracker_;
    WandWatch wand_;
    LampWatch lamp_;
    DeviceWatch devices_;
    MisfitWatch misfit_;
    StrokeWatch strokes_;
    std::uint64_t laid_out_changes_ = 0;  // of the log, when the panel was laid out
    std::vector<EventMark> events_;       // not taken yet
    bool exchange_full_screen_ = false;
    std::optional<wall::StereoMode> refused_;  // for the recorder
    std::optional<std::uint64_t> acknowledged_;
    bool recording_ended_ = false;
};

}  // namespace burin::session
