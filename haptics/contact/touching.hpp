// SPDX-License-Identifier: MIT
// Contact queries of the god-object for a ball: the triangles it touches and how far it may move. The work of each
// query is counted against the tick's budget.
//
// Tolerances are fractions of the ball's radius; see haptics/contact/god_object.hpp. Frame: relative to the surface's
// origin, metres. No heap, lock, throw.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

#include "haptics/contact/candidates.hpp"
#include "haptics/contact/god_object.hpp"
#include "haptics/contact/half_spaces.hpp"
#include "haptics/contact/static_vector.hpp"

namespace burin::haptics {

// A triangle counts as touched within this fraction of the radius.
inline constexpr double kTouch = 1e-3;
// Where no edge is longer than this part of the radius the ball touches vertices alone, and then sinks into the surface
// by at most kFineEdge^2 / 6, or 1/200, of the radius, and usually by a quarter of that.
inline constexpr double kFineEdge = 0.1732;
// A point probe is a ball of this part of a mean edge.
inline constexpr double kPointProbeOfEdge = 1.0 / 500.0;
[[nodiscard]] inline double felt_radius_m(double contact_radius_m, double mean_edge_m) noexcept {
    return std::max(contact_radius_m, kPointProbeOfEdge * mean_edge_m);
}
// Two triangles within this fraction of the radius share their nearest point: an edge or a corner.
inline constexpr double kTie = 1e-6;

// The half-spaces, relative to the ball's centre, of what it touches from outside.
struct Touches {
    // As many as there can be candidates: a ball in its own groove touches hundreds.
    static constexpr std::uint32_t kMost = 2 * Candidates::kMost;

    struct Place {
        Vec3 point{0.0};  // the candidate's point nearest to the centre
        std::uint32_t candidate = 0;
        bool on_face = false;         // inside a triangle; else on an edge or a corner
        bool seen_from_back = false;  // of a two-sided triangle
    };
    StaticVector<HalfSpace, kMost> planes;
    StaticVector<Place, kMost> places;
    std::uint32_t count = 0;

    [[nodiscard]] std::span<const HalfSpace> span() const { return planes.first(count); }
};

struct Nearest {
    double distance = HUGE_VAL;
    double height = 0.0;  // above the triangle's plane; negative: behind it
    Vec3 point{0.0};
    Vec3 normal{0.0};
};

// The queries of one tick for a ball of one radius.
class ContactSearch {
public:
    ContactSearch(const geometry::PosedSurface& surface, double radius, const ProxyBudget& budget,
                  ContactWork& work) noexcept
        : surface_(surface), radius_(radius), budget_(budget), work_(work), fineness_{kFineEdge * radius, 1} {}

    // Among very many vertices only each so manieth is touched: as in the last tick, and for the next one.
    void begin_with_stride(std::uint32_t stride) noexcept { fineness_.stride = stride; }
    [[nodiscard]] std::uint32_t next_stride() const noexcept {
        const bool few = candidates_.points() < Candidates::kMost / 3;
        return few && fineness_.stride > 1 ? fineness_.stride / 2 : fineness_.stride;
    }

    // Broad phase: gathers the triangles that the ball may touch along the segment and a little beside it. If there are
    // too many, covers a shorter part of the segment from its beginning. Returns false when the tick's work budget is
    // used up.
    [[nodiscard]] bool broad_phase(const Way& way) noexcept;
    [[nodiscard]] bool knows(const Vec3& center) const noexcept { return candidates_.covers(center); }
    // The fraction of the motion from a covered centre that stays within what broad_phase() covers.
    [[nodiscard]] double known_share(const Vec3& center, const Vec3& motion) const noexcept;

    struct Touching {
        Nearest nearest;  // of all triangles within reach, from either side
        bool complete = true;
    };
    // Finds the touched triangles at a covered centre.
    [[nodiscard]] Touching touching(const Vec3& center, Touches& touches) noexcept;

    struct Sweep {
        double fraction = 1.0;
        bool complete = true;
    };
    // How far the ball may move before it meets a triangle, except those that the last touching() found. Both ends must
    // be covered.
    [[nodiscard]] Sweep sweep(const Vec3& center, const Vec3& motion) noexcept;

    // The nearest triangle of the whole surface, searched in boxes that double until the one found must be the nearest.
    // Of triangles farther than `most`, returns any or none; returns none too when the work budget is used up.
    // Independent of broad_phase().
    [[nodiscard]] Nearest nearest(const Vec3& center, double most) noexcept;

    // Whether most of the surface within reach shows its back to the centre, weighted by the solid angles of its
    // triangles: a facet folded over, which a surface under carving may have, is outvoted by those around it. False
    // when the tick's work budget is used up.
    [[nodiscard]] bool sees_backs(const Vec3& center, double reach) noexcept;

    // The id of a triangle that has a corner at this vertex.
    [[nodiscard]] std::uint32_t triangle_at(const Vec3& vertex) const noexcept;

    [[nodiscard]] const Candidates& candidates() const noexcept { return candidates_; }
    // Whether some broad phase covered less than it was asked for, or more coarsely.
    [[nodiscard]] bool was_coarse() const noexcept { return was_coarse_; }
    [[nodiscard]] bool has_work_for(double cost_ns) const noexcept { return left_ns() >= cost_ns; }

private:
    // Counts an exact test, and what was measured before it, if the work suffices.
    [[nodiscard]] bool count_fours_and_test() noexcept;
    void count_fours() noexcept { work_.fours_measured = fours_before_ + candidates_.fours_measured(); }
    void bound_fours() noexcept;
    [[nodiscard]] double left_ns() const noexcept { return budget_.max_cost_ns - cost_ns(work_); }
    void keep_nearest(Nearest& best, const Nearest& other) const noexcept;
    [[nodiscard]] bool keep_nearest_within(Nearest& best, const Vec3& center, double reach) noexcept;
    [[nodiscard]] bool touch_triangle(std::uint32_t candidate, const Vec3& center, Touching& result,
                                      Touches& touches) noexcept;
    [[nodiscard]] bool touch_point(std::uint32_t candidate, const Vec3& center, Touching& result,
                                   Touches& touches) noexcept;
    void add(Touches& touches, const HalfSpace& plane, const Touches::Place& place) noexcept;

    geometry::PosedSurface surface_;
    double radius_;
    ProxyBudget budget_;
    ContactWork& work_;
    int looks_taken_ = 0;
    bool was_coarse_ = false;
    Candidates candidates_;
    geometry::Fineness fineness_;
    std::uint32_t fours_before_ = 0;                           // measured in earlier broad phases
    std::array<bool, 2 * Candidates::kMost> touches_already_;  // of the present candidates
};

}  // namespace burin::haptics
