// SPDX-License-Identifier: MIT
#include "devices/emulators/emulated_dhd.hpp"

#include <limits>

#include "devices/drivers/dhd_device.hpp"
#include "devices/emulators/circling_hand.hpp"
#include "devices/emulators/emulated_arm.hpp"

namespace burin::devices {

Result<EmulatedDhd> EmulatedDhd::create(const std::string& name, EmulatedDhdOptions options) {
    if (!name.starts_with("emulated"))
        return fail("emulated dhd " + name, "has no such name", "begin it with emulated: emulated, emulated-2");
    auto memory = DhdSharedMemory::create(name);
    if (!memory)
        return fail("emulated dhd " + name, "cannot be made: another one may be running by this name",
                    "end that one, or choose another name: --at emulated-2");
    if (options.script.empty()) options.script = circling_hand();
    (*memory)->type.store(options.type, std::memory_order_relaxed);
    return EmulatedDhd(std::move(*memory), std::move(options));
}

Vec3 EmulatedDhd::written_N() const {
    const auto force = memory_->force_N.read();
    // The library's x is to the user, its y to the right, its z up.
    return force ? Vec3((*force)[1], (*force)[2], (*force)[0]) : Vec3(std::numeric_limits<double>::quiet_NaN());
}

void EmulatedDhd::publish(SimulatedOmni& arm, Nanoseconds now_ns) {
    const DeviceSample sample = arm.read();
    const glm::dmat3 turn = glm::mat3_cast(sample.orientation_device);
    const Vec3& place = sample.position_device_m;
    std::array<double, 12> pose{place.z, place.x, place.y};
    // Row and column of the library's matrix are of its own axes: its axis i is the device frame's (i + 2) % 3.
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column)
            pose[static_cast<std::size_t>(3 + 3 * row + column)] = turn[(column + 2) % 3][(row + 2) % 3];
    if (drill_->is_nan) pose[0] = std::numeric_limits<double>::quiet_NaN();
    memory_->pose.write(pose);
    memory_->buttons.store(sample.buttons, std::memory_order_relaxed);
    memory_->beat(now_ns, DhdShared::kMagic);
}

void EmulatedDhd::run(const std::function<bool()>& ends) {
    auto hand = SimulatedHand::create(options_.script, HandPath::monotone_cubic);
    if (!hand) return;
    SimulatedOmni arm(std::move(*hand), omega_model());
    run_emulated_arm(
        *memory_, arm,
        {.ends = ends,
         .is_silent = [&](double time_s) { return drill_->is_silent || options_.silence.is_silent(time_s); },
         .written_N = [&] { return written_N(); },
         .publish = [&](Nanoseconds now_ns) { publish(arm, now_ns); },
         .holds_ns =
             [&] {
                 constexpr Nanoseconds kStep_ns = 125'000;
                 return watchdog() > 0 ? watchdog() * kStep_ns : std::numeric_limits<Nanoseconds>::max();
             }});
}

}  // namespace burin::devices
