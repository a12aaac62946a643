// SPDX-License-Identifier: MIT
// How stiff a wall may be on a device before the sampled spring gives out more energy than the device takes away.
//
// The bounds and their sources stand in the .cpp file beside their formulas. Pure; no clock, heap, lock or throw.
#pragma once

#include <cstdint>

#include "devices/haptic_device.hpp"

namespace burin {

// What bears on the limit most; the reason to show.
enum class StiffnessBound : std::uint8_t {
    none,      // the wanted stiffness is within all bounds
    sampling,  // damping and friction of the device against sampling and delay, at the contact speed it is meant for
    quantisation,  // Coulomb friction against the encoder's step: K <= 2 f_c / D
    device,        // what the device's maker says
    damping,       // the virtual damping asked for takes up what the device could take away
};

struct StiffnessLimit {
    double stiffness_N_per_m = 0.0;  // the wanted one, or the most that is allowed
    double damping_Ns_per_m = 0.0;   // likewise
    StiffnessBound bound = StiffnessBound::none;
};

struct ContactDemand {
    double stiffness_N_per_m = 0.0;
    double damping_Ns_per_m = 0.0;
    double contact_speed_m_per_s = 0.3;  // the fastest contact that shall be passive
    double filter_lag_s = 0.0;           // mean lag of a filter on the force: counts as delay
};

[[nodiscard]] StiffnessLimit limited(const ContactDemand& wanted, const DeviceDescription& device) noexcept;

// A sentence for people, of static storage.
[[nodiscard]] const char* text(StiffnessBound bound) noexcept;

}  // namespace burin
