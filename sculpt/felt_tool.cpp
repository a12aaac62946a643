// SPDX-License-Identifier: MIT
#include "sculpt/felt_tool.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "sculpt/tool_mesh.hpp"

namespace burin::sculpt {
namespace {

using haptics::SurfacePoint;

// Points by which the shape is known, and what difference of normals counts as half of the tool's size.
constexpr std::uint32_t kPoints = 400;
constexpr double kTurn = 0.5;
// Of the tool's size: the least ball, and what may stand out without another one.
constexpr double kLeastBall = 0.1, kCovered = 0.03;

struct InnerBall {
    Vec3 center_m{0.0};
    double radius_m = 0.0;
};

// The largest ball that touches the shape from inside at this point. Each point found within it makes it smaller, until
// none is.
InnerBall largest_inside(const SurfacePoint& at, std::span<const SurfacePoint> shape, double most_m) {
    InnerBall ball{at.position_m - most_m * at.normal, most_m};
    for (const SurfacePoint& other : shape) {
        const Vec3 way = at.position_m - other.position_m;
        if (glm::length(other.position_m - ball.center_m) >= ball.radius_m * (1.0 - 1e-6)) continue;
        // The ball that touches at `at` and passes through the other point.
        const double along = glm::dot(way, at.normal);
        if (along > 0.0) ball.radius_m = std::min(ball.radius_m, 0.5 * glm::dot(way, way) / along);
        ball.center_m = at.position_m - ball.radius_m * at.normal;
    }
    return ball;
}

// A ball that is too large for its corner or edge moves inward until it fits.
InnerBall moved_inside(InnerBall ball, std::span<const SurfacePoint> shape) {
    for (int round = 0; round < 20; ++round)
        for (const SurfacePoint& p : shape) {
            const Vec3 way = p.position_m - ball.center_m;
            if (glm::dot(way, way) > 9.0 * ball.radius_m * ball.radius_m) continue;
            const double out = ball.radius_m - glm::dot(way, p.normal);
            if (out > 0.0) ball.center_m -= out * p.normal;
        }
    return ball;
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
    const double clearance = haptics::TickParameters{}.clearance_ratio;
    std::vector<double> stands_out(points.size(), HUGE_VAL);
    felt.probe.count = 0;
    felt.probe.rigid_tool = true;
    std::size_t next = 0;  // the first point, then whichever stands out most
    while (felt.probe.count < haptics::kMostProbePoints) {
        InnerBall ball = largest_inside(points[next], points, 2.0 * reach_of(shape));
        if (ball.radius_m < kLeastBall * size_m) {
            ball.radius_m = kLeastBall * size_m;
            ball.center_m = points[next].position_m - ball.radius_m * points[next].normal;
            ball = moved_inside(ball, points);
        }
        for (std::size_t i = 0; i < points.size(); ++i)
            stands_out[i] = std::min(stands_out[i], glm::length(points[i].position_m - ball.center_m) - ball.radius_m);
        // The tick makes each ball smaller by the clearance's share of its radius; it is to be a share of the tool's.
        const double touches_m = ball.radius_m - clearance * size_m;
        felt.probe.points[felt.probe.count++] = {ball.center_m, touches_m / (1.0 - clearance)};
        next = static_cast<std::size_t>(std::ranges::max_element(stands_out) - stands_out.begin());
        felt.uncovered_m = stands_out[next];
        if (felt.uncovered_m <= kCovered * size_m) break;
    }
    return felt;
}

}  // namespace burin::sculpt
