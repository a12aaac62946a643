// SPDX-License-Identifier: MIT
#include "toolbox/tool_options.hpp"

#include <algorithm>
#include <cmath>

#include "base/numbers.hpp"
#include "base/text.hpp"
#include "base/try.hpp"
#include "compute/tools/turning_sweep.hpp"
#include "toolbox/tool_mesh.hpp"

namespace burin::toolbox {
namespace {

// What the tick looks at around a tool (haptics/forces/tool_surface.hpp), of the tool's size.
constexpr double kSurroundings = 1.0;

// Bounds the poses that one sweep may replace, because the search for the next sweep looks at all of them.
constexpr std::size_t kLongestRun = 1024, kLongestTurningRun = 64;
// Radius of the tool where none is given, as a share of the workpiece's longest side.
constexpr double kUsualRadius = 0.05;

Result<std::array<std::uint8_t, 3>> parse_colour(const std::string& text) {
    const std::string where = "--material " + text;
    const auto numbers = parse_numbers(text, 3, where);
    if (!numbers) return std::unexpected(numbers.error());
    std::array<std::uint8_t, 3> colour{};
    for (std::size_t k = 0; k < 3; ++k) {
        const double part = (*numbers)[k];
        if (!(part >= 0.0 && part <= 255.0) || part != std::floor(part)) {
            return fail(where, "is no colour", "write R,G,B, whole numbers from 0 to 255");
        }
        colour[k] = static_cast<std::uint8_t>(part);
    }
    return colour;
}

// How far a point of the tool, at most reach_m from its origin, is off its place where the tool goes straight and turns
// evenly from one pose to another instead of passing through this pose; at the share of the way where it is least, by
// small angles.
double off_the_way(const Pose& pose, const Pose& from, const Pose& to, double reach_m) {
    const auto turn_m = [&](const Quat& a, const Quat& b) {
        Quat q = b * glm::conjugate(a);
        if (q.w < 0.0) q = -q;
        return 2.0 * reach_m * Vec3(q.x, q.y, q.z);
    };
    const Vec3 way = to.position_m - from.position_m, done = pose.position_m - from.position_m;
    if (from.orientation == to.orientation && from.orientation == pose.orientation) {
        const double length2 = glm::dot(way, way);
        const double share = length2 > 0.0 ? std::clamp(glm::dot(done, way) / length2, 0.0, 1.0) : 0.0;
        return glm::length(pose.position_m - (from.position_m + way * share));
    }
    const Vec3 way_turned = turn_m(from.orientation, to.orientation);
    const Vec3 done_turned = turn_m(from.orientation, pose.orientation);
    const double length2 = glm::dot(way, way) + glm::dot(way_turned, way_turned);
    const double share =
        length2 > 0.0 ? std::clamp((glm::dot(done, way) + glm::dot(done_turned, way_turned)) / length2, 0.0, 1.0) : 0.0;
    const Quat there = compute::turned(from.orientation, to.orientation, share);
    return glm::length(done - way * share) + glm::length(turn_m(there, pose.orientation));
}

// Whether one sweep from the first of these poses to the last stands for all.
bool one_sweep_replaces(std::span<const Pose> poses, const Tool& tool, double reach_m, double tolerance_m) {
    const bool turning = tool.turns() && poses.front().orientation != poses.back().orientation;
    if (poses.size() > (turning ? kLongestTurningRun : kLongestRun) + 1) return false;
    const auto as_felt = [&](const Pose& pose) { return tool.turns() ? pose : Pose{pose.position_m}; };
    return std::ranges::all_of(poses.subspan(1, poses.size() - 2), [&](const Pose& pose) {
        return off_the_way(as_felt(pose), as_felt(poses.front()), as_felt(poses.back()), reach_m) <= tolerance_m;
    });
}

// Returns how wide a tool is across: of a ball the diameter, of a mesh the longest side of its box.
double width_of(const ToolSpec& spec, const compute::ToolShape& shape) {
    if (const auto* mesh = std::get_if<compute::MeshTool>(&shape)) {
        Box box;
        for (const Vec3& p : mesh->mesh->positions_m) box.include(p);
        const Vec3 size_m = box.extent();
        return std::max({size_m.x, size_m.y, size_m.z});
    }
    return 2.0 * half_width_m(spec);
}

}  // namespace

ToolOptions with_tool(ToolOptions options, double longest_side_m) {
    if (options.shape.empty()) options.shape = formatted("ball:%.2g", kUsualRadius * longest_side_m);
    return options;
}

Result<ToolSettings> parse_tool_settings(const ToolOptions& options) {
    ToolSettings settings;
    if (!options.shape.empty()) {
        BURIN_TRY(shape, parse_tool_spec(options.shape, "--tool " + options.shape));
        settings.shape = std::move(shape);
        settings.shape.units = options.units;
    }
    settings.operation = options.operation;
    settings.sweep_tolerance_cells = options.sweep_tolerance_cells;
    settings.smooth_strength = options.smooth_strength;
    BURIN_TRY_DO(check_tool(settings));
    if (options.material.empty()) return settings;
    BURIN_TRY(colour, parse_colour(options.material));
    settings.colour = colour;
    return settings;
}

Result<void> check_tool(const ToolSettings& settings) {
    const std::string where = "--tool " + text_of(settings.shape);
    return check_sizes(settings.shape, where);
}

Result<Tool> make_tool(const ToolSettings& settings) {
    BURIN_TRY(shape, make_shape(settings.shape));
    return make_tool(settings, std::move(shape));
}

Tool make_tool(const ToolSettings& settings, compute::ToolShape shape) {
    return {std::move(shape), settings.operation, 0, settings.sweep_tolerance_cells, settings.smooth_strength};
}

Result<Tool> parse_tool(const ToolOptions& options) {
    BURIN_TRY(settings, parse_tool_settings(options));
    return make_tool(settings);
}

geometry::Material material_of(const ToolSettings& settings) {
    const OperationDescriptor& operation = descriptor_of(settings.operation);
    return {std::string(operation.material), settings.colour.value_or(operation.colour)};
}

Json describe_tool(const ToolOptions& options, const geometry::Material& material) {
    return {{"shape", options.shape},
            {"operation", descriptor_of(options.operation).name},
            {"material_rgb", material.colour},
            {"sweep_tolerance_cells", options.sweep_tolerance_cells}};
}

std::optional<std::string> misfit(const ToolSettings& settings, const Tool& tool, double longest_side_m,
                                  double cell_m) {
    const double width_m = width_of(settings.shape, tool.shape);
    const bool large = width_m > longest_side_m;
    if (!large && width_m >= cell_m) return std::nullopt;
    const std::string suits = with_tool({}, longest_side_m).shape;
    const std::string tool_is = "the tool " + text_of(settings.shape) + " is " + in_millimetres(width_m) + " wide";
    if (large) {
        return tool_is + ", wider than the whole workpiece, whose longest side is " + in_millimetres(longest_side_m) +
               "; take one such as " + suits + ", or check the workpiece's size and unit (--units)";
    }
    return tool_is + ", narrower than a cell of the lattice, which is " + in_millimetres(cell_m) +
           " in a workpiece whose longest side is " + in_millimetres(longest_side_m) + "; take one such as " + suits +
           ", raise --resolution, or check the workpiece's size and unit (--units)";
}

std::vector<compute::ToolSweep> sweeps_along(std::span<const Pose> poses, const Tool& tool, double tolerance_m) {
    if (poses.size() == 1) return {tool.sweep(poses[0], poses[0])};
    const double reach_m = reach_of(tool.shape);
    std::vector<compute::ToolSweep> sweeps;
    for (std::size_t from = 0; from + 1 < poses.size();) {
        std::size_t to = from + 1;
        while (tolerance_m >= 0.0 && to + 1 < poses.size() &&
               one_sweep_replaces(poses.subspan(from, to + 2 - from), tool, reach_m, tolerance_m))
            ++to;
        sweeps.push_back(tool.sweep(poses[from], poses[to]));
        from = to;
    }
    return sweeps;
}

double around_m(const Tool& tool) { return reach_of(tool.shape) + kSurroundings * size_of(tool.shape); }

haptics::ToolAction action_of(compute::Operation operation) {
    switch (operation) {
        case compute::Operation::cut: return haptics::ToolAction::cut;
        case compute::Operation::fill: return haptics::ToolAction::fill;
        case compute::Operation::paint: return haptics::ToolAction::paint;
        case compute::Operation::smooth: break;
    }
    return haptics::ToolAction::touch;
}

}  // namespace burin::toolbox
