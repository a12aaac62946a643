// SPDX-License-Identifier: MIT
// Who runs the ticks and the scene's updates of a session (session/drive/driver.hpp): the caller, step by step in
// simulated time, or threads in real time.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "base/clock.hpp"
#include "haptics/realtime.hpp"
#include "scene/scene_thread.hpp"
#include "session/drive/driver.hpp"

namespace burin::session {

// Runs ticks and updates one after the other on the caller's thread in simulated time: a tick each period of the loop,
// and after the tick of that time an update each SceneService::kHandsMove_ns. Every run gives the same bits.
class SteppedExecutor final : public Executor {
public:
    using AfterUpdate = scene::SceneThread::AfterUpdate;

    // All must outlive it. The first tick is one period from the clock's present time.
    SteppedExecutor(SimulatedClock& clock, haptics::HapticLoop& loop, std::vector<haptics::HapticChannels*> parts,
                    scene::SceneService& service, AfterUpdate after_update = {});

    // Appends how long each tick from now on takes, in nanoseconds.
    void measure_ticks(std::vector<std::uint32_t>& durations_ns) { tick_durations_ns_ = &durations_ns; }

    // Has the parts' reports collected after updates alone, as a thread of the scene does: a replay has no others.
    void collect_after_updates_alone() { collects_orders_ = false; }

    [[nodiscard]] Result<void> advance_to(Nanoseconds until_ns) override;
    [[nodiscard]] std::vector<haptics::ToolState> tools() override { return newest_tools(parts_); }
    // Carries the order out at once, exports to their end, so that later orders find it complete.
    void order(Order order) override;
    // Collects once more, for orders since the last update, unless updates alone are collected.
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
    bool collects_orders_ = true;
    std::uint64_t made_ = 0;                   // updates
    std::size_t orders_ = 0;                   // since the last update
    std::vector<scene::SceneUpdate> updates_;  // not taken yet
    MonotonicClock stopwatch_;
    std::vector<std::uint32_t>* tick_durations_ns_ = nullptr;
};

// Leaves the ticks to a HapticThread in real time, and the scene to a SceneThread. Stops them in this order: haptics,
// which ends with zero force, then the scene, after the update that goes on.
class ThreadedExecutor final : public Executor {
public:
    using AfterUpdate = scene::SceneThread::AfterUpdate;

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
