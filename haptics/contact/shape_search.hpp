// SPDX-License-Identifier: MIT
// Contact queries of a tool's shape: the planes between it and what it touches, and how far it may move.
//
// The tool's axes are the frame, with the surface's origin as theirs, so that a tool that moves without turning needs
// no transform. What was gathered from the surface holds for every place of the tool within the slack of the gathering.
// Metres. No heap, lock, throw; work is counted.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>

#include "geometry/contact/local_surface_search.hpp"
#include "haptics/contact/god_object.hpp"
#include "haptics/contact/half_spaces.hpp"
#include "haptics/contact/separation.hpp"
#include "haptics/contact/static_vector.hpp"

namespace burin::haptics {

// Fractions of the rounding: a triangle counts as touched within kReached; an edge or corner may sink in by kEdge; a
// sweep stops twice as deep.
inline constexpr double kReached = 0.01, kEdge = 0.01;
// Of the rounding: by how much a face's own plane may lie nearer than the best one.
inline constexpr double kOwnPlane = 2e-3;

class ShapeSearch {
public:
    static constexpr std::uint32_t kMost = 1024;
    static constexpr std::uint32_t kNoId = ProxyResult{}.active_triangle;

    ShapeSearch(const ToolShape& shape, const geometry::PosedSurface& surface, const ProxyBudget& budget,
                ContactWork& work) noexcept;

    // Turns the tool and what was gathered.
    void turn_to(const Quat& object_from_tool) noexcept;
    [[nodiscard]] Vec3 to_tool(const Vec3& relative_m) const noexcept { return relative_m * turn_; }
    [[nodiscard]] Vec3 from_tool(const Vec3& v) const noexcept { return turn_ * v; }

    // Where the hand draws the tool, in the tool's axes: what is below it that way is looked at first.
    void draw_to(const Vec3& pull) noexcept { pull_ = pull; }
    // Gathers what the tool may touch within `slack` of `at`, also while it turns by as much as moves none of it by
    // more. With too little work left or too many triangles the slack becomes smaller, and then the surface coarser.
    // False: not even that was possible.
    [[nodiscard]] bool gather(const Vec3& at, double slack) noexcept;
    [[nodiscard]] bool covers(const Vec3& at) const noexcept {
        return slack_ > 0.0 && glm::length(at - gathered_at_) <= slack_ * (1.0 + 1e-9);
    }
    // How much of a step from a covered place is covered.
    [[nodiscard]] double covered_share(const Vec3& at, const Vec3& step) const noexcept;
    [[nodiscard]] double slack() const noexcept { return slack_; }

    // Finds the planes of what the tool touches at a covered place. False: the work is used up.
    [[nodiscard]] bool touch(const Vec3& at) noexcept;
    [[nodiscard]] std::span<const HalfSpace> planes() const noexcept { return planes_.first(plane_count_); }
    [[nodiscard]] const Vec3& touched(std::uint32_t plane) const noexcept { return touched_[plane]; }
    // The id of the plane's triangle, or of one that has a corner at its vertex.
    [[nodiscard]] std::uint32_t triangle(std::uint32_t plane) const noexcept;
    [[nodiscard]] bool overlaps() const noexcept { return overlaps_; }
    // The deepest that something is in the rounding.
    [[nodiscard]] double sunk_m() const noexcept { return sunk_m_; }

    struct Sweep {
        double fraction = 1.0;
        bool complete = true;  // false: the work is used up, and the fraction is what was proved until then
    };
    // How far the tool may go before it meets what touch() did not find. Both ends must be covered.
    [[nodiscard]] Sweep sweep(const Vec3& at, const Vec3& step) noexcept;

    // Whether nothing is in the way of a step, nor touches the tool after it; false as well where the work does not
    // suffice to tell. squeezed_m: how deep facets may be in the tool that it lies between, as in its own bed. What was
    // gathered before is gone.
    [[nodiscard]] bool is_way_free(const Vec3& at, const Vec3& step, double squeezed_m) noexcept;

private:
    static constexpr std::uint32_t kMostCovers = 8, kMostHeld = 6, kMostTried = 3;

