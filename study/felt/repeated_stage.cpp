// SPDX-License-Identifier: MIT
#include "study/felt/repeated_stage.hpp"

#include <algorithm>

namespace burin::study {

RepeatedTouch::RepeatedTouch(const Protocol& protocol, const Stage& stage, const Group& group, const FeltWorld& world,
                             TouchPurpose purpose)
    : world_(world), touch_(protocol, stage, group, world, purpose), ticks_(touch_.device()) {
    begin_at_start();
}

const haptics::TickRecord& RepeatedTouch::tick(const devices::DeviceSample& sample, Nanoseconds now_ns) {
    touch_.lead(now_ns, ticks_.state().guidance);
    return ticks_.repeat(sample, world_.surface(), touch_.parameters(), now_ns);
}

void RepeatedTouch::begin_at_start() { ticks_.place(world_.world().spine_m.front(), world_.surface()); }

const haptics::TickRecord& RepeatedStage::take(const devices::DeviceSample& sample, Nanoseconds now_ns,
                                               OperatorAct act) {
    const haptics::TickRecord& record = touch_.tick(sample, now_ns);
    const std::size_t known = session_.events().size();
    session_.follow(record, sample, act);
    const auto news = std::span(session_.events()).subspan(known);
    if (std::ranges::find(news, StageEventKind::start_touched, &StageEvent::kind) != news.end())
        touch_.begin_at_start();
    return record;
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
    const Group nobody;
    RepeatedTouch model_touch(protocol, stage, nobody, world, TouchPurpose::model);
    for (const AttemptTick& tick : every_millisecond(attempt)) {
        devices::DeviceSample sample;
        sample.time_ns = tick.sample_ns;
        sample.position_device_m = tick.position_device_m;
        sample.orientation_device = tick.orientation_device;
        const haptics::TickRecord& record = model_touch.tick(sample, tick.now_ns);
        const std::array<Vec3, kWandPoints> points_m = model_touch.touch().points_m(sample);
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
