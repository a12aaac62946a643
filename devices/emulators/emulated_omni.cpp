// SPDX-License-Identifier: MIT
#include "devices/emulators/emulated_omni.hpp"

#include "devices/drivers/hd_api.hpp"
#include "devices/emulators/circling_hand.hpp"

namespace burin::devices {
Result<EmulatedOmni> EmulatedOmni::create(const std::string& name, EmulatedOmniOptions options) {
    if (!name.starts_with("emulated"))
        return fail("emulated omni " + name, "has no such name", "begin it with emulated: emulated, emulated-2");
    auto memory = HdSharedMemory::create(name);
    if (!memory)
        return fail("emulated omni " + name, "cannot be made: another one may be running by this name",
                    "end that one, or choose another name: --at emulated-2");
    if (options.script.empty()) options.script = circling_hand();
    (*memory)->calibration.store(kHdCalibrated, std::memory_order_relaxed);
    return EmulatedOmni(std::move(*memory), std::move(options));
}

Vec3 EmulatedOmni::written_N() const {
    const auto force = memory_->force_N.read();
    return force ? Vec3((*force)[0], (*force)[1], (*force)[2]) : Vec3(std::numeric_limits<double>::quiet_NaN());
}

void EmulatedOmni::publish(SimulatedOmni& omni, Nanoseconds now_ns) {
    const DeviceSample sample = omni.read();
    const glm::dmat3 turn = glm::mat3_cast(sample.orientation_device);
    const Vec3 place_mm = 1000.0 * (sample.position_device_m + kMiddle_hd_m);
    std::array<double, 16> transform{};
    for (int column = 0; column < 3; ++column)
        for (int row = 0; row < 3; ++row) transform[static_cast<std::size_t>(4 * column + row)] = turn[column][row];
    for (int row = 0; row < 3; ++row) transform[static_cast<std::size_t>(12 + row)] = place_mm[row];
    transform[15] = 1.0;
    if (drill_->is_nan) transform[12] = std::numeric_limits<double>::quiet_NaN();
    memory_->transform.write(transform);
    memory_->buttons.store(sample.buttons, std::memory_order_relaxed);
    memory_->beat_ns.store(now_ns, std::memory_order_relaxed);
    // release: who sees the layout's word sees what was written before.
    memory_->magic.store(HdShared::kMagic, std::memory_order_release);
}

void EmulatedOmni::run(const std::function<bool()>& ends) {
    constexpr Nanoseconds kPeriod_ns = 1'000'000;
    MonotonicClock clock;
    auto hand = SimulatedHand::create(options_.script, HandPath::monotone_cubic);
    if (!hand) return;
    SimulatedOmni omni(std::move(*hand));
    const Nanoseconds begun_ns = clock.now_ns();
    Nanoseconds due_ns = begun_ns;
    while (!ends()) {
        due_ns = std::max(due_ns + kPeriod_ns, clock.now_ns() - 50 * kPeriod_ns);
        clock.sleep_until(due_ns);
        const Nanoseconds now_ns = clock.now_ns();
        if (drill_->is_silent || options_.silence.is_silent(seconds(now_ns - begun_ns))) continue;
        const Nanoseconds frame_ns = memory_->frame_ns.load(std::memory_order_relaxed);
        const bool is_heard = frame_ns > 0 && now_ns - frame_ns < HdShared::kSilent_ns;
        const auto force = memory_->force_N.read();
        if (!is_heard)
            omni.write({});
        else if (force)
            omni.write({Vec3((*force)[0], (*force)[1], (*force)[2]), Vec3(0.0)});
        // Before a session has opened it the hand's time stands.
        if (frame_ns > 0) omni.advance(kPeriod_ns);
        publish(omni, now_ns);
    }
}

}  // namespace burin::devices
