// SPDX-License-Identifier: MIT
#include "compute/tools/convex_pieces.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <string>

namespace burin::compute {
namespace {

constexpr double kLargestReach = 1 << 24;  // lattice units, as for balls: 4096 cells

bool above_zero(std::initializer_list<double> sizes) {
    return std::ranges::all_of(sizes, [](double x) { return x > 0.0 && std::isfinite(x); });
}

std::unexpected<Error> no_size(const char* tool, const char* sizes) {
    return fail(std::string("tool ") + tool, "has no size", std::string("give ") + sizes + ", in metres");
}

Result<Extent> within_reach(const char* tool, const Extent& extent) {
    if (extent.radius <= kLargestReach) return extent;
    return fail(std::string("tool ") + tool, "is too large for the workpiece",
                "choose one that measures less than 4096 lattice cells from its middle");
}

// Returns the extent of a tool that is round about +Y and has its tip at the origin.
Extent round_extent(double radius, double length) {
    return {Vec3(0.0, 0.5 * length, 0.0), std::sqrt(radius * radius + 0.25 * length * length), true};
}

Vec3 axis_of(const StraightMove& move) { return move.orientation * Vec3(0.0, 1.0, 0.0); }

// Makes the sweep of a frustum between two points (radius, height) of a round tool's profile. With `rim`, the centre of
// its rounded corner, it takes the corner's normals.
FrustumSweep slice(const Vec2& low, const Vec2& high, const StraightMove& move, const Vec2* rim = nullptr) {
    const Vec3 axis = axis_of(move);
    Frustum shape{low.x, high.x, high.y - low.y};
    if (rim != nullptr) {
        shape.rim_radius = rim->x;
        shape.rim_height = rim->y - low.y;
    }
    return {shape, move.start + axis * low.y, axis, move.along};
}

// Returns a quarter of the unit circle, from straight down to straight out, as 2^k chords that each lie at most
// `sagitta` inside it.
std::vector<Vec2> quarter_circle(double sagitta) {
    std::vector<Vec2> points{{0.0, -1.0}, {1.0, 0.0}};
    constexpr int kMostHalvings = 8;
    for (int halving = 0; halving <= kMostHalvings; ++halving) {
        const Vec2 chord = 0.5 * (points[0] + points[1]);
        if (1.0 - std::sqrt(glm::dot(chord, chord)) <= sagitta) break;
        std::vector<Vec2> finer;
        for (std::size_t i = 0; i + 1 < points.size(); ++i) {
            const Vec2 middle = points[i] + points[i + 1];
            finer.push_back(points[i]);
            finer.push_back(middle / std::sqrt(glm::dot(middle, middle)));
        }
        finer.push_back(points.back());
        points = std::move(finer);
    }
    return points;
}

}  // namespace

Result<Extent> extent_of(const CylinderTool& tool, double unit_m) {
    if (!above_zero({tool.radius_m, tool.length_m})) return no_size("cylinder", "a radius and a length above zero");
    return within_reach("cylinder", round_extent(tool.radius_m / unit_m, tool.length_m / unit_m));
}

Result<Extent> extent_of(const ConeTool& tool, double unit_m) {
    const double wider = std::max(tool.tip_radius_m, tool.top_radius_m);
    if (!above_zero({wider, tool.length_m}) || !(tool.tip_radius_m >= 0.0 && tool.top_radius_m >= 0.0)) {
        return no_size("cone", "a length above zero and two radii of which one may be zero");
    }
    return within_reach("cone", round_extent(wider / unit_m, tool.length_m / unit_m));
}

Result<Extent> extent_of(const BullNoseTool& tool, double unit_m) {
    if (!above_zero({tool.radius_m, tool.corner_radius_m, tool.length_m})) {
        return no_size("bullnose", "a radius, a corner radius and a length above zero");
    }
    if (tool.corner_radius_m > tool.radius_m || tool.corner_radius_m > tool.length_m) {
        return fail("tool bullnose", "has a corner larger than its radius or its length",
                    "give a corner radius up to the smaller of the two");
    }
    return within_reach("bullnose", round_extent(tool.radius_m / unit_m, tool.length_m / unit_m));
}

Result<Extent> extent_of(const BoxTool& tool, double unit_m) {
    const Vec3& h = tool.half_size_m;
    if (!above_zero({h.x, h.y, h.z})) return no_size("box", "three sizes above zero");
    return within_reach("box", Extent{Vec3(0.0), std::sqrt(glm::dot(h, h)) / unit_m, false});
}

void append_pieces(const CylinderTool& tool, const StraightMove& move, double unit_m, double /*tolerance*/,
                   std::vector<ConvexPiece>& pieces) {
    const double radius = tool.radius_m / unit_m;
    pieces.emplace_back(slice({radius, 0.0}, {radius, tool.length_m / unit_m}, move));
}

void append_pieces(const ConeTool& tool, const StraightMove& move, double unit_m, double /*tolerance*/,
                   std::vector<ConvexPiece>& pieces) {
    pieces.emplace_back(
        slice({tool.tip_radius_m / unit_m, 0.0}, {tool.top_radius_m / unit_m, tool.length_m / unit_m}, move));
}

void append_pieces(const BullNoseTool& tool, const StraightMove& move, double unit_m, double tolerance,
                   std::vector<ConvexPiece>& pieces) {
    const double radius = tool.radius_m / unit_m, corner = tool.corner_radius_m / unit_m,
                 length = tool.length_m / unit_m;
    const Vec2 rim(radius - corner, corner);
    const std::vector<Vec2> profile = quarter_circle(0.25 * tolerance / corner);
    for (std::size_t i = 0; i + 1 < profile.size(); ++i) {
        pieces.emplace_back(slice(rim + corner * profile[i], rim + corner * profile[i + 1], move, &rim));
    }
    if (length > corner) pieces.emplace_back(slice({radius, corner}, {radius, length}, move));
}

void append_pieces(const BoxTool& tool, const StraightMove& move, double unit_m, double /*tolerance*/,
                   std::vector<ConvexPiece>& pieces) {
    pieces.emplace_back(BoxSweep(tool.half_size_m / unit_m, move.start, move.orientation, move.along));
}

}  // namespace burin::compute
