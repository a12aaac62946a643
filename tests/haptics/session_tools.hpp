// SPDX-License-Identifier: MIT
// The tools that a session offers, as they are felt: a mill, a cone, a bull-nose, a box and a mesh.
#pragma once

#include <memory>
#include <numbers>
#include <vector>

#include "toolbox/felt_tool.hpp"

namespace burin::haptics::test {

struct NamedTool {
    const char* name;
    ToolShape shape;
};

// Of six corners below and above, from the origin up.
inline geometry::TriangleMesh six_sided_bar(double radius_m, double length_m) {
    geometry::TriangleMesh bar;
    for (const double y : {0.0, length_m})
        for (int i = 0; i < 6; ++i) {
            const double angle = i * std::numbers::pi / 3.0;
            bar.positions_m.push_back({radius_m * std::cos(angle), y, radius_m * std::sin(angle)});
        }
    for (std::uint32_t i = 0; i < 6; ++i) {
        const std::uint32_t next = (i + 1) % 6;
        bar.triangles.push_back({i, i + 6, next + 6});
        bar.triangles.push_back({i, next + 6, next});
        if (i > 0 && i < 5) {
            bar.triangles.push_back({0, i, i + 1});
            bar.triangles.push_back({6, i + 7, i + 6});
        }
    }
    return bar;
}

// About `width_m` wide.
inline std::vector<NamedTool> session_tools(double width_m) {
    const auto felt = [](const compute::ToolShape& tool) { return toolbox::felt_tool(tool).shape; };
    const double w = width_m;
    return {
        {"mill", felt(compute::CylinderTool{w / 3.0, 2.0 * w})},
        {"cone", felt(compute::ConeTool{w / 6.0, w / 1.5, 2.0 * w})},
        {"bull-nose", felt(compute::BullNoseTool{w / 2.0, w / 6.0, 2.0 * w})},
        {"box", felt(compute::BoxTool{{w / 1.5, w / 2.0, w / 1.2}})},
        {"mesh", felt(compute::MeshTool{std::make_shared<geometry::TriangleMesh>(six_sided_bar(w / 2.0, w / 0.6))})}};
}

}  // namespace burin::haptics::test
