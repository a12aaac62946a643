// SPDX-License-Identifier: MIT
// A piece that is turned under a tool, against the same piece standing: a ball of 60 mm that another hand turns about
// its middle, whose mapping a session publishes sixty times a second, and a hand that stays where it is, a millimetre
// deep. Right is the force of the standing piece along its normal, and beside it what friction holds. Tests and the
// bench share the scene. In simulated time: the same figures on every machine.
#pragma once

#include <cstdint>

#include "bench/haptics/carving_hand.hpp"

namespace burin::bench {

struct Turning {
    double speed_deg_per_s = 0.0;  // 0: the piece stands
    bool friction = true;          // of the medium material
    bool follows = true;           // false: each mapping is set anew, as one that a command has placed
    double stops_after_s = 1e9;    // after so long it stands again
    bool along = false;            // the hand goes along with the piece once it turns, as one that friction has taken
};

struct TurnedUnder {
    // Along the normal, as given to the device: while it turns, and afterwards.
    double mean_N = 0.0, least_N = 0.0, most_N = 0.0;
    // Of the force that friction adds beside it: over the normal's in the last tick; the most while it turns; and how
    // much of it is along the surface's motion.
    double last_beside = 0.0, most_beside = 0.0, last_along = 0.0;
    double dynamic_friction = 0.0;
    double most_beyond_rad = 0.0;  // how far the piece was felt beyond where it had been published
    double late_rad = 0.0;         // how far behind at the end
    double moved_m = 0.0;          // of what touches, on the piece, in the last half
    std::uint64_t ticks = 0, limited = 0, let_go = 0, set_anew = 0;
};

// Lets the hand rest, turns the piece for a second, and for half a second more where it stops.
[[nodiscard]] TurnedUnder turn_under(const compute::ToolShape& tool, const Turning& turning);

}  // namespace burin::bench
