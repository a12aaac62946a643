// SPDX-License-Identifier: MIT
#include "haptics/stability/energy_account.hpp"

#include <algorithm>
#include <cmath>

namespace burin::haptics {
namespace {

using devices::DeviceDescription;
using devices::DeviceWrench;

constexpr std::uint32_t kCommands = EnergyAccount::kCommands;

// Wrenches below this move no device; a filtered force never decays to zero altogether.
constexpr double kNoForce_N = 0.001, kNoTorque_Nm = 0.0001;

double sum_of_axes(const Vec3& v) { return std::abs(v.x) + std::abs(v.y) + std::abs(v.z); }

// Dissipation and limits of one kind of motion: translation or rotation.
struct DeviceLosses {
    double friction = 0.0, damping = 0.0, speed = 0.0, step = 0.0;
};
DeviceLosses of_translation(const PromiseLimits& promise, const DeviceDescription& device) {
    return {device.friction_N, device.damping_Ns_per_m, promise.speed_m_per_s, device.resolution_m};
}
DeviceLosses of_rotation(const PromiseLimits& promise, const DeviceDescription& device) {
    return {device.angular_friction_Nm, device.angular_damping_Nms_per_rad, promise.turn_speed_rad_per_s,
            device.orientation_step_rad};
}

// ---- What acts, and when

Nanoseconds delay_ns(const PromiseLimits& promise, const DeviceDescription& device) {
    const double most_s = EnergyAccount::kLongestDelay * promise.period_s;
    return nanoseconds(std::clamp(device.delay_s, 0.0, most_s));
}

// Calls each(from, to, wrench, before) for every piece of the time from t0 to t1 in which one wrench acts, in order;
// `before` acted until then, and is null where the piece began before t0. The next command is written at `next_ns`.
template <typename Each>
void over_pieces(const EnergyAccount& account, const PromiseLimits& promise, const DeviceDescription& device,
                 Nanoseconds t0, Nanoseconds t1, Nanoseconds next_ns, Each&& each) {
    static constexpr DeviceWrench kNone{};
    const Nanoseconds delay = delay_ns(promise, device), watchdog = nanoseconds(device.watchdog_s);
    const DeviceWrench* before = &kNone;
    const auto piece = [&](Nanoseconds from, Nanoseconds to, const DeviceWrench& wrench) {
        if (to > t0 && from < t1) each(std::max(from, t0), std::min(to, t1), wrench, from < t0 ? nullptr : before);
        before = &wrench;
    };
    for (std::uint32_t i = 1; i <= kCommands; ++i) {
        const EnergyAccount::Command& command = account.commands[(account.newest + i) % kCommands];
        const bool last = i == kCommands;
        const Nanoseconds written = last ? next_ns : account.commands[(account.newest + i + 1) % kCommands].time_ns;
        const Nanoseconds from = command.time_ns + delay, to = last ? t1 : written + delay;
        const Nanoseconds silenced = watchdog > 0 && written > command.time_ns + watchdog
                                         ? std::clamp(command.time_ns + watchdog, from, std::max(from, to))
                                         : to;
        piece(from, silenced, command.wrench);
        if (silenced < to) piece(silenced, to, kNone);
    }
}

// ---- What the read positions admit

struct StepsWay {
    double shortest = 0.0;          // at least, since the last sample
    double squares_per_time = 0.0;  // integral of v^2, at least, now that it is known
};

StepsWay follow(Path& path, const Vec3& position, Nanoseconds time_ns, double step) {
    const double half = 0.5 * std::sqrt(3.0) * step;  // half a step along each axis
    StepsWay way;
    const Vec3 away = position - path.play;
    const double distance = glm::length(away);
    if (distance > half) {
        way.shortest = distance - half;
        path.play += away * (way.shortest / distance);
    }
    const Vec3 moved = position - path.anchor;
    const double far = glm::length(moved) - 2.0 * half;
    constexpr Nanoseconds kLongest_ns = 16'000'000;
    const Nanoseconds elapsed = time_ns - path.anchor_ns;
    if (elapsed > 0 && (far >= 3.0 * step || elapsed >= kLongest_ns)) {
        if (far > 0.0) way.squares_per_time = far * far / seconds(elapsed);
        path.anchor = position;
        path.anchor_ns = time_ns;
    }
    path.at = position;
    return way;
}

void restart(Path& path, const Vec3& position, Nanoseconds time_ns) { path = {position, position, position, time_ns}; }

// Rotation vector from one orientation to the next, for small angles.
Vec3 turn_since(const Quat& from, const Quat& to) {
    Quat q = to * glm::conjugate(from);
    if (q.w < 0.0) q = -q;
    return {2.0 * q.x, 2.0 * q.y, 2.0 * q.z};
}

// What a change of the force costs where the position at that moment is uncertain: by half a step, and by as much as
// the tool can be off the straight line between two samples, `since` after the first and `until` before the second.
double uncertain_J(const Vec3& change, double way, double since_s, double until_s, const DeviceLosses& r) {
    const double mean = way / (since_s + until_s);
    const double off = std::min(std::max(0.0, r.speed - mean) * std::max(since_s, until_s),
                                (r.speed + mean) * std::min(since_s, until_s));
    return sum_of_axes(change) * 0.5 * r.step + glm::length(change) * off;
}

// ---- What a wrench may cost

// The most that a constant force takes out in the time, beyond friction and damping, at any speed up to the limit.
double loss_J(double force, double time_s, const DeviceLosses& r) {
    const double over = force - r.friction;
    if (over <= 0.0) return 0.0;
    const double v = r.damping > 0.0 ? std::min(r.speed, over / (2.0 * r.damping)) : r.speed;
    return time_s * (over - r.damping * v) * v;
}

// The greatest force for which that is at most the budget.
double most_force(double budget_J, double time_s, const DeviceLosses& r) {
    if (!(budget_J > 0.0)) return r.friction;
    if (r.damping > 0.0) {
        const double slow = 2.0 * std::sqrt(r.damping * budget_J / time_s);
        if (slow <= 2.0 * r.damping * r.speed) return r.friction + slow;
    }
    return r.friction + r.damping * r.speed + budget_J / (r.speed * time_s);
}

// The same for force and torque together; without what damping dissipates, which is on the safe side.
double most_share(double budget_J, double time_s, double force, const DeviceLosses& t, double torque,
                  const DeviceLosses& r) {
    const double rate = std::max(0.0, budget_J) / time_s;
    const double by_force = t.speed * force, by_torque = r.speed * torque;
    return std::min({(rate + t.speed * t.friction) / by_force, (rate + r.speed * r.friction) / by_torque,
                     (rate + t.speed * t.friction + r.speed * r.friction) / (by_force + by_torque)});
}

// How long a command may act, from when it begins to: until the next one does, which the device's watchdog awaits at
// most for its own time.
double longest_hold_s(const PromiseLimits& promise, const DeviceDescription& device) {
    const double hold_s = longest_gap_s(promise);
    return device.watchdog_s > 0.0 ? std::min(hold_s, device.watchdog_s) : hold_s;
}

// Whether a sample is stamped no later than the last one. A device that repeats its samples may do so for long; a stamp
// of long ago is a fault of one sample or a few, and with more in a row of a clock that was set back.
bool is_overtaken(const EnergyAccount& account, Nanoseconds time_ns) {
    constexpr Nanoseconds kLittle_ns = 100'000'000;
    constexpr std::uint32_t kMostOfLongAgo = 8;
    if (time_ns > account.time_ns) return false;
    return account.time_ns - time_ns < kLittle_ns || account.overtaken < kMostOfLongAgo;
}

bool wrenches_are_gone(const EnergyAccount& account, const PromiseLimits& promise, const DeviceDescription& device) {
    bool gone = true;
    const Nanoseconds later = account.time_ns + delay_ns(promise, device) + 1;
    over_pieces(account, promise, device, account.time_ns, later, account.time_ns,
                [&](Nanoseconds, Nanoseconds, const DeviceWrench& acting, const DeviceWrench*) {
                    gone = gone && glm::length(acting.force_device_N) <= kNoForce_N &&
                           glm::length(acting.torque_device_Nm) <= kNoTorque_Nm;
                });
    return gone;
}

}  // namespace

AccountStep count_energy(const EnergyAccount& account, const AccountInput& in, const PromiseLimits& promise,
                         const DeviceDescription& device) noexcept {
    AccountStep step{account};
    EnergyAccount& next = step.next;
    // A sample that is no newer than the last says nothing of the way since: as if it had not come. The next one that
    // is counts the whole way, with all commands that have acted on it.
    if (in.known && account.counting && is_overtaken(account, in.time_ns)) {
        ++next.overtaken;
        return step;
    }
    next.overtaken = 0;
    next.time_ns = in.time_ns;
    next.orientation_device = in.orientation_device;
    const Nanoseconds gap_ns = in.time_ns - account.time_ns;
    const bool follows = in.known && gap_ns > 0;
    const Vec3 moved = in.position_device_m - account.moved.at;
    const double way = glm::length(moved), gap_s = seconds(gap_ns);
    if (follows) step.dissipated_J = device.friction_N * way + device.damping_Ns_per_m * way * way / gap_s;
    if (!follows || !account.counting) {
        next.budget_J = 0.0;
        next.counting = in.in_contact;
        restart(next.moved, in.position_device_m, in.time_ns);
        if (in.turns) restart(next.turned, Vec3(0.0), in.time_ns);
        return step;
    }
    step.counted = true;
    const DeviceLosses t = of_translation(promise, device), r = of_rotation(promise, device);
    const Vec3 turned = in.turns ? turn_since(account.orientation_device, in.orientation_device) : Vec3(0.0);
    double charge_J = 0.0;
    over_pieces(account, promise, device, account.time_ns, in.time_ns, in.time_ns,
                [&](Nanoseconds from, Nanoseconds to, const DeviceWrench& acting, const DeviceWrench* before) {
                    const double share = seconds(to - from) / gap_s;
                    step.taken_J -= share * glm::dot(acting.force_device_N, moved);
                    step.given_by_surface_J +=
                        seconds(to - from) * glm::dot(acting.force_device_N, in.surface_velocity_device_m_per_s);
                    if (in.turns) step.taken_J -= share * glm::dot(acting.torque_device_Nm, turned);
                    if (before == nullptr) return;
                    const double since_s = seconds(from - account.time_ns), until_s = seconds(in.time_ns - from);
                    charge_J += uncertain_J(acting.force_device_N - before->force_device_N, way, since_s, until_s, t);
                    if (in.turns)
                        charge_J += uncertain_J(acting.torque_device_Nm - before->torque_device_Nm, glm::length(turned),
                                                since_s, until_s, r);
                });
    const StepsWay went = follow(next.moved, in.position_device_m, in.time_ns, t.step);
    double dissipated_J = t.friction * went.shortest + t.damping * went.squares_per_time;
    if (in.turns) {
        const StepsWay spun = follow(next.turned, account.turned.at + turned, in.time_ns, r.step);
        dissipated_J += r.friction * spun.shortest + r.damping * spun.squares_per_time;
    }
    next.budget_J += step.taken_J + dissipated_J - charge_J;
    next.budget_J += std::max(0.0, step.given_by_surface_J);
    next.counting = in.in_contact || !wrenches_are_gone(next, promise, device);
    if (!next.counting) next.budget_J = 0.0;
    return step;
}

bool can_promise(const DeviceDescription& device) noexcept {
    return device.friction_N > 0.0 || device.damping_Ns_per_m > 0.0;
}

bool rotation_is_known(const DeviceDescription& device) noexcept {
    return device.angular_friction_Nm > 0.0 || device.angular_damping_Nms_per_rad > 0.0;
}

double longest_gap_s(const PromiseLimits& promise) noexcept { return (promise.lost_ticks + 1.5) * promise.period_s; }

Affordable affordable(const EnergyAccount& account, const DeviceWrench& wrench, const PromiseLimits& promise,
                      const DeviceDescription& device, Nanoseconds now_ns) noexcept {
    const DeviceLosses t = of_translation(promise, device), r = of_rotation(promise, device);
    const bool may_turn = rotation_is_known(device);
    if (!account.counting) return {1.0, t.friction, may_turn ? r.friction : HUGE_VAL};
    const bool turns = wrench.torque_device_Nm != Vec3(0.0) && may_turn;
    // What acts until this command does, and what the uncertain position is worth to what acts now.
    const Nanoseconds begins = std::max(now_ns, account.time_ns) + delay_ns(promise, device);
    double under_way_J = 0.0, turning_J = 0.0, uncertain = 0.0;
    over_pieces(account, promise, device, account.time_ns, begins + 1, now_ns,
                [&](Nanoseconds from, Nanoseconds to, const DeviceWrench& acting, const DeviceWrench*) {
                    const double time_s = seconds(std::min(to, begins) - from);
                    under_way_J += loss_J(glm::length(acting.force_device_N), time_s, t);
                    if (may_turn) turning_J += loss_J(glm::length(acting.torque_device_Nm), time_s, r);
                    if (from == account.time_ns)
                        uncertain = 0.5 * (sum_of_axes(acting.force_device_N) * t.step +
                                           sum_of_axes(acting.torque_device_Nm) * r.step);
                });
    const double budget_J = account.budget_J - uncertain, hold_s = longest_hold_s(promise, device);
    const double wait_s = seconds(begins - account.time_ns);
    if (turns) under_way_J += turning_J;
    // The first bound is the tighter one as long as the forces under way are no greater than this one. It keeps the
    // force from alternating between what is under way and what is left.
    Affordable most;
    most.force_N = std::min(most_force(budget_J, hold_s + wait_s, t), most_force(budget_J - under_way_J, hold_s, t));
    const double force = glm::length(wrench.force_device_N);
    if (turns) {
        const double torque = glm::length(wrench.torque_device_Nm);
        most.share = std::min({1.0, most_share(budget_J, hold_s + wait_s, force, t, torque, r),
                               most_share(budget_J - under_way_J, hold_s, force, t, torque, r)});
    } else if (force > most.force_N) {
        most.share = most.force_N / force;
    }
    if (may_turn) {
        if (!turns) under_way_J += turning_J;
        const double held = glm::length(account.commands[account.newest].wrench.force_device_N);
        const double beside = std::min(most.force_N, std::max(most.share * force, held));
        most.torque_Nm = std::min(most_force(budget_J - loss_J(beside, hold_s + wait_s, t), hold_s + wait_s, r),
                                  most_force(budget_J - under_way_J - loss_J(beside, hold_s, t), hold_s, r));
    }
    return most;
}

void remember(EnergyAccount& account, const DeviceWrench& wrench, Nanoseconds now_ns) noexcept {
    account.newest = (account.newest + 1) % kCommands;
    account.commands[account.newest] = {wrench, now_ns};
}

}  // namespace burin::haptics
