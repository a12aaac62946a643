// SPDX-License-Identifier: MIT
// The haptic loop: the same class in simulated time and in real time.
//
// step() does exactly this: read the device, borrow the newest surface and parameters, tick, gate, write the device,
// publish tool state, stroke sample and tick record. run() calls it at absolute deadlines one period apart.
// In simulated time: advance the clock (and the device, if it does not follow the clock) by a period and call step();
// or call run() with a SimulatedClock, which does just that.
// Thread: one at a time calls step() or run(). Neither allocates, locks, throws or opens a file.
// How late each tick began and how long it took is kept in histograms, which any thread may read while the loop runs.
// Rehearsal: a thread that has slept finds its caches cold, and a tick then takes two or three times as long. So run() wakes a little
// before the deadline, ticks once for nothing, from the sample that it expects, and spins out the rest: what the tick will
// need is at hand when the device is read, and the tick begins on the dot. tick() is pure, so nothing comes of it.
// Rest: a loop whose force nobody feels need not tick a thousand times a second while nothing happens. Where it may rest (LoopPace), it
// does so after a second in which the hand and the parameters stayed as they were and no force was given; the first change, or force,
// that it sees ends it. A loop that drives a device never rests.
// A tick that starts late is flagged and counted; deadlines that were missed altogether are skipped and counted, so
// that the loop never runs a burst of ticks to catch up.
#pragma once

#include <atomic>
#include <cstdint>

#include "haptics/channels.hpp"
#include "haptics/histogram.hpp"
#include "haptics/tick.hpp"

namespace burin {

// How run() keeps time.
struct LoopPace {
    // Before each deadline it wakes up for a rehearsal; a quarter of a period at most; 0: it does not.
    Nanoseconds lead_ns = 0;
    bool rests = false;  // only where nobody feels the force
};

class HapticLoop {
public:
    // device, clock and channels must outlive the loop. The period is 1 / device rate.
    HapticLoop(HapticDevice& device, Clock& clock, HapticChannels& channels) noexcept;

    // One tick at the clock's present time. lateness_ns is only recorded. Returns what was published as the tick
    // record.
    TickRecord step(Nanoseconds lateness_ns = 0) noexcept;
    // The next tick as another session had it: with what that read, saw and took for the time, whatever is in the channels. The rest is
    // as in step(): the same inputs give the same ticks.
    TickRecord repeat(const DeviceSample& sample, const LocalSurface& surface, const TickParameters& parameters,
                      Nanoseconds now_ns, Nanoseconds lateness_ns) noexcept;

    // The next tick as it will probably be, all of it but its effects.
    void rehearse() noexcept;

    // Wake-ups are some 50 us late on an ordinary kernel, and a tick takes 10 or 20: before a deadline this is the time for both.
    static constexpr Nanoseconds kLead_ns = 100'000;

    // Before it rests, and between ticks while it does: well below what the gate takes for a lost loop.
    static constexpr Nanoseconds kStill_ns = 1'000'000'000, kRest_ns = 14'000'000;

    // Steps at absolute deadlines, the first one period from now, until stop is true; then writes zero force.
    void run(const std::atomic<bool>& stop, const LoopPace& pace) noexcept;
    // As run(), for so many ticks at most.
    void run_ticks(std::uint64_t count, const std::atomic<bool>* stop = nullptr, const LoopPace& pace = {}) noexcept;

    [[nodiscard]] Nanoseconds period_ns() const noexcept { return period_ns_; }
    [[nodiscard]] std::uint64_t ticks() const noexcept { return ticks_; }
    [[nodiscard]] std::uint64_t late_ticks() const noexcept { return late_ticks_; }
    [[nodiscard]] std::uint64_t skipped_deadlines() const noexcept { return skipped_deadlines_; }
    // Of ticks of run() and run_ticks(): from the deadline to the tick's beginning, and from there to its end. Any thread.
    [[nodiscard]] const Histogram& lateness() const noexcept { return lateness_; }
    [[nodiscard]] const Histogram& duration() const noexcept { return duration_; }
    [[nodiscard]] const FullTickState& state() const noexcept { return state_; }

private:
    void watch_stillness(const TickRecord& tick) noexcept;
    [[nodiscard]] bool is_still() const noexcept { return newest_ns_ - still_.since_ns >= kStill_ns; }

    HapticDevice& device_;
    Clock& clock_;
    HapticChannels& channels_;
    Nanoseconds period_ns_;
    double dt_s_;
    FullTickState state_;
    DeviceSample sample_;                // the last one
    Vec3 velocity_device_m_per_s_{0.0};  // then
    std::uint64_t ticks_ = 0, late_ticks_ = 0, skipped_deadlines_ = 0;
    struct Still {
        Nanoseconds since_ns = 0;
        DeviceSample sample;
        std::uint64_t parameter_sequence = 0;
    };
    Still still_;                  // nothing else was seen since then
    Nanoseconds newest_ns_ = 0;    // of the last tick
    std::uint64_t rehearsed_ = 0;  // triangles: so that a compiler that sees everything keeps the rehearsal
    Histogram lateness_, duration_;
};

}  // namespace burin
