// SPDX-License-Identifier: MIT
// A simulated wand: a handle that is held in its middle by a scripted or a steered hand, moves and turns in six
// degrees, and is driven in three forces and in some torques.
//
// Model, in the device frame: translation as the simulated Omni's (devices/haptic/simulated_omni.hpp), and rotation
// alike, with the inertia of arm and hand the same about every axis:
//   (I_device + I_hand) w' = T_motor + K_r turn(target, handle) + B_r (w_target - w) - b_r w - Coulomb friction
// turn() is twice the sine of half the angle, along its axis. Steps of 50 us, semi-implicit Euler, damping taken
// implicitly, friction as an impulse that never reverses the motion. Only +, -, *, / and sqrt in a step.
// The workspace box ends in hard stops, and so do pitch and roll: a step that would leave them is not made. About the
// handle's own axis there is no stop.
//
// Amplifiers: they give what is written, until a force or torque along any axis exceeds its limit, or is not a number.
// Then they trip: nothing acts, every sample reports a fault, and what is written has no effect, until
// switch_amplifiers(true) after a wrench within the limits. So a driver that keeps the limits never meets them; ticks
// in which an axis was at its limit are counted for each axis. Torque about an axis without a motor has no effect.
//
// Time as SimulatedOmni: the caller moves it with advance(), or a clock is given and read() catches up with it.
// Threads: one for all, but switch_amplifiers() and tripped(), which any thread may call. After construction nothing
// allocates, locks or throws.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>

#include "devices/haptic/amplifiers.hpp"
#include "devices/haptic/simulated_omni.hpp"
#include "devices/haptic/wand_description.hpp"

namespace burin::devices {

// How often write() was given so much along an axis as the amplifiers can give, or more.
struct WandSaturation {
    std::array<std::uint64_t, 3> force{}, torque{};
};

class SimulatedWand final : public HapticDevice, public Amplifiers {
public:
    static constexpr Nanoseconds kStep_ns = 50'000;
    static constexpr Nanoseconds kMostCatchUp_ns = 100'000'000;
    // A wrench counts as at its limit this close below it: the gate keeps a rounding's distance.
    static constexpr double kAtLimit = 1.0 - 1e-9;

    // The hand's poses are in the device frame. The clock may be null, and must outlive the device. Starts at rest in
    // the hand's pose at time 0, as far as the stops allow it.
    explicit SimulatedWand(AnyHand hand, WandDescription wand = {}, Clock* clock = nullptr);
    SimulatedWand(const SimulatedWand&) = delete;
    SimulatedWand& operator=(const SimulatedWand&) = delete;

    [[nodiscard]] const DeviceDescription& description() const noexcept override { return description_; }
    [[nodiscard]] DeviceSample read() noexcept override;
    void write(const DeviceWrench& wrench) noexcept override;

    // Advances simulated time in whole steps of kStep_ns; the remainder is kept for the next call. Call it before
    // read().
    void advance(Nanoseconds dt_ns) noexcept;

    // Whether the amplifiers are off, by a trip or by hand.
    [[nodiscard]] bool tripped() const noexcept { return tripped_.load(std::memory_order_relaxed); }
    [[nodiscard]] AmplifierAnswer switch_amplifiers(bool on) noexcept override;
    [[nodiscard]] std::uint64_t trips() const noexcept { return trips_; }
    [[nodiscard]] const WandSaturation& saturation() const noexcept { return saturation_; }
    void lose_connection(bool is_lost) noexcept { is_lost_ = is_lost; }  // for tests and drills

    [[nodiscard]] const WandDescription& wand() const noexcept { return wand_; }
    // The model's true state behind the samples; a hardware driver has no such functions.
    [[nodiscard]] const Pose& true_pose_device() const noexcept { return pose_; }
    [[nodiscard]] const Vec3& true_velocity_device_m_per_s() const noexcept { return velocity_m_per_s_; }
    [[nodiscard]] const Vec3& true_turning_device_rad_per_s() const noexcept { return turning_rad_per_s_; }
    [[nodiscard]] const DeviceWrench& acting_wrench() const noexcept { return acting_; }
    [[nodiscard]] Nanoseconds time_ns() const noexcept { return time_ns_; }

private:
    struct TurnStops {
        // Of the handle's axis h: lowest <= h.z / h.y <= highest for pitch, and so for -h.x for roll.
        double lowest_pitch = 0.0, highest_pitch = 0.0, lowest_roll = 0.0, highest_roll = 0.0;
        bool pitch_stops = false, roll_stops = false;
    };
    void step() noexcept;
    void move(const HandGrip& grip, const HandTarget& target) noexcept;
    void turn(const HandGrip& grip, const HandTarget& target) noexcept;
    [[nodiscard]] bool within_stops(const Quat& orientation) const noexcept;
    void update_acting_wrench() noexcept;
    void let_motors_rest() noexcept;

    AnyHand hand_;
    WandDescription wand_;
    Clock* clock_;
    Nanoseconds clock_start_ns_ = 0;  // the clock's reading at the hand's time 0
    DeviceDescription description_;
    TurnStops stops_;
    Nanoseconds delay_ns_ = 0;
    Nanoseconds time_ns_ = 0;  // of the model and of the hand
    Nanoseconds owed_ns_ = 0;  // requested by advance() but less than a step
    Pose pose_;
    Vec3 velocity_m_per_s_{0.0}, turning_rad_per_s_{0.0};
    Quat target_{1.0, 0.0, 0.0, 0.0};  // the hand's orientation in the last step
    struct Command {
        DeviceWrench wrench;
        Nanoseconds time_ns = 0;  // of the write(), in the model's time
    };
    static constexpr std::uint32_t kCommands = 5;  // three periods of delay, and one beside
    std::array<Command, kCommands> commands_{};    // a ring buffer: the last ones may still be on their way
    std::uint32_t newest_ = 0;
    DeviceWrench acting_;  // on the motors now
    // Flags of their own, that say nothing of other memory: relaxed order is enough for all of them.
    std::atomic<bool> tripped_ = false;
    std::atomic<bool> untold_ = false;     // they were off, and no sample has said so yet
    std::atomic<bool> exceeding_ = false;  // what was written last, since they are off, is beyond a limit
    std::atomic<bool> is_lost_ = false;
    std::uint64_t trips_ = 0;
    WandSaturation saturation_;
    DeviceSample last_sample_;
};

}  // namespace burin::devices
