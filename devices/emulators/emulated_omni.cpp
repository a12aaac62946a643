// SPDX-License-Identifier: MIT
#include "devices/emulators/emulated_omni.hpp"

#include <algorithm>

#include "devices/drivers/hd_api.hpp"
#include "devices/emulators/circling_hand.hpp"
#include "devices/emulators/emulated_arm.hpp"

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
    (*memory)->styles.store(kHdByInkwell, std::memory_order_relaxed);
    (*memory)->most_N.store(options.most_N, std::memory_order_relaxed);
    std::copy_n(options.model.begin(), std::min(options.model.size(), (*memory)->model.size() - 1),
                (*memory)->model.begin());
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
    memory_->beat(now_ns, HdShared::kMagic);
}

void EmulatedOmni::run(const std::function<bool()>& ends) {
    auto hand = SimulatedHand::create(options_.script, HandPath::monotone_cubic);
    if (!hand) return;
    SimulatedOmni omni(std::move(*hand));
    run_emulated_arm(
        *memory_, omni,
        {.ends = ends,
         .is_silent = [&](double time_s) { return drill_->is_silent || options_.silence.is_silent(time_s); },
         .written_N = [&] { return written_N(); },
         .publish = [&](Nanoseconds now_ns) { publish(omni, now_ns); }});
}

}  // namespace burin::devices
