// SPDX-License-Identifier: MIT
// Drives a session of any kind: one loop, which brings ticks and carving to the time of each frame and then makes it.
//
//   FrameSource   when the next frame is due, and how it is made: LiveFrames, ScriptedFrames, RecordedFrames
//                 (session_frames.hpp), and the frames of a felt stroke, which only collect figures
//   Executor      who runs the haptic ticks and the carving updates: the caller step by step (SteppedExecutor), threads
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
#include "sculpt/sculpt_thread.hpp"

namespace burin::session {

// Runs haptic ticks and carving updates, and exchanges with the frame what these need of each other.
class Executor {
public:
    using Taken = sculpt::SculptThread::Taken;
    virtual ~Executor() = default;

    // Returns when all is done that is due by this time of the clock; in real time that is when the time has come.
    // Fails when carving does.
    [[nodiscard]] virtual Result<void> advance_to(Nanoseconds until_ns) = 0;
    // Returns the tool as the present frame draws it.
    [[nodiscard]] virtual const haptics::ToolState& tool() = 0;
    // Gives an order to the carving service, if there is one.
    virtual void order(sculpt::SculptOrder order) = 0;
    // Returns what the carving service has to hand over to the present frame.
    [[nodiscard]] virtual Result<Taken> take_surface_update() = 0;
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

// Makes all frames, until the source has no more or something fails, and then stops the executor.
[[nodiscard]] Result<void> drive(Executor& executor, FrameSource& frames);

// Runs ticks and updates one after the other on the caller's thread in simulated time: a tick each period of the loop,
// and after the tick of that time an update each kPeriod_ns of a SculptThread. Every run gives the same bits.
class SteppedExecutor final : public Executor {
public:
    // All must outlive it. The first tick is one period from the clock's present time.
    SteppedExecutor(SimulatedClock& clock, haptics::HapticLoop& loop, haptics::HapticChannels& channels,
                    sculpt::SculptService& service);

    // Appends how long each tick from now on takes, in nanoseconds.
    void measure_ticks(std::vector<std::uint32_t>& durations_ns) { tick_durations_ns_ = &durations_ns; }

    [[nodiscard]] Result<void> advance_to(Nanoseconds until_ns) override;
    [[nodiscard]] const haptics::ToolState& tool() override { return channels_.tool.newest(); }
    // Carries the order out at once, exports to their end, so that later orders find it complete.
    void order(sculpt::SculptOrder order) override;
    [[nodiscard]] Result<Taken> take_surface_update() override;

private:
    void tick();

    SimulatedClock& clock_;
    haptics::HapticLoop& loop_;
    haptics::HapticChannels& channels_;
    sculpt::SculptService& service_;
    Nanoseconds next_update_ns_;
    MonotonicClock stopwatch_;
    std::vector<std::uint32_t>* tick_durations_ns_ = nullptr;
};

// Leaves the ticks to a HapticThread in real time, and carving to a SculptThread. Stops them in this order: haptics,
// which ends with zero force, then carving, after the update that goes on.
class ThreadedExecutor final : public Executor {
public:
    // All must outlive it. on_update is called on the carving thread when there is something to take; it must not wait.
    ThreadedExecutor(Clock& clock, haptics::HapticLoop& loop, haptics::HapticChannels& channels,
                     sculpt::SculptService& service, const haptics::LoopPace& pace, std::function<void()> on_update);
    // Without a thread for carving: the caller's makes one update each time it has come to a frame.
    ThreadedExecutor(Clock& clock, haptics::HapticLoop& loop, haptics::HapticChannels& channels,
                     sculpt::SculptService& service);

    // Starts the threads; call it once. Returns what the system refused of real-time scheduling.
    [[nodiscard]] haptics::RealtimeNotice start();
    // Returns how long the service's updates took in which the surface changed.
    [[nodiscard]] const haptics::Histogram& update_duration() const { return carving_->update_duration(); }

    [[nodiscard]] Result<void> advance_to(Nanoseconds until_ns) override;
    [[nodiscard]] const haptics::ToolState& tool() override { return channels_.tool.newest(); }
    void order(sculpt::SculptOrder order) override;
    [[nodiscard]] Result<Taken> take_surface_update() override;
    void stop() override;

private:
    Clock& clock_;
    haptics::HapticChannels& channels_;
    haptics::HapticThread touch_;
    sculpt::SculptService& service_;
    std::optional<sculpt::SculptThread> carving_;
};

}  // namespace burin::session
