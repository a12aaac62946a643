// SPDX-License-Identifier: MIT
// What is kept of the ticks of a stage (study/felt/stage_session.hpp). Plain data; frame: the world's.
#pragma once

#include <array>
#include <cstdint>

#include "base/clock.hpp"
#include "base/space.hpp"
#include "haptics/stability/gate_output.hpp"

namespace burin::haptics {
struct TickRecord;  // haptics/tick_record.hpp
}  // namespace burin::haptics

namespace burin::study {

// A tick of the attempt that counts, from the start cap to the end cap.
struct AttemptTick {
    Nanoseconds sample_ns = 0, now_ns = 0;
    Vec3 position_device_m{0.0};
    Quat orientation_device{1.0, 0.0, 0.0, 0.0};
    std::array<Vec3, 2> points_m{};  // top, bottom
};

// What the hand was given over a stage. Times are those that the ticks state, whatever their rate: what begins or ends
// between two ticks lasts for half of the time between them. Contacts are episodes (study/metrics/trial_metrics.hpp).
struct FeltForces {
    std::uint64_t ticks = 0, contacts = 0, limited_ticks = 0, faults = 0, late_ticks = 0;
    double contact_s = 0.0, limited_s = 0.0;
    double sum_Ns = 0.0, largest_N = 0.0;  // of the commanded force; the sum over the time in contact
    double largest_torque_Nm = 0.0;
    haptics::GateCause cause = haptics::GateCause::none;  // of the last tick without force
    bool was_in_contact = false, was_limited = false;
    double was_N = 0.0;
    Nanoseconds last_ns = 0, touched_ns = 0;  // of the last tick, and of the last in contact

    void add(const haptics::TickRecord& record);
    [[nodiscard]] double mean_N() const;  // over the time in contact; 0 without any
};

}  // namespace burin::study
