// SPDX-License-Identifier: MIT
// A hand that strokes any triangle mesh: a point that walks over the triangles at constant speed, and a hand that
// follows it smoothly and presses.
//
// The walk is a geodesic one: straight ahead within a triangle, unfolded across the edge into the next one, so that it
// neither leaves the surface nor skips a facet, however fine. It turns slowly to one side or the other, at random, and
// is reflected at borders, at edges of more than two triangles, of triangles that wind against each other, and of
// degenerate triangles.
// The hand is held under the point, along a smoothed normal, and follows it through two low-passes: it turns no sharper
// corner than a hand does. It takes no account of what it touches, so that every probe and every program that is
// compared meets the same path. So it may leave a probe behind that is caught in a groove; therefore it strokes: after
// half a second it lifts and comes down somewhere else, at places spread evenly over the whole surface.
//
// Frame: the mesh's, metres. Deterministic: the same mesh and seed give the same bits wherever doubles round as IEEE
// says, since nothing but the four operations and the square root is used.
#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "bench/measure/split_mix.hpp"
#include "geometry/mesh/triangle_mesh.hpp"

namespace burin::bench {

// A value that moves smoothly towards a new random number from -1 to 1 again and again.
class Wander {
public:
    // Chooses a new aim every `interval` steps, and goes `share` of the way towards it in a step.
    Wander(std::uint64_t seed, std::uint32_t interval, double share)
        : random_(seed), interval_(interval), share_(share) {}
    double step();

private:
    SplitMix random_;
    std::uint32_t interval_, steps_ = 0;
    double share_, aim_ = 0.0, value_ = 0.0;
};

// A sine and a cosine whose frequency may change from step to step.
class Oscillator {
public:
    // Advances by an angle below 1 rad; a larger one lags by its cube / 12.
    void step(double angle_rad);
    [[nodiscard]] double sine() const { return sine_; }
    [[nodiscard]] double cosine() const { return cosine_; }

private:
    double sine_ = 0.0, cosine_ = 1.0;
};

class SurfaceWalk {
public:
    // The largest turn, per metre of way.
    static constexpr double kBend_rad_per_m = 20.0;
    // The most edges crossed in one advance; at the next one it turns back.
    static constexpr std::uint32_t kMostCrossings = 20'000;

    // Copies what it needs of the mesh, and begins somewhere on it. Fails where no triangle has an area, or an index is
    // out of range.
    [[nodiscard]] static Result<SurfaceWalk> create(const geometry::TriangleMesh& mesh, std::uint64_t seed);

    // Begins somewhere else: every part of the surface is as likely as its area is large.
    void begin_elsewhere();
    // Walks so far along the surface.
    void advance(double length_m);

    [[nodiscard]] const Vec3& point_m() const { return point_m_; }
    [[nodiscard]] const Vec3& along() const { return along_; }  // unit, in the triangle's plane
    [[nodiscard]] const Vec3& normal() const { return normals_[triangle_]; }
    [[nodiscard]] std::uint32_t triangle() const { return triangle_; }
    [[nodiscard]] std::uint64_t crossings() const { return crossings_; }      // edges crossed so far
    [[nodiscard]] std::uint64_t reflections() const { return reflections_; }  // of them, those not let through

private:
    static constexpr std::uint32_t kNone = 0xffffffffu;
    struct Crossing {
        std::uint32_t edge = kNone;  // from this corner to the next; none: the way ends inside
        double length_m = 0.0;       // the way to it
    };
    SurfaceWalk(const geometry::TriangleMesh& mesh, std::uint64_t seed);
    void join();
    [[nodiscard]] const Vec3& corner(std::uint32_t triangle, std::uint32_t k) const {
        return positions_m_[triangles_[triangle][k % 3]];
    }
    // Returns the unit vector of the triangle's plane that points from the edge into the triangle.
    [[nodiscard]] Vec3 inward(std::uint32_t triangle, std::uint32_t edge) const;
    [[nodiscard]] Crossing next_edge(double length_m) const;
    void cross(std::uint32_t edge);

    std::vector<Vec3> positions_m_;
    std::vector<std::array<std::uint32_t, 3>> triangles_;
    std::vector<Vec3> normals_;        // unit; zero of degenerate triangles
    std::vector<double> areas_up_m2_;  // of all triangles up to each
    // For each edge the triangle beyond and its edge there, as 3 * triangle + edge; none where it is reflected.
    std::vector<std::array<std::uint32_t, 3>> beyond_;
    std::uint32_t triangle_ = 0, entered_by_ = kNone;
    Vec3 point_m_{0.0}, along_{1.0, 0.0, 0.0};
    SplitMix places_;
    Wander bend_;
    std::uint64_t crossings_ = 0, reflections_ = 0;
};

struct HandPress {
    double speed_m_per_s = 0.1;
    double tick_s = 0.001;
    // How deep the hand is below the point: a mean, and how far it swings about it.
    double depth_m = 0.0015, depth_swing_m = 0.0005, swings_Hz = 0.7;
    double follows_s = 0.015;  // of each of the two low-passes of the hand
    double normal_s = 0.03;    // over which the surface's normal is smoothed
    double tremor_m = 0.0;     // amplitude of a tremor of 8 to 12 Hz, such as 0.00005
    // A stroke: the hand begins so far above the surface, which a ball's radius should fit in, comes down, and then
    // moves for so long before it lifts.
    double above_m = 0.01, comes_down_s = 0.05, stroke_s = 0.5;
    std::uint64_t seed = 1;
};

// The hand that follows such a walk.
class PressedWalk {
public:
    [[nodiscard]] static Result<PressedWalk> create(const geometry::TriangleMesh& mesh, const HandPress& press);
    // Follows a walk that has not begun to move.
    PressedWalk(SurfaceWalk walk, const HandPress& press)
        : walk_(std::move(walk)), press_(press), tremble_(press.seed + 1, 100, 0.05) {}

    // Advances by a tick.
    void step();
    [[nodiscard]] const Vec3& hip_m() const { return hip_m_; }
    [[nodiscard]] const Vec3& outward() const { return outward_; }  // the smoothed normal, unit
    // Returns the frame whose columns are along, outward, across: its y axis points away from the surface.
    [[nodiscard]] Quat orientation() const;
    [[nodiscard]] const SurfaceWalk& walk() const { return walk_; }
    // Whether the hand has just been taken to another place: whatever followed it has to let go.
    [[nodiscard]] bool lifted() const { return ticks_ == 1; }
    // Whether the hand has come down and moves.
    [[nodiscard]] bool pressed() const { return ticks_ > come_down_ticks() + settle_ticks(); }

private:
    [[nodiscard]] std::uint64_t ticks_in(double time_s) const {
        return static_cast<std::uint64_t>(time_s / press_.tick_s + 0.5);
    }
    [[nodiscard]] std::uint64_t come_down_ticks() const { return ticks_in(press_.comes_down_s); }
    [[nodiscard]] std::uint64_t settle_ticks() const { return ticks_in(6.0 * press_.follows_s); }
    void begin_stroke();
    [[nodiscard]] Vec3 aim_m();

    SurfaceWalk walk_;
    HandPress press_;
    Oscillator swing_, tremor_, tremor_across_;
    Wander tremble_;
    std::uint64_t ticks_ = 0;  // of this stroke
    Vec3 outward_{0.0}, along_{0.0}, half_way_m_{0.0}, held_m_{0.0}, hip_m_{0.0};
};

}  // namespace burin::bench
