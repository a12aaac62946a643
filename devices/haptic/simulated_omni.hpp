// SPDX-License-Identifier: MIT
// A simulated PHANTOM Omni, held by a scripted hand or by one that is steered live.
//
// Model, each axis alike, in the device frame: (m_device + m_hand) a = F_motor + F_grip - b v - Coulomb friction.
// Friction holds the stylus exactly still until the other forces exceed it. Steps of 50 us, semi-implicit Euler with
// damping taken implicitly and friction as an impulse that never reverses the motion. Input and output match the real
// device: positions in steps of the encoder, forces clamped, held until the next one acts, and acting a millisecond
// after they are written; an optional watchdog takes them off the motors when nothing is written any more.
// The workspace box ends in hard stops. Constants: 162.6 x 121.9 x 71.1 mm, 3.3 N from the maker's data as the
// PowerWall paper gives it; 0.055 mm, 45 g, 0.26 N from the data sheet; 0.05 Ns/m is an assumption.
//
// Time: either the caller moves it with advance(), or a clock is given and read() catches up with it first. Both take
// the same steps, so a session in simulated time gives the same bits as a real-time one with the same ticks.
// Thread: create it anywhere, then one thread only. After construction nothing allocates, locks or throws.
#pragma once

#include <array>

#include "devices/hand/any_hand.hpp"
#include "devices/haptic/haptic_device.hpp"

namespace burin::devices {

struct OmniModel {
    const char* name = "simulated PHANTOM Omni";
    Vec3 workspace_m{0.1626, 0.1219, 0.0711};
    double resolution_m = 0.000055;
    double apparent_mass_kg = 0.045;
    double friction_N = 0.26;
    double damping_Ns_per_m = 0.05;
    double max_force_N = 3.3;
    double max_stiffness_N_per_m = 700.0;
    double watchdog_s = 0.0;  // time without a write() after which the motors give nothing; 0: none, as the data sheet
};

// Returns the device as the tick sees it. The model's name must outlive the result.
[[nodiscard]] DeviceDescription description_of(const OmniModel& model) noexcept;

// Faults that tests and drills inject.
enum class InjectedFault : std::uint8_t {
    none,
    disconnected,  // samples repeat with fault = disconnected; forces are ignored
    nan_position,  // the position reads NaN, with no fault reported
    overspeed,     // the position reads as running away at 10 m/s, with no fault reported
    frozen,        // samples repeat, time stamp included, with no fault reported
};

class SimulatedOmni final : public HapticDevice {
public:
    static constexpr Nanoseconds kStep_ns = 50'000;
    static constexpr Nanoseconds kDelay_ns = 1'000'000;  // of transport
    // The longest time by which read() catches up with its clock; for the rest of a longer time the model stands still
    // (a debugger's pause must not cost thousands of steps in one tick).
    static constexpr Nanoseconds kMostCatchUp_ns = 100'000'000;

    // clock may be null: then only advance() moves time. The clock must outlive the device. Starts at rest at the
    // hand's position at time 0.
    explicit SimulatedOmni(AnyHand hand, const OmniModel& model = {}, Clock* clock = nullptr);

    [[nodiscard]] const DeviceDescription& description() const noexcept override { return description_; }
    [[nodiscard]] DeviceSample read() noexcept override;
    void write(const DeviceWrench& wrench) noexcept override;  // torque is ignored

    // Advances simulated time in whole steps of kStep_ns; the remainder is kept for the next call. Call it before
    // read().
    void advance(Nanoseconds dt_ns) noexcept;

    void inject(InjectedFault fault) noexcept { injected_ = fault; }

    // The model's true state behind the samples, for tests and plots; a hardware driver has no such functions.
    [[nodiscard]] const Vec3& true_position_device_m() const noexcept { return position_m_; }
    [[nodiscard]] const Vec3& true_velocity_device_m_per_s() const noexcept { return velocity_m_per_s_; }
    [[nodiscard]] const Vec3& acting_force_device_N() const noexcept { return acting_force_N_; }
    [[nodiscard]] Nanoseconds time_ns() const noexcept { return time_ns_; }
    // Null when the hand is steered.
    [[nodiscard]] const SimulatedHand* scripted_hand() const noexcept { return std::get_if<SimulatedHand>(&hand_); }

private:
    void step() noexcept;
    void update_acting_force() noexcept;
    [[nodiscard]] DeviceSample honest_sample() noexcept;

    AnyHand hand_;
    OmniModel model_;
    Clock* clock_;
    Nanoseconds clock_start_ns_ = 0;  // the clock's reading at the hand's time 0
    DeviceDescription description_;
    Nanoseconds time_ns_ = 0;  // of the model and of the hand
    Nanoseconds owed_ns_ = 0;  // requested by advance() but less than a step
    Vec3 position_m_{0.0}, velocity_m_per_s_{0.0};
    struct Command {
        Vec3 force_N{0.0};
        Nanoseconds time_ns = 0;  // of the write(), in the model's time
    };
    static constexpr std::uint32_t kCommands = 4;
    std::array<Command, kCommands> commands_{};  // a ring buffer: the last ones may still be on their way
    std::uint32_t newest_ = 0;
    Vec3 acting_force_N_{0.0};  // on the motors now
    InjectedFault injected_ = InjectedFault::none;
    DeviceSample last_sample_;
    Vec3 runaway_m_{0.0};
};

}  // namespace burin::devices
