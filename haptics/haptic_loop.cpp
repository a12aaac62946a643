// SPDX-License-Identifier: MIT
#include "haptics/haptic_loop.hpp"

#include "haptics/channels.hpp"

#include <algorithm>

namespace burin::haptics {

TickRecord HapticLoop::step(Nanoseconds lateness_ns) noexcept {
    const Nanoseconds now_ns = clock_.now_ns();
    for (Part& part : parts_) {
        part.input = {part.device->read(), &part.channels->surface.newest(), &part.channels->parameters.newest()};
    }
    return turn(now_ns, lateness_ns);
}

TickRecord HapticLoop::repeat(const devices::DeviceSample& sample, const geometry::LocalSurface& surface,
                              const TickParameters& parameters, Nanoseconds now_ns, Nanoseconds lateness_ns) noexcept {
    return repeat(std::array{PartInput{sample, &surface, &parameters}}, now_ns, lateness_ns);
}

TickRecord HapticLoop::repeat(std::span<const PartInput> inputs, Nanoseconds now_ns, Nanoseconds lateness_ns) noexcept {
    BURIN_CHECK(inputs.size() == parts_.size());
    for (std::size_t i = 0; i < parts_.size(); ++i) parts_[i].input = inputs[i];
    return turn(now_ns, lateness_ns);
}

TickRecord HapticLoop::turn(Nanoseconds now_ns, Nanoseconds lateness_ns) noexcept {
    spread_fault();
    ++ticks_;
    if (lateness_ns > period_ns_ / 2) ++late_ticks_;
    newest_ns_ = now_ns;
    TickRecord of_first;
    double spent_ns = 0.0;
    std::size_t next_first = first_;
    for (std::size_t n = 0; n < parts_.size(); ++n) {
        const std::size_t i = in_turn(n);
        const TurnShare share = share_of(n, spent_ns, *parts_[i].input.parameters);
        const TickRecord record = tick_part(parts_[i], share, now_ns, lateness_ns);
        spent_ns += cost_ns(record.contact.work);
        const bool fell_short =
            (record.flags & (kTickHeldOver | kTickWorkLimited)) != 0 || anyone_waits(parts_[i].state.tick.probe.turns);
        if (n > 0 && fell_short && next_first == first_) next_first = i;
        if (i == 0) of_first = record;
    }
    first_ = next_first;
    return of_first;
}

TurnShare HapticLoop::share_of(std::size_t n, double spent_ns, const TickParameters& parameters) const noexcept {
    constexpr double kMostKept = 0.02;  // of the budget
    const double budget = budget_ns(parameters.work, dt_s_);
    const auto after = static_cast<double>(parts_.size() - 1 - n);
    return {.spent_ns = spent_ns,
            .held_over = n > 0 && budget - spent_ns < std::max(TurnShare::kLeast * budget, TurnShare::kLeast_ns),
            .kept_ns = std::min(after * WorkCost::kTick_ns, kMostKept * budget)};
}

// A fault of a whole device counts as one of each of its parts that has none of its own.
void HapticLoop::spread_fault() noexcept {
    using devices::DeviceFault;
    for (const Part& lost : parts_) {
        const devices::DeviceSample& sample = lost.input.sample;
        if (!sample.fault_is_of_all || sample.fault == DeviceFault::none) continue;
        for (Part& part : parts_)
            if (part.of_device == lost.of_device && part.input.sample.fault == DeviceFault::none)
                part.input.sample.fault = sample.fault;
    }
}

TickRecord HapticLoop::tick_part(Part& part, const TurnShare& share, Nanoseconds now_ns,
                                 Nanoseconds lateness_ns) noexcept {
    const auto& [sample, surface, parameters] = part.input;
    FullTick full =
        full_tick(part.state, sample, *surface, *parameters, part.device->description(), now_ns, dt_s_, share);
    TickRecord& record = full.record;
    if (sample.drive.is_one()) {
        part.law = step_local_law(part.law, record, full.next.tick, *parameters, part.device->description(), dt_s_);
        part.device->offer(part.law.law);
    }
    part.device->write(record.gate.given);
    watch_stillness(part.still, record);
    part.state = full.next;
    part.sample = sample;
    part.velocity_device_m_per_s = record.motion.velocity_device_m_per_s;

    record.tick = ticks_;
    record.lateness_ns = lateness_ns;
    if (lateness_ns > period_ns_ / 2) record.flags |= kTickLate;
    HapticChannels& channels = *part.channels;
    if (!channels.ticks.push(record)) record.flags |= kTickSampleDropped;
    channels.records.push(record);  // a full ring counts the records it refuses
    if ((record.flags & kTickLetGo) != 0) part.let_go_ns = now_ns;
    channels.tool.draft() = tool_of(record, late_ticks_, channels.ticks.refused());
    channels.tool.draft().let_go_ns = part.let_go_ns;
    channels.tool.publish();
    return record;
}

void HapticLoop::watch_stillness(Still& still, const TickRecord& tick) noexcept {
    const bool is_same = tick.gate.given.force_device_N == Vec3(0.0) && tick.gate.given.torque_device_Nm == Vec3(0.0) &&
                         tick.sample.position_device_m == still.sample.position_device_m &&
                         tick.sample.orientation_device == still.sample.orientation_device &&
                         tick.sample.buttons == still.sample.buttons && tick.sample.fault == still.sample.fault &&
                         tick.parameter_sequence == still.parameter_sequence;
    if (!is_same) still = {tick.time_ns, tick.sample, tick.parameter_sequence};
}

bool HapticLoop::is_still() const noexcept {
    for (const Part& part : parts_)
        if (newest_ns_ - part.still.since_ns < kStill_ns) return false;
    return true;
}

void HapticLoop::warm_up() noexcept { warm_up_until(INT64_MAX); }

// Parts whose turn would come after the deadline go without: a warm-up must not make the turn late.
void HapticLoop::warm_up_until(Nanoseconds deadline_ns) noexcept {
    double spent_ns = 0.0;
    for (std::size_t n = 0; n < parts_.size(); ++n) {
        const Part& part = parts_[in_turn(n)];
        const Nanoseconds now_ns = clock_.now_ns();
        if (n > 0 && now_ns >= deadline_ns) return;
        devices::DeviceSample expected = part.sample;
        expected.time_ns += period_ns_;
        expected.position_device_m += dt_s_ * part.velocity_device_m_per_s;
        const TickParameters& parameters = part.channels->parameters.newest();
        const FullTick full = full_tick(part.state, expected, part.channels->surface.newest(), parameters,
                                        part.device->description(), now_ns, dt_s_, share_of(n, spent_ns, parameters));
        warmed_up_ += full.record.contact.work.triangles_tested;
        spent_ns += cost_ns(full.record.contact.work);
    }
}

void HapticLoop::run(const std::atomic<bool>& stop, const LoopPace& pace) noexcept {
    run_ticks(UINT64_MAX, &stop, pace);
}

void HapticLoop::run_ticks(std::uint64_t count, const std::atomic<bool>* stop, const LoopPace& pace) noexcept {
    const Nanoseconds lead_ns =
        // At most a quarter, so that most of a period is sleep, however fast the device.
        std::min(pace.lead_ns, period_ns_ / 4);
    Nanoseconds deadline_ns = clock_.now_ns() + period_ns_;
    for (std::uint64_t i = 0; i < count; ++i) {
        // acquire: what the stopping thread wrote before it set `stop` is visible to whoever runs after this loop.
        if (stop != nullptr && stop->load(std::memory_order_acquire)) break;
        clock_.sleep_until(deadline_ns - lead_ns);
        if (lead_ns > 0) {
            warm_up_until(deadline_ns);
            clock_.spin_until(deadline_ns);
        }
        const Nanoseconds begin_ns = clock_.now_ns();
        const Nanoseconds lateness_ns = begin_ns - deadline_ns;
        step(lateness_ns);
        lateness_.add(lateness_ns);
        duration_.add(clock_.now_ns() - begin_ns);
        const std::uint64_t skipped = haptics::skipped_deadlines(lateness_ns, period_ns_);
        skipped_deadlines_ += skipped;
        deadline_ns += static_cast<Nanoseconds>(skipped + 1) * period_ns_;
        if (pace.rests && is_still()) deadline_ns += std::max<Nanoseconds>(kRest_ns - period_ns_, 0);
    }
    for (Part& part : parts_) part.device->write({});
}

}  // namespace burin::haptics
