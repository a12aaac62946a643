// SPDX-License-Identifier: MIT
#include "toolbox/tool_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "compute/tools/mesh_tool.hpp"

namespace burin::toolbox {
namespace {

using geometry::TriangleMesh;

constexpr double kStep = 0.12;               // longest edge, of the tool's size
constexpr double kMostTriangles = 20'000.0;  // about
constexpr int kSegments = 32;

// Divides a triangle evenly into parts no longer than step_m.
void add_divided(TriangleMesh& mesh, const Vec3& a, const Vec3& b, const Vec3& c, double step_m) {
    const double longest = std::max({glm::length(b - a), glm::length(c - b), glm::length(a - c)});
    const int parts = std::max(1, static_cast<int>(std::ceil(longest / step_m)));
    const auto first = static_cast<std::uint32_t>(mesh.positions_m.size());
    // Row j has parts + 1 - j points.
    const auto at = [&](int i, int j) {
        return first + static_cast<std::uint32_t>(j * (parts + 1) - j * (j - 1) / 2 + i);
    };
    for (int j = 0; j <= parts; ++j)
        for (int i = 0; i + j <= parts; ++i)
            mesh.positions_m.push_back(a + (b - a) * (double(i) / parts) + (c - a) * (double(j) / parts));
    for (int j = 0; j < parts; ++j)
        for (int i = 0; i + j < parts; ++i) {
            mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i, j + 1)});
            if (i + j + 1 < parts) mesh.triangles.push_back({at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
        }
}

void add_quad(TriangleMesh& mesh, const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, double step_m) {
    add_divided(mesh, a, b, c, step_m);
    add_divided(mesh, a, c, d, step_m);
}

// What is drawn is welded where it closes; what is felt keeps the positions that recorded forces came from.
enum class Seam { welded, as_felt };

TriangleMesh revolved(const Outline& outline, double step_m, int segments, Seam seam) {
    TriangleMesh mesh;
    const auto place = [&](const OutlinePoint& p, int segment) {
        const int at = seam == Seam::welded ? segment % segments : segment;
        const double angle = 2.0 * std::numbers::pi * at / segments;
        return Vec3(p.radius_m * std::cos(angle), p.height_m, p.radius_m * std::sin(angle));
    };
    for (std::size_t i = 0; i + 1 < outline.size(); ++i) {
        const OutlinePoint &from = outline[i], &to = outline[i + 1];
        for (int k = 0; k < segments; ++k) {
            const Vec3 a = place(from, k), b = place(from, k + 1), c = place(to, k + 1), d = place(to, k);
            if (from.radius_m == 0.0)
                add_divided(mesh, a, d, c, step_m);
            else if (to.radius_m == 0.0)
                add_divided(mesh, a, d, b, step_m);
            else
                add_quad(mesh, a, d, c, b, step_m);
        }
    }
    return mesh;
}

TriangleMesh box_of(const Vec3& half, double step_m) {
    TriangleMesh mesh;
    for (int axis = 0; axis < 3; ++axis)
        for (const double side : {-1.0, 1.0}) {
            Vec3 out(0.0), u(0.0), v(0.0);
            out[axis] = side * half[axis];
            u[(axis + 1) % 3] = half[(axis + 1) % 3];
            v[(axis + 2) % 3] = side * half[(axis + 2) % 3];  // u x v points outward
            add_quad(mesh, out - u - v, out + u - v, out + u + v, out - u + v, step_m);
        }
    return mesh;
}

// Triangles of each kind of tool, none longer than step_m. A kind without an operator here does not compile: none takes
// "all others".
struct Triangles {
    double step_m = HUGE_VAL;
    int segments = 0;
    Seam seam = Seam::welded;

    TriangleMesh operator()(const compute::BallTool& tool) const { return turned(tool); }
    TriangleMesh operator()(const compute::CylinderTool& tool) const { return turned(tool); }
    TriangleMesh operator()(const compute::ConeTool& tool) const { return turned(tool); }
    TriangleMesh operator()(const compute::BullNoseTool& tool) const { return turned(tool); }
    TriangleMesh operator()(const compute::BoxTool& tool) const { return box_of(tool.half_size_m, step_m); }
    TriangleMesh operator()(const compute::MeshTool& tool) const {
        if (step_m == HUGE_VAL) return *tool.mesh;
        const std::vector<Vec3>& at_m = tool.mesh->positions_m;
        TriangleMesh mesh;
        for (const auto& [a, b, c] : tool.mesh->triangles) add_divided(mesh, at_m[a], at_m[b], at_m[c], step_m);
        return mesh;
    }

private:
    TriangleMesh turned(const auto& tool) const { return revolved(outline_of(tool), step_m, segments, seam); }
};

}  // namespace

