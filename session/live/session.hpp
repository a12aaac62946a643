// SPDX-License-Identifier: MIT
// One session without a window: hands touch a scene, an activity gives that a meaning, and the work is kept. The same
// in real time and in simulated time, seen or not.
//
//   begin_step(), step() -> state                        the frame's thread
//                |-> hand, parameters                ->  the haptic loop (its own thread, or stepped)
//                |-> orders                          ->  the scene's parts (the scene's thread, or stepped)
//   what the parts report (scene_news.hpp) -> take_news() -> what is new of the carved surface
//
// It has six owners: hands, scene, activity, work, notices, and the recorder beside it (session/drive). Where a hand
// and the scene are led besides its commands is a Leader's (session/state/leader.hpp): a desk is one (desk/live). A
// driver gives it its steps (session/drive/driver.hpp).
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "session/live/activity_side.hpp"
#include "session/live/hand_side.hpp"
#include "session/live/notices.hpp"
#include "session/live/scene_side.hpp"
#include "session/live/work_side.hpp"
#include "session/options/session_setup.hpp"
#include "session/state/leader.hpp"
#include "session/state/session_room.hpp"

namespace burin::session {

class Session {
public:
    // Returns where the workpiece stands in the world at first. held: the first hand's handle; null: none.
    using Place = std::function<Similarity(const Room& room, const HeldHandle* held)>;
    // Loads and meshes the workpiece, opens the world, and the devices. Session time counts from the clock's present
    // value; the clock must outlive the session. pace: how much slower than the reference core the machine is
    // (haptics::WorkSettings); as measured where time is real (session/hands/machine_pace.hpp), as recorded in a
    // replay, and 1 where results must depend on no machine. made: the workpiece of the options, where it is ready
    // already. place: none, where the scene's frame is the world's.
    [[nodiscard]] static Result<std::unique_ptr<Session>> create(const SessionSetup& options, Clock& clock, double pace,
                                                                 std::unique_ptr<workpiece::Workpiece> made,
                                                                 const Place& place);
    [[nodiscard]] static Result<std::unique_ptr<Session>> create(const SessionSetup& options, Clock& clock);

    // ---- A step
    using Give = SceneSide::Give;
    // tools: those that the frame draws, one of each part of the hands. line: of the log that the input has come to.
    void begin_step(Nanoseconds time_ns, std::span<const haptics::ToolState> tools, std::size_t line = 0);
    struct Input {
        std::span<const InputEvent> events;
        std::size_t line = 0;     // of the log; 0: none
        bool keys_taken = false;  // by a text field
    };
    // Applies the input of the step that has begun. Orders to the scene's parts are passed to `give`.
    void step(const Input& input, Leader& leader, const Give& give);
    // Collects what the scene's parts report of the update that has just ended; returns whether it is anything. The
    // scene's thread.
    bool collect(const scene::SceneThread::Ended& update) { return scene_.news().collect(update); }
    // Takes over what the parts report at the beginning, before the scene's thread starts, and what so many of the
    // collected updates have reported. Returns what is new of the carved surface, for who shows it.
    std::optional<scene::SurfaceUpdate> take_loaded();
    std::optional<scene::SurfaceUpdate> take_news(std::uint64_t updates);
    // Ends what the scene's parts do elsewhere, takes over all that is left, and has the activity end. No thread runs
    // any more.
    void finish_scene();

    // ---- Its owners
    [[nodiscard]] SessionHands& hands() { return hands_.all(); }
    [[nodiscard]] const SessionHands& hands() const { return hands_.all(); }
    [[nodiscard]] SceneSide& scene_side() { return scene_; }
    [[nodiscard]] const SceneSide& scene_side() const { return scene_; }
    [[nodiscard]] ActivitySide& activity() { return activity_; }
    [[nodiscard]] const ActivitySide& activity() const { return activity_; }
    [[nodiscard]] WorkSide& work() { return work_; }
    [[nodiscard]] const WorkSide& work() const { return work_; }
    [[nodiscard]] Notices& notices() { return notices_; }
    [[nodiscard]] const Notices& notices() const { return notices_; }

    [[nodiscard]] const SessionState& state() const { return state_; }
    [[nodiscard]] const Room& room() const { return room_; }
    [[nodiscard]] const SessionSetup& options() const { return options_; }
    [[nodiscard]] const FoundOut& found() const { return found_; }
    [[nodiscard]] Nanoseconds start_ns() const { return time_.start_ns; }
    [[nodiscard]] Nanoseconds step_ns() const { return time_.step_ns; }  // session time of the last step
    // Returns the tools that the step has, of each part of the hands, and that of the hand in use.
    [[nodiscard]] std::span<const haptics::ToolState> tools() const { return hands_.tools(); }
    [[nodiscard]] const haptics::ToolState& tool_in_use() const { return hands_.tool_of(state_.hand); }
    // Returns the options with what the session found out in place of what they leave open: the unit of the workpiece's
    // file, the tool, and the models of devices.
    [[nodiscard]] SessionSetup settled(SessionSetup options) const;

    // ---- Shorthands
    void notify(const std::string& message, MessageKind kind = MessageKind::warning) { log().notify(message, kind); }
    void notify_of_event(const std::string& message, MessageKind kind = MessageKind::info) {
        log().notify_of_event(message, kind);
    }
    [[nodiscard]] MessageLog& log() { return notices_.log(); }
    [[nodiscard]] AskedFiles& files() { return notices_.files(); }
    [[nodiscard]] haptics::HapticLoop& loop() { return hands().loop(); }
    [[nodiscard]] haptics::HapticChannels& channels(std::size_t part = 0) { return hands().channels(part); }
    [[nodiscard]] std::vector<haptics::HapticChannels*> channels_of_parts() { return hands().channels_of_parts(); }
    [[nodiscard]] scene::SceneService& scene() { return scene_.service(); }
    // Returns the newest tool state that the haptic loop has published for the first part of the first hand.
    [[nodiscard]] const haptics::ToolState& newest_tool() { return hands().newest_tool(0); }
    // Returns what the session is to be told of its document since the last call, as inputs of the next step; nothing
    // where an input takes a user's place.
    [[nodiscard]] std::vector<CommandInput> take_told() { return work_.take_told((tool_in_use().buttons & 1u) != 0); }
    // Returns when something is to be said without input, in session time; nothing: never.
    [[nodiscard]] std::optional<Nanoseconds> changes_ns() const { return notices_.changes_ns(); }

private:
    Session(Clock& clock, const SessionSetup& options, double pace);
    [[nodiscard]] Result<void> load(std::unique_ptr<workpiece::Workpiece> made);
    [[nodiscard]] Result<void> begin(const Place& place);
    void publish_parameters() { hands_.publish_parameters(state_, room_, activity_); }
    void carry_out(SessionOrders orders, const Give& give);
    void take(const scene::SurfaceUpdate& news);
    [[nodiscard]] document::Content saved_content() const;

    // Of the session's beginning, on its clock, and of the step that has begun, since then.
    struct Time {
        Nanoseconds start_ns = 0, step_ns = 0;
        double dt_s = 0.0;  // since the step before
    };

    Clock& clock_;
    Time time_;
    SessionSetup options_;
    FoundOut found_;
    HandSide hands_;
    ActivitySide activity_;
    SceneSide scene_{hands_.all()};  // after what its parts refer to
    Notices notices_;
    WorkSide work_;
    Room room_;
    SessionState state_;
};

}  // namespace burin::session
