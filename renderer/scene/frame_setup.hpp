// SPDX-License-Identifier: MIT
// From a scene to what the shaders need: the two projections, the light, and the list of shapes.
// Pure functions; any thread.
#pragma once

#include <array>
#include <vector>

#include "renderer/primitives.hpp"
#include "renderer/scene.hpp"
#include "shaders/shared/frame_uniforms.h"

namespace burin {

struct Ball {
    Vec3 center_world{0.0};
    double radius_m = 0.0;  // 0: nothing there

    bool operator==(const Ball&) const = default;
};

// Where the workpiece is in the world.
struct Workpiece {
    Ball enclosing;  // holds all of it
    Ball typical;    // of its mean size: what it looks like from far away

    bool operator==(const Workpiece&) const = default;
};
// reach: PatchStore::reach_m.
[[nodiscard]] Workpiece place_workpiece(const Scene& scene, const Box& patch_bounds, double reach_m);

// Near and far planes (distances along the screen's normal) that cut off neither the room nor anything drawn, as long as it
// is at least 1 cm in front of the eyes. Powers of two: they seldom change, and a change turns no other bit of the projection.
struct DepthRange {
    double near_m = 0.03125;
    double far_m = 256.0;

    bool operator==(const DepthRange&) const = default;
};
[[nodiscard]] DepthRange depth_range(const Scene& scene, const Workpiece& workpiece);

// The picture is the middle of a viewport that is kGuard times as large each way: triangles that the picture's edge cuts are not clipped,
// only left out beyond it. (Mesa 22.3's software driver gives clipped triangles wrong attributes in every view but the first.)
inline constexpr double kGuard = 2.0;

[[nodiscard]] shared::FrameUniforms frame_uniforms(const Scene& scene, const Workpiece& workpiece);

// The ball around a tool and its stylus; around a box of the workspace; radius 0 for what is not shown.
[[nodiscard]] Ball ball_of(const SceneTool& tool);
[[nodiscard]] Ball ball_of(const SceneBox& box);
[[nodiscard]] Ball ball_of(const SceneBubble& bubble);
// Closer around the tool: its own ball, then balls along its stylus that together hold it.
[[nodiscard]] std::array<Ball, 9> balls_of(const SceneTool& tool);
// Unit, towards the lamp.
[[nodiscard]] const Vec3& direction_to_light();
inline constexpr double kLightHalfAngleTangent = 0.07;  // a lamp of 4 degrees: edges 7 mm wide at 100 mm

// world_from_patch, for surface vertices.
[[nodiscard]] Mat4 world_from_patch(const Scene& scene);

// One shape of primitives.hpp.
struct Shape {
    PrimitiveRange range;
    shared::DrawConstants constants;
};
struct Shapes {
    std::vector<Shape> solid;
    std::vector<Shape> glass;  // the faces of the workspace boxes, and the bubble
};
[[nodiscard]] Shapes shapes_of(const Scene& scene, const Primitives& primitives);

// The workpiece's own constants.
[[nodiscard]] shared::DrawConstants surface_constants(const Scene& scene);

// Linear light from an sRGB colour.
[[nodiscard]] Vec3 linear_of(const Vec3& srgb);

}  // namespace burin
