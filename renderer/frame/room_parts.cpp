// SPDX-License-Identifier: MIT
#include "renderer/frame/room_parts.hpp"

#include <algorithm>
#include <cmath>

#include "renderer/frame/redraw.hpp"
#include "wall/projection.hpp"

namespace burin::renderer {
namespace {

// Constants of the room in shaders/backdrop.frag: where the floor
// begins to rise, and where its grid has faded out on the rise.
constexpr double kBend_m = -2.4, kGridEndZ_m = -2.76, kGridEndY_m = 0.045;

void include_disc(Box& box, const Vec3& center, double radius_m) {
    box.include({center.x - radius_m, 0.0, center.z - radius_m});
    box.include({center.x + radius_m, 0.0, center.z + radius_m});
}

}  // namespace

PixelRect shadows_on_floor(const Scene& scene, const Workpiece& workpiece, ImageSize size) {
    const Vec3& light = direction_to_light();
    const auto fallen = [&](double height_m) { return -height_m / light.y * Vec3(light.x, 0.0, light.z); };
    Box box;
    if (const Ball& ball = workpiece.typical; ball.radius_m > 0.0) {
        const double farthest_m = 1.5 * (std::max(ball.center_world.y, 0.0) + ball.radius_m) / light.y;
        const double edge_m = std::max(2.2 * kLightHalfAngleTangent * farthest_m, 0.01);
        include_disc(box, ball.center_world + fallen(ball.center_world.y), (ball.radius_m + edge_m) / light.y);
    }
    if (const ScenePedestal& plinth = scene.pedestal; plinth.visible) {
        const double height_m = plinth.top_center_world.y;
        const double edge_m = 0.012 + 2.2 * kLightHalfAngleTangent * std::max(height_m, 0.0);
        include_disc(box, plinth.top_center_world + fallen(height_m), plinth.radius_m + edge_m);
        include_disc(box, plinth.top_center_world, plinth.radius_m + std::max(edge_m, double{shared::kFootDarkens}));
    }
    if (box.empty()) return {};
    if (box.lo.z <= kBend_m) return all_of(size);  // the shadows extend up the rise
    return seen_part(scene, size, std::span(&box, 1));
}

std::uint32_t rows_above_grid(const Scene& scene, ImageSize size) {
    const wall::Screen& s = scene.screen;
    const Vec3 across = s.lower_right_world - s.lower_left_world, upright = s.upper_left_world - s.lower_left_world;
    const wall::Eyes eyes = wall::eyes_of(scene.viewer);
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

std::vector<RoomPart> room_parts(const Scene& scene, const Workpiece& workpiece, ImageSize size,
                                 const PixelRect& part) {
    const PixelRect shaded = shadows_on_floor(scene, workpiece, size);
    const std::uint32_t grid = rows_above_grid(scene, size);
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
