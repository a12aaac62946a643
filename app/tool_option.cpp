// SPDX-License-Identifier: MIT
#include "app/tool_option.hpp"

#include <algorithm>
#include <cmath>

#include "app/workpiece.hpp"
#include "compute/mesh_tool.hpp"

namespace burin {
namespace {

constexpr std::size_t kLongestRun =
    1024;  // poses that one sweep may replace: the search for the next looks at all of them
const char* const kShapes =
    "write ball:R, cylinder:R,L, cone:R0,R1,L, bullnose:R,C,L, box:X,Y,Z or mesh:FILE, in metres";

struct NamedOperation {
    const char* name;      // as --operation has it
    const char* material;  // what the surface it leaves is called
    std::array<std::uint8_t, 3> colour;
};

const NamedOperation& named(Operation operation) {
    static const NamedOperation cut{"cut", "cut", {224, 142, 54}};  // a warm wood under whatever the skin is
    static const NamedOperation fill{"fill", "filled", {96, 158, 122}};
    static const NamedOperation paint{"paint", "painted", {66, 104, 196}};
    static const NamedOperation smooth{
        "smooth", "smoothed", {190, 190, 190}};  // only where nothing was near to take after
    switch (operation) {
        case Operation::fill: return fill;
        case Operation::paint: return paint;
        case Operation::smooth: return smooth;
        case Operation::cut: break;
    }
    return cut;
}

Result<ToolShape> mesh_tool(const std::string& file) {
    Result<ClosedMesh> closed = load_closed_mesh(file, false);
    if (!closed) return std::unexpected(closed.error());
    Result<MeshTool> tool = prepare_mesh_tool(std::make_shared<const TriangleMesh>(std::move(closed->mesh)));
    if (!tool) {
        tool.error().where = file;
        return std::unexpected(tool.error());
    }
    return ToolShape(std::move(*tool));
}

// What each tool's sizes must be is the core's to say (compute/tool_spans.hpp); here only what no lattice could change.
Result<ToolShape> parse_shape(const std::string& text) {
    const std::size_t colon = text.find(':');
    const std::string kind = text.substr(0, colon), what = "--tool " + text;
    const std::string rest = colon == std::string::npos ? std::string() : text.substr(colon + 1);
    if (kind == "mesh" && !rest.empty()) return mesh_tool(rest);
    const std::size_t count = kind == "ball" ? 1 : kind == "cylinder" ? 2 : 3;
    if (kind != "ball" && kind != "cylinder" && kind != "cone" && kind != "bullnose" && kind != "box") {
        return fail(what, "is not a tool", kShapes);
    }
    const auto numbers = parse_numbers(rest, count, what);
    if (!numbers) return std::unexpected(numbers.error());
    const std::vector<double>& n = *numbers;
    const bool cone = kind == "cone";
    for (std::size_t i = 0; i < n.size(); ++i) {
        const bool may_be_zero = cone && i < 2 && n[0] + n[1] > 0.0;
        if (!(n[i] > 0.0 || (may_be_zero && n[i] == 0.0))) {
            return fail(
                what, "has no size",
                cone ? "give a length above zero, and one radius above zero" : "give sizes above zero, in metres");
        }
    }
    if (kind == "ball") return BallTool{n[0]};
    if (kind == "cylinder") return CylinderTool{n[0], n[1]};
    if (cone) return ConeTool{n[0], n[1], n[2]};
    if (kind == "box") return BoxTool{0.5 * Vec3(n[0], n[1], n[2])};
    if (n[1] > n[0] || n[1] > n[2]) {
        return fail(what, "has a corner larger than its radius or its length",
                    "write bullnose:R,C,L with C up to both");
    }
    return BullNoseTool{n[0], n[1], n[2]};
}

double distance_to_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
    const Vec3 ab = b - a;
    const double length2 = glm::dot(ab, ab);
    const double t = length2 > 0.0 ? std::clamp(glm::dot(p - a, ab) / length2, 0.0, 1.0) : 0.0;
    return glm::length(p - (a + ab * t));
}

}  // namespace

Result<Tool> parse_tool(const ToolOptions& options) {
    Result<ToolShape> shape = parse_shape(options.shape);
    if (!shape) return std::unexpected(shape.error());
    if (options.operation == Operation::smooth && !std::holds_alternative<BallTool>(*shape)) {
        return fail("--tool " + options.shape, "cannot smooth", "use --tool ball:R with --operation smooth");
    }
    return Tool{std::move(*shape), options.operation, 0, options.sweep_tolerance_cells, options.smooth_strength};
}

Result<Material> parse_tool_material(const ToolOptions& options) {
    const NamedOperation& operation = named(options.operation);
    Material material{operation.material, operation.colour};
    if (options.material.empty()) return material;
    const std::string what = "--material " + options.material;
    const auto numbers = parse_numbers(options.material, 3, what);
    if (!numbers) return std::unexpected(numbers.error());
    for (std::size_t k = 0; k < 3; ++k) {
        const double part = (*numbers)[k];
        if (!(part >= 0.0 && part <= 255.0) || part != std::floor(part)) {
            return fail(what, "is no colour", "write R,G,B, whole numbers from 0 to 255");
        }
        material.colour[k] = static_cast<std::uint8_t>(part);
    }
    return material;
}

Json describe_tool(const ToolOptions& options, const Material& material) {
    return {{"shape", options.shape},
            {"operation", named(options.operation).name},
            {"material_rgb", material.colour},
            {"sweep_tolerance_cells", options.sweep_tolerance_cells}};
}

std::vector<ToolSweep> sweeps_along(std::span<const Pose> poses, const Tool& tool, double tolerance_m) {
    std::vector<ToolSweep> sweeps;
    if (poses.size() == 1) return {tool.sweep(poses[0], poses[0])};
    const bool has_orientation = !std::holds_alternative<BallTool>(tool.shape);
    for (std::size_t from = 0; from + 1 < poses.size();) {
        std::size_t to = from + 1;
        const auto unturned = [&](std::size_t end) {
            return !has_orientation || poses[end].orientation == poses[from].orientation;
        };
        const auto straight = [&](std::size_t end) {
            for (std::size_t k = from + 1; k < end; ++k) {
                const double off =
                    distance_to_segment(poses[k].position_m, poses[from].position_m, poses[end].position_m);
                if (off > tolerance_m) return false;
            }
            return true;
        };
        while (tolerance_m >= 0.0 && to + 1 < poses.size() && to - from < kLongestRun && unturned(to) &&
               unturned(to + 1) && straight(to + 1)) {
            ++to;
        }
        sweeps.push_back(tool.sweep(poses[from], poses[to]));
        from = to;
    }
    return sweeps;
}

}  // namespace burin
