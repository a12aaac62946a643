// SPDX-License-Identifier: MIT
#include "toolbox/felt_tool.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <tuple>
#include <vector>

#include "haptics/contact/half_spaces.hpp"
#include "haptics/contact/separation.hpp"
#include "haptics/tick_parameters.hpp"
#include "toolbox/tool_mesh.hpp"
#include "toolbox/tool_samples.hpp"

namespace burin::toolbox {
namespace {

using haptics::HalfSpace;
using haptics::ToolShape;

// The rounding, of the tool's least width: the first of these with which the tool differs by little, else the last.
constexpr std::array kRoundings{0.02, 0.01, 0.005};
constexpr double kDiffersLittle = 0.045;
// Of its corners, so many are measured at.
constexpr std::size_t kMeasuredAt = 2000;
// Cosine between two sides of a tool that count as one.
constexpr double kSameSide = 1.0 - 1e-6;
// Directions by which the hull of a mesh is known, besides those of its faces.
constexpr int kDirections = 600;

std::vector<Vec3> directions() {
    std::vector<Vec3> all;
    const double golden = std::numbers::pi * (3.0 - std::sqrt(5.0));
    for (int i = 0; i < kDirections; ++i) {
        const double y = 1.0 - 2.0 * (i + 0.5) / kDirections, across = std::sqrt(1.0 - y * y);
        all.emplace_back(across * std::cos(golden * i), y, across * std::sin(golden * i));
    }
    return all;
}

// A convex outline in the plane of the axis and one direction across it, on both sides of the axis.
using Polygon = std::vector<Vec2>;

Polygon cut_off(const Polygon& polygon, const Vec2& normal, double offset) {
    Polygon left;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vec2 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
        const double over_a = glm::dot(normal, a) - offset, over_b = glm::dot(normal, b) - offset;
        if (over_a <= 0.0) left.push_back(a);
        if ((over_a < 0.0) != (over_b < 0.0) && over_a != over_b)
            left.push_back(a + (b - a) * (over_a / (over_a - over_b)));
    }
    return left;
}

// The circles whose hull is the turned outline, less `inset` all around.
std::vector<Vec3> inset_circles(const Outline& outline, double inset) {
    Polygon polygon;
    for (const OutlinePoint& p : outline) polygon.emplace_back(p.radius_m, p.height_m);
    for (std::size_t i = outline.size(); i-- > 0;)
        if (outline[i].radius_m > 0.0) polygon.emplace_back(-outline[i].radius_m, outline[i].height_m);
    Polygon left = polygon;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vec2 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
        const double length = glm::length(b - a);
        if (!(length > 0.0)) continue;
        const Vec2 normal = Vec2(b.y - a.y, a.x - b.x) / length;  // outward: the outline is counter-clockwise
        left = cut_off(left, normal, glm::dot(normal, a) - inset);
    }
    std::vector<Vec3> circles;
    for (const Vec2& p : left)
        if (p.x >= -1e-12) circles.emplace_back(std::max(p.x, 0.0), p.y, 0.0);
    return circles;
}

// The corners of a mesh's hull less `inset` all around: each moved to the nearest place that is so far inside.
std::vector<Vec3> inset_corners(const geometry::TriangleMesh& mesh, double inset) {
    std::vector<Vec3> normals = directions();
    std::vector<Vec3> corners;
    const auto farthest = [&](const Vec3& along) {
        return *std::ranges::max_element(mesh.positions_m, {}, [&](const Vec3& p) { return glm::dot(p, along); });
    };
    for (const auto& t : mesh.triangles) {
        const Vec3 area = glm::cross(mesh.positions_m[t[1]] - mesh.positions_m[t[0]],
                                     mesh.positions_m[t[2]] - mesh.positions_m[t[0]]);
        const double length = glm::length(area);
        if (normals.size() < 4096 && length > 0.0) normals.push_back(area / length);
    }
    for (const Vec3& along : directions()) corners.push_back(farthest(along));
    std::ranges::sort(corners,
                      [](const Vec3& a, const Vec3& b) { return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z); });
    corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
    std::vector<HalfSpace> inside;
    for (const Vec3& n : normals) inside.push_back({-n, inset - glm::dot(farthest(n), n)});
    std::vector<Vec3> moved;
    for (const Vec3& corner : corners) {
        const haptics::NearestInside nearest = haptics::nearest_inside(inside, corner, 1e-9 * inset);
        if (nearest.found) moved.push_back(nearest.point);
    }
    return moved;
}