    struct Candidate {
        geometry::Triangle triangle;  // of a vertex all corners are alike
        Vec3 face{0.0};               // unit, outward; of a vertex that of the smooth surface, or zero
        double height = 0.0;          // of the face's plane above the origin
        bool is_vertex = false, two_sided = false;
        Vec3 guess{0.0};             // a direction from it to the tool
        bool guessed = false;        // by a plane that was found
        double least_gap_m = -1.0;   // when it was gathered; below 0: not known
        double clear_until_m = 0.0;  // it is farther than the rounding until the tool has travelled so far
    };
    // What lies wholly behind it need not be touched: the tool stays beyond this plane. Relative to the origin.
    struct Cover {
        Vec3 normal{0.0};
        double top = 0.0;
    };
    // An edge or corner that is near enough to be touched.
    struct Feature {
        std::uint32_t candidate = 0;
        Vec3 normal{0.0}, place{0.0};
        double gap_m = 0.0;
    };
    [[nodiscard]] double left_ns() const noexcept { return budget_.max_cost_ns - cost_ns(work_); }
    // How many that cost so much a share of what is left affords.
    [[nodiscard]] std::uint32_t affords(double share, double each_ns) const noexcept {
        return static_cast<std::uint32_t>(std::clamp(share * left_ns() / each_ns, 0.0, 4e9));
    }
    [[nodiscard]] Separation from(Candidate& c, const Vec3& at, double matters_m) noexcept;
    [[nodiscard]] double above(const Candidate& c, const Vec3& at) noexcept;
    [[nodiscard]] HalfSpace way_out(const Candidate& c, const Vec3& at) noexcept;
    [[nodiscard]] double surely_clear_m(Candidate& c, const Vec3& at, double reach) noexcept;
    [[nodiscard]] bool faces(const Candidate& c, const Vec3& normal) const noexcept;
    [[nodiscard]] bool is_covered(const Candidate& c) const noexcept;
    [[nodiscard]] bool is_hidden(const Vec3& place, const Vec3& normal) noexcept;
    void cover(const geometry::Triangle& t, const Vec3& normal) noexcept;
    [[nodiscard]] bool touch_face(std::uint32_t candidate, const Separation& s, const Vec3& at) noexcept;
    void touch_features(const Vec3& at) noexcept;
    struct WaySeen;
    [[nodiscard]] Candidate candidate_of(const geometry::Triangle& object, const Vec3& normal, std::uint32_t id,
                                         bool is_vertex) const noexcept;
    [[nodiscard]] bool passes(Candidate c, const Vec3& at, WaySeen& seen) noexcept;
    [[nodiscard]] static bool leaves(const Candidate& c, const Vec3& step) noexcept;
    [[nodiscard]] bool passes_a_side(const Candidate& c, const Vec3& at, const Vec3& step, double stop) noexcept;
    [[nodiscard]] double until(Candidate& c, const Vec3& at, const Vec3& step) noexcept;
    [[nodiscard]] double nearest_beyond(double from) const noexcept;
    [[nodiscard]] bool is_beside(const Vec3& low, const Vec3& high, double slack) const noexcept;
    [[nodiscard]] bool is_left_out(const Box& box, const geometry::TriangleSlab& slab, double slack) noexcept;
    [[nodiscard]] bool is_around(const Vec3& low, const Vec3& high, double reach) const noexcept;
    [[nodiscard]] bool is_above(const geometry::TriangleSlab& slab, const Vec3& at, double reach) noexcept;
    [[nodiscard]] geometry::Near near_tool(const Vec3& at, double slack) const noexcept;
    [[nodiscard]] bool look(const Vec3& at, double& slack) noexcept;
    [[nodiscard]] bool is_behind_held(const geometry::Triangle& object) noexcept;
    [[nodiscard]] bool make_room(const Vec3& at, double& slack, std::uint32_t most) noexcept;
    void hold_faces(const Vec3& at, double reach) noexcept;
    [[nodiscard]] Vec3 lowest_along(const Vec3& normal) noexcept;
    [[nodiscard]] bool was_tried(const Vec3& normal) const noexcept;
    void hold_faces_around(const Vec3& place, const Vec3& at, double reach) noexcept;
    [[nodiscard]] bool lies_on(const Candidate& c, const Vec3& at, const Vec3& place) noexcept;
    [[nodiscard]] double least_gap_m(const Candidate& c, const Vec3& at) noexcept;
    void hold(std::uint32_t candidate) noexcept;
    void swap_candidates(std::uint32_t a, std::uint32_t b) noexcept;
    template <typename Keeps>
    void keep_candidates(Keeps&& keeps) noexcept;
    void touch_held(const Vec3& at) noexcept;
    void add(const geometry::Triangle& object, const Vec3& normal, std::uint32_t id, bool is_vertex) noexcept;
    void put_plane(std::uint32_t candidate, const HalfSpace& plane, const Vec3& touched) noexcept;

    const ToolShape& shape_;
    geometry::PosedSurface surface_;
    ProxyBudget budget_;
    ContactWork& work_;
    glm::dmat3 turn_{1.0};  // columns: the tool's axes in the object's
    double rounding_, slack_ = 0.0;
    Vec3 gathered_at_{0.0}, touched_at_{0.0};
    double travel_ = 0.0;
    geometry::Fineness fineness_;
    std::uint32_t count_ = 0, plane_count_ = 0;
    bool overlaps_ = false;
    double sunk_m_ = 0.0;
    StaticVector<Candidate, kMost> candidates_;
    StaticVector<geometry::Triangle, kMost> in_object_;
    StaticVector<Vec3, kMost> faces_in_object_;
    std::array<std::uint32_t, kMost> ids_;
    // The first candidates are the faces that are held: their planes cover what was not gathered.
    std::uint32_t held_count_ = 0, looked_at_ = 0, hold_at_ = 0;
    std::array<double, kMostHeld> held_tops_{};  // in the object's axes
    Vec3 pull_{0.0};
    std::array<Vec3, kMostTried> tried_{};  // normals of faces that the tool was found to lie on or not
    std::uint32_t tried_count_ = 0;
    Vec3 slab_normal_{0.0};
    double slab_lowest_ = 0.0;  // the tool's, along that normal
    std::uint32_t cover_count_ = 0, feature_count_ = 0;
    std::array<Cover, kMostCovers> covers_{};
    StaticVector<Feature, kMost> features_;
    StaticVector<HalfSpace, kMost> planes_;
    StaticVector<Vec3, kMost> touched_;
    std::array<std::uint32_t, kMost> owners_;
    std::array<bool, kMost> touches_;
};

}  // namespace burin::haptics
