// SPDX-License-Identifier: MIT
// Bounds how far the moves of a convex tool reach in a direction. A bound costs far less than the section of a ray with
// a swept piece (convex_sweep.hpp), and tells which sections need not be computed.
//
// The pieces of one move are slices of one round tool, stacked along its axis, or a single box. What a move sweeps is
// convex, and lies in n.x <= reach(n) for every direction n. So does what the sections say of it, but for rounding and
// the slack at corners: a section never leaves the swept tool by more than margin() lattice units.
//
// Lattice axes and units. Immutable; any thread.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "compute/tools/convex_pieces.hpp"

namespace burin::compute {

class MoveBounds {
public:
    // `pieces` holds the same number of pieces for each move, as append_pieces makes them, move after move.
    MoveBounds(std::span<const ConvexPiece> pieces, std::size_t pieces_a_move);

    [[nodiscard]] std::size_t moves() const { return moves_.size(); }
    [[nodiscard]] double margin() const { return margin_; }

    // Tells whether a ray comes so near to a piece's box that the piece may meet it. Pieces are counted over all moves.
    [[nodiscard]] bool is_near(std::size_t piece, int axis, double u, double v) const {
        const Box& box = boxes_[piece];
        const int along_u = (axis + 1) % 3, along_v = (axis + 2) % 3;
        return u >= box.lo[along_u] && u <= box.hi[along_u] && v >= box.lo[along_v] && v <= box.hi[along_v];
    }

    // Returns an upper bound of |reach(to, n) - reach(from, n)| for n of length 1; from <= to.
    [[nodiscard]] double way(std::size_t from, std::size_t to) const { return moves_[to].way - moves_[from].way; }

    // A direction in terms of the tool, which are the same in every move, and how far the tool at rest reaches in it
    // from its base.
    struct ToolDirection {
        Vec3 n{0.0};                      // in the move that it was found in; of length 1, or zero
        double across = 0.0, rise = 0.0;  // of a round tool: away from the axis and along it
        Vec3 along_sides{0.0};            // of a box
        double reach = 0.0;
    };
    [[nodiscard]] ToolDirection tool_direction(std::size_t move, const Vec3& n) const;
    // Returns the same direction of the tool in another move; of a round tool, at the same place about its axis. A
    // plane along the side of a long tool has to turn with it, or the next move's tool reaches beyond it at one end.
    [[nodiscard]] Vec3 in_move(std::size_t move, const ToolDirection& direction) const;
    // Returns how far what the move sweeps stays from the plane through a point; the direction is `n` in this move.
    [[nodiscard]] double room(std::size_t move, const ToolDirection& direction, const Vec3& n,
                              const Vec3& point) const {
        return swept_room(moves_[move], n, point) - direction.reach;
    }

    // Returns how far a point of a ray is outside of what the move sweeps: the most by which a face of the tool keeps
    // away from it, of the faces that the ray leaves upwards or, if not `upwards`, downwards. Where that is above zero,
    // all of the move lies before the point or, if not `upwards`, behind it. Exact for a tool at rest.
    [[nodiscard]] double clearance(std::size_t move, const Vec3& point, int axis, bool upwards) const;

    // Returns the direction in which a move's slices are stacked, as far as it is perpendicular to the motion.
    [[nodiscard]] const Vec3& stacked_along(std::size_t move) const { return moves_[move].stacked; }
    // The half-space behind a plane in the profile's terms of one move: a circle about the axis lies within it all
    // along the motion where across * radius + rise * height <= room.
    struct ProfileSpace {
        double across = 0.0, rise = 0.0, room = -1.0;
    };
    [[nodiscard]] ProfileSpace profile_space(std::size_t move, const Vec3& n, const Vec3& point) const;
    // Returns that half-space for a plane along a direction of the tool, which in this move is `n` (in_move).
    [[nodiscard]] ProfileSpace profile_space(std::size_t move, const ToolDirection& direction, const Vec3& n,
                                             const Vec3& point) const {
        return {direction.across, direction.rise, swept_room(moves_[move], n, point)};
    }
    // Tells whether a slice lies within the half-space, the margin aside; `slice` is counted from the move's first.
    [[nodiscard]] bool slice_within(const ProfileSpace& space, std::size_t slice) const {
        const Vec2 &low = profile_[slice], &high = profile_[slice + 1];
        const double room = space.room - margin_;
        return space.across * low.x + space.rise * low.y < room && space.across * high.x + space.rise * high.y < room;
    }

    // The part of row v of an axis that a move may meet, margin included; empty when lo > hi. The bounds are found by
    // tilting a plane about the row. How far is kept, since the next move's bounds lie nearly alike.
    struct RowPart {
        double lo = 0.0, hi = -1.0;
        double tilt_lo = 0.0, tilt_hi = 0.0;
    };
    [[nodiscard]] RowPart part_of_row(std::size_t move, int axis, double v, const RowPart& alike) const;

private:
    struct Move {
        Vec3 base{0.0};            // the tip of a round tool, the centre of a box, at the start
        Vec3 along{0.0};           // the motion
        Vec3 axis{0.0};            // of a round tool
        Vec3 sides[3] = {};        // of a box: directions of length 1
        Vec3 across{0.0};          // the part of the motion perpendicular to the axis,
        double per_across2 = 0.0;  // and one over its square; zero without such a part
        Vec3 stacked{0.0};         // the part of the axis perpendicular to the motion
        double way = 0.0;          // of all moves before it
    };
    // A support plane that is tilted about a row: where it meets the row, and the row that its touching point lies in.
    struct Tilted {
        double meets = 0.0, touches_v = 0.0;
    };
    void add(const FrustumSweep& first);
    void add(const BoxSweep& box);
    void find_faces();
    void measure_ways();
    [[nodiscard]] static double swept_room(const Move& move, const Vec3& n, const Vec3& point) {
        return glm::dot(n, point - move.base) - std::max(0.0, glm::dot(n, move.along));
    }
    [[nodiscard]] Tilted tilted(const Move& move, int axis, double side, double tilt, double v) const;
    [[nodiscard]] double bound_of_row(const Move& move, int axis, double side, double v, double& tilt) const;

    std::vector<Move> moves_;
    std::vector<Box> boxes_;  // of the pieces, margin included
    // A face of a round tool: its normal away from the axis and along it, and how far it is from the tip.
    struct Face {
        double across = 0.0, rise = 0.0, reach = 0.0;
    };
    std::vector<Face> faces_;
    std::vector<Vec2> profile_;  // (radius, height above the tip) of a round tool
    Vec3 half_size_{0.0};        // of a box
    double margin_ = 0.0;
};

}  // namespace burin::compute
