// SPDX-License-Identifier: MIT
// A PHANTOM Omni in software, held by a hand with a script or by one that is steered live.
//
// Model, each axis alike, in the device frame: (m_device + m_hand) a = F_motor + F_grip - b v - Coulomb friction.
// Friction holds the stylus exactly still until the other forces exceed it. Steps of 50 us, semi-implicit Euler with
// damping taken implicitly and friction as an impulse that never reverses the motion. What the device shows and does is
// what the real one does: positions in steps of the encoder, forces clamped, held between ticks, and acting one tick
// after they are written. The workspace box ends in hard stops. Constants: 162.6 x 121.9 x 71.1 mm, 3.3 N from the
// maker's data as the PowerWall paper gives it; 0.055 mm, 45 g, 0.26 N from the data sheet; 0.05 Ns/m is an assumption.
//
// Time: either the caller moves it with advance(), or a clock is given and read() catches up with it first. Both take
// the same steps, so a session in simulated time gives the same bits as a real-time one with the same ticks.
// Thread: create it anywhere, then one thread only. After create() nothing allocates, locks or throws.
#pragma once

#include <variant>

#include "devices/haptic_device.hpp"
#include "devices/simulated_hand.hpp"
#include "devices/steered_hand.hpp"

namespace burin {

struct OmniModel {
    Vec3 workspace_m{0.1626, 0.1219, 0.0711};
    double resolution_m = 0.000055;
    double apparent_mass_kg = 0.045;
    double friction_N = 0.26;
    double damping_Ns_per_m = 0.05;
    double max_force_N = 3.3;
    double max_stiffness_N_per_m = 700.0;
};

// Faults that tests and drills switch on and off.
enum class InjectedFault : std::uint8_t {
    none,
    disconnected,  // samples repeat with fault = disconnected; forces are ignored
    nan_position,  // the position reads NaN, with no fault reported
    overspeed,     // the position reads as running away at 10 m/s, with no fault reported
    frozen,        // samples repeat, time stamp included, with no fault reported
};

// Who holds the stylus.
using OmniHand = std::variant<SimulatedHand, SteeredHand>;

class SimulatedOmni final : public HapticDevice {
public:
    static constexpr Nanoseconds kStep_ns = 50'000;
    // read() catches up at most this far with its clock; beyond it the model stands still for the rest (a debugger's
    // pause must not cost thousands of steps in one tick).
    static constexpr Nanoseconds kMostCatchUp_ns = 100'000'000;

    // clock may be null: then only advance() moves time. The clock must outlive the device. Starts at rest where
    // the hand is at time 0.
    explicit SimulatedOmni(OmniHand hand, const OmniModel& model = {}, Clock* clock = nullptr);

    [[nodiscard]] const DeviceDescription& description() const noexcept override { return description_; }
    [[nodiscard]] DeviceSample read() noexcept override;
    void write(const DeviceWrench& wrench) noexcept override;  // it drives no torque

    // Moves simulated time on in whole steps of kStep_ns; what is left over is kept for the next call. Before read().
    void advance(Nanoseconds dt_ns) noexcept;

    void inject(InjectedFault fault) noexcept { injected_ = fault; }

    // The truth behind the samples, for tests and plots; a driver for hardware has nothing like it.
    [[nodiscard]] const Vec3& true_position_device_m() const noexcept { return position_m_; }
    [[nodiscard]] const Vec3& true_velocity_device_m_per_s() const noexcept { return velocity_m_per_s_; }
    [[nodiscard]] const Vec3& acting_force_device_N() const noexcept { return acting_force_N_; }
    [[nodiscard]] Nanoseconds time_ns() const noexcept { return time_ns_; }
    // Null when the hand is steered.
    [[nodiscard]] const SimulatedHand* scripted_hand() const noexcept { return std::get_if<SimulatedHand>(&hand_); }

private:
    void step() noexcept;
    [[nodiscard]] HandTarget hand_target(double time_s) noexcept;
    [[nodiscard]] const HandGrip& grip() const noexcept;
    [[nodiscard]] DeviceSample honest_sample() noexcept;

    OmniHand hand_;
    OmniModel model_;
    Clock* clock_;
    Nanoseconds clock_start_ns_ = 0;  // the clock's reading at time 0 of the hand
    DeviceDescription description_;
    Nanoseconds time_ns_ = 0;  // of the model and of the hand
    Nanoseconds owed_ns_ = 0;  // asked for by advance() but less than a step
    Vec3 position_m_{0.0}, velocity_m_per_s_{0.0};
    Vec3 written_force_N_{0.0};  // by the last write()
    Vec3 acting_force_N_{0.0};   // on the motors since the last read()
    InjectedFault injected_ = InjectedFault::none;
    DeviceSample last_sample_;
    Vec3 runaway_m_{0.0};
};

}  // namespace burin
