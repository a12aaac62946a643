// SPDX-License-Identifier: MIT
// The haptic loop: the same class in simulated time and in real time.
//
// step() does exactly this: read the device, borrow the newest surface and parameters, tick, gate, write the device,
// publish tool state, stroke sample and tick record. run() calls it at absolute deadlines one period apart. A device of
// several parts that move by themselves (a glove's fingertips) is one loop with a list of parts, fixed when the loop is
// made. One turn reads all parts, then ticks and writes one after the other. Each has channels, state, parameters, gate
// and energy account of its own, so limits, slew and passivity hold for each. The turn's work is bounded as one tick's
// is: the parts have one period's budget among them (TurnShare). A part for which nothing is left is held over, and the
// next turn begins with the first part, after the one that this turn began with, whose work did not suffice, so that
// each gets its turn. A fault of one part gives it no force; one that it reports as its whole device's gives none to
// any part of that device, in the same turn (DeviceSample::fault_is_of_all). All others go on, those of another device
// in the loop as well. Warm-up, idling, late and skipped ticks are the turn's, and so alike for all. In
// simulated time: advance the clock (and the device, if it does not follow the clock) by a period and call step(); or
// call run() with a SimulatedClock, which does just that. Thread: one at a time calls step() or run(). Neither
// allocates, locks, throws or opens a file. The lateness and duration of each tick are counted in histograms, which any
// thread may read while the loop runs. Warm-up tick: a thread that has slept finds its caches cold, and a tick then
// takes two or three times as long. So run() wakes shortly before the deadline, computes one tick without effect from
// the sample that it expects, and spins until the deadline: the tick's data are then in the caches when the device is
// read, and the tick begins on time. tick() is pure, so the warm-up changes nothing. Idle: a loop whose force nobody
// feels need not tick a thousand times a second while nothing happens. Where LoopPace allows it, it slows down after a
// second in which the hand and the parameters stayed as they were and no force was given; the first change or force
// that it sees ends this. A loop that drives a device never idles. A tick that starts late is flagged and counted;
// deadlines that were missed altogether are skipped and counted, so that the loop never runs a burst of ticks to catch
// up.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <span>
#include <vector>

#include "base/error.hpp"
#include "haptics/histogram.hpp"
#include "haptics/local_law.hpp"
#include "haptics/tick.hpp"
#include "haptics/tick_parameters.hpp"
#include "haptics/tick_record.hpp"

namespace burin::haptics {

struct HapticChannels;  // haptics/channels.hpp

// A part of a device: what is read and written, and what the other threads exchange with it. Each has its own channels.
struct LoopPart {
    devices::HapticDevice& device;
    HapticChannels& channels;
    // The device that it is a part of, by a number of the caller's: what a part reports as the whole device's takes the
    // force off the parts of this number alone.
    std::size_t of_device = 0;
};

// What a part's tick is computed from, besides its state. The references hold for the call.
struct PartInput {
    devices::DeviceSample sample;
    const geometry::LocalSurface* surface = nullptr;
    const TickParameters* parameters = nullptr;
};

// Timing policy of run().
struct LoopPace {
    // How long before each deadline run() wakes for a warm-up tick; a quarter of a period at most; 0: no warm-up tick.
    Nanoseconds lead_ns = 0;
    bool rests = false;  // may idle; only where nobody feels the force
};

class HapticLoop {
public:
    // device, clock and channels must outlive the loop. The period is 1 / device rate.
    HapticLoop(devices::HapticDevice& device, Clock& clock, HapticChannels& channels)
        : HapticLoop(std::array{LoopPart{device, channels}}, clock) {}
    // At least one part; all of one rate. Allocates here only: in this header, so that no object that ticks can.
    HapticLoop(std::span<const LoopPart> parts, Clock& clock)
        : clock_(clock),
          period_ns_(nanoseconds(1.0 / parts.front().device.description().rate_Hz)),
          dt_s_(seconds(period_ns_)),
          parts_(parts.begin(), parts.end()) {
        for (const LoopPart& part : parts)
            BURIN_CHECK(part.device.description().rate_Hz == parts.front().device.description().rate_Hz);
    }

    // Runs one turn at the clock's present time: a tick of each part. lateness_ns is only recorded. Returns the first
    // part's tick record as published; those of the others are in their channels.
    TickRecord step(Nanoseconds lateness_ns = 0) noexcept;
    // Runs the next tick with the sample, surface, parameters and time of a recorded session, whatever the channels
    // hold. Otherwise as step(): the same inputs give the same ticks.
    TickRecord repeat(const devices::DeviceSample& sample, const geometry::LocalSurface& surface,
                      const TickParameters& parameters, Nanoseconds now_ns, Nanoseconds lateness_ns) noexcept;
    // Likewise for all parts, in their order.
    TickRecord repeat(std::span<const PartInput> inputs, Nanoseconds now_ns, Nanoseconds lateness_ns) noexcept;

    // Computes the expected next tick of all parts without its effects, to warm the caches.
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
    [[nodiscard]] std::size_t parts() const noexcept { return parts_.size(); }
    [[nodiscard]] const FullTickState& state(std::size_t part = 0) const noexcept { return parts_[part].state; }

private:
    struct Still {
        Nanoseconds since_ns = 0;
        devices::DeviceSample sample;
        std::uint64_t parameter_sequence = 0;
    };
    struct Part {
        explicit Part(const LoopPart& part)
            : device(&part.device), channels(&part.channels), of_device(part.of_device) {}
        devices::HapticDevice* device;
        HapticChannels* channels;
        std::size_t of_device;
        FullTickState state;
        PartInput input;                    // of this turn
        devices::DeviceSample sample;       // of the last tick
        Vec3 velocity_device_m_per_s{0.0};  // of the last tick
        Still still;                        // the state last seen to change, and when
        LocalLawState law;                  // offered to a part that drives one way
        Nanoseconds let_go_ns = 0;          // when the watch last let the hand go
    };

    TickRecord turn(Nanoseconds now_ns, Nanoseconds lateness_ns) noexcept;
    TickRecord tick_part(Part& part, const TurnShare& share, Nanoseconds now_ns, Nanoseconds lateness_ns) noexcept;
    // The share of the n-th part of this turn, after what those before it have spent.
    [[nodiscard]] TurnShare share_of(std::size_t n, double spent_ns, const TickParameters& parameters) const noexcept;
    // The part that is ticked as the n-th of this turn.
    [[nodiscard]] std::size_t in_turn(std::size_t n) const noexcept { return (first_ + n) % parts_.size(); }
    void spread_fault() noexcept;
    void warm_up_until(Nanoseconds deadline_ns) noexcept;
    static void watch_stillness(Still& still, const TickRecord& tick) noexcept;
    [[nodiscard]] bool is_still() const noexcept;

    Clock& clock_;
    Nanoseconds period_ns_;
    double dt_s_;
    std::vector<Part> parts_;
    std::size_t first_ = 0;  // the part with which the next turn begins
    std::uint64_t ticks_ = 0, late_ticks_ = 0, skipped_deadlines_ = 0;
    Nanoseconds newest_ns_ = 0;  // time of the last tick
    // Triangle count of the warm-up ticks, kept so that an optimizing compiler cannot remove them.
    std::uint64_t warmed_up_ = 0;
    Histogram lateness_, duration_;
};

}  // namespace burin::haptics