bool put_piece(ToolShape& shape, const std::vector<Vec3>& corners, bool turned) {
    const std::uint32_t first =
        shape.piece_count > 0 ? shape.pieces[shape.piece_count - 1].first + shape.pieces[shape.piece_count - 1].count
                              : 0;
    if (corners.empty() || shape.piece_count == ToolShape::kMostPieces) return false;
    const auto count =
        static_cast<std::uint32_t>(std::min<std::size_t>(corners.size(), ToolShape::kMostCorners - first));
    // Too many are thinned evenly, and `differs_m` measures what that takes.
    for (std::uint32_t i = 0; i < count; ++i) shape.corners[first + i] = corners[i * corners.size() / count];
    shape.pieces[shape.piece_count++] = {first, count, turned};
    return true;
}

// Puts a side, as far out as the piece's corners reach. One that is there already, or is one too many, is left out.
void put_side(ToolShape& shape, const Vec3& normal) {
    if (shape.side_count == ToolShape::kMostSides) return;
    for (std::uint32_t i = 0; i < shape.side_count; ++i)
        if (glm::dot(shape.sides[i].normal, normal) > kSameSide) return;
    double offset_m = -HUGE_VAL;
    for (const Vec3& corner : shape.corners_of(shape.pieces[0]))
        offset_m = std::max(offset_m, glm::dot(corner, normal));
    shape.sides[shape.side_count++] = {normal, offset_m};
}

// The sides of a turned piece: those of its outline, whose corners go from below upwards or the other way.
void put_turned_sides(ToolShape& shape) {
    const std::span<const Vec3> corners = shape.corners_of(shape.pieces[0]);
    put_side(shape, Vec3(0.0, 1.0, 0.0));
    put_side(shape, Vec3(0.0, -1.0, 0.0));
    for (std::size_t i = 1; i < corners.size(); ++i) {
        const Vec3 along = corners[i] - corners[i - 1];
        const Vec3 across(std::abs(along.y), along.y > 0.0 ? -along.x : along.x, 0.0);
        if (glm::length(across) > 0.0) put_side(shape, glm::normalize(across));
    }
}

void put_sides_of(ToolShape& shape, const geometry::TriangleMesh& mesh) {
    for (const auto& t : mesh.triangles) {
        const Vec3 area = glm::cross(mesh.positions_m[t[1]] - mesh.positions_m[t[0]],
                                     mesh.positions_m[t[2]] - mesh.positions_m[t[0]]);
        if (glm::length(area) > 0.0) put_side(shape, glm::normalize(area));
    }
}

// Put what is felt of each kind of tool that is no ball, `inset_m` inside it all around. A kind without one does not
// compile.
void put_turned(ToolShape& shape, const Outline& outline, double inset_m) {
    if (put_piece(shape, inset_circles(outline, inset_m), true)) put_turned_sides(shape);
}
void put_felt(ToolShape& shape, const compute::CylinderTool& tool, double inset_m) {
    put_turned(shape, outline_of(tool), inset_m);
}
void put_felt(ToolShape& shape, const compute::ConeTool& tool, double inset_m) {
    put_turned(shape, outline_of(tool), inset_m);
}
void put_felt(ToolShape& shape, const compute::BullNoseTool& tool, double inset_m) {
    put_turned(shape, outline_of(tool), inset_m);
}
void put_felt(ToolShape& shape, const compute::BoxTool& tool, double inset_m) {
    std::vector<Vec3> corners;
    const Vec3 half = tool.half_size_m - inset_m;
    for (int i = 0; i < 8; ++i)
        corners.emplace_back((i & 1) != 0 ? half.x : -half.x, (i & 2) != 0 ? half.y : -half.y,
                             (i & 4) != 0 ? half.z : -half.z);
    put_piece(shape, corners, false);
    for (int axis = 0; axis < 3; ++axis)
        for (const double side : {-1.0, 1.0}) {
            Vec3 normal(0.0);
            normal[axis] = side;
            put_side(shape, normal);
        }
}
void put_felt(ToolShape& shape, const compute::MeshTool& tool, double inset_m) {
    if (put_piece(shape, inset_corners(*tool.mesh, inset_m), false)) put_sides_of(shape, *tool.mesh);
}

