// SPDX-License-Identifier: MIT
#include "desk/input/surface_hand.hpp"

#include <algorithm>
#include <cmath>

#include "wall/seen_place.hpp"

namespace burin::session {
namespace {

// Of the tool's half width: how far above the surface it hovers.
constexpr double kClear = 0.1;
// Of a step's way across the ray: how much more than the tool's width the surface may be off the plane of the last
// contact, and still be the same surface.
constexpr double kSlope = 0.5;
// The least cosine between a ray and a plane's normal for which the plane says where the ray should meet it.
constexpr double kFaces = 0.15;
// A surface that turns from the last contact's by more than 45 degrees and is seen at less than 15 is what lies behind
// an edge, such as a hole's wall.
constexpr double kTurns = 0.7, kGrazes = 0.26;
// Of the tool's half width: what is farther below the last contact's plane is a hole or a groove, which the tool enters
// where a ball of so much of its half width has room.
constexpr double kBelow = 0.5, kRoom = 0.8;

// How far a place is above the plane of a contact.
double above_m(const SurfaceContact& last, const Vec3& place_object_m) {
    return glm::dot(place_object_m - last.place_object_m, last.normal_object);
}

// Whether a hit goes on with the surface of the last contact.
bool goes_on(const SeenSurface& surface, const SurfaceHit& hit, const SurfaceContact& last, const Ray& ray,
             double half_width_m) {
    const bool turns = glm::dot(hit.normal_object, last.normal_object) < kTurns;
    if (turns && -glm::dot(hit.normal_object, ray.direction) < kGrazes) return false;
    const double below_m = -above_m(last, hit.place_object_m);
    const bool is_edge = turns && below_m > 0.0;
    // A wall that lies lower and faces back is the far one of a hole, with air before it.
    if (is_edge && glm::dot(hit.normal_object, hit.place_object_m - last.place_object_m) < 0.0) return false;
    if (is_edge || below_m > kBelow * half_width_m) {
        const Vec3 facing = surface.facing_around(hit.place_object_m, half_width_m, hit.normal_object);
        if (!surface.has_room(hit.place_object_m + half_width_m * facing, kRoom * half_width_m)) return false;
    }
    const Vec3 to_last = last.place_object_m - ray.origin;
    const double along_m = glm::dot(to_last, ray.direction);
    const double across_m = glm::length(to_last - along_m * ray.direction);
    const double facing = -glm::dot(last.normal_object, ray.direction);
    double expected_m = along_m, slope = 1.0 / kFaces;
    if (facing > kFaces) {
        expected_m = -glm::dot(last.normal_object, to_last) / facing;
        slope = kSlope / facing;
    }
    return std::abs(hit.distance_m - expected_m) <= 2.0 * half_width_m + slope * across_m;
}

// Returns the rotation that stands a tool along a normal, its +X to the screen's right as far as the normal lets it.
Quat standing_on(const Vec3& normal, const Quat& object_from_screen, double roll_rad) {
    Vec3 right = object_from_screen * Vec3(1.0, 0.0, 0.0);
    right -= glm::dot(right, normal) * normal;
    if (glm::length(right) < 1e-3) right = glm::cross(normal, object_from_screen * Vec3(0.0, 1.0, 0.0));
    right = glm::normalize(right);
    const Quat standing = glm::quat_cast(glm::dmat3(right, normal, glm::cross(right, normal)));
    return glm::normalize(standing * glm::angleAxis(roll_rad, Vec3(0.0, 1.0, 0.0)));
}

Pose standing_at(const SurfaceContact& contact, double height_m, const ToolOnSurface& tool,
                 const Quat& object_from_screen) {
    return {contact.place_object_m + (tool.tip_m + height_m) * contact.normal_object,
            standing_on(contact.normal_object, object_from_screen, tool.roll_rad)};
}

}  // namespace

std::optional<Ray> CursorView::ray_object(const Vec2& px) const {
    const auto seen = wall::seen_at(shown, place, px);
    if (!seen) return std::nullopt;
    const Vec3 across = screen.lower_right_world - screen.lower_left_world;
    const Vec3 upright = screen.upper_left_world - screen.lower_left_world;
    const Vec3 on_screen = screen.lower_left_world + seen->picture_uv.x * across + (1.0 - seen->picture_uv.y) * upright;
    const Vec3 eye = object_from_world * eye_world;
    return Ray{eye, glm::normalize(object_from_world * on_screen - eye)};
}

PointedAt pointed_at(SurfaceHand hand, const Ray& ray, const SeenSurface& now, const ToolOnSurface& tool,
                     const Quat& object_from_screen, const Vec3& middle_object) {
    const SeenSurface& surface = hand.pressed ? hand.as_it_was : now;
    const auto hit = surface.first_hit(ray);
    const double clear_m = kClear * tool.half_width_m;
    PointedAt pointed;
    pointed.on_surface = hit.has_value();
    const bool stays =
        hit && (!hand.pressed || !hand.last || goes_on(surface, *hit, *hand.last, ray, tool.half_width_m));
    const bool hidden = hit && !stays && above_m(*hand.last, hit->place_object_m) > 0.0 &&
                        glm::dot(hand.last->place_object_m - ray.origin, ray.direction) > hit->distance_m;
    if (stays || hidden) {
        const SurfaceContact contact{hit->place_object_m,
                                     surface.facing_around(hit->place_object_m, tool.half_width_m, hit->normal_object)};
        const bool works = stays && hand.pressed;
        pointed.tool = {standing_at(contact, works ? -tool.depth_m : clear_m, tool, object_from_screen), works,
                        works ? tool.depth_m + clear_m : 0.0};
        if (stays) hand.last = contact;
    } else {
        SurfaceContact beside = hand.last.value_or(SurfaceContact{middle_object, -ray.direction});
        const double depth_m = glm::dot(beside.place_object_m - ray.origin, ray.direction);
        beside.place_object_m = ray.origin + depth_m * ray.direction;
        pointed.tool = {standing_at(beside, clear_m, tool, object_from_screen), hand.pressed, 0.0, hand.pressed};
    }
    pointed.hand = std::move(hand);
    return pointed;
}

}  // namespace burin::session
