// SPDX-License-Identifier: MIT
// A motion that turns the tool, as straight moves at fixed orientations.
//
// The middle of the tool's body goes straight from its place at the start to its place at the end of each move, and the tool
// keeps the orientation that it has half-way. A point of the body at most r from the middle is then off its true path by at
// most r a / 2, if a is the angle of one move: between the orientation kept and the true one lies at most half of a, and a
// chord is shorter than its arc. The middle itself is off by the sagitta of its own arc, at most c a^2 / 8, if it lies c from
// the point that moves along a line. So the swept surface is off by at most
//   r a / 2 + c a^2 / 8,  and with n moves for an angle A in all, a = A / n:  at most (r A / 2 + c A^2 / 8) / n.
// n is the least whole number for which that is within the tolerance. A move itself is swept in closed form: no scallops.
//
// Angles come without trigonometry, so that every machine makes the same moves: A from its chord, at most 11 % too large, and
// orientations on the way by halving.
#pragma once

#include <vector>

#include "base/error.hpp"
#include "compute/lattice.hpp"
#include "compute/tool.hpp"

namespace burin {

struct StraightMove {
    Quat orientation{1.0, 0.0, 0.0, 0.0};  // lattice_from_tool
    Vec3 start{0.0}, along{0.0};           // of the tool's own origin, lattice units
    Vec3 start_object_m{0.0};  // the same start; as the sweep gave it, to the last digit, if it begins there
};

// What of a tool decides how finely its turning must be split; tool frame, lattice units.
struct Extent {
    Vec3 middle{0.0};
    double radius = 0.0;           // of a ball about the middle that holds the tool
    bool turns_on_itself = false;  // the tool is round about +Y
};

// The moves of a sweep, in order; those that cannot reach the lattice are left out, and a single one is clipped to where it
// can. Fails on a pose that is not finite or too far away, on a tolerance outside 1/1024 to 1024 cells, and on a motion that
// would take more than 4096 moves.
[[nodiscard]] Result<std::vector<StraightMove>> straight_moves(const Lattice& lattice, const ToolSweep& sweep,
                                                               const Extent& extent);

// The orientation a share (0 to 1) of the way from one to another, turning evenly about one axis; to 2^-40 of the angle.
[[nodiscard]] Quat turned(const Quat& from, const Quat& to, double share);

}  // namespace burin
