// SPDX-License-Identifier: MIT
#include "toolbox/tool_samples.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <span>
#include <vector>

namespace burin::toolbox {
namespace {

using haptics::ToolSample;
using haptics::ToolSurface;

// Of the tool's size: how far from the tool its surroundings are looked at.
constexpr double kReach = 1.0;
// Normals that differ by one count as this far apart, of the tool's size.
constexpr double kTurn = 0.5;

std::vector<SurfacePoint> points_of(const geometry::TriangleMesh& mesh) {
    std::vector<SurfacePoint> points;
    points.reserve(mesh.triangles.size());
    for (const std::array<std::uint32_t, 3>& t : mesh.triangles) {
        const Vec3 a = mesh.positions_m[t[0]], b = mesh.positions_m[t[1]], c = mesh.positions_m[t[2]];
        const Vec3 area = 0.5 * glm::cross(b - a, c - a);
        const double size = std::sqrt(glm::dot(area, area));
        if (size > 0.0) points.push_back({(a + b + c) / 3.0, area / size, size});
    }
    return points;
}

double squared_distance(const SurfacePoint& a, const SurfacePoint& b, double turn_m) {
    const Vec3 way = a.position_m - b.position_m, turn = turn_m * (a.normal - b.normal);
    return glm::dot(way, way) + glm::dot(turn, turn);
}

// The points chosen, each the farthest from those before, and for each point which of them is nearest.
struct Grouping {
    std::vector<std::size_t> chosen;
    std::vector<std::uint32_t> group;
};
Grouping grouped(std::span<const SurfacePoint> points, std::uint32_t most, double turn_m) {
    Grouping result{{}, std::vector<std::uint32_t>(points.size(), 0)};
    std::vector<double> nearest(points.size(), HUGE_VAL);
    std::size_t next = 0;
    while (result.chosen.size() < most) {
        const auto number = static_cast<std::uint32_t>(result.chosen.size());
        result.chosen.push_back(next);
        for (std::size_t i = 0; i < points.size(); ++i) {
            const double d2 = squared_distance(points[i], points[next], turn_m);
            if (d2 < nearest[i]) nearest[i] = d2, result.group[i] = number;
        }
        next = static_cast<std::size_t>(std::ranges::max_element(nearest) - nearest.begin());
        if (!(nearest[next] > 0.0)) break;
    }
    return result;
}

void find_neighbours(ToolSurface& tool) {
    std::vector<std::uint8_t> others(tool.count);
    for (std::uint32_t i = 0; i < tool.count; ++i) {
        std::iota(others.begin(), others.end(), std::uint8_t{0});
        const auto by_distance = [&](std::uint8_t k) {
            const Vec3f way = tool.samples[k].position_m - tool.samples[i].position_m;
            return glm::dot(way, way);
        };
        const std::size_t wanted = std::min(tool.samples[i].beside.size() + 1, others.size());
        std::ranges::partial_sort(others, others.begin() + static_cast<std::ptrdiff_t>(wanted), {}, by_distance);
        tool.samples[i].beside.fill(static_cast<std::uint8_t>(i));
        // The first is the sample itself.
        std::copy(others.begin() + 1, others.begin() + static_cast<std::ptrdiff_t>(wanted),
                  tool.samples[i].beside.begin());
    }
}

void fill_table(ToolSurface& tool) {
    const Vec3f reach(static_cast<float>(tool.reach_m));
    tool.table_lo_m = tool.lo_m - reach;
    const Vec3f size = tool.hi_m + reach - tool.table_lo_m;
    tool.cells_per_m = Vec3f(static_cast<float>(ToolSurface::kCells)) / size;
    const Vec3f cell = size / static_cast<float>(ToolSurface::kCells);
    std::size_t at = 0;
    for (std::uint32_t z = 0; z < ToolSurface::kCells; ++z)
        for (std::uint32_t y = 0; y < ToolSurface::kCells; ++y)
            for (std::uint32_t x = 0; x < ToolSurface::kCells; ++x) {
                const Vec3f middle =
                    tool.table_lo_m +
                    (Vec3f(static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)) + 0.5f) * cell;
                const auto by_distance = [&](const ToolSample& s) {
                    return glm::dot(s.position_m - middle, s.position_m - middle);
                };
                const auto samples = std::span(tool.samples).first(tool.count);
                tool.table[at++] =
                    static_cast<std::uint8_t>(std::ranges::min_element(samples, {}, by_distance) - samples.begin());
            }
}

// Gives each point's area to the sample that a look would give it to.
void share_out_areas(std::span<const SurfacePoint> points, ToolSurface& tool) {
    std::array<double, ToolSurface::kMost> areas_m2{};
    for (const SurfacePoint& p : points) {
        const std::uint8_t sample = tool.nearest_facing(Vec3f(p.position_m), Vec3f(-p.normal));
        if (sample != ToolSurface::kNone) areas_m2[sample] += p.area_m2;
    }
    for (std::uint32_t i = 0; i < tool.count; ++i) {
        tool.samples[i].area_m2 = static_cast<float>(areas_m2[i]);
        tool.samples[i].half_width_m = static_cast<float>(std::sqrt(areas_m2[i] / std::numbers::pi));
    }
}

}  // namespace

