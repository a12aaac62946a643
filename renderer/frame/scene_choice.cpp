// SPDX-License-Identifier: MIT
#include "renderer/frame/scene_choice.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "picture/lamp_view.hpp"
#include "picture/pixel_length.hpp"
#include "renderer/frame/redraw.hpp"
#include "wall/projection.hpp"

namespace burin::renderer {
namespace {

constexpr double kMostError_px = 0.25;

Box world_box(const picture::Shape& shape) {
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

bool meets(const PixelRect& part, const picture::Picture& picture, ImageSize size, const picture::Shape& shape) {
    const Box box = world_box(shape);
    const PixelRect seen = seen_part(picture, size, std::span(&box, 1));
    return !seen.empty() && seen.x < part.x + part.width && part.x < seen.x + seen.width &&
           seen.y < part.y + part.height && part.y < seen.y + seen.height;
}

// Returns the radius of a ball in pixels.
double radius_px(const picture::Shape& ball, const picture::PixelLength& pixel) {
    const Mat4 place(ball.constants.world_from_local);
    const double radius_m = glm::length(Vec3(place[0]));
    return radius_m / pixel.at(Vec3(place[3]), radius_m);
}

// Constants of the room in shaders/backdrop_stage.glsl: where the floor
// begins to rise, and where its grid has faded out on the rise.
constexpr double kBend_m = -2.4, kGridEndZ_m = -2.76, kGridEndY_m = 0.045;

void include_disc(Box& box, const Vec3& center, double radius_m) {
    box.include({center.x - radius_m, 0.0, center.z - radius_m});
    box.include({center.x + radius_m, 0.0, center.z + radius_m});
}

}  // namespace

const picture::PrimitiveRange& ball_for(const picture::Primitives& primitives, double radius_px) {
    // Each chord of n segments around the circle lies off by r (1 - cos(pi / n)).
    for (std::size_t i = 0; i < primitives.balls.size(); ++i) {
        const double half_angle = std::numbers::pi / (2.0 * picture::kBallRings[i]);
        if (radius_px * (1.0 - std::cos(half_angle)) <= kMostError_px) return primitives.balls[i];
    }
    return primitives.balls.back();
}

ShownShapes shapes_in(const PixelRect& part, const picture::Picture& picture, const picture::Primitives& primitives,
                      ImageSize size, const Savings& savings) {
    ShownShapes shown{picture::shapes_of(picture, primitives), 0};
    const picture::PixelLength pixel(picture, size);
    for (auto* list : {&shown.shapes.solid, &shown.shapes.tool, &shown.shapes.hidden, &shown.shapes.glass}) {
        const std::size_t all = list->size();
        if (savings.cull_beside)
            std::erase_if(*list, [&](const picture::Shape& shape) { return !meets(part, picture, size, shape); });
        shown.left_out += static_cast<std::uint32_t>(all - list->size());
        if (!savings.coarser_levels) continue;
        for (picture::Shape& shape : *list)
            if (shape.range == primitives.balls.back()) shape.range = ball_for(primitives, radius_px(shape, pixel));
    }
    return shown;
}

PixelRect shadows_on_floor(const picture::Picture& picture, const picture::Workpiece& workpiece, ImageSize size) {
    const Vec3& light = picture::direction_to_light();
    const auto fallen = [&](double height_m) { return -height_m / light.y * Vec3(light.x, 0.0, light.z); };
    Box box;
    if (const picture::Ball& ball = workpiece.typical; ball.radius_m > 0.0) {
        const double farthest_m = 1.5 * (std::max(ball.center_world.y, 0.0) + ball.radius_m) / light.y;
        const double edge_m = std::max(2.2 * picture::kLightHalfAngleTangent * farthest_m, 0.01);
        include_disc(box, ball.center_world + fallen(ball.center_world.y), (ball.radius_m + edge_m) / light.y);
    }
    if (const picture::PicturePedestal& plinth = picture.pedestal; plinth.visible) {
        const double height_m = plinth.top_center_world.y;
        const double edge_m = 0.012 + 2.2 * picture::kLightHalfAngleTangent * std::max(height_m, 0.0);
        include_disc(box, plinth.top_center_world + fallen(height_m), plinth.radius_m + edge_m);
        include_disc(box, plinth.top_center_world, plinth.radius_m + std::max(edge_m, double{shared::kFootDarkens}));
    }
    if (const std::optional<picture::LampView> lamp = picture::lamp_view(picture)) {
        const Box& casters = lamp->casters_world;
        // As far as a shadow is looked up, across the lamp's light.
        const double reach = shared::kSoftestShadow + shared::kBesideSurface + shared::kTowardsLamp + 1.0;
        const double edge_m = reach * lamp->side_m / picture::kShadowMapSide / light.y;
        for (const double height_m : {casters.lo.y, casters.hi.y})
            for (const Vec3& corner :
                 {casters.lo, casters.hi, Vec3(casters.lo.x, 0.0, casters.hi.z), Vec3(casters.hi.x, 0.0, casters.lo.z)})
                include_disc(box, Vec3(corner.x, 0.0, corner.z) + fallen(height_m), edge_m);
    }
    if (box.empty()) return {};
    if (box.lo.z <= kBend_m) return all_of(size);  // the shadows extend up the rise
    return seen_part(picture, size, std::span(&box, 1));
}

std::uint32_t rows_above_grid(const picture::Picture& picture, ImageSize size) {
    const wall::Screen& s = picture.screen;
    const Vec3 across = s.lower_right_world - s.lower_left_world, upright = s.upper_left_world - s.lower_left_world;
    const wall::Eyes eyes = wall::eyes_of(picture.viewer);
    double highest = 0.0;  // where the grid may begin, as a share of the screen's height
    for (const Vec3& eye : {eyes.left_world, eyes.right_world}) {
        if (eye.z <= kGridEndZ_m || eye.y <= kGridEndY_m) return 0;
        // No line of sight above the plane through the eye and the grid's far end meets the grid.
        const Vec3 up{0.0, eye.z - kGridEndZ_m, kGridEndY_m - eye.y};
        for (const Vec3& edge : {Vec3(0.0), across}) {
            const double lower = glm::dot(s.lower_left_world + edge - eye, up), rise = glm::dot(upright, up);
            if (rise <= 0.0) return 0;
            highest = std::max(highest, -lower / rise);
        }
    }
    constexpr double kSpare_px = 2.0;
    const double rows = std::floor((1.0 - highest) * size.height - kSpare_px);
    return static_cast<std::uint32_t>(std::clamp(rows, 0.0, static_cast<double>(size.height)));
}

std::vector<RoomPart> room_parts(const picture::Picture& picture, const picture::Workpiece& workpiece, ImageSize size,
                                 const PixelRect& part) {
    const PixelRect shaded = shadows_on_floor(picture, workpiece, size);
    const std::uint32_t grid = rows_above_grid(picture, size);
    std::vector<RoomPart> parts;
    const auto add = [&](const PixelRect& rect, RoomLook look) {
        if (const PixelRect in = common(rect, part); !in.empty()) parts.push_back({in, look});
    };
    const auto add_unshaded = [&](const PixelRect& rect) {
        add(common(rect, {0, 0, size.width, grid}), RoomLook::plain);
        add(common(rect, {0, grid, size.width, size.height - grid}), RoomLook::without_shadows);
    };
    if (shaded.empty()) {
        add_unshaded(all_of(size));
        return parts;
    }
    add(shaded, RoomLook::full);
    const std::uint32_t right = shaded.x + shaded.width, below = shaded.y + shaded.height;
    add_unshaded({0, 0, size.width, shaded.y});
    add_unshaded({0, shaded.y, shaded.x, shaded.height});
    add_unshaded({right, shaded.y, size.width - right, shaded.height});
    add_unshaded({0, below, size.width, size.height - below});
    return parts;
}

}  // namespace burin::renderer
