// SPDX-License-Identifier: MIT
#include "session/record/session_check.hpp"

#include "haptics/tick_record.hpp"

namespace burin::session {
void SessionCheck::tick(std::size_t part, const haptics::TickRecord& record) {
    Part& own = parts_[part];
    CheckSum sum(own.check);
    sum.add(static_cast<std::uint64_t>(record.time_ns));
    sum.add(static_cast<std::uint64_t>(record.sample.time_ns));
    sum.add(record.surface_sequence);
    sum.add(record.parameter_sequence);
    for (const Vec3& v :
         {record.sample.position_device_m, record.deepest().hip_object_m, record.deepest().proxy_object_m,
          record.contact.cut_object_m, record.gate.given.force_device_N, record.gate.given.torque_device_Nm})
        sum.add(v);
    sum.add(record.sample.orientation_device);
    sum.add(std::uint64_t{record.flags} << 32 | record.sample.buttons);
    own.check = sum.sum();
    own.ticks.push_back({record.tick, own.check});
}

std::uint64_t SessionCheck::Part::at(std::uint64_t tick) {
    while (ticks.size() > 1 && ticks[1].tick <= tick) ticks.pop_front();
    return !ticks.empty() && ticks.front().tick <= tick ? ticks.front().check : 0;
}

std::uint64_t SessionCheck::frame(std::span<const std::uint64_t> ticks, const StateWords& state) {
    CheckSum sum(parts_.front().at(ticks.front()));
    for (const std::uint64_t word : state) sum.add(word);
    for (std::size_t part = 1; part < parts_.size(); ++part) sum.add(parts_[part].at(ticks[part]));
    return sum.sum();
}

}  // namespace burin::session