std::vector<SurfacePoint> spread_points(const geometry::TriangleMesh& mesh, std::uint32_t most, double turn_m) {
    const std::vector<SurfacePoint> points = points_of(mesh);
    std::vector<SurfacePoint> spread;
    if (points.empty()) return spread;
    for (const std::size_t i : grouped(points, most, turn_m).chosen) spread.push_back(points[i]);
    return spread;
}

ToolSurface tool_surface(const geometry::TriangleMesh& mesh, double size_m) {
    ToolSurface tool;
    const std::vector<SurfacePoint> points = points_of(mesh);
    if (points.empty() || !(size_m > 0.0)) return tool;
    tool.size_m = size_m;
    tool.reach_m = kReach * size_m;
    const std::vector<std::uint32_t> group = grouped(points, ToolSurface::kMost, kTurn * size_m).group;
    struct Sum {
        Vec3 position{0.0}, normal{0.0};
        double area_m2 = 0.0, height = 0.0;
    };
    std::array<Sum, ToolSurface::kMost> sums{};
    for (std::size_t i = 0; i < points.size(); ++i) {
        const SurfacePoint& p = points[i];
        Sum& sum = sums[group[i]];
        sum.position += p.area_m2 * p.position_m;
        sum.normal += p.area_m2 * p.normal;
        sum.area_m2 += p.area_m2;
        sum.height += p.area_m2 * glm::dot(p.normal, p.position_m);
    }
    for (const Sum& sum : sums) {
        const double length = std::sqrt(glm::dot(sum.normal, sum.normal));
        if (!(length > 0.0)) continue;
        const Vec3 normal = sum.normal / length, middle = sum.position / sum.area_m2;
        // The middle of a round part lies inside it. On the plane whose height is the mean of its tangent planes a
        // sample meets the plane of its own bed, which is found in the same way (engagement.hpp).
        const double raised_m = sum.height / length - glm::dot(normal, middle);
        ToolSample& sample = tool.samples[tool.count++];
        sample.position_m = Vec3f(middle + raised_m * normal);
        sample.normal = Vec3f(normal);
        sample.raised_m = static_cast<float>(raised_m);
    }
    Box bounds;
    for (const Vec3& p : mesh.positions_m) bounds.include(p);
    tool.lo_m = Vec3f(bounds.lo);
    tool.hi_m = Vec3f(bounds.hi);
    find_neighbours(tool);
    fill_table(tool);
    share_out_areas(points, tool);
    return tool;
}

ToolSurface scaled(ToolSurface tool, double factor) {
    if (!(factor > 0.0)) return {};
    const auto f = static_cast<float>(factor);
    tool.size_m *= factor;
    tool.reach_m *= factor;
    for (Vec3f* place : {&tool.lo_m, &tool.hi_m, &tool.table_lo_m}) *place *= f;
    tool.cells_per_m /= f;
    for (ToolSample& s : std::span(tool.samples).first(tool.count)) {
        s.position_m *= f;
        s.area_m2 *= f * f;
        s.half_width_m *= f;
        s.raised_m *= f;
    }
    return tool;
}

}  // namespace burin::toolbox
