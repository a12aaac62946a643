// SPDX-License-Identifier: MIT
// Drives a session of any kind: one loop, which brings ticks and scene to the time of each frame and then makes it.
//
//   FrameSource   when the next frame is due, and how it is made: LiveFrames, ScriptedFrames, RecordedFrames
//                 (session_frames.hpp), and those of a session that nobody sees (headless_session.hpp)
//   Executor      who runs the haptic ticks and the scene's updates: the caller step by step (SteppedExecutor), threads
//                 (ThreadedExecutor), or the caller as a recording says (ThreadReplay, thread_replay.hpp)
//
// Knows neither pictures nor windows. One thread calls all of it: the frame's.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "base/clock.hpp"
#include "base/error.hpp"
#include "haptics/tool_state.hpp"
#include "scene/scene_order.hpp"
#include "scene/scene_update.hpp"

namespace burin::haptics {
struct HapticChannels;  // haptics/channels.hpp
}  // namespace burin::haptics

namespace burin::session {

// Runs haptic ticks and updates of the scene, and exchanges with the frame what these need of each other. What parts
// have to report to the frame is collected by whoever knows them, in a call after each update (SceneThread).
class Executor {
public:
    // Carried out on the scene's thread (scene/scene_thread.hpp).
    using Order = scene::SceneOrder;
    // Updates that a frame takes.
    struct Taken {
        std::vector<scene::SceneUpdate> updates;  // since the last call, for a recording
        std::uint64_t collected = kAllCollected;  // how many of all calls after updates the frame knows the results of
    };
    static constexpr std::uint64_t kAllCollected = UINT64_MAX;
    virtual ~Executor() = default;

    // Returns when all is done that is due by this time of the clock; in real time that is when the time has come.
    // Fails when the scene does.
    [[nodiscard]] virtual Result<void> advance_to(Nanoseconds until_ns) = 0;
    // Returns the tool of each part of the hands as the present frame draws it, in the parts' order.
    [[nodiscard]] virtual std::vector<haptics::ToolState> tools() = 0;
    // Gives an order to a part of the scene, which is carried out before its next update.
    virtual void order(Order order) = 0;
    // Has the present frame take the updates that are done.
    [[nodiscard]] virtual Result<Taken> take_updates() = 0;
    // Ends the threads. What they did last is there to be taken afterwards.
    virtual void stop() {}
};

// Says when frames are due and makes them.
class FrameSource {
public:
    virtual ~FrameSource() = default;
    // Returns when the next frame is due, on the executor's clock; waits until then where input decides about it in
    // real time. Nothing: the session is over.
    [[nodiscard]] virtual std::optional<Nanoseconds> next() = 0;
    // Makes that frame; the executor has advanced to it.
    [[nodiscard]] virtual Result<void> make(Executor& executor) = 0;
};

// Returns the newest tool state of each part of the hands.
[[nodiscard]] std::vector<haptics::ToolState> newest_tools(const std::vector<haptics::HapticChannels*>& parts);

// Makes all frames, until the source has no more or something fails, and then stops the executor.
[[nodiscard]] Result<void> drive(Executor& executor, FrameSource& frames);

}  // namespace burin::session
