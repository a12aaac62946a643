// SPDX-License-Identifier: MIT
// Drives a session of any kind: one loop, which brings ticks and scene to the time of each frame and then makes it.
//
//   FrameSource   when the next frame is due, and how it is made: LiveFrames, ScriptedFrames, RecordedFrames
//                 (session_frames.hpp), and the frames of a felt stroke, which only collect figures
//   Executor      who runs the haptic ticks and the scene's updates: the caller step by step (SteppedExecutor), threads
//                 (ThreadedExecutor), or the caller as a recording says (ThreadReplay, thread_replay.hpp)
//
// Knows neither pictures nor windows. One thread calls all of it: the frame's.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "base/clock.hpp"
#include "haptics/realtime.hpp"
#include "scene/scene_thread.hpp"

namespace burin::session {

// Runs haptic ticks and updates of the scene, and exchanges with the frame what these need of each other. What parts
// have to report to the frame is collected by whoever knows them, in a call after each update (SceneThread).
class Executor {
public:
    using Order = scene::SceneThread::Order;
    using AfterUpdate = scene::SceneThread::AfterUpdate;
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

// Runs ticks and updates one after the other on the caller's thread in simulated time: a tick each period of the loop,
// and after the tick of that time an update each SceneService::kHandsMove_ns. Every run gives the same bits.
class SteppedExecutor final : public Executor {
public:
    // All must outlive it. The first tick is one period from the clock's present time.
    SteppedExecutor(SimulatedClock& clock, haptics::HapticLoop& loop, std::vector<haptics::HapticChannels*> parts,
                    scene::SceneService& service, AfterUpdate after_update = {});

    // Appends how long each tick from now on takes, in nanoseconds.
    void measure_ticks(std::vector<std::uint32_t>& durations_ns) { tick_durations_ns_ = &durations_ns; }

    [[nodiscard]] Result<void> advance_to(Nanoseconds until_ns) override;
    [[nodiscard]] std::vector<haptics::ToolState> tools() override { return newest_tools(parts_); }
    // Carries the order out at once, exports to their end, so that later orders find it complete.
    void order(Order order) override;
    // Collects once more, for orders since the last update.
    [[nodiscard]] Result<Taken> take_updates() override;

private:
    void tick();
    void collect();

    SimulatedClock& clock_;
    haptics::HapticLoop& loop_;
    std::vector<haptics::HapticChannels*> parts_;
    scene::SceneService& service_;
    AfterUpdate after_update_;
    Nanoseconds next_update_ns_;
    MonotonicClock stopwatch_;
    std::vector<std::uint32_t>* tick_durations_ns_ = nullptr;
};

// Leaves the ticks to a HapticThread in real time, and the scene to a SceneThread. Stops them in this order: haptics,
// which ends with zero force, then the scene, after the update that goes on.
class ThreadedExecutor final : public Executor {
public:
    // All must outlive it. after_update is called on the scene's thread (SceneThread).
    ThreadedExecutor(Clock& clock, haptics::HapticLoop& loop, std::vector<haptics::HapticChannels*> parts,
                     scene::SceneService& service, const haptics::LoopPace& pace, AfterUpdate after_update);
    // Without a thread for the scene: the caller's makes one update each time it has come to a frame.
    ThreadedExecutor(Clock& clock, haptics::HapticLoop& loop, std::vector<haptics::HapticChannels*> parts,
                     scene::SceneService& service);

    // Starts the threads; call it once. Returns what the system refused of real-time scheduling.
    [[nodiscard]] haptics::RealtimeNotice start();

    [[nodiscard]] Result<void> advance_to(Nanoseconds until_ns) override;
    [[nodiscard]] std::vector<haptics::ToolState> tools() override { return newest_tools(parts_); }
    void order(Order order) override;
    [[nodiscard]] Result<Taken> take_updates() override;
    void stop() override;

private:
    Clock& clock_;
    std::vector<haptics::HapticChannels*> parts_;
    haptics::HapticThread touch_;
    scene::SceneService& service_;
    std::optional<scene::SceneThread> scene_;
    std::uint64_t updates_ = 0;  // of the scene's thread, taken so far
};

}  // namespace burin::session
