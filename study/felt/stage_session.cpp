// SPDX-License-Identifier: MIT
#include "study/felt/stage_session.hpp"

#include <algorithm>

namespace burin::study {

void FeltForces::add(const haptics::TickRecord& record) {
    ++ticks;
    const bool contact = record.in_contact();
    if (contact && !was_in_contact) ++contacts;
    was_in_contact = contact;
    const double force_N = glm::length(record.gate.given.force_device_N);
    largest_N = std::max(largest_N, force_N);
    largest_torque_Nm = std::max(largest_torque_Nm, glm::length(record.gate.given.torque_device_Nm));
    if (contact) {
        ++contact_ticks;
        sum_N += force_N;
    }
    limited_ticks += record.gate.saturated ? 1 : 0;
    if (record.gate.cause != haptics::GateCause::none) {
        ++faults;
        cause = record.gate.cause;
    }
    late_ticks += (record.flags & haptics::kTickLate) != 0 ? 1 : 0;
}

double FeltForces::mean_N() const { return contact_ticks > 0 ? sum_N / static_cast<double>(contact_ticks) : 0.0; }

StageSession::StageSession(const Protocol& protocol, const Stage& stage, const Group& group, const FeltWorld& world)
    : touch_(protocol, stage, group, world), setup_(setup_of(protocol, stage)) {}

const haptics::TickRecord& StageSession::take(const devices::DeviceSample& sample, Nanoseconds now_ns,
                                              OperatorAct act) {
    const haptics::TickRecord& record = touch_.tick(sample, now_ns);
    if (step_on(record, sample, now_ns, act)) touch_.begin_at_start();
    return record;
}

void StageSession::follow(const haptics::TickRecord& record, OperatorAct act) {
    follows_ = true;
    const devices::DeviceSample sample = sample_of(record);
    touch_.follow(record.time_ns, sample);
    step_on(record, sample, record.time_ns, act);
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
    sample.orientation_device =
        glm::conjugate(own.orientation) * its.orientation * record.sample.orientation_device;
    return sample;
}

// Returns whether the start cap was touched.
bool StageSession::step_on(const haptics::TickRecord& record, const devices::DeviceSample& sample, Nanoseconds now_ns,
                           OperatorAct act) {
    sample_ = sample;
    if (forces_.ticks == 0) begun_ns_ = now_ns;
    time_s_ = seconds(now_ns - begun_ns_);
    forces_.add(record);
    const StageTick tick{time_s_, touch_.points_m(sample), act, sample.fault != devices::DeviceFault::none};
    const StageStep stepped = step(setup_, state_, tick);
    state_ = stepped.state;
    bool at_start = false;
    for (std::size_t i = 0; i < stepped.event_count; ++i) {
        events_.push_back(stepped.events[i]);
        at_start = at_start || stepped.events[i].kind == StageEventKind::start_touched;
    }
    const bool running = state_.phase == StagePhase::running;
    if (running && !was_running_) attempt_.clear();
    was_running_ = running;
    if (running)
        attempt_.push_back(
            {sample.time_ns, now_ns, sample.position_device_m, sample.orientation_device, tick.points_m});
    if (done() && state_.result != StageResult::valid_exit) attempt_.clear();
    return at_start;
}

ModelTouch touch_by_model(const Protocol& protocol, const Stage& stage, const FeltWorld& world,
                          std::span<const AttemptTick> attempt) {
    ModelTouch model;
    StageTouch touch(protocol, stage, {}, world, TouchPurpose::model);
    for (const AttemptTick& tick : attempt) {
        devices::DeviceSample sample;
        sample.time_ns = tick.sample_ns;
        sample.position_device_m = tick.position_device_m;
        sample.orientation_device = tick.orientation_device;
        const haptics::TickRecord& record = touch.tick(sample, tick.now_ns);
        for (std::size_t i = 0; i < kWandPoints; ++i) {
            const haptics::PointRecord& point = record.contact.points[i];
            const bool known = record.contact.point_count == kWandPoints;
            model.points_m[i].push_back(tick.points_m[i]);
            model.collision_points_m[i].push_back(known ? point.proxy_object_m : tick.points_m[i]);
            model.forces_N[i].push_back(known ? point.force_device_N : Vec3(0.0));
        }
    }
    return model;
}

}  // namespace burin::study
