// SPDX-License-Identifier: MIT
// A handle in a hand that does not keep still, in simulated time, with motors that a test chooses; every hand is one of
// a seed. For the taps of `burin devices test`.
// Model, in the device frame: m a = M (F - b F(t - d)) + K (target - p) + B (target' - p') less Coulomb friction: M are
// the motors (the identity: well), b is the share that the hand pushes back with after its reaction time d. Steps
// of 0.2 ms.
#pragma once

#include <array>
#include <random>
#include <vector>

#include "devices/haptic/haptic_device.hpp"

namespace burin::bench {

// Sinusoids of 0.3 to 8 Hz which together reach sway_m along each axis, a drift of up to 5 mm/s, and a tremor of 8 to
// 12 Hz and up to 0.1 mm. The softest direction has 100 to 700 N/m, the stiffest up to 3 times as much.
struct UnsteadyHand {
    static constexpr int kWaves = 4;
    struct Wave {
        double amplitude_m = 0.0, radians_per_s = 0.0, phase = 0.0;
    };
    std::array<std::array<Wave, kWaves>, 3> waves{};
    Vec3 drift_m_per_s{0.0};
    // Moves to another place, of 0.4 s each, with the least jerk (Flash and Hogan 1985).
    struct Reach {
        double begin_s = 0.0;
        Vec3 by_m{0.0};
    };
    std::vector<Reach> reaches;
    glm::dmat3 stiffness_N_per_m{1.0};
    double mass_kg = 0.1, damping_Ns_per_m = 6.0;
    double pushes_back = 0.0, reaction_s = 0.15;

    [[nodiscard]] static UnsteadyHand drawn(std::mt19937_64& random, double sway_m);
    // Adds a reach of up to most_m along each axis about every other second.
    void reach(std::mt19937_64& random, double most_m);
};

class HeldHandle final : public devices::HapticDevice {
public:
    static constexpr double kFriction_N = 0.2;

    HeldHandle(const UnsteadyHand& hand, const glm::dmat3& motors, Clock& clock);
    [[nodiscard]] const devices::DeviceDescription& description() const noexcept override { return description_; }
    [[nodiscard]] devices::DeviceSample read() noexcept override;
    void write(const devices::DeviceWrench& wrench) noexcept override;

private:
    struct Target {
        Vec3 place_m{0.0}, velocity_m_per_s{0.0};
    };
    [[nodiscard]] Target target_at(double time_s) const;
    void step(const Target& target);

    UnsteadyHand hand_;
    glm::dmat3 motors_;
    Clock& clock_;
    devices::DeviceDescription description_;
    Nanoseconds time_ns_ = 0;
    Vec3 place_m_{0.0}, velocity_m_per_s_{0.0};
    std::array<Vec3, 256> written_N_{};  // the last ones, a millisecond apart
    std::size_t writes_ = 0;
};

}  // namespace burin::bench
