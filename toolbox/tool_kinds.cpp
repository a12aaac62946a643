// SPDX-License-Identifier: MIT
#include "toolbox/tool_kinds.hpp"
#include "geometry/files/closed_mesh.hpp"

#include <algorithm>
#include <charconv>

#include "base/numbers.hpp"
#include "base/try.hpp"
#include "compute/tools/mesh_tool.hpp"

namespace burin::toolbox {
namespace {

using Made = Result<compute::ToolShape>;

constexpr std::string_view kAboveZero = "give sizes above zero, in metres";
constexpr std::string_view kConeSizes = "give a length above zero, and one radius above zero";

Made read_mesh_tool(const ToolSpec& spec) {
    BURIN_TRY(closed, geometry::load_closed_mesh({.file = spec.file, .units = spec.units}));
    Result<compute::MeshTool> tool =
        compute::prepare_mesh_tool(std::make_shared<const geometry::TriangleMesh>(std::move(closed.mesh)));
    if (!tool) {
        tool.error().where = spec.file;
        return std::unexpected(tool.error());
    }
    return compute::ToolShape(std::move(*tool));
}

bool a_radius_is_above_zero(const ToolSizes& s) { return s[0] + s[1] > 0.0; }
ToolSizes with_a_radius(ToolSizes s, std::size_t kept, double least_m) {
    if (!a_radius_is_above_zero(s)) s[kept == 0 ? 1 : 0] = least_m;
    return s;
}

bool corner_fits(const ToolSizes& s) { return s[1] <= s[0] && s[1] <= s[2]; }
ToolSizes with_fitting_corner(ToolSizes s, std::size_t kept, double /*least_m*/) {
    if (kept == 1) return {std::max(s[0], s[1]), s[1], std::max(s[2], s[1])};
    return {s[0], std::min({s[0], s[1], s[2]}), s[2]};
}

// To add a kind: its struct in compute::ToolShape, its enumerator in ToolKind at the same place, and a row here.
constexpr std::array<ToolDescriptor, kToolKinds> kKinds{{
    {.kind = ToolKind::ball,
     .name = "ball",
     .sizes = {{{"R", "radius"}}},
     .size_remedy = kAboveZero,
     .rule = {},
     .proportions = {1.0},
     .make = [](const ToolSpec& t) -> Made { return compute::BallTool{t.sizes_m[0]}; }},
    {.kind = ToolKind::cylinder,
     .name = "cylinder",
     .sizes = {{{"R", "radius"}, {"L", "length"}}},
     .size_remedy = kAboveZero,
     .rule = {},
     .proportions = {1.0, 4.0},
     .make = [](const ToolSpec& t) -> Made { return compute::CylinderTool{t.sizes_m[0], t.sizes_m[1]}; }},
    {.kind = ToolKind::cone,
     .name = "cone",
     .sizes = {{{"R0", "tip radius", true}, {"R1", "top radius", true}, {"L", "length"}}},
     .size_remedy = kConeSizes,
     .rule = {a_radius_is_above_zero, "has no size", kConeSizes, with_a_radius},
     .proportions = {0.0, 1.0, 3.0},
     .make = [](const ToolSpec& t) -> Made { return compute::ConeTool{t.sizes_m[0], t.sizes_m[1], t.sizes_m[2]}; }},
    {.kind = ToolKind::bullnose,
     .name = "bullnose",
     .sizes = {{{"R", "radius"}, {"C", "corner"}, {"L", "length"}}},
     .size_remedy = kAboveZero,
     .rule = {corner_fits, "has a corner larger than its radius or its length",
              "write bullnose:R,C,L with C up to both", with_fitting_corner},
     .proportions = {1.0, 0.25, 4.0},
     .make = [](const ToolSpec& t) -> Made { return compute::BullNoseTool{t.sizes_m[0], t.sizes_m[1], t.sizes_m[2]}; }},
    {.kind = ToolKind::box,
     .name = "box",
     .sizes = {{{"X", "width"}, {"Y", "height"}, {"Z", "depth"}}},
     .size_remedy = kAboveZero,
     .rule = {},
     .proportions = {2.0, 2.0, 2.0},
     .make = [](const ToolSpec& t) -> Made {
         return compute::BoxTool{0.5 * Vec3(t.sizes_m[0], t.sizes_m[1], t.sizes_m[2])};
     }},
    {.kind = ToolKind::mesh,
     .name = "mesh",
     .sizes = {},
     .size_remedy = {},
     .rule = {},
     .proportions = {},
     .make = read_mesh_tool},
}};

constexpr bool each_kind_has_its_row() {
    for (std::size_t i = 0; i < kKinds.size(); ++i) {
        const ToolDescriptor& kind = kKinds[i];
        if (kind.kind != static_cast<ToolKind>(i) || kind.make == nullptr) return false;
        if (kind.on_panel() == kind.used_sizes().empty()) return false;
    }
    return true;
}
static_assert(each_kind_has_its_row(),
              "give each alternative of compute::ToolShape an enumerator and a row, in order, "
              "with proportions for a kind that has sizes");

constexpr OperationDescriptor described(compute::Operation operation) {
    switch (operation) {
        // A warm wood under whatever the workpiece's skin is.
        case compute::Operation::cut: return {operation, "cut", "cut", {224, 142, 54}};
        case compute::Operation::fill: return {operation, "fill", "filled", {96, 158, 122}};
        case compute::Operation::paint: return {operation, "paint", "painted", {66, 104, 196}};
        // Seen only where there was no surface nearby to take the colour from.
        case compute::Operation::smooth: return {operation, "smooth", "smoothed", {190, 190, 190}};
    }
    return {};
}
constexpr auto kOperations = table_of<compute::Operation, described>();

}  // namespace

std::span<const ToolDescriptor> tool_kinds() { return kKinds; }
const ToolDescriptor& descriptor_of(ToolKind kind) { return kKinds.at(static_cast<std::size_t>(kind)); }

std::string synopsis_of(const ToolDescriptor& kind) {
    std::string text(kind.name);
    if (kind.used_sizes().empty()) return text + ":FILE";
    for (const ToolSize& size : kind.used_sizes())
        text += (&size == kind.sizes.data() ? ":" : ",") + std::string(size.symbol);
    return text;
}

std::vector<std::string> tool_synopses() {
    std::vector<std::string> all;
    for (const ToolDescriptor& kind : kKinds) all.push_back(synopsis_of(kind));
    return all;
}

Result<ToolSpec> parse_tool_spec(std::string_view text, const std::string& where) {
    const std::size_t colon = text.find(':');
    const auto kind = std::ranges::find(kKinds, text.substr(0, colon), &ToolDescriptor::name);
    if (kind == kKinds.end()) {
        return fail(where, "is not a tool", "write " + alternatives(tool_synopses()) + ", in metres");
    }
    const std::string_view rest = colon == std::string_view::npos ? std::string_view{} : text.substr(colon + 1);
    ToolSpec tool{kind->kind, {}, {}};
    const std::size_t count = kind->used_sizes().size();
    if (count == 0) {
        if (rest.empty() || rest.contains('\0')) return fail(where, "names no file", "write " + synopsis_of(*kind));
        tool.file = rest;
        return tool;
    }
    BURIN_TRY(sizes, parse_numbers(rest, count, where));
    std::ranges::copy(sizes, tool.sizes_m.begin());
    BURIN_TRY_DO(check_sizes(tool, where));
    return tool;
}

std::string text_of(const ToolSpec& tool) {
    const ToolDescriptor& kind = descriptor_of(tool.kind);
    std::string text = std::string(kind.name) + ":" + tool.file;
    for (std::size_t i = 0; i < kind.used_sizes().size(); ++i) {
        std::array<char, 32> digits{};
        const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), tool.sizes_m.at(i)).ptr;
        if (i > 0) text += ',';
        text.append(digits.data(), end);
    }
    return text;
}

