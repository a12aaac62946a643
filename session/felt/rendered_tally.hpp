// SPDX-License-Identifier: MIT
// Sums up, over the ticks in which a point touches an object, what the object's material asks, what the device renders
// of it, and what the hand gets: the energy account may take a part of that (haptics/stability/energy_account.hpp).
// Pure; any thread.
#pragma once

#include <cstdint>

#include "haptics/tick_record.hpp"

namespace burin::session {

class RenderedTally {
public:
    // A tick in which this point touches.
    void add(const haptics::TickRecord& tick, std::uint32_t point);

    // As it was in the last tick.
    [[nodiscard]] const haptics::CoupledWall& asked() const { return asked_; }
    [[nodiscard]] const haptics::CoupledWall& rendered() const { return rendered_; }
    [[nodiscard]] haptics::StiffnessBound bound() const { return bound_; }
    // What was given, as a stiffness: the force over the depth, of both the mean.
    [[nodiscard]] double felt_N_per_m() const { return depth_sum_m_ > 0.0 ? force_sum_N_ / depth_sum_m_ : 0.0; }
    // How much of the forces the energy account has taken, from 0 to 1.
    [[nodiscard]] double energy_took() const { return wanted_sum_N_ > 0.0 ? 1.0 - force_sum_N_ / wanted_sum_N_ : 0.0; }
    // Whether that is more than the hand misses by its own motion.
    [[nodiscard]] bool is_limited_by_energy() const { return energy_took() > 0.02; }

private:
    haptics::CoupledWall asked_, rendered_;
    haptics::StiffnessBound bound_ = haptics::StiffnessBound::none;
    double force_sum_N_ = 0.0, wanted_sum_N_ = 0.0, depth_sum_m_ = 0.0;
};

// How much of a point's force the hand gets in a tick: of what the energy account affords, what the gate lets through.
[[nodiscard]] double given_share(const haptics::TickRecord& tick);

}  // namespace burin::session