Outline outline_of(const compute::BallTool& tool) {
    Outline outline;
    constexpr int kParts = 48;
    for (int i = 0; i <= kParts; ++i) {
        const double angle = std::numbers::pi * i / kParts;
        outline.push_back({tool.radius_m * std::sin(angle), -tool.radius_m * std::cos(angle)});
    }
    return outline;
}
Outline outline_of(const compute::CylinderTool& tool) {
    return {{0.0, 0.0}, {tool.radius_m, 0.0}, {tool.radius_m, tool.length_m}, {0.0, tool.length_m}};
}
Outline outline_of(const compute::ConeTool& tool) {
    return {{0.0, 0.0}, {tool.tip_radius_m, 0.0}, {tool.top_radius_m, tool.length_m}, {0.0, tool.length_m}};
}
Outline outline_of(const compute::BullNoseTool& tool) {
    Outline outline{{0.0, 0.0}};
    constexpr int kParts = 12;
    const double corner = tool.corner_radius_m, flat = tool.radius_m - corner;
    for (int i = 0; i <= kParts; ++i) {
        const double angle = 0.5 * std::numbers::pi * i / kParts;
        outline.push_back({flat + corner * std::sin(angle), corner * (1.0 - std::cos(angle))});
    }
    outline.push_back({tool.radius_m, tool.length_m});
    outline.push_back({0.0, tool.length_m});
    return outline;
}

Box bounds_of(const compute::ToolShape& shape) {
    const auto around_axis = [](double radius_m, double length_m) {
        return Box{{-radius_m, 0.0, -radius_m}, {radius_m, length_m, radius_m}};
    };
    struct Visitor {
        decltype(around_axis)& turned;
        Box operator()(const compute::BallTool& t) const { return {Vec3(-t.radius_m), Vec3(t.radius_m)}; }
        Box operator()(const compute::CylinderTool& t) const { return turned(t.radius_m, t.length_m); }
        Box operator()(const compute::ConeTool& t) const {
            return turned(std::max(t.tip_radius_m, t.top_radius_m), t.length_m);
        }
        Box operator()(const compute::BullNoseTool& t) const { return turned(t.radius_m, t.length_m); }
        Box operator()(const compute::BoxTool& t) const { return {-t.half_size_m, t.half_size_m}; }
        Box operator()(const compute::MeshTool& t) const {
            Box box;
            for (const Vec3& p : t.mesh->positions_m) box.include(p);
            return box;
        }
    };
    return std::visit(Visitor{around_axis}, shape);
}

double size_of(const compute::ToolShape& shape) {
    const Vec3 extent = bounds_of(shape).extent();
    return 0.5 * std::min({extent.x, extent.y, extent.z});
}

double reach_of(const compute::ToolShape& shape) {
    if (const auto* ball = std::get_if<compute::BallTool>(&shape)) return ball->radius_m;
    if (const auto* tool = std::get_if<compute::MeshTool>(&shape)) {
        if (tool->edges) return glm::length(tool->edges->middle_m) + tool->edges->radius_m;
        double farthest2 = 0.0;
        for (const Vec3& p : tool->mesh->positions_m) farthest2 = std::max(farthest2, glm::dot(p, p));
        return std::sqrt(farthest2);
    }
    const Box box = bounds_of(shape);
    return glm::length(glm::max(glm::abs(box.lo), glm::abs(box.hi)));
}

Spine spine_of(const compute::ToolShape& shape) {
    const Box box = bounds_of(shape);
    const Vec3 extent = box.extent();
    if (const auto* ball = std::get_if<compute::BallTool>(&shape)) return {Vec3(0.0), Vec3(0.0), ball->radius_m};
    double radius_m = size_of(shape);
    if (const auto* cone = std::get_if<compute::ConeTool>(&shape))
        radius_m = std::min(radius_m, 0.6 * std::max(cone->tip_radius_m, cone->top_radius_m));
    int longest = 0;
    for (int i = 1; i < 3; ++i)
        if (extent[i] > extent[longest]) longest = i;
    Vec3 half(0.0);
    half[longest] = std::max(0.5 * extent[longest] - radius_m, 0.0);
    return {box.center() - half, box.center() + half, radius_m};
}

double tip_m(const compute::ToolShape& shape) { return -bounds_of(shape).lo.y; }

double shaft_height_m(const compute::ToolShape& shape) {
    return std::holds_alternative<compute::BallTool>(shape) ? 0.0 : bounds_of(shape).hi.y;
}

TriangleMesh drawing_of(const compute::ToolShape& shape) {
    constexpr int kAround = 48;
    return std::visit(Triangles{HUGE_VAL, kAround, Seam::welded}, shape);
}

TriangleMesh mesh_of(const compute::ToolShape& shape) {
    const Vec3 extent = bounds_of(shape).extent();
    const double area = 2.0 * (extent.x * extent.y + extent.y * extent.z + extent.z * extent.x);
    const double step_m = std::max(kStep * size_of(shape), std::sqrt(2.0 * area / kMostTriangles));
    return std::visit(Triangles{step_m, kSegments, Seam::as_felt}, shape);
}

}  // namespace burin::toolbox