// Finds bounds, reach and middle of the pieces that were put.
void bound_pieces(ToolShape& shape) {
    Vec3 sum(0.0);
    double count = 0.0;
    for (std::uint32_t k = 0; k < shape.piece_count; ++k)
        for (const Vec3& c : shape.corners_of(shape.pieces[k])) {
            const bool turned = shape.pieces[k].turned;
            const Vec3 most = turned ? Vec3(c.x, c.y, c.x) : c, least = turned ? Vec3(-c.x, c.y, -c.x) : c;
            shape.bounds.include(most + shape.rounding_m);
            shape.bounds.include(least - shape.rounding_m);
            shape.reach_m = std::max(shape.reach_m, glm::length(c) + shape.rounding_m);
            sum += turned ? Vec3(0.0, c.y, 0.0) : c;
            count += 1.0;
        }
    if (count > 0.0) shape.inside_m = sum / count;
}

// How far the felt surface is from the tool's at most.
double differing_m(const ToolShape& shape, const geometry::TriangleMesh& mesh) {
    double most = 0.0;
    const std::vector<Vec3> along = directions();
    const std::size_t each = 1 + mesh.positions_m.size() / kMeasuredAt;
    std::vector<Vec3> places;
    for (std::size_t i = 0; i < mesh.positions_m.size(); i += each) places.push_back(mesh.positions_m[i]);
    for (std::size_t i = 0; i < mesh.triangles.size(); i += each) {
        const auto& [a, b, c] = mesh.triangles[i];
        places.push_back((mesh.positions_m[a] + mesh.positions_m[b] + mesh.positions_m[c]) / 3.0);
    }
    for (const Vec3& p : places) {
        double nearest = HUGE_VAL;
        for (std::uint32_t k = 0; k < shape.piece_count; ++k) {
            const haptics::ConvexPiece& piece = shape.pieces[k];
            const haptics::Separation found = haptics::separation(
                shape, piece, {p, p, p}, {Vec3(0.0), shape.inside_m - p, HUGE_VAL, 1e-6 * shape.size_m});
            if (!found.overlaps) {
                nearest = std::min(nearest, std::abs(found.gap_m - shape.rounding_m));
                continue;
            }
            double depth = HUGE_VAL;
            for (const Vec3& n : along) depth = std::min(depth, glm::dot(n, p) - haptics::lowest(shape, piece, n));
            nearest = std::min(nearest, std::max(depth, 0.0) + shape.rounding_m);
        }
        most = std::max(most, nearest);
    }
    return most;
}

FeltTool felt_as(const compute::BallTool& ball) {
    // All balls are alike, and a session may change the radius in every frame.
    static const haptics::ToolSurface kUnit = tool_surface(mesh_of(compute::BallTool{1.0}), 1.0);
    FeltTool felt;
    felt.probe = haptics::ball_probe(ball.radius_m);
    felt.surface = scaled(kUnit, ball.radius_m);
    return felt;
}

template <typename Tool>
FeltTool felt_as(const Tool& tool) {
    FeltTool felt;
    const geometry::TriangleMesh mesh = mesh_of(tool);
    const double size_m = size_of(tool), width_m = 2.0 * size_m;
    felt.surface = tool_surface(mesh, size_m);
    const double clearance_m = haptics::TickParameters{}.clearance_ratio * size_m;
    for (const double rounding : kRoundings) {
        felt.shape = {};
        felt.shape.rounding_m = rounding * width_m;
        felt.shape.size_m = width_m;
        put_felt(felt.shape, tool, rounding * width_m + clearance_m);
        bound_pieces(felt.shape);
        felt.differs_m = differing_m(felt.shape, mesh);
        if (felt.differs_m <= kDiffersLittle * width_m) break;
    }
    return felt;
}

}  // namespace

FeltTool felt_tool(const compute::ToolShape& shape) {
    return std::visit([](const auto& tool) { return felt_as(tool); }, shape);
}

}  // namespace burin::toolbox
