// SPDX-License-Identifier: MIT
#include "session/felt/rendered_tally.hpp"

namespace burin::session {

void RenderedTally::add(const haptics::TickRecord& tick, std::uint32_t point) {
    const haptics::PointRecord& of = tick.contact.points[point];
    asked_ = of.asked;
    rendered_ = of.rendered;
    bound_ = tick.contact.stiffness_bound;
    const double force_N = glm::length(of.force_device_N);
    force_sum_N_ += tick.passivity.share * force_N;
    wanted_sum_N_ += force_N;
    depth_sum_m_ += of.penetration_m / tick.motion.object_from_device.scale;
}

double given_share(const haptics::TickRecord& tick) {
    const double wanted_N = glm::length(tick.wanted.force_device_N);
    const double given_N = glm::length(tick.gate.given.force_device_N);
    const double passed = wanted_N > given_N ? given_N / wanted_N : 1.0;
    return tick.passivity.share * passed;
}

}  // namespace burin::session
