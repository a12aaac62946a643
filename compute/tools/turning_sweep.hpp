// SPDX-License-Identifier: MIT
// Approximates a motion that turns the tool by straight moves at fixed orientations.
//
// In each move, the middle of the tool's body goes straight from its position at the start to its position at the end,
// and the tool keeps the orientation that it has half-way. A point of the body at most r from the middle is then off
// its true path by at most r a / 2, where a is the angle of one move: the kept orientation differs from the true one by
// at most a / 2, and a chord is shorter than its arc. The middle itself is off by the sagitta of its own arc, at most c
// a^2 / 8, where c is its distance from the point that moves along a line. So the swept surface is off by at most
//   r a / 2 + c a^2 / 8,  and with n moves for an angle A in all, a = A / n:  at most (r A / 2 + c A^2 / 8) / n.
// n is the least whole number for which this is within the tolerance. Each move is swept in closed form, without
// scallops.
//
// Angles are computed without trigonometry, so that every machine makes the same moves: A from its chord, at most 11 %
// too large, and orientations on the way by halving.
#pragma once

#include <vector>

#include "base/error.hpp"
#include "compute/rays/lattice.hpp"
#include "compute/tools/tool.hpp"

namespace burin::compute {

struct StraightMove {
    Quat orientation{1.0, 0.0, 0.0, 0.0};  // lattice_from_tool
    Vec3 start{0.0}, along{0.0};           // of the tool's origin, lattice units
    // The same start in metres. If it is the start of the sweep, it is copied from there to the last digit.
    Vec3 start_object_m{0.0};
};

// The measures of a tool that decide how finely its turning is split; tool frame, lattice units.
struct Extent {
    Vec3 middle{0.0};
    double radius = 0.0;           // of a ball about the middle that contains the tool
    bool turns_on_itself = false;  // set when the tool is round about +Y
};

// Returns the moves of a sweep in order. Moves that cannot reach the lattice are left out, and the others are clipped
// to the part that can. Fails on a pose that is not finite or too far away, a tolerance outside 1/1024 to 1024 cells,
// and a motion that would take more than 4096 moves.
[[nodiscard]] Result<std::vector<StraightMove>> straight_moves(const Lattice& lattice, const ToolSweep& sweep,
                                                               const Extent& extent);

// Returns the orientation at a share (0 to 1) of an even turn about one axis, accurate to 2^-40 of the angle.
[[nodiscard]] Quat turned(const Quat& from, const Quat& to, double share);

}  // namespace burin::compute
