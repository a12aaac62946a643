// SPDX-License-Identifier: MIT
#include "bench/haptics/surface_walk.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/try.hpp"
#include "geometry/mesh/edge_table.hpp"
#include "geometry/mesh/triangle.hpp"

namespace burin::bench {
namespace {

// How near to an edge's ends it is crossed at least, as a share of its length: at a corner itself nothing says which
// triangle comes next.
constexpr double kEnd = 1e-6;

constexpr double kTurn_rad = 6.283185307179586;

// Turns a unit vector of a plane by a small angle about the plane's unit normal.
Vec3 turned(const Vec3& v, const Vec3& normal, double angle_rad) {
    return glm::normalize(v + angle_rad * glm::cross(normal, v));
}

// Returns what lies in the plane of the normal, as a unit vector; any direction where nothing does.
Vec3 in_plane(const Vec3& v, const Vec3& normal) {
    const Vec3 flat = v - glm::dot(v, normal) * normal;
    if (glm::dot(flat, flat) > 1e-12) return glm::normalize(flat);
    const Vec3 other = std::abs(normal.x) < 0.6 ? Vec3(1.0, 0.0, 0.0) : Vec3(0.0, 1.0, 0.0);
    return glm::normalize(other - glm::dot(other, normal) * normal);
}

// Returns the share of the way that a low-pass goes in a step of this length.
double share_of(double tick_s, double time_s) { return tick_s / (time_s + tick_s); }

}  // namespace

double Wander::step() {
    if (steps_++ % interval_ == 0) aim_ = random_.signed_unit();
    return value_ += share_ * (aim_ - value_);
}

void Oscillator::step(double angle_rad) {
    const double h = 0.5 * angle_rad, c = (1.0 - h * h) / (1.0 + h * h), s = 2.0 * h / (1.0 + h * h);
    const double sine = s * cosine_ + c * sine_, cosine = c * cosine_ - s * sine_;
    const double length = std::sqrt(sine * sine + cosine * cosine);
    sine_ = sine / length, cosine_ = cosine / length;
}

// ---- The walk

SurfaceWalk::SurfaceWalk(const geometry::TriangleMesh& mesh, std::uint64_t seed)
    : positions_m_(mesh.positions_m), triangles_(mesh.triangles), places_(seed ^ 0x5bd1e995u), bend_(seed, 250, 0.01) {
    normals_.resize(triangles_.size(), Vec3(0.0));
    double area_m2 = 0.0;
    for (std::size_t i = 0; i < triangles_.size(); ++i) {
        const auto& [a, b, c] = triangles_[i];
        const geometry::Triangle t{positions_m_[a], positions_m_[b], positions_m_[c]};
        if (!geometry::is_degenerate(t)) {
            const Vec3 twice = glm::cross(t.b - t.a, t.c - t.a);
            normals_[i] = glm::normalize(twice);
            area_m2 += 0.5 * glm::length(twice);
        }
        areas_up_m2_.push_back(area_m2);
    }
    join();
}

Result<SurfaceWalk> SurfaceWalk::create(const geometry::TriangleMesh& mesh, std::uint64_t seed) {
    for (const auto& triangle : mesh.triangles)
        for (const std::uint32_t vertex : triangle)
            if (vertex >= mesh.positions_m.size())
                return fail("a mesh to walk on", "names a vertex that it does not have", "repair it");
    SurfaceWalk walk(mesh, seed);
    if (walk.areas_up_m2_.empty() || !(walk.areas_up_m2_.back() > 0.0))
        return fail("a mesh to walk on", "has no triangle with an area", "use another");
    walk.begin_elsewhere();
    return walk;
}

// Joins the triangles on both sides of each edge that two of them share and run along in opposite directions.
void SurfaceWalk::join() {
    beyond_.assign(triangles_.size(), {kNone, kNone, kNone});
    const std::vector<geometry::EdgeUse> uses = geometry::edge_uses(triangles_);
    geometry::for_each_edge(uses, [&](std::span<const geometry::EdgeUse> edge) {
        if (edge.size() != 2 || edge[0].upwards == edge[1].upwards) return;
        for (const geometry::EdgeUse& use : edge)
            if (normals_[use.triangle] == Vec3(0.0)) return;
        beyond_[edge[0].triangle][edge[0].corner] = 3 * edge[1].triangle + edge[1].corner;
        beyond_[edge[1].triangle][edge[1].corner] = 3 * edge[0].triangle + edge[0].corner;
    });
}

void SurfaceWalk::begin_elsewhere() {
    const double at_m2 = 0.5 * (places_.signed_unit() + 1.0) * areas_up_m2_.back();
    const auto found = std::ranges::upper_bound(areas_up_m2_, at_m2);
    triangle_ = static_cast<std::uint32_t>(
        std::min<std::ptrdiff_t>(found - areas_up_m2_.begin(), std::ssize(areas_up_m2_) - 1));
    entered_by_ = kNone;
    point_m_ = (corner(triangle_, 0) + corner(triangle_, 1) + corner(triangle_, 2)) / 3.0;
    const double x = places_.signed_unit(), y = places_.signed_unit(), z = places_.signed_unit();
    along_ = in_plane({x, y, z}, normal());
}

Vec3 SurfaceWalk::inward(std::uint32_t triangle, std::uint32_t edge) const {
    return glm::normalize(glm::cross(normals_[triangle], corner(triangle, edge + 1) - corner(triangle, edge)));
}

SurfaceWalk::Crossing SurfaceWalk::next_edge(double length_m) const {
    Crossing first{kNone, length_m};
    for (std::uint32_t edge = 0; edge < 3; ++edge) {
        if (edge == entered_by_) continue;
        const Vec3 inside = inward(triangle_, edge);
        const double speed = -glm::dot(along_, inside);
        if (!(speed > 1e-12)) continue;
        const double room = std::max(glm::dot(point_m_ - corner(triangle_, edge), inside), 0.0);
        if (room < first.length_m * speed) first = {edge, room / speed};
    }
    return first;
}

void SurfaceWalk::cross(std::uint32_t edge) {
    ++crossings_;
    const Vec3 from = corner(triangle_, edge), whole = corner(triangle_, edge + 1) - from;
    const double share = std::clamp(glm::dot(point_m_ - from, whole) / glm::dot(whole, whole), kEnd, 1.0 - kEnd);
    point_m_ = from + share * whole;  // rounding does not take it off the surface
    const Vec3 ahead = glm::normalize(whole);
    const double beside = glm::dot(along_, ahead), through = std::sqrt(std::max(1.0 - beside * beside, 1e-12));
    const std::uint32_t other = beyond_[triangle_][edge];
    if (other != kNone) {
        triangle_ = other / 3, entered_by_ = other % 3;
    } else {
        entered_by_ = edge;
        ++reflections_;
    }
    along_ = glm::normalize(beside * ahead + through * inward(triangle_, entered_by_));
}

void SurfaceWalk::advance(double length_m) {
    along_ = in_plane(turned(along_, normal(), kBend_rad_per_m * length_m * bend_.step()), normal());
    // A turn on an edge may point back through it.
    if (entered_by_ != kNone && glm::dot(along_, inward(triangle_, entered_by_)) < 0.0) entered_by_ = kNone;
    for (std::uint32_t i = 0; i < kMostCrossings; ++i) {
        const Crossing crossing = next_edge(length_m);
        point_m_ += crossing.length_m * along_;
        length_m -= crossing.length_m;
        if (crossing.edge == kNone) {
            if (crossing.length_m > 0.0) entered_by_ = kNone;
            return;
        }
        cross(crossing.edge);
    }
    along_ = -along_;
    entered_by_ = kNone;
}

// ---- The hand

Result<PressedWalk> PressedWalk::create(const geometry::TriangleMesh& mesh, const HandPress& press) {
    BURIN_TRY(walk, SurfaceWalk::create(mesh, press.seed));
    return PressedWalk(std::move(walk), press);
}

void PressedWalk::begin_stroke() {
    walk_.begin_elsewhere();
    outward_ = walk_.normal(), along_ = walk_.along();
    half_way_m_ = held_m_ = walk_.point_m() + press_.above_m * outward_;
}

// Returns where the hand wants to be: below the point that walks.
Vec3 PressedWalk::aim_m() {
    const double share = share_of(press_.tick_s, press_.normal_s);
    const Vec3 normal = outward_ + share * (walk_.normal() - outward_);
    // On a knife's edge the two sides' normals may cancel out.
    if (glm::dot(normal, normal) > 1e-6) outward_ = glm::normalize(normal);
    along_ = in_plane(along_ + share * (walk_.along() - along_), outward_);
    swing_.step(kTurn_rad * press_.swings_Hz * press_.tick_s);
    const double depth_m = press_.depth_m + press_.depth_swing_m * swing_.sine();
    const auto come_down = static_cast<double>(come_down_ticks()), ticks = static_cast<double>(ticks_);
    const double above = ticks < come_down ? 1.0 - ticks / come_down : 0.0;
    return walk_.point_m() + (above * press_.above_m - (1.0 - above) * depth_m) * outward_;
}

void PressedWalk::step() {
    if (ticks_++ % (come_down_ticks() + settle_ticks() + ticks_in(press_.stroke_s)) == 0) {
        begin_stroke();
        ticks_ = 1;
    } else {
        if (ticks_ > come_down_ticks()) walk_.advance(press_.speed_m_per_s * press_.tick_s);
        const double share = share_of(press_.tick_s, press_.follows_s);
        half_way_m_ += share * (aim_m() - half_way_m_);
        held_m_ += share * (half_way_m_ - held_m_);
    }
    const double angle_rad = kTurn_rad * press_.tick_s * (10.0 + 2.0 * tremble_.step());
    tremor_.step(angle_rad);
    tremor_across_.step(0.83 * angle_rad);
    hip_m_ = held_m_ + press_.tremor_m * Vec3(tremor_.sine(), tremor_across_.sine(), tremor_.cosine());
}

Quat PressedWalk::orientation() const {
    return glm::normalize(glm::quat_cast(glm::dmat3(along_, outward_, glm::cross(along_, outward_))));
}

}  // namespace burin::bench
