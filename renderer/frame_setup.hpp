// SPDX-License-Identifier: MIT
// From a scene to what the shaders need: the two projections, the light and its shadow map's frame, and the list of shapes.
// Pure functions; any thread.
#pragma once

#include <vector>

#include "renderer/primitives.hpp"
#include "renderer/scene.hpp"
#include "shaders/shared/frame_uniforms.h"

namespace burin {

struct Ball {
    Vec3 center_world{0.0};
    double radius_m = 0.0;  // 0: nothing there
};

// Where the workpiece is in the world.
struct Workpiece {
    Ball enclosing;  // holds all of it
    Ball typical;    // of its mean size: what it looks like from far away
};
// reach: PatchStore::reach_m.
[[nodiscard]] Workpiece place_workpiece(const Scene& scene, const Box& patch_bounds, double reach_m);

// Near and far planes (distances along the screen's normal) that cut off neither the room nor anything drawn, as long as it
// is at least 1 cm in front of the eyes.
struct DepthRange {
    double near_m = 0.05;
    double far_m = 200.0;
};
[[nodiscard]] DepthRange depth_range(const Scene& scene, const Workpiece& workpiece);

[[nodiscard]] shared::FrameUniforms frame_uniforms(const Scene& scene, const Workpiece& workpiece,
                                                   std::uint32_t shadow_texels);

// world_from_patch, for surface vertices.
[[nodiscard]] Mat4 world_from_patch(const Scene& scene);

// One shape of primitives.hpp.
struct Shape {
    PrimitiveRange range;
    shared::DrawConstants constants;
    bool casts_shadow = false;
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
