// SPDX-License-Identifier: MIT
// What changes under a hand that touches changes over kEase_s: the walls that its points render, their friction, and
// the force of a contact that an edit has taken away, moved or replaced.
//
//   Walls. Stiffness and damping of a point that goes on touching move linearly from what was rendered to what is now
//   asked, whatever has changed that: a material that is edited, another object, the share of the device's limit that
//   each of several points has. Where a point comes to touch while others still have more than their new shares, it
//   begins with what they leave and grows as they give way: so the sum never exceeds what the device renders.
//   Friction. Likewise, so that a stretch that friction has held is let go over the same time.
//   Force. Where the surface has changed in another way (felt no more, taken into a hand, moved, turned, scaled, gone),
//   no law leads from the old contact to the new one. The force given last is held and fades out while that of the new
//   contact fades in. The energy account bounds the one as it bounds the other (haptics/stability/energy_account.hpp).
//
// A contact that begins in free space begins with its whole wall: its force starts at 0 by itself. What makes a force
// zero for safety (haptics/stability/safety_gate.hpp) is not eased, and neither is force that is switched off.
// Frame: device. Pure; no clock, heap, lock or throw; bounded loops.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "haptics/contact/probe.hpp"
#include "haptics/forces/touch_force.hpp"
#include "haptics/stability/rendered_wall.hpp"

namespace burin::haptics {

inline constexpr double kEase_s = 0.05;
// A change below this share of the value may be faster: what drifts, such as a finger's lever as it bends, is followed
// at once, by as much a tick as a change of this share would be over kEase_s.
inline constexpr double kDrift = 0.1;

// A number that moves to its aim within kEase_s.
struct Eased {
    double value = 0.0, aim = 0.0, rate_per_s = 0.0;

    void begin(double at, double new_aim) noexcept;
    void move_to(double new_aim, double dt_s) noexcept;
};

// The wall of one point, from tick to tick.
struct EasedWall {
    Eased stiffness_N_per_m, damping_Ns_per_m;
    bool touches = false;  // in the last tick

    [[nodiscard]] CoupledWall wall() const noexcept { return {stiffness_N_per_m.value, damping_Ns_per_m.value}; }
};
using EasedWalls = std::array<EasedWall, kMostProbePoints>;

// Moves the walls of the points that touch towards what is asked of each; nothing is asked of those that do not touch.
void ease_walls(std::span<EasedWall> walls, std::span<const std::optional<CoupledWall>> asked, double dt_s) noexcept;

// The friction of one point, from tick to tick.
struct EasedFriction {
    Eased static_friction, dynamic_friction;
    // The Coulomb velocity before and after its last change, and how far friction has gone from the one to the other.
    double coulomb_from_m_per_s = 0.0, coulomb_to_m_per_s = 0.0;
    Eased coulomb_share;
    // Ticks of the contact before this one, as far as 2. A point learns in its first tick what it touches, so its
    // second begins with that friction.
    std::uint8_t ticks = 0;
};

// Moves the friction of a point towards that of the material that it touches. touched: it touched in the last tick.
[[nodiscard]] TouchMaterial with_eased_friction(EasedFriction& state, TouchMaterial material, bool touched,
                                                double dt_s) noexcept;

// Returns the cone of friction of a point whose friction has been eased (friction_at()).
[[nodiscard]] FrictionCone eased_friction_at(const EasedFriction& state, const TouchMaterial& material,
                                             double slip_speed_m_per_s) noexcept;

// What a contact gives, and what its springs store: put in by the hand, and given out by a force that fades out.
struct ContactForce {
    devices::DeviceWrench wrench;
    double stored_J = 0.0;
};

// The force of a contact, from tick to tick.
struct EasedForce {
    ContactForce last;        // of the contact, after easing
    ContactForce from;        // at the last change
    double rate_per_s = 0.0;  // at which that goes; 0: no change is under way
    double gone = 0.0;        // how much of it has
    bool again = false;       // it came while another was under way

    [[nodiscard]] bool changes() const noexcept { return rate_per_s > 0.0; }
};

// Eases the force of a contact. Where it changes again meanwhile, what comes begins a tick after what goes, so that a
// contact that changes in every tick falls silent instead of being held. changed_s: over how long, where it has changed
// in this tick; 0: it goes on.
[[nodiscard]] ContactForce eased(EasedForce& state, const ContactForce& force, double changed_s, double dt_s) noexcept;

}  // namespace burin::haptics
