// SPDX-License-Identifier: MIT
#include "bench/stroke/stroke_tools.hpp"

#include <numbers>

namespace burin::bench {
namespace {

// The ball of STROKE-1000 is sunk by 1.25 of its radii r, where it takes 2.86 r^3 away. Sizes below are in r.
constexpr double kTall = 2.0;
constexpr double kCylinder = 0.84;
constexpr double kConeTip = 0.65, kConeTop = 1.3;
constexpr double kBullnose = 0.87, kBullnoseCorner = 0.3;
constexpr double kBoxHalf = 0.757;

compute::ToolShape shape_in_place_of(double r_m, StrokeTool tool) {
    switch (tool) {
        case StrokeTool::ball: return compute::BallTool{r_m};
        case StrokeTool::cylinder: return compute::CylinderTool{kCylinder * r_m, kTall * r_m};
        case StrokeTool::cone: return compute::ConeTool{kConeTip * r_m, kConeTop * r_m, kTall * r_m};
        case StrokeTool::bullnose: return compute::BullNoseTool{kBullnose * r_m, kBullnoseCorner * r_m, kTall * r_m};
        case StrokeTool::box: return compute::BoxTool{{kBoxHalf * r_m, 0.5 * kTall * r_m, kBoxHalf * r_m}};
    }
    return compute::BallTool{r_m};
}

// Turns the tool's axis, +Y, to the scene's +Z, out of the face that is carved, and lets it lean.
Quat leaning_upright() {
    const Quat upright = glm::angleAxis(0.5 * std::numbers::pi, Vec3(1.0, 0.0, 0.0));
    return glm::angleAxis(std::numbers::pi / 15.0, glm::normalize(Vec3(2.0, 1.0, 0.0))) * upright;
}

}  // namespace

std::string name_of(StrokeTool tool) {
    switch (tool) {
        case StrokeTool::ball: return "ball";
        case StrokeTool::cylinder: return "cylinder";
        case StrokeTool::cone: return "cone";
        case StrokeTool::bullnose: return "bullnose";
        case StrokeTool::box: return "box";
    }
    return "";
}

compute::ToolSweep tool_sweep(const CarveScene& scene, const compute::BallSweep& sweep_scene, StrokeTool tool) {
    const compute::BallSweep ball = in_object(scene, sweep_scene);
    compute::ToolSweep sweep{.shape = shape_in_place_of(ball.radius_m, tool),
                             .start = {ball.start_object_m},
                             .end = {ball.end_object_m},
                             .operation = ball.operation,
                             .material = ball.material};
    if (tool == StrokeTool::ball) return sweep;
    const Quat leaning = scene.object_from_scene.orientation * leaning_upright();
    sweep.start.orientation = sweep.end.orientation = leaning;
    if (tool == StrokeTool::box) return sweep;  // its origin is its middle, that of the others their tip
    const Vec3 to_tip = leaning * Vec3(0.0, -0.5 * kTall * ball.radius_m, 0.0);
    sweep.start.position_m += to_tip;
    sweep.end.position_m += to_tip;
    return sweep;
}

}  // namespace burin::bench
