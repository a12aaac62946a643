// SPDX-License-Identifier: MIT
#include "sculpt/felt_tool.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "geometry/mesh/triangle_tree.hpp"
#include "sculpt/tool_mesh.hpp"

namespace burin::sculpt {
namespace {

using haptics::SurfacePoint;

// Points by which the shape is known, and what difference of normals counts as half of the tool's size.
constexpr std::uint32_t kPoints = 400;
constexpr double kTurn = 0.5;
// Of the tool's size: the least ball, but where even that has no room, and what may stand out without another ball.
constexpr double kLeastBall = 0.25, kCovered = 0.03;
// The search for a ball ends here, or within this share of its radius.
constexpr int kMostRounds = 20;
constexpr double kSettled = 1e-3;

struct InnerBall {
    Vec3 center_m{0.0};
    double radius_m = 0.0;
};

// A closed shape turned outward, as triangles that can be asked for the nearest place.
class Shape {
public:
    explicit Shape(const geometry::TriangleMesh& mesh) : mesh_(mesh), tree_(mesh.positions_m, mesh.triangles) {}

    struct Nearest {
        Vec3 place_m{0.0};
        double depth_m = 0.0;  // of what it is nearest to; below zero outside the shape
        Vec3 inward{0.0};      // unit
    };
    [[nodiscard]] Nearest nearest(const Vec3& p) {
        hint_ = tree_.nearest(p, hint_).triangle;
        const geometry::VertexTriple& t = mesh_.triangles[hint_];
        const std::array<Vec3, 3> corners{mesh_.positions_m[t[0]], mesh_.positions_m[t[1]], mesh_.positions_m[t[2]]};
        const Vec3 outward = glm::normalize(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
        const Vec3 place = geometry::nearest_point(corners, p), way = p - place;
        const double distance = glm::length(way);
        if (glm::dot(way, outward) > 0.0) return {place, -distance, -outward};
        return {place, distance, distance > 0.0 ? way / distance : -outward};
    }

private:
    const geometry::TriangleMesh& mesh_;
    geometry::TriangleTree tree_;
    std::uint32_t hint_ = 0;
};

// The largest ball that touches the shape from inside at this point: it becomes smaller until the place nearest to its
// centre is this point.
InnerBall largest_inside(const SurfacePoint& at, Shape& shape, double most_m) {
    double radius_m = most_m;
    for (int round = 0; round < kMostRounds; ++round) {
        const Vec3 center = at.position_m - radius_m * at.normal;
        const Shape::Nearest nearest = shape.nearest(center);
        if (std::abs(nearest.depth_m) >= radius_m * (1.0 - kSettled)) break;
        // The ball that touches at the point and passes through the nearest place.
        const Vec3 way = at.position_m - nearest.place_m;
        const double along = glm::dot(way, at.normal);
        if (!(along > 0.0)) break;
        radius_m = std::min(radius_m, 0.5 * glm::dot(way, way) / along);
    }
    const Vec3 center = at.position_m - radius_m * at.normal;
    return {center, std::clamp(shape.nearest(center).depth_m, 0.0, radius_m)};
}

// A ball of this radius as near to the point as there is room for it; a smaller one where there is none.
InnerBall moved_inside(const SurfacePoint& at, Shape& shape, double radius_m) {
    Vec3 center = at.position_m - radius_m * at.normal;
    Shape::Nearest nearest = shape.nearest(center);
    for (int round = 0; round < kMostRounds && nearest.depth_m < radius_m * (1.0 - kSettled); ++round) {
        center += (radius_m - nearest.depth_m) * nearest.inward;
        nearest = shape.nearest(center);
    }
    return {center, std::clamp(nearest.depth_m, 0.0, radius_m)};
}

// How far the shape stands out of a ball at a point.
double out_of(const InnerBall& ball, const SurfacePoint& point) {
    return std::max(0.0, glm::length(point.position_m - ball.center_m) - ball.radius_m);
}

// What stands out with one ball more: a mean that counts the largest most.
double left_with(const InnerBall& ball, std::span<const SurfacePoint> points, std::span<const double> stands_out,
                 double size_m) {
    double sum = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const double out = std::min(stands_out[i], out_of(ball, points[i])) / size_m;
        const double to_the_fourth = out * out * out * out;
        sum += to_the_fourth * to_the_fourth;
    }
    return sum;
}

}  // namespace

FeltTool felt_tool(const compute::ToolShape& shape) {
    FeltTool felt;
    const double size_m = size_of(shape);
    if (const auto* ball = std::get_if<compute::BallTool>(&shape)) {
        // All balls are alike, and a session may change the radius in every frame.
        static const haptics::ToolSurface kUnit = haptics::tool_surface(mesh_of(compute::BallTool{1.0}), 1.0);
        felt.probe = haptics::ball_probe(ball->radius_m);
        felt.surface = haptics::scaled(kUnit, ball->radius_m);
        return felt;
    }
    const geometry::TriangleMesh mesh = mesh_of(shape);
    felt.surface = haptics::tool_surface(mesh, size_m);
    const std::vector<SurfacePoint> points = haptics::spread_points(mesh, kPoints, kTurn * size_m);
    Shape inside(mesh);
    std::vector<InnerBall> candidates;
    for (const SurfacePoint& point : points) {
        candidates.push_back(largest_inside(point, inside, 2.0 * reach_of(shape)));
        if (candidates.back().radius_m < kLeastBall * size_m)
            candidates.back() = moved_inside(point, inside, kLeastBall * size_m);
    }
    const double clearance = haptics::TickParameters{}.clearance_ratio;
    std::vector<double> stands_out(points.size(), 2.0 * reach_of(shape));
    felt.probe.count = 0;
    felt.probe.rigid_tool = true;
    do {
        const InnerBall& ball = *std::ranges::min_element(
            candidates, {}, [&](const InnerBall& with) { return left_with(with, points, stands_out, size_m); });
        for (std::size_t i = 0; i < points.size(); ++i)
            stands_out[i] = std::min(stands_out[i], out_of(ball, points[i]));
        // The tick makes each ball smaller by the clearance's share of its radius; it is to be a share of the tool's.
        const double touches_m = ball.radius_m - clearance * size_m;
        felt.probe.points[felt.probe.count++] = {ball.center_m, touches_m / (1.0 - clearance)};
        felt.uncovered_m = *std::ranges::max_element(stands_out);
    } while (felt.probe.count < haptics::kMostProbePoints && felt.uncovered_m > kCovered * size_m);
    return felt;
}

}  // namespace burin::sculpt
