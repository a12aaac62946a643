// SPDX-License-Identifier: MIT
#include "devices/served/served_arm.hpp"

#include <pthread.h>
#include <sched.h>

#include <algorithm>

namespace burin::devices {
namespace {

class ServedArm final : public HapticDevice, public DeviceMessages {
public:
    ServedArm(std::unique_ptr<ServedLink> link, const DeviceDescription& description, AnyHand hand, Clock& clock)
        : description_(description),
          link_(std::move(link)),
          exchange_(link_->exchange()),
          hand_(std::move(hand)),
          clock_(clock),
          start_ns_(clock.now_ns()) {}

    [[nodiscard]] const DeviceDescription& description() const noexcept override { return description_; }

    [[nodiscard]] DeviceSample read() noexcept override {
        now_ns_ = clock_.now_ns();
        // The mouse's way is taken from its channel and left: a person's hand leads the handle.
        static_cast<void>(target_of(hand_, seconds(now_ns_ - start_ns_)));
        const ServedState& newest = exchange_.newest();
        if (newest.time_ns != newest_.time_ns) before_ = std::exchange(newest_, newest);
        const bool is_lost = newest_.time_ns == 0 || now_ns_ - newest_.time_ns > kServedLost_ns;
        DeviceSample sample;
        sample.time_ns = now_ns_;
        sample.buttons = newest_.buttons;
        sample.fault = is_lost ? DeviceFault::disconnected : newest_.fault;
        const Pose pose = served_pose_at(before_, newest_, now_ns_ - nanoseconds(kServedTurn_s));
        sample.position_device_m = pose.position_m;
        sample.orientation_device = pose.orientation;
        sample.joints = newest_.joints;
        may_push_ = sample.fault == DeviceFault::none;
        return sample;
    }

    void write(const DeviceWrench& wrench) noexcept override {
        exchange_.command(may_push_ ? wrench : DeviceWrench{}, clock_.now_ns());
    }

    [[nodiscard]] std::vector<std::string> take_messages() override { return link_->take_messages(); }

private:
    DeviceDescription description_;
    std::unique_ptr<ServedLink> link_;
    ServedExchange& exchange_;
    AnyHand hand_;
    Clock& clock_;
    Nanoseconds start_ns_, now_ns_ = 0;
    ServedState newest_, before_;
    bool may_push_ = false;
};

class RestingArm final : public HapticDevice {
public:
    RestingArm(const DeviceDescription& description, Clock& clock) : description_(description), clock_(clock) {}
    [[nodiscard]] const DeviceDescription& description() const noexcept override { return description_; }
    [[nodiscard]] DeviceSample read() noexcept override {
        DeviceSample sample;
        sample.time_ns = clock_.now_ns();
        return sample;
    }
    void write(const DeviceWrench& /*wrench*/) noexcept override {}

private:
    DeviceDescription description_;
    Clock& clock_;
};

}  // namespace

bool ask_for_servo_priority() noexcept {
    sched_param priority{};
    priority.sched_priority = ::sched_get_priority_min(SCHED_FIFO) + 10;
    return ::pthread_setschedparam(::pthread_self(), SCHED_FIFO, &priority) == 0;
}

Pose served_pose_at(const ServedState& before, const ServedState& newest, Nanoseconds time_ns) noexcept {
    const Nanoseconds between_ns = newest.time_ns - before.time_ns;
    if (before.time_ns == 0 || between_ns <= 0 || between_ns > kServedLost_ns) return newest.pose_device;
    const double share = std::clamp(seconds(time_ns - before.time_ns) / seconds(between_ns), 0.0, 1.0);
    const Pose &from = before.pose_device, &to = newest.pose_device;
    const Quat nearer = glm::dot(from.orientation, to.orientation) < 0.0 ? -to.orientation : to.orientation;
    return {from.position_m + share * (to.position_m - from.position_m),
            glm::normalize(glm::lerp(from.orientation, nearer, share))};
}

void ServedExchange::command(const DeviceWrench& wrench, Nanoseconds now_ns) noexcept {
    wanted_.draft() = {wrench, now_ns};
    wanted_.publish();
}

DeviceWrench ServedExchange::wanted(Nanoseconds now_ns) noexcept {
    const Wanted wanted = wanted_.newest();
    const bool is_fresh = now_ns - wanted.time_ns < kServedSilent_ns;
    const bool is_sound = finite(wanted.wrench.force_device_N) && finite(wanted.wrench.torque_device_Nm);
    return is_fresh && is_sound ? wanted.wrench : DeviceWrench{};
}

DeviceDescription describe_served_arm(const char* name, const OmniModel& model, double own_delay_s) {
    DeviceDescription d;
    d.name = name;
    d.workspace_m = model.workspace_m;
    d.resolution_m = model.resolution_m;
    d.max_force_N = model.max_force_N;
    d.max_stiffness_N_per_m = model.max_stiffness_N_per_m;
    d.rate_Hz = 1.0 / kServedTurn_s;
    d.apparent_mass_kg = model.apparent_mass_kg;
    d.damping_Ns_per_m = model.damping_Ns_per_m;
    d.friction_N = model.friction_N;
    d.delay_s = kServedDelay_s + own_delay_s;
    d.watchdog_s = seconds(kServedSilent_ns);
    d.felt_by_person = true;
    return d;
}

OpenedDevice served_arm(std::unique_ptr<ServedLink> link, const DeviceDescription& description, AnyHand hand,
                        Clock& clock) {
    auto arm = std::make_unique<ServedArm>(std::move(link), description, std::move(hand), clock);
    DeviceMessages* const messages = arm.get();
    OpenedDevice opened = of_one_part(std::move(arm));
    opened.messages = messages;
    return opened;
}

OpenedDevice arm_that_rests(const DeviceDescription& description, Clock& clock) {
    return of_one_part(std::make_unique<RestingArm>(description, clock));
}

}  // namespace burin::devices
