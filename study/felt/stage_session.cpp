// SPDX-License-Identifier: MIT
#include "study/felt/stage_session.hpp"

#include <algorithm>

#include "haptics/tick_record.hpp"
#include "study/metrics/trial_metrics.hpp"

namespace burin::study {

void FeltForces::add(const haptics::TickRecord& record) {
    const double half_s = ticks > 0 ? 0.5 * seconds(record.time_ns - last_ns) : 0.0;
    const bool contact = record.in_contact(), limited = record.gate.saturated;
    const double force_N = glm::length(record.gate.given.force_device_N);
    ++ticks;
    if (contact) {
        if (contacts == 0 || seconds(record.time_ns - touched_ns) > kContactBreak_s) ++contacts;
        touched_ns = record.time_ns;
    }
    contact_s += half_s * ((was_in_contact ? 1.0 : 0.0) + (contact ? 1.0 : 0.0));
    sum_Ns += half_s * ((was_in_contact ? was_N : 0.0) + (contact ? force_N : 0.0));
    limited_s += half_s * ((was_limited ? 1.0 : 0.0) + (limited ? 1.0 : 0.0));
    largest_N = std::max(largest_N, force_N);
    largest_torque_Nm = std::max(largest_torque_Nm, glm::length(record.gate.given.torque_device_Nm));
    limited_ticks += limited ? 1 : 0;
    if (record.gate.cause != haptics::GateCause::none) {
        ++faults;
        cause = record.gate.cause;
    }
    late_ticks += (record.flags & haptics::kTickLate) != 0 ? 1 : 0;
    was_in_contact = contact;
    was_limited = limited;
    was_N = force_N;
    last_ns = record.time_ns;
}

double FeltForces::mean_N() const { return contact_s > 0.0 ? sum_Ns / contact_s : 0.0; }

StageSession::StageSession(const Protocol& protocol, const Stage& stage, const Group& group, const FeltWorld& world)
    : touch_(protocol, stage, group, world), setup_(setup_of(protocol, stage)) {}

void StageSession::follow(const haptics::TickRecord& record, OperatorAct act) {
    follow(record, sample_of(record), act);
}

void StageSession::follow(const haptics::TickRecord& record, const devices::DeviceSample& sample, OperatorAct act) {
    touch_.follow(record.time_ns, sample);
    step_on(record, sample, act);
}

devices::DeviceSample StageSession::sample_of(const haptics::TickRecord& record) const {
    const Similarity& own = touch_.parameters().workspace.object_from_device;
    const Similarity& its = record.motion.object_from_device;
    if (its == own) return record.sample;
    devices::DeviceSample sample = record.sample;
    sample.time_ns = record.time_ns;
    sample.position_device_m = sample_.position_device_m;
    sample.orientation_device = sample_.orientation_device;
    const haptics::ContactRecord& contact = record.contact;
    if (contact.point_count == 0) return sample;
    Vec3 middle_m = contact.points[0].hip_object_m;  // of a stylus that stands in for a wand
    if (contact.point_count > 1) middle_m = 0.5 * (middle_m + contact.points[1].hip_object_m);
    sample.position_device_m = touch_.place_at_device(middle_m);
    sample.orientation_device = glm::conjugate(own.orientation) * its.orientation * record.sample.orientation_device;
    return sample;
}

void StageSession::step_on(const haptics::TickRecord& record, const devices::DeviceSample& sample, OperatorAct act) {
    const Nanoseconds now_ns = record.time_ns;
    sample_ = sample;
    if (forces_.ticks == 0) begun_ns_ = now_ns;
    time_s_ = seconds(now_ns - begun_ns_);
    forces_.add(record);
    const StageTick tick{time_s_, touch_.points_m(sample), act, sample.fault != devices::DeviceFault::none};
    const StageStep stepped = step(setup_, state_, tick);
    state_ = stepped.state;
    for (std::size_t i = 0; i < stepped.event_count; ++i) events_.push_back(stepped.events[i]);
    const bool running = state_.phase == StagePhase::running;
    if (running && !was_running_) attempt_.clear();
    was_running_ = running;
    if (running)
        attempt_.push_back(
            {sample.time_ns, now_ns, sample.position_device_m, sample.orientation_device, tick.points_m});
    if (done() && state_.result != StageResult::valid_exit) attempt_.clear();
}

}  // namespace burin::study
