// SPDX-License-Identifier: MIT
#include "picture/contact_marks.hpp"

#include <algorithm>
#include <cmath>

#include "picture/primitives.hpp"

namespace burin::picture {
namespace {

constexpr double kLeastForce_N = 0.05;
// Bounds of the arrow's length, in units of the length for 1 N.
constexpr double kShortest = 0.6, kLongest = 4.0;
constexpr double kFullHeadFrom = 1.0, kHead = 0.55, kHeadRadius = 0.25, kShaftRadius = 0.095;
constexpr double kBareRing = 0.35;
// The ring around a ball, in the ball's radii: wider than the ball, so that it shows around it as seen from above, and
// lifted, so that it is not buried in a shallow groove.
constexpr double kRingAroundBall = 1.2, kRingLift = 0.3;
constexpr double kClearOfBall = 1.06;

bool finite(const Vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

// Returns the place on the tool's spine nearest to a point; a ball's centre.
Vec3 nearest_on_spine(const PictureTool& tool, const Vec3& point) {
    const double length2 = glm::dot(tool.spine_m, tool.spine_m);
    if (!(length2 > 0.0)) return tool.center_world;
    const double along = glm::dot(point - tool.center_world, tool.spine_m) / length2;
    return tool.center_world + std::clamp(along, 0.0, 1.0) * tool.spine_m;
}

// Returns whether the contact is the ball's own, and not that of another part of a tool. The round about the spine of a
// tool that is no ball counts as its ball.
bool ball_touches(const PictureTool& tool, const Vec3& point) {
    return tool.visible && glm::length(point - nearest_on_spine(tool, point)) < 1.5 * tool.radius_m;
}

std::optional<ContactRing> ring_of(const PictureContact& contact, const PictureTool& tool) {
    const double length = glm::length(contact.normal_world);
    if (!(length > 0.0)) return std::nullopt;
    const Vec3 axis = contact.normal_world / length;
    if (ball_touches(tool, contact.point_world)) {
        return ContactRing{contact.point_world + kRingLift * tool.radius_m * axis, axis,
                           kRingAroundBall * tool.radius_m};
    }
    const double radius = kBareRing * contact.metres_per_N;
    return ContactRing{contact.point_world + kRingThickness * radius * axis, axis, radius};
}

// Returns the distance from a point along a line to where the line leaves a ball; 0 where the line misses it.
double end_of_ball(const Vec3& from, const Vec3& direction, const Vec3& center, double radius_m) {
    const Vec3 to = center - from;
    const double along = glm::dot(to, direction);
    const double square = radius_m * radius_m - glm::dot(to, to) + along * along;
    return square > 0.0 ? std::max(along + std::sqrt(square), 0.0) : 0.0;
}

std::optional<ForceArrow> arrow_of(const PictureContact& contact, const PictureTool& tool) {
    const double force_N = glm::length(contact.force_N);
    if (!(force_N >= kLeastForce_N) || !(contact.metres_per_N > 0.0)) return std::nullopt;
    const double unit = contact.metres_per_N;
    const double length = std::clamp(force_N, kShortest, kLongest);
    const double size = std::min(1.0, length / kFullHeadFrom);
    ForceArrow arrow;
    arrow.direction_world = contact.force_N / force_N;
    arrow.length_m = length * unit;
    arrow.head_m = kHead * size * unit;
    arrow.head_radius_m = kHeadRadius * size * unit;
    arrow.shaft_radius_m = kShaftRadius * size * unit;
    const double clear_m = ball_touches(tool, contact.point_world)
                               ? end_of_ball(contact.point_world, arrow.direction_world,
                                             nearest_on_spine(tool, contact.point_world), kClearOfBall * tool.radius_m)
                               : 0.0;
    arrow.from_world = contact.point_world + clear_m * arrow.direction_world;
    return arrow;
}

}  // namespace

ContactMarks contact_marks(const Picture& picture) {
    const PictureContact& c = picture.contact;
    if (!c.visible || !std::isfinite(c.metres_per_N)) return {};
    for (const Vec3& v : {c.point_world, c.normal_world, c.force_N})
        if (!finite(v)) return {};
    return {ring_of(c, picture.tool), arrow_of(c, picture.tool), c.colour};
}

std::array<Box, 2> boxes_of(const ContactMarks& marks) {
    std::array<Box, 2> boxes;
    if (marks.ring) {
        const Vec3& a = marks.ring->axis_world;
        Vec3 half;
        // Half the extent of a circle along a world axis: its radius
        // times the sine of the angle between its axis and that axis.
        for (int i = 0; i < 3; ++i)
            half[i] = marks.ring->radius_m * (std::sqrt(std::max(1.0 - a[i] * a[i], 0.0)) + kRingThickness);
        boxes[0].include(marks.ring->center_world - half);
        boxes[0].include(marks.ring->center_world + half);
    }
    if (marks.arrow) {
        const ForceArrow& arrow = *marks.arrow;
        const Vec3 thick(std::max(arrow.head_radius_m, arrow.shaft_radius_m));
        for (const double along_m : {0.0, arrow.length_m}) {
            const Vec3 p = arrow.from_world + along_m * arrow.direction_world;
            boxes[1].include(p - thick);
            boxes[1].include(p + thick);
        }
    }
    return boxes;
}

}  // namespace burin::picture
