// SPDX-License-Identifier: MIT
#include "picture/lamp_view.hpp"

#include <algorithm>
#include <cmath>

#include "picture/frame_setup.hpp"

namespace burin::picture {
namespace {

// The lamp's own axes: x and y across its light, z away from it.
struct LampAxes {
    Vec3 x, y, z;
};
LampAxes lamp_axes() {
    const Vec3 z = -direction_to_light(), x = glm::normalize(glm::cross(Vec3(0.0, 0.0, 1.0), z));
    return {x, glm::cross(z, x), z};
}

Box seen_by_lamp(const DrawnObject& object, const LampAxes& axes) {
    Box seen;
    const Box& own = object.mesh->bounds;
    for (int i = 0; !own.empty() && i < 8; ++i) {
        const Vec3 p =
            object.world_from_mesh * Vec3((i & 1) != 0 ? own.hi.x : own.lo.x, (i & 2) != 0 ? own.hi.y : own.lo.y,
                                          (i & 4) != 0 ? own.hi.z : own.lo.z);
        seen.include({glm::dot(p, axes.x), glm::dot(p, axes.y), glm::dot(p, axes.z)});
    }
    return seen;
}

// Returns the next of four steps for each doubling.
double step_up(double length_m) { return std::exp2(std::ceil(4.0 * std::log2(length_m)) / 4.0); }

}  // namespace

std::optional<LampView> lamp_view(const Picture& picture) {
    if (!picture.capsules.empty()) return std::nullopt;
    const LampAxes axes = lamp_axes();
    LampView view;
    Box seen;
    for (const DrawnObject& object : picture.objects) {
        if (!object.casts_shadow || object.opacity < 1.0) continue;
        const Box one = seen_by_lamp(object, axes);
        if (one.empty()) continue;
        seen.include(one.lo);
        seen.include(one.hi);
        const Box world = bounds_world(object);
        view.casters_world.include(world.lo);
        view.casters_world.include(world.hi);
        view.casters.push_back(&object);
    }
    if (view.casters.empty()) return std::nullopt;
    constexpr double kBorder = 1.02, kLeast_m = 1e-3;
    const Vec3 size = seen.extent(), middle = seen.center();
    view.side_m = step_up(std::max(kBorder * std::max(size.x, size.y), kLeast_m));
    view.deep_m = step_up(std::max(kBorder * size.z, kLeast_m));
    const double texel_m = view.side_m / kShadowMapSide, layer_m = view.deep_m / 1024.0;
    const double x_m = texel_m * std::round(middle.x / texel_m), y_m = texel_m * std::round(middle.y / texel_m),
                 nearest_m = layer_m * std::round(middle.z / layer_m) - 0.5 * view.deep_m;
    const double across = 2.0 / view.side_m, along = 1.0 / view.deep_m;
    for (int i = 0; i < 3; ++i) {
        view.map_from_world[i][0] = across * axes.x[i];
        view.map_from_world[i][1] = across * axes.y[i];
        view.map_from_world[i][2] = along * axes.z[i];
    }
    view.map_from_world[3] = glm::dvec4(-across * x_m, -across * y_m, -along * nearest_m, 1.0);
    return view;
}

}  // namespace burin::picture
