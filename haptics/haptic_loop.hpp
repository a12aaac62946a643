// SPDX-License-Identifier: MIT
// The haptic loop: the same class in simulated time and in real time.
//
// step() does exactly this: read the device, borrow the newest surface and parameters, tick, gate, write the device,
// publish tool state, stroke sample and tick record. run() calls it at absolute deadlines one period apart.
// In simulated time: advance the clock (and the device, if it does not follow the clock) by a period and call step();
// or call run() with a SimulatedClock, which does just that.
// Thread: one at a time calls step() or run(). Neither allocates, locks, throws or opens a file.
// The lateness and duration of each tick are counted in histograms, which any thread may read while the loop runs.
// Warm-up tick: a thread that has slept finds its caches cold, and a tick then takes two or three times as long. So
// run() wakes shortly before the deadline, computes one tick without effect from the sample that it expects, and spins
// until the deadline: the tick's data are then in the caches when the device is read, and the tick begins on time.
// tick() is pure, so the warm-up changes nothing.
// Idle: a loop whose force nobody feels need not tick a thousand times a second while nothing happens. Where LoopPace
// allows it, it slows down after a second in which the hand and the parameters stayed as they were and no force was
// given; the first change or force that it sees ends this. A loop that drives a device never idles.
// A tick that starts late is flagged and counted; deadlines that were missed altogether are skipped and counted, so
// that the loop never runs a burst of ticks to catch up.
#pragma once

#include <atomic>
#include <cstdint>

#include "haptics/channels.hpp"
#include "haptics/histogram.hpp"
#include "haptics/tick.hpp"

namespace burin::haptics {

// Timing policy of run().
struct LoopPace {
    // How long before each deadline run() wakes for a warm-up tick; a quarter of a period at most; 0: no warm-up tick.
    Nanoseconds lead_ns = 0;
    bool rests = false;  // may idle; only where nobody feels the force
};

class HapticLoop {
public:
    // device, clock and channels must outlive the loop. The period is 1 / device rate.
    HapticLoop(devices::HapticDevice& device, Clock& clock, HapticChannels& channels) noexcept;

    // Runs one tick at the clock's present time. lateness_ns is only recorded. Returns the published tick record.
    TickRecord step(Nanoseconds lateness_ns = 0) noexcept;
    // Runs the next tick with the sample, surface, parameters and time of a recorded session, whatever the channels
    // hold. Otherwise as step(): the same inputs give the same ticks.
    TickRecord repeat(const devices::DeviceSample& sample, const geometry::LocalSurface& surface,
                      const TickParameters& parameters, Nanoseconds now_ns, Nanoseconds lateness_ns) noexcept;

    // Computes the expected next tick without its effects, to warm the caches.
    void warm_up() noexcept;

    // Lead for a warm-up tick: wake-ups are some 50 us late on an ordinary kernel, and a tick takes 10 or 20 us.
    static constexpr Nanoseconds kLead_ns = 100'000;

    // Time without change before the loop idles, and its tick interval while idle: well below what the gate takes for a
    // lost loop.
    static constexpr Nanoseconds kStill_ns = 1'000'000'000, kRest_ns = 14'000'000;

    // Steps at absolute deadlines, the first one period from now, until stop is true; then writes zero force.
    void run(const std::atomic<bool>& stop, const LoopPace& pace) noexcept;
    // Like run(), for at most `count` ticks.
    void run_ticks(std::uint64_t count, const std::atomic<bool>* stop = nullptr, const LoopPace& pace = {}) noexcept;

    [[nodiscard]] Nanoseconds period_ns() const noexcept { return period_ns_; }
    [[nodiscard]] std::uint64_t ticks() const noexcept { return ticks_; }
    [[nodiscard]] std::uint64_t late_ticks() const noexcept { return late_ticks_; }
    [[nodiscard]] std::uint64_t skipped_deadlines() const noexcept { return skipped_deadlines_; }
    // Times of the ticks of run() and run_ticks(): from the deadline to the tick's beginning, and from there to its
    // end. Any thread.
    [[nodiscard]] const Histogram& lateness() const noexcept { return lateness_; }
    [[nodiscard]] const Histogram& duration() const noexcept { return duration_; }
    [[nodiscard]] const FullTickState& state() const noexcept { return state_; }

private:
    void watch_stillness(const TickRecord& tick) noexcept;
    [[nodiscard]] bool is_still() const noexcept { return newest_ns_ - still_.since_ns >= kStill_ns; }

    devices::HapticDevice& device_;
    Clock& clock_;
    HapticChannels& channels_;
    Nanoseconds period_ns_;
    double dt_s_;
    FullTickState state_;
    devices::DeviceSample sample_;       // of the last tick
    Vec3 velocity_device_m_per_s_{0.0};  // of the last tick
    std::uint64_t ticks_ = 0, late_ticks_ = 0, skipped_deadlines_ = 0;
    struct Still {
        Nanoseconds since_ns = 0;
        devices::DeviceSample sample;
        std::uint64_t parameter_sequence = 0;
    };
    Still still_;                // the state last seen to change, and when
    Nanoseconds newest_ns_ = 0;  // time of the last tick
    // Triangle count of the warm-up ticks, kept so that an optimizing compiler cannot remove them.
    std::uint64_t warmed_up_ = 0;
    Histogram lateness_, duration_;
};

}  // namespace burin::haptics
