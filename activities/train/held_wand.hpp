// SPDX-License-Identifier: MIT
// A simulated wand in a hand: a device of forces and torques, pulled by the springs of a grip towards where the hand
// means to be, and by the motors towards where the haptics want it.
//
// Model, in the device frame: translation as in devices/haptic/simulated_omni.hpp, (m_device + m_hand) a = F_motor +
// F_grip - b v - Coulomb friction; rotation alike, with a torsional grip, about all axes; motors drive the axes that
// the description has a torque for. A hand that gives way holds with a share of the grip's damping alone and is led.
// Steps of kStep_ns, semi-implicit Euler with damping taken implicitly and friction as an impulse that never reverses
// the motion. A force acts from when it was written until the next. Mass, grip and friction are assumptions.
// One thread; nothing allocates, locks or throws.
#pragma once

#include "devices/hand/simulated_hand.hpp"
#include "devices/haptic/haptic_device.hpp"

namespace burin::activities {

struct TurningGrip {
    double inertia_kgm2 = 0.002;  // of the hand
    double stiffness_Nm_per_rad = 1.5, damping_Nms_per_rad = 0.06;
};

class HeldWand final : public devices::HapticDevice {
public:
    static constexpr Nanoseconds kStep_ns = 125'000;

    // Starts at rest where the hand is.
    HeldWand(const devices::DeviceDescription& description, const devices::HandTarget& start,
             const devices::HandGrip& grip = {}, const TurningGrip& turning = {});

    [[nodiscard]] const devices::DeviceDescription& description() const noexcept override { return description_; }
    // The pose in steps of the encoders, stamped with the time that advance() has reached.
    [[nodiscard]] devices::DeviceSample read() noexcept override;
    void write(const devices::DeviceWrench& wrench) noexcept override;

    // Where the hand means to be from now on; it goes on with the target's velocity.
    void hold(const devices::HandTarget& target, bool gives_way) noexcept;
    // Advances simulated time in whole steps; the rest of less than a step is left.
    void advance(Nanoseconds dt_ns) noexcept;

    [[nodiscard]] const Vec3& true_position_device_m() const noexcept { return position_m_; }

private:
    void step() noexcept;
    void step_turn() noexcept;

    devices::DeviceDescription description_;
    devices::HandTarget target_;
    devices::HandGrip grip_;
    TurningGrip turning_;
    bool gives_way_ = false;
    devices::DeviceWrench acting_;
    Nanoseconds time_ns_ = 1'000'000'000;  // a loop's clock is never 0
    Vec3 position_m_{0.0}, velocity_m_per_s_{0.0}, turn_rad_per_s_{0.0};
    Quat orientation_{1.0, 0.0, 0.0, 0.0};
};

}  // namespace burin::activities
