// SPDX-License-Identifier: MIT
#include "study/felt/tube_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "study/trial/stage_step.hpp"

namespace burin::study {
namespace {

using geometry::TriangleMesh;

constexpr double kMostSections = 1000.0;
constexpr double kHoop_m = 0.003, kHoopsApart = 0.8;  // width of a hoop; their distance, in radii of the tube
constexpr std::uint32_t kFunnelParts = 8;             // of each side, and along it half as many

// The spine with points added, so that no triangle is much longer than wide.
std::vector<Vec3> with_points_between(const StudyWorld& world) {
    double length_m = 0.0;
    for (std::size_t i = 1; i < world.spine_m.size(); ++i)
        length_m += glm::distance(world.spine_m[i - 1], world.spine_m[i]);
    const double side_m = 2.0 * std::numbers::pi * world.tube_radius_m / static_cast<double>(kTubeSides);
    const double piece_m = std::max(2.0 * side_m, length_m / kMostSections);
    std::vector<Vec3> line{world.spine_m.front()};
    for (std::size_t i = 1; i < world.spine_m.size(); ++i) {
        const Vec3& from = world.spine_m[i - 1];
        const Vec3 way = world.spine_m[i] - from;
        const double pieces = std::ceil(glm::length(way) / piece_m);
        for (double k = 1.0; k < pieces; k += 1.0) line.push_back(from + (k / pieces) * way);
        line.push_back(world.spine_m[i]);
    }
    return line;
}

// A unit vector across `along`, as near to `wanted` as that allows.
Vec3 across(const Vec3& along, const Vec3& wanted) {
    Vec3 found = wanted - glm::dot(wanted, along) * along;
    if (glm::length(found) < 1e-6) {
        const Vec3 other = std::abs(along.x) < 0.9 ? Vec3(1, 0, 0) : Vec3(0, 0, 1);
        found = other - glm::dot(other, along) * along;
    }
    return glm::normalize(found);
}

struct Section {
    Vec3 middle{0.0}, normal{0.0};  // unit, along the tube
};

// Across each straight stretch at both its ends, and halfway between at a bend, so that the outer side of a bend is as
// round as the tube.
std::vector<Section> sections_along(const std::vector<Vec3>& line) {
    constexpr double kStraight = 1.0 - 1e-6;  // cosine
    std::vector<Section> sections;
    for (std::size_t i = 1; i < line.size(); ++i) {
        const Vec3 way = glm::normalize(line[i] - line[i - 1]);
        const bool bends = !sections.empty() && glm::dot(sections.back().normal, way) < kStraight;
        const Vec3 both = bends ? sections.back().normal + way : Vec3(0.0);
        if (glm::length(both) > 1e-3) sections.push_back({line[i - 1], glm::normalize(both)});
        if (sections.empty() || bends) sections.push_back({line[i - 1], way});
        sections.push_back({line[i], way});
    }
    return sections;
}

// Corners around a section, counter-clockwise about its normal; `up` is unit and across it.
std::vector<Vec3> ring_around(const Section& section, const Vec3& up, double radius_m) {
    const Vec3 side = glm::cross(section.normal, up);
    std::vector<Vec3> ring;
    for (std::size_t k = 0; k < kTubeSides; ++k) {
        const double angle = 2.0 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(kTubeSides);
        ring.push_back(section.middle + radius_m * (std::cos(angle) * up + std::sin(angle) * side));
    }
    return ring;
}

// Joins a row of points to the row before it; both are closed rings of `count`, counter-clockwise about the way from
// one to the next.
void join_rings(TriangleMesh& mesh, std::uint32_t count) {
    const auto second = static_cast<std::uint32_t>(mesh.positions_m.size()) - count, first = second - count;
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint32_t next = (i + 1) % count;
        mesh.triangles.push_back({first + i, second + i, first + next});
        mesh.triangles.push_back({first + next, second + i, second + next});
    }
}

// Where the spine bends more sharply than the tube is wide, sections cross each other on the inner side and would lie
// within the tube. Such corners are moved out to where the tube's wall is: to its radius from the nearest place of the
// spine, until no place is nearer.
Vec3 out_of_tube(const StudyWorld& world, Vec3 corner) {
    constexpr int kMostMoves = 20;
    const double within_m = (1.0 - 1e-6) * world.tube_radius_m;
    for (int i = 0; i < kMostMoves; ++i) {
        const NearestOnLine nearest = nearest_on(world.spine_m, corner);
        if (nearest.distance_m >= within_m || nearest.distance_m == 0.0) break;
        corner = nearest.place_m + (world.tube_radius_m / nearest.distance_m) * (corner - nearest.place_m);
    }
    return corner;
}

// A hoop around a section, seen from both sides: a hair within the wall, so that it shows on it.
void add_hoop(TriangleMesh& mesh, const Section& section, const Vec3& up, double radius_m) {
    constexpr double kWithin = 0.99;
    const Vec3 to_edge = 0.5 * kHoop_m * section.normal;
    const Section near{section.middle - to_edge, section.normal}, far{section.middle + to_edge, section.normal};
    for (const auto& [first, second] : {std::pair{near, far}, std::pair{far, near}}) {
        for (const Section& edge : {first, second})
            for (const Vec3& corner : ring_around(edge, up, kWithin * radius_m)) mesh.positions_m.push_back(corner);
        join_rings(mesh, kTubeSides);
    }
}

CapBox cap_of(const StudyWorld& world, WorldEnd end) {
    return end == WorldEnd::start ? start_cap(world) : end_cap(world);
}

}  // namespace