Result<void> check_sizes(const ToolSpec& tool, const std::string& where) {
    const ToolDescriptor& kind = descriptor_of(tool.kind);
    for (std::size_t i = 0; i < kind.used_sizes().size(); ++i) {
        const double size_m = tool.sizes_m.at(i);
        if (!(size_m > 0.0 || (kind.sizes.at(i).may_be_zero && size_m == 0.0))) {
            return fail(where, "has no size", std::string(kind.size_remedy));
        }
        if (size_m > kMostToolSize_m) return fail(where, "is larger than 10 m", "give sizes in metres");
    }
    const SizeRule& rule = kind.rule;
    if (rule.holds == nullptr || rule.holds(tool.sizes_m)) return {};
    return fail(where, std::string(rule.problem), std::string(rule.remedy));
}

Result<compute::ToolShape> make_shape(const ToolSpec& tool) { return descriptor_of(tool.kind).make(tool); }

double half_width_m(const ToolSpec& tool) {
    const ToolSizes& of_unit_ball = descriptor_of(tool.kind).proportions;
    const auto measure = std::ranges::find_if(of_unit_ball, [](double part) { return part > 0.0; });
    if (measure == of_unit_ball.end()) return 0.0;
    return tool.sizes_m.at(static_cast<std::size_t>(measure - of_unit_ball.begin())) / *measure;
}

ToolSpec resized(ToolSpec tool, double half_width_m) {
    const double now_m = toolbox::half_width_m(tool);
    if (tool.kind == ToolKind::ball)
        tool.sizes_m[0] = half_width_m;  // to the bit
    else if (now_m > 0.0)
        for (double& size_m : tool.sizes_m) size_m *= half_width_m / now_m;
    return tool;
}

double ball_radius_m(const ToolSpec& tool) { return tool.kind == ToolKind::ball ? tool.sizes_m[0] : 0.0; }

std::span<const OperationDescriptor> operations() { return kOperations; }
const OperationDescriptor& descriptor_of(compute::Operation operation) {
    return kOperations.at(static_cast<std::size_t>(operation));
}

}  // namespace burin::toolbox
