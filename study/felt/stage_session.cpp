// SPDX-License-Identifier: MIT
#include "study/felt/stage_session.hpp"

#include <algorithm>

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

namespace {

// The times at which the device was read, where it says them; those of its ticks otherwise.
std::vector<Nanoseconds> times_of(std::span<const AttemptTick> attempt) {
    std::vector<Nanoseconds> read_ns, ticked_ns;
    for (const AttemptTick& tick : attempt) {
        read_ns.push_back(tick.sample_ns);
        ticked_ns.push_back(tick.now_ns);
    }
    const bool says = std::ranges::is_sorted(read_ns) && !read_ns.empty() && read_ns.front() < read_ns.back();
    return says ? read_ns : ticked_ns;
}

// A tick between two, or one of them.
AttemptTick between(const AttemptTick& before, const AttemptTick& after, double share) {
    AttemptTick tick = before;
    if (!(share > 0.0)) return tick;
    tick.position_device_m += share * (after.position_device_m - before.position_device_m);
    tick.orientation_device = glm::slerp(before.orientation_device, after.orientation_device, share);
    return tick;
}

// The attempt a millisecond a tick, whatever its device's rate: what a wall gives depends on the period of its ticks.
std::vector<AttemptTick> every_millisecond(std::span<const AttemptTick> attempt) {
    constexpr Nanoseconds kStep_ns = 1'000'000;
    const std::vector<Nanoseconds> times_ns = times_of(attempt);
    std::vector<AttemptTick> even;
    std::size_t next = 0;  // the first tick behind the place
    for (Nanoseconds at_ns = times_ns.empty() ? 0 : times_ns.front(); next < times_ns.size(); at_ns += kStep_ns) {
        while (next < times_ns.size() && times_ns[next] <= at_ns) ++next;
        if (next == times_ns.size() && times_ns.back() < at_ns) break;
        const std::size_t last = std::min(next, times_ns.size() - 1);
        const Nanoseconds whole_ns = times_ns[last] - times_ns[next - 1];
        const double share = whole_ns > 0 ? seconds(at_ns - times_ns[next - 1]) / seconds(whole_ns) : 0.0;
        even.push_back(between(attempt[next - 1], attempt[last], share));
        even.back().sample_ns = even.back().now_ns = at_ns;
    }
    return even;
}

}  // namespace

ModelTouch touch_by_model(const Protocol& protocol, const Stage& stage, const FeltWorld& world,
                          std::span<const AttemptTick> attempt) {
    ModelTouch model;
    StageTouch touch(protocol, stage, {}, world, TouchPurpose::model);
    for (const AttemptTick& tick : every_millisecond(attempt)) {
        devices::DeviceSample sample;
        sample.time_ns = tick.sample_ns;
        sample.position_device_m = tick.position_device_m;
        sample.orientation_device = tick.orientation_device;
        const haptics::TickRecord& record = touch.tick(sample, tick.now_ns);
        const std::array<Vec3, kWandPoints> points_m = touch.points_m(sample);
        model.times_ns.push_back(tick.now_ns);
        for (std::size_t i = 0; i < kWandPoints; ++i) {
            const haptics::PointRecord& point = record.contact.points[i];
            const bool known = record.contact.point_count == kWandPoints;
            model.points_m[i].push_back(points_m[i]);
            model.collision_points_m[i].push_back(known ? point.proxy_object_m : points_m[i]);
            model.forces_N[i].push_back(known ? point.force_device_N : Vec3(0.0));
        }
    }
    return model;
}

}  // namespace burin::study