TriangleMesh tube_mesh(const StudyWorld& world) {
    BURIN_CHECK(world.spine_m.size() >= 2);
    const std::vector<Vec3> line = with_points_between(world);
    const double half_side = std::numbers::pi / static_cast<double>(kTubeSides);
    const double corner_m = world.tube_radius_m * 2.0 / (1.0 + std::cos(half_side));
    TriangleMesh mesh;
    Vec3 up{0.0, 1.0, 0.0};
    for (const Section& section : sections_along(line)) {
        up = across(section.normal, up);
        for (const Vec3& corner : ring_around(section, up, corner_m))
            mesh.positions_m.push_back(out_of_tube(world, corner));
        if (mesh.positions_m.size() > kTubeSides) join_rings(mesh, kTubeSides);
    }
    return mesh;
}

TriangleMesh drawn_tube_mesh(const StudyWorld& world) {
    BURIN_CHECK(world.spine_m.size() >= 2);
    TriangleMesh mesh;
    Vec3 up{0.0, 1.0, 0.0};
    for (std::size_t i = 0; i < world.spine_m.size(); ++i) {
        const std::size_t from = i > 0 ? i - 1 : 0, to = std::min(i + 1, world.spine_m.size() - 1);
        const Section section{world.spine_m[i], glm::normalize(world.spine_m[to] - world.spine_m[from])};
        up = across(section.normal, up);
        for (const Vec3& corner : ring_around(section, up, world.tube_radius_m)) mesh.positions_m.push_back(corner);
        if (i > 0) join_rings(mesh, kTubeSides);
    }
    double since_hoop_m = 0.0;
    const std::vector<Vec3> line = with_points_between(world);
    up = {0.0, 1.0, 0.0};
    for (std::size_t i = 1; i < line.size(); ++i) {
        const Section section{line[i], glm::normalize(line[i] - line[i - 1])};
        up = across(section.normal, up);
        since_hoop_m += glm::distance(line[i - 1], line[i]);
        if (since_hoop_m < kHoopsApart * world.tube_radius_m) continue;
        since_hoop_m = 0.0;
        add_hoop(mesh, section, up, world.tube_radius_m);
    }
    return mesh;
}

TriangleMesh funnel_mesh(const StudyWorld& world, WorldEnd end) {
    TriangleMesh mesh;
    if (!(world.funnel_half_width_m > 0.0)) return mesh;
    const CapBox cap = cap_of(world, end);
    constexpr std::uint32_t kAlong = kFunnelParts / 2;
    for (std::uint32_t row = 0; row <= kAlong; ++row) {
        const double share = static_cast<double>(row) / kAlong;
        const double half_m = world.funnel_half_width_m + share * (cap.half_width_m - world.funnel_half_width_m);
        const Vec3 middle = cap.centre_m + share * cap.depth_m * cap.z;
        const std::array corners{cap.x + cap.y, cap.y - cap.x, -cap.x - cap.y, cap.x - cap.y};
        for (std::size_t c = 0; c < corners.size(); ++c) {
            const Vec3 from = half_m * corners[c], to = half_m * corners[(c + 1) % corners.size()];
            for (std::uint32_t k = 0; k < kFunnelParts; ++k)
                mesh.positions_m.push_back(middle + from + (static_cast<double>(k) / kFunnelParts) * (to - from));
        }
        if (row > 0) join_rings(mesh, 4 * kFunnelParts);
    }
    return mesh;
}

TriangleMesh cap_mesh(const StudyWorld& world, WorldEnd end) {
    const CapBox cap = cap_of(world, end);
    TriangleMesh mesh;
    for (const double depth_m : {cap.depth_m, cap.depth_m + kDrawnCap_m}) {
        for (const Vec3& corner : {cap.x + cap.y, cap.y - cap.x, -cap.x - cap.y, cap.x - cap.y})
            mesh.positions_m.push_back(cap.centre_m + cap.half_width_m * corner + depth_m * cap.z);
    }
    // The far face looks along z, the near one towards the tube.
    mesh.triangles = {{4, 5, 6}, {4, 6, 7}, {0, 2, 1}, {0, 3, 2}};
    for (std::uint32_t i = 0; i < 4; ++i) {
        const std::uint32_t next = (i + 1) % 4;
        mesh.triangles.push_back({i, next, 4 + next});
        mesh.triangles.push_back({i, 4 + next, 4 + i});
    }
    return mesh;
}

}  // namespace burin::study
