// SPDX-License-Identifier: MIT
// Turns a scene into what the shaders need: the two projections, the light, and the list of shapes.
// Pure functions; any thread.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "picture/picture.hpp"
#include "picture/primitives.hpp"
#include "shaders/shared/frame_uniforms.h"

namespace burin::picture {

struct Ball {
    Vec3 center_world{0.0};
    double radius_m = 0.0;  // 0: absent

    bool operator==(const Ball&) const = default;
};

// Position and extent of the workpiece in the world.
struct Workpiece {
    Ball enclosing;  // holds all of the workpiece
    Ball typical;  // of the workpiece's mean size: its appearance from far away; absent where objects cast the shadows

    bool operator==(const Workpiece&) const = default;
};
// Computes the balls around the workpiece; reach_m is PatchStore::reach_m.
[[nodiscard]] Workpiece place_workpiece(const Picture& picture, const Box& patch_bounds, double reach_m);

// Near and far planes (distances along the screen's normal) that clip neither the room
// nor anything drawn that is at least 1 cm in front of the eyes. Both are powers of
// two, so that they seldom change and a change alters no other bit of the projection.
struct DepthRange {
    double near_m = 0.03125;
    double far_m = 256.0;

    bool operator==(const DepthRange&) const = default;
};
[[nodiscard]] DepthRange depth_range(const Picture& picture, const Workpiece& workpiece);

// Ratio of the viewport's size to the picture's, each way, with the picture in the middle. Triangles that cross the
// picture's edge are thus scissored instead of clipped. (Mesa 22.3's software driver gives clipped triangles wrong
// attributes in every view but the first.)
inline constexpr double kGuard = 2.0;

[[nodiscard]] shared::FrameUniforms frame_uniforms(const Picture& picture, const Workpiece& workpiece);

// Return the bounding ball of a tool with its stylus, of a
// workspace box and of a bubble; radius 0 for what is not visible.
[[nodiscard]] Ball ball_of(const PictureTool& tool);
[[nodiscard]] Ball ball_of(const PictureBox& box);
[[nodiscard]] Ball ball_of(const PictureBubble& bubble);
// Returns what casts the tool's shadow: balls along its spine, then balls along its stylus that together hold it. Of a
// ball the first is the tool's own, and the other three of the spine are absent.
inline constexpr std::size_t kSpineBalls = 4, kStylusBalls = 8;
[[nodiscard]] std::array<Ball, kSpineBalls + kStylusBalls> balls_of(const PictureTool& tool);
// Returns the bounds of a box that is placed in the world; empty for one that is.
[[nodiscard]] Box placed_box(const Box& own, const Similarity& world_from_own);
// Returns the bounds of an object in the world.
[[nodiscard]] Box bounds_world(const DrawnObject& object);
// Returns the bounds of the tool without its stylus, as it is drawn; empty where it is not visible.
[[nodiscard]] Box head_of(const PictureTool& tool);
// Returns the unit vector towards the lamp.
[[nodiscard]] const Vec3& direction_to_light();
// Tangent of half the angle that the lamp subtends: 4 degrees in all, so that shadow edges are 7 mm wide at 100 mm.
inline constexpr double kLightHalfAngleTangent = 0.07;

// Returns world_from_patch, which transforms positions of surface vertices.
[[nodiscard]] Mat4 world_from_patch(const Picture& picture);

// One draw: of a range of primitives.hpp, or of a mesh as a whole.
struct Shape {
    PrimitiveRange range;  // of a mesh, its bounds alone
    shared::DrawConstants constants;
    std::shared_ptr<const DrawnMesh> mesh = nullptr;
};
struct Shapes {
    std::vector<Shape> solid;
    std::vector<Shape> tool;    // and its stylus, solid as well
    std::vector<Shape> hidden;  // the tool's head once more, as an outline where it lies behind something
    // Objects through which one sees, the farthest first; then the faces of the workspace boxes, and the bubble.
    std::vector<Shape> glass;
};
[[nodiscard]] Shapes shapes_of(const Picture& picture, const Primitives& primitives);

// Returns the draw constants of the workpiece.
[[nodiscard]] shared::DrawConstants surface_constants(const Picture& picture);

// Returns the constants for drawing the room: world_from_local maps the viewport's corners, -1 to 1, to the plane of
// the screen, kGuard times as far out as the picture's corners.
[[nodiscard]] shared::DrawConstants screen_constants(const wall::Screen& screen);
// Lists the meshes that the scene shows, each once.
[[nodiscard]] std::vector<std::shared_ptr<const DrawnMesh>> meshes_of(const Picture& picture);

// Converts an sRGB colour to linear light.
[[nodiscard]] Vec3 linear_of(const Vec3& srgb);

}  // namespace burin::picture
