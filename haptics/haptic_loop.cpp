// SPDX-License-Identifier: MIT
#include "haptics/haptic_loop.hpp"

#include <algorithm>

namespace burin::haptics {

HapticLoop::HapticLoop(devices::HapticDevice& device, Clock& clock, HapticChannels& channels) noexcept
    : device_(device),
      clock_(clock),
      channels_(channels),
      period_ns_(nanoseconds(1.0 / device.description().rate_Hz)),
      dt_s_(seconds(period_ns_)) {}

TickRecord HapticLoop::step(Nanoseconds lateness_ns) noexcept {
    const Nanoseconds now_ns = clock_.now_ns();
    const devices::DeviceSample sample = device_.read();
    const geometry::LocalSurface& surface = channels_.surface.newest();
    const TickParameters& parameters = channels_.parameters.newest();
    return repeat(sample, surface, parameters, now_ns, lateness_ns);
}

TickRecord HapticLoop::repeat(const devices::DeviceSample& sample, const geometry::LocalSurface& surface,
                              const TickParameters& parameters, Nanoseconds now_ns, Nanoseconds lateness_ns) noexcept {
    FullTick full = full_tick(state_, sample, surface, parameters, device_.description(), now_ns, dt_s_);
    TickRecord& record = full.record;
    device_.write(record.gate.given);
    watch_stillness(record);
    state_ = full.next;
    sample_ = sample;
    velocity_device_m_per_s_ = record.motion.velocity_device_m_per_s;

    record.tick = ++ticks_;
    record.lateness_ns = lateness_ns;
    if (lateness_ns > period_ns_ / 2) {
        ++late_ticks_;
        record.flags |= kTickLate;
    }
    if (!channels_.stroke.push(stroke_of(record))) record.flags |= kTickSampleDropped;
    channels_.records.push(record);  // a full ring counts the records it refuses
    channels_.tool.draft() = tool_of(record, late_ticks_, channels_.stroke.refused());
    channels_.tool.publish();
    return record;
}

void HapticLoop::watch_stillness(const TickRecord& tick) noexcept {
    const bool still = tick.gate.given.force_device_N == Vec3(0.0) && tick.gate.given.torque_device_Nm == Vec3(0.0) &&
                       tick.sample.position_device_m == still_.sample.position_device_m &&
                       tick.sample.orientation_device == still_.sample.orientation_device &&
                       tick.sample.buttons == still_.sample.buttons && tick.sample.fault == still_.sample.fault &&
                       tick.parameter_sequence == still_.parameter_sequence;
    if (!still) still_ = {tick.time_ns, tick.sample, tick.parameter_sequence};
    newest_ns_ = tick.time_ns;
}

void HapticLoop::warm_up() noexcept {
    devices::DeviceSample expected = sample_;
    expected.time_ns += period_ns_;
    expected.position_device_m += dt_s_ * velocity_device_m_per_s_;
    const FullTick full = full_tick(state_, expected, channels_.surface.newest(), channels_.parameters.newest(),
                                    device_.description(), clock_.now_ns(), dt_s_);
    warmed_up_ += full.record.contact.work.triangles_tested;
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
            warm_up();
            clock_.spin_until(deadline_ns);
        }
        const Nanoseconds begin_ns = clock_.now_ns();
        const Nanoseconds lateness_ns = begin_ns - deadline_ns;
        step(lateness_ns);
        lateness_.add(lateness_ns);
        duration_.add(clock_.now_ns() - begin_ns);
        const Nanoseconds missed = lateness_ns / period_ns_;
        skipped_deadlines_ += static_cast<std::uint64_t>(missed);
        deadline_ns += (missed + 1) * period_ns_;
        if (pace.rests && is_still()) deadline_ns += std::max<Nanoseconds>(kRest_ns - period_ns_, 0);
    }
    device_.write({});
}

}  // namespace burin::haptics
