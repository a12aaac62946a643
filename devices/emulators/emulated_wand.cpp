// SPDX-License-Identifier: MIT
#include "devices/emulators/emulated_wand.hpp"

#include <signal.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "devices/served/served_arm.hpp"

namespace burin::devices {
namespace {

WandAxis axis_in_mechanism(const WandDescription& wand, const Pose& device_from_handle) {
    const Pose to_device = device_from_maker(wand);
    const Quat back = glm::conjugate(to_device.orientation);
    return {back * (device_from_handle.position_m - to_device.position_m),
            back * (device_from_handle.orientation * Vec3(0.0, 1.0, 0.0))};
}

// The jig as the joints have it, which the description gives in round numbers.
Pose jig_of(const WandDescription& wand) {
    const auto tips = wand_tips(wand.mechanism.arm, wand.mechanism.jig_rad);
    return {tips ? device_from_maker(wand) * wand_axis(*tips).middle_m : Vec3(0.0), Quat(1.0, 0.0, 0.0, 0.0)};
}

// The usual script, for an hour: out of the jig, then round and round in the plane that faces the user.
std::vector<HandPose> circling(const Pose& jig) {
    constexpr double kRest_s = 2.0, kOut_s = 2.0, kCircle_s = 6.0, kStep_s = 0.25, kRadius_m = 0.06, kNod_rad = 0.3;
    const Quat upright(1.0, 0.0, 0.0, 0.0);
    std::vector<HandPose> script{{0.0, jig.position_m, upright, 0}, {kRest_s, jig.position_m, upright, 0}};
    for (double time_s = kRest_s + kOut_s; time_s < EmulatedWand::kScript_s; time_s += kStep_s) {
        const double turn = 2.0 * std::numbers::pi * (time_s - kRest_s - kOut_s) / kCircle_s;
        script.push_back({time_s, kRadius_m * Vec3(std::cos(turn), std::sin(turn), 0.0),
                          glm::angleAxis(kNod_rad * std::sin(0.5 * turn), Vec3(1.0, 0.0, 0.0)), 0});
    }
    return script;
}

}  // namespace

Result<EmulatedWand> EmulatedWand::create(const std::string& name, EmulatedWandOptions options) {
    if (!name.starts_with("emulated"))
        return fail("emulated wand " + name, "has no such name", "begin it with emulated: emulated, emulated-2");
    auto memory = HilSharedMemory::create(name);
    if (!memory)
        return fail("emulated wand " + name, "cannot be made: another one may be running by this name",
                    "end that one, or choose another name: --at emulated-2");
    if (options.script.empty()) options.script = circling(jig_of(wand()));
    return EmulatedWand(std::move(*memory), std::move(options));
}

void EmulatedWand::lose_counts() {
    if (const auto counts = memory_->encoder_counts.read()) memory_->zero_counts.write(*counts);
}

WandJoints EmulatedWand::volts() const {
    const bool are_off = memory_->takes_off != 0 && memory_->has_expired(MonotonicClock().now_ns());
    return are_off ? WandJoints{} : memory_->volts.read().value_or(WandJoints{});
}

DeviceWrench EmulatedWand::acting() const {
    const auto w = drill_->acting.read().value_or(std::array<double, 6>{});
    return {Vec3(w[0], w[1], w[2]), Vec3(w[3], w[4], w[5])};
}

// A card holds what was written to it for ever, as long as its watchdog does not take it off.
DeviceWrench EmulatedWand::wrench_of_volts(const Pose& device_from_handle) const {
    const WandJoints at_motors = volts();
    if (at_motors == WandJoints{} || !are_amplifiers_on()) return {};
    const WandAxis axis = axis_in_mechanism(wand_, device_from_handle);
    const auto joints = wand_joints(wand_.mechanism.arm, axis);
    const auto jacobian = joints ? wand_jacobian(wand_.mechanism.arm, *joints) : std::nullopt;
    const auto force =
        jacobian ? force_of(wand_.mechanism.arm, axis, *jacobian, torques_of_volts(wand_.mechanism, at_motors))
                 : std::nullopt;
    if (!force) return {};
    const Quat turn = device_from_maker(wand_).orientation;
    return {turn * force->force_N, turn * force->torque_Nm};
}

void EmulatedWand::publish(const Pose& device_from_handle, Nanoseconds now_ns) {
    // A hand that would take the handle where no linkage reaches finds its end there: it stays where it was.
    if (const auto joints = wand_joints(wand_.mechanism.arm, axis_in_mechanism(wand_, device_from_handle))) {
        std::array<double, 6> counts = counts_of_joints(wand_.mechanism, *joints);
        counts[0] += drill_->miscount.load(std::memory_order_relaxed);
        memory_->encoder_counts.write(counts);
    }
    memory_->beat(now_ns, HilShared::kMagic);
}

void EmulatedWand::run(const std::function<bool()>& ends) {
    static_cast<void>(ask_for_servo_priority());
    constexpr Nanoseconds kPeriod_ns = 1'000'000;
    MonotonicClock clock;
    const auto hand = SimulatedHand::create(options_.script, HandPath::monotone_cubic);
    if (!hand) return;
    std::optional<SimulatedWand> wand;
    wand.emplace(*hand, wand_);
    const Nanoseconds begun_ns = clock.now_ns();
    Nanoseconds due_ns = begun_ns;
    while (!ends()) {
        due_ns = std::max(due_ns + kPeriod_ns, clock.now_ns() - 50 * kPeriod_ns);
        clock.sleep_until(due_ns);
        const Nanoseconds now_ns = clock.now_ns();
        if (drill_->is_silent || options_.silence.is_silent(seconds(now_ns - begun_ns))) {
            memory_->pull_cable();
            continue;
        }
        // A session whose process has ended leaves the handle to whoever puts it back into the jig.
        const std::uint32_t opener = memory_->opener.load(std::memory_order_relaxed);
        if (opener != 0 && ::kill(static_cast<pid_t>(opener), 0) != 0) {
            memory_->opener.store(0, std::memory_order_relaxed);
            wand.emplace(*hand, wand_);
        }
        const Pose pose = wand->true_pose_device();
        const DeviceWrench wrench = wrench_of_volts(pose);
        wand->write(wrench);
        drill_->has_tripped = wand->trips() > 0;
        drill_->acting.write({wrench.force_device_N.x, wrench.force_device_N.y, wrench.force_device_N.z,
                              wrench.torque_device_Nm.x, wrench.torque_device_Nm.y, wrench.torque_device_Nm.z});
        // The hand keeps the handle in its jig until the counters have been set there: a busy machine may take long.
        if (opener != 0 && memory_->setter.load(std::memory_order_relaxed) == opener) wand->advance(kPeriod_ns);
        publish(wand->true_pose_device(), now_ns);
    }
    memory_->pull_cable();
}

}  // namespace burin::devices
