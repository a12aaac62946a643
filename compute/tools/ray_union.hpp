// SPDX-License-Identifier: MIT
// The union of what the pieces of a sweep cover of one ray, computed from as few sections as decide it.
//
// A tool that turns is hundreds of pieces (convex_pieces.hpp) that nearly coincide, and of most rays only the two at
// the union's ends matter. A section found has a plane at each end that touches its piece there. A move, or a slice,
// that stays within both planes (move_bounds.hpp) runs through the ray strictly between the ends, so that it changes
// nothing and its section is left out. Slices that touch along a circle share a plane; then the plane is tilted a
// little away from the other slice. The pieces at the ends of one ray are tried first on the next.
//
// A tool that does not turn is a single move; of few pieces all sections are computed.
//
// Gives the union of all sections, equal to the bit, joined by the device's rule (shaders/shared/covered_part.h).
// Lattice units; one object for some rows of rays, in order.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "compute/rays/ray_batch.hpp"
#include "compute/tools/move_bounds.hpp"
#include "shaders/shared/covered_part.h"

namespace burin::compute {

class RayUnion {
public:
    // Pieces and bounds are kept by reference and outlive the object.
    RayUnion(std::span<const ConvexPiece> pieces, std::size_t pieces_a_move, const MoveBounds& bounds)
        : pieces_(pieces),
          a_move_(pieces_a_move),
          bounds_(bounds),
          seen_on_(pieces.size(), 0),
          tried_on_(bounds.moves(), 0) {}

    // Gathers the sections of the ray at (u, v), in lattice units, with the pieces of these moves, which come in order.
    void gather(int axis, double u, double v, std::span<const std::uint32_t> moves);

    // Appends the union as ends, clipped to the lattice; `deepest` is the depth at which it ends on this axis.
    void append(int deepest, std::uint8_t material, std::vector<shared::DexelEnd>& ends);

    // Tells that the next ray begins another row: it is next to the first ray of this one.
    void start_row();

    // Returns how many sections all rays so far took.
    [[nodiscard]] std::uint64_t sections() const { return sections_; }

private:
    struct Section {
        SweepSpan span;
        std::uint32_t piece = 0;
    };
    // An end of a covered part, and the plane that touches its piece there.
    struct End {
        double depth = 0.0;
        std::uint32_t piece = 0;
        std::size_t move = 0;  // of the piece
        Vec3 place{0.0};
        MoveBounds::ToolDirection plane;
    };
    // Sections that overlap.
    struct Part {
        End lo, hi;
    };

    void try_last_ends(std::span<const std::uint32_t> moves);
    void add_pieces(std::size_t move, std::size_t from);
    void see_parts(std::size_t move);
    bool add_section(std::uint32_t piece);
    bool add(std::uint32_t piece);
    void join();
    void include(const SweepSpan& span, std::uint32_t piece);
    [[nodiscard]] End end_at(double depth, const Vec3& plane, std::uint32_t piece) const;
    [[nodiscard]] bool leaves(const Vec3& n, bool is_hi) const { return is_hi ? n[axis_] > 0.0 : n[axis_] < 0.0; }
    // The plane at an end as one move sees it. Those that are tilted down and up the tool's axis are made when needed.
    struct SeenEnd {
        Vec3 n{0.0};
        MoveBounds::ProfileSpace straight, tilted[2];
        bool is_tilted[2] = {false, false};
    };
    // Says how far a move stays behind both planes of a part; not above zero: its `slice` is looked at first.
    struct Room {
        double width = -1.0;
        std::size_t slice = 0;
        bool operator<(const Room& other) const { return width < other.width; }
    };
    struct SeenPart {
        SeenEnd lo, hi;
    };

    [[nodiscard]] double room_behind(const End& end, bool is_hi, std::size_t move) const;
    [[nodiscard]] Room room_in(const Part& part, std::size_t move) const;
    [[nodiscard]] SeenEnd seen(const End& end, bool is_hi, std::size_t move) const;
    [[nodiscard]] bool is_within(std::size_t move, std::size_t slice);
    [[nodiscard]] bool is_behind(const End& end, SeenEnd& seen, bool is_hi, std::size_t move, std::size_t slice) const;

    std::span<const ConvexPiece> pieces_;
    std::size_t a_move_;
    const MoveBounds& bounds_;
    std::vector<std::uint64_t> seen_on_;   // for each piece, the last ray that its section was computed on
    std::vector<std::uint64_t> tried_on_;  // for each move, the last ray that all its pieces were tried on
    std::uint64_t ray_ = 0, sections_ = 0;
    int axis_ = 0;
    double u_ = 0.0, v_ = 0.0;
    std::vector<Section> found_;
    std::vector<std::uint32_t> order_;  // of the sections by their pieces
    std::vector<shared::CoveredPart> joined_;
    std::vector<Part> parts_;
    std::vector<SeenPart> seen_;
    std::vector<std::uint32_t> at_ends_;       // the pieces at the ends on the ray before
    std::vector<std::uint32_t> at_row_start_;  // and on the first ray of this row that had some
};

}  // namespace burin::compute
