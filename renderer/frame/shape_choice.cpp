// SPDX-License-Identifier: MIT
#include "renderer/frame/shape_choice.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "renderer/frame/redraw.hpp"
#include "renderer/scene/pixel_length.hpp"

namespace burin::renderer {
namespace {

constexpr double kMostError_px = 0.25;

Box world_box(const Shape& shape) {
    const Mat4 world_from_local(shape.constants.world_from_local);
    const Box& local = shape.range.bounds;
    Box world;
    for (int i = 0; i < 8; ++i) {
        const Vec3 corner{(i & 1) != 0 ? local.hi.x : local.lo.x, (i & 2) != 0 ? local.hi.y : local.lo.y,
                          (i & 4) != 0 ? local.hi.z : local.lo.z};
        world.include(Vec3(world_from_local * glm::dvec4(corner, 1.0)));
    }
    return world;
}

bool meets(const PixelRect& part, const Scene& scene, ImageSize size, const Shape& shape) {
    const Box box = world_box(shape);
    const PixelRect seen = seen_part(scene, size, std::span(&box, 1));
    return !seen.empty() && seen.x < part.x + part.width && part.x < seen.x + seen.width &&
           seen.y < part.y + part.height && part.y < seen.y + seen.height;
}

// Returns the radius of a ball in pixels.
double radius_px(const Shape& ball, const PixelLength& pixel) {
    const Mat4 place(ball.constants.world_from_local);
    const double radius_m = glm::length(Vec3(place[0]));
    return radius_m / pixel.at(Vec3(place[3]), radius_m);
}

}  // namespace

const PrimitiveRange& ball_for(const Primitives& primitives, double radius_px) {
    // Each chord of n segments around the circle lies off by r (1 - cos(pi / n)).
    for (std::size_t i = 0; i < primitives.balls.size(); ++i) {
        const double half_angle = std::numbers::pi / (2.0 * kBallRings[i]);
        if (radius_px * (1.0 - std::cos(half_angle)) <= kMostError_px) return primitives.balls[i];
    }
    return primitives.balls.back();
}

ShownShapes shapes_in(const PixelRect& part, const Scene& scene, const Primitives& primitives, ImageSize size,
                      const Savings& savings) {
    ShownShapes shown{shapes_of(scene, primitives), 0};
    const PixelLength pixel(scene, size);
    for (auto* list : {&shown.shapes.solid, &shown.shapes.glass}) {
        const std::size_t all = list->size();
        if (savings.cull_beside)
            std::erase_if(*list, [&](const Shape& shape) { return !meets(part, scene, size, shape); });
        shown.left_out += static_cast<std::uint32_t>(all - list->size());
        if (!savings.coarser_levels) continue;
        for (Shape& shape : *list)
            if (shape.range == primitives.balls.back()) shape.range = ball_for(primitives, radius_px(shape, pixel));
    }
    return shown;
}

}  // namespace burin::renderer
