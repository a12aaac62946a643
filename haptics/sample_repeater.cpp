// SPDX-License-Identifier: MIT
#include "haptics/sample_repeater.hpp"

namespace burin::haptics {

const TickRecord& SampleRepeater::repeat(const devices::DeviceSample& sample, const geometry::LocalSurface& surface,
                                         const TickParameters& parameters, Nanoseconds now_ns) {
    full_ = full_tick(full_.next, sample, surface, parameters, device_, now_ns, dt_s_);
    full_.record.tick = ++ticks_;
    return full_.record;
}

void SampleRepeater::place(const Vec3& position_object_m, const geometry::LocalSurface& surface) {
    place_proxies(full_.next.tick.probe, position_object_m, surface.sequence);
}

}  // namespace burin::haptics
