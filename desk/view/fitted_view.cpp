// SPDX-License-Identifier: MIT
#include "desk/view/fitted_view.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "wall/projection.hpp"

namespace burin::session {
namespace {

std::array<Vec3, 8> corners_of(const Box& box) {
    std::array<Vec3, 8> corners{};
    for (std::size_t i = 0; i < 8; ++i)
        corners.at(i) = {(i & 1) != 0 ? box.hi.x : box.lo.x, (i & 2) != 0 ? box.hi.y : box.lo.y,
                         (i & 4) != 0 ? box.hi.z : box.lo.z};
    return corners;
}

struct Axes {
    Vec3 right, up, out;
    double width_m = 0.0, height_m = 0.0;
};
Axes axes_of(const wall::Screen& s) {
    const Vec3 across = s.lower_right_world - s.lower_left_world, upright = s.upper_left_world - s.lower_left_world;
    return {glm::normalize(across), glm::normalize(upright), glm::normalize(glm::cross(across, upright)),
            glm::length(across), glm::length(upright)};
}

// Fits a box that is turned so; scales are tried.
struct Fit {
    const SeenFrom& from;
    Quat turn;
    Axes axes = axes_of(from.screen);
    std::array<Vec3, 8> corners = corners_of(from.bounds_object);
    Vec3 middle = from.bounds_object.center();
    double deep = 0.0;  // the turned box along the screen's normal

    void measure() {
        double least = 0.0, most = 0.0;
        for (const Vec3& corner : corners) {
            const double along = glm::dot(turn * (corner - middle), axes.out);
            least = std::min(least, along);
            most = std::max(most, along);
        }
        deep = most - least;
    }

    struct Seen {
        Vec2 lo{1e300}, hi{-1e300};  // on the screen, metres from its lower left corner
    };
    [[nodiscard]] Seen seen(const Similarity& pose) const {
        Seen all;
        for (const Vec3& corner : corners) {
            const Vec2 at = wall::point_on_screen(from.screen, from.eye_world, pose * corner);
            all.lo = glm::min(all.lo, at);
            all.hi = glm::max(all.hi, at);
        }
        return all;
    }

    // Returns the box in the middle of the free part, this large.
    [[nodiscard]] Similarity placed(double scale) const {
        const Vec2 wanted(0.5 * from.free_width * axes.width_m, 0.5 * axes.height_m);
        const double to_screen_m = glm::dot(from.eye_world - from.screen.lower_left_world, axes.out);
        const double behind_m = 0.5 * deep * scale;
        const double further = (to_screen_m + behind_m) / to_screen_m;
        const Vec3 on_screen = from.screen.lower_left_world + wanted.x * axes.right + wanted.y * axes.up;
        Vec3 place = from.eye_world + further * (on_screen - from.eye_world);
        Similarity pose{Vec3(0.0), turn, scale};
        for (int i = 0; i < 8; ++i) {  // the middle of the picture is not quite the picture of the middle
            pose.position_m = place - scale * (turn * middle);
            const Seen now = seen(pose);
            const Vec2 off = wanted - 0.5 * (now.lo + now.hi);
            place += further * (off.x * axes.right + off.y * axes.up);
        }
        pose.position_m = place - scale * (turn * middle);
        return pose;
    }

    [[nodiscard]] bool fits(double scale) const {
        const Seen now = seen(placed(scale));
        return now.hi.x - now.lo.x <= kFilled * from.free_width * axes.width_m &&
               now.hi.y - now.lo.y <= kFilled * axes.height_m;
    }
};

// Returns the smallest rotation that takes one direction to another.
Quat between(const Vec3& a, const Vec3& b) {
    const Vec3 axis = glm::cross(a, b);
    const double s = glm::length(axis);
    if (s < 1e-12) return {1.0, 0.0, 0.0, 0.0};
    return glm::angleAxis(std::atan2(s, glm::dot(a, b)), axis / s);
}

}  // namespace

Similarity fitted(const SeenFrom& from, const Quat& world_from_object) {
    Fit fit{from, glm::normalize(world_from_object)};
    if (from.bounds_object.empty() || !(fit.axes.height_m > 0.0)) return {Vec3(0.0), fit.turn, 1.0};  // nothing is seen
    fit.measure();
    const Vec3 size = from.bounds_object.extent();
    const double longest_m = std::max({size.x, size.y, size.z, 1e-9});
    double least = 1e-3 * fit.axes.height_m / longest_m, most = 10.0 * fit.axes.height_m / longest_m;
    for (int i = 0; i < 48; ++i) {
        const double scale = std::sqrt(least * most);
        (fit.fits(scale) ? least : most) = scale;
    }
    return fit.placed(least);
}

Similarity fitted_straight(const SeenFrom& from, const Quat& world_from_object) {
    const Vec3 out = axes_of(from.screen).out;
    Similarity pose = fitted(from, world_from_object);
    for (int i = 0; i < 12; ++i) {
        const Vec3 to_eye = glm::normalize(from.eye_world - pose * from.bounds_object.center());
        pose = fitted(from, between(out, to_eye) * world_from_object);
    }
    return pose;
}

PlinthPlace plinth_under(const Box& bounds_object, const Similarity& world_from_object, const Vec3& eye_world,
                         std::optional<double> lowest_world_m) {
    constexpr double kLeastHigh_m = 0.02;                // of a plinth that is one
    constexpr double kRadius = 0.25;                     // of the box's diagonal
    const double gap = lowest_world_m ? 0.0002 : 0.002;  // likewise: the surface is not quite the box
    constexpr double kFromViewer_m = 0.4;                // its rim, before the eye
    constexpr double kSeenFromAbove_m = 0.05;            // the eye, above its top
    PlinthPlace plinth;
    const Vec3 middle = world_from_object * bounds_object.center();
    double lowest_m = lowest_world_m.value_or(middle.y);
    if (!lowest_world_m)
        for (const Vec3& corner : corners_of(bounds_object))
            lowest_m = std::min(lowest_m, (world_from_object * corner).y);
    const double across_m = world_from_object.scale * glm::length(bounds_object.extent());
    lowest_m -= gap * across_m;
    plinth.top_center_world = {middle.x, lowest_m, middle.z};
    plinth.radius_m = kRadius * across_m;
    const double away_m = glm::length(Vec2(eye_world.x - middle.x, eye_world.z - middle.z));
    plinth.visible = lowest_m > kLeastHigh_m && eye_world.y > lowest_m + kSeenFromAbove_m &&
                     away_m > plinth.radius_m + kFromViewer_m;
    return plinth;
}

}  // namespace burin::session
