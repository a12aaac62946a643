// SPDX-License-Identifier: MIT
#include "wall/comfort.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "wall/projection.hpp"

namespace burin::wall {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;
constexpr double kNearestShare = 0.1;  // of the screen's distance; content nearer than this cannot be fused

// Uses atan2, which keeps its digits for small angles.
double angle_between(const Vec3& a, const Vec3& b) { return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)); }

double vergence(const Eyes& eyes, const Vec3& p) { return angle_between(p - eyes.left_world, p - eyes.right_world); }

struct Plane {
    Vec3 right, up, normal, origin;
    explicit Plane(const Screen& s)
        : right(glm::normalize(s.lower_right_world - s.lower_left_world)),
          up(glm::normalize(s.upper_left_world - s.lower_left_world)),
          normal(glm::normalize(glm::cross(right, up))),
          origin(s.lower_left_world) {}
    [[nodiscard]] double in_front_m(const Vec3& p) const { return glm::dot(p - origin, normal); }
    [[nodiscard]] Vec3 place(const Vec2& xy) const { return origin + xy.x * right + xy.y * up; }
};

class Extremes {
public:
    Extremes(const Screen& screen, const Eyes& eyes)
        : screen_(screen),
          eyes_(eyes),
          plane_(screen),
          middle_(middle_of(eyes)),
          nearest_m_(kNearestShare * plane_.in_front_m(middle_)) {}

    void include(const ContentBall& ball) {
        const Vec3 from_eyes = ball.center_world - middle_;
        const double l = glm::length(from_eyes);
        const Vec3 along = l > 0.0 ? from_eyes / l : -plane_.normal;
        const double radius_m = std::max(ball.radius_m, 0.0);
        for (const Vec3& direction : {along, plane_.normal}) {
            include_point(ball.center_world + radius_m * direction);
            include_point(ball.center_world - radius_m * direction);
        }
    }
    void include(const Box& box) {
        if (box.empty()) return;
        for (unsigned i = 0; i < 8; ++i) {
            include_point({(i & 1u) != 0 ? box.hi.x : box.lo.x, (i & 2u) != 0 ? box.hi.y : box.lo.y,
                           (i & 4u) != 0 ? box.hi.z : box.lo.z});
        }
        include_point(glm::clamp(middle_, box.lo, box.hi));
    }
    [[nodiscard]] const ContentParallax& found() const { return found_; }

private:
    void include_point(Vec3 p) {
        const double in_front_m = plane_.in_front_m(p);
        const double from_eyes_m = plane_.in_front_m(middle_) - in_front_m;
        if (from_eyes_m < nearest_m_) p -= plane_.normal * (nearest_m_ - from_eyes_m);
        const Parallax parallax = parallax_of(screen_, eyes_, p);
        if (parallax.deg < found_.crossed.deg) found_.crossed = parallax;
        if (parallax.deg > found_.uncrossed.deg) found_.uncrossed = parallax;
        found_.in_front_m = found_.any ? std::max(found_.in_front_m, in_front_m) : in_front_m;
        found_.any = true;
    }

    Screen screen_;
    Eyes eyes_;
    Plane plane_;
    Vec3 middle_;
    double nearest_m_;
    ContentParallax found_;
};

Content moved(const Content& content, const Vec3& by, std::vector<ContentBall>& balls, std::vector<Box>& boxes) {
    balls.assign(content.balls.begin(), content.balls.end());
    boxes.assign(content.boxes_world.begin(), content.boxes_world.end());
    for (ContentBall& b : balls) b.center_world += by;
    for (Box& b : boxes) b.lo += by, b.hi += by;
    return {balls, boxes};
}

bool too_crossed(const ParallaxBudget& budget, const ContentParallax& p) { return -p.crossed.deg > budget.crossed_deg; }

bool too_uncrossed(const ParallaxBudget& budget, const ContentParallax& p, const Eyes& eyes) {
    const double eyes_m = glm::length(eyes.right_world - eyes.left_world);
    return p.uncrossed.deg > budget.uncrossed_deg || p.uncrossed.m > eyes_m;
}

// The smallest displacement that keeps one side of the budget, by bisection: both measures fall as content moves back.
double least_move(const ParallaxBudget& budget, const Screen& screen, const Eyes& eyes, const Content& content,
                  bool back) {
    const Vec3 normal = Plane(screen).normal;
    std::vector<ContentBall> balls;
    std::vector<Box> boxes;
    const auto keeps = [&](double by_m) {
        const Content there = moved(content, normal * (back ? -by_m : by_m), balls, boxes);
        const ContentParallax p = largest_parallax(screen, eyes, there);
        return back ? !too_crossed(budget, p) : !too_uncrossed(budget, p, eyes);
    };
    double less_m = 0.0, enough_m = 0.01;
    for (int i = 0; i < 30 && !keeps(enough_m); ++i) less_m = enough_m, enough_m *= 2.0;
    while (enough_m - less_m > 1e-4) {
        const double half_m = 0.5 * (less_m + enough_m);
        (keeps(half_m) ? enough_m : less_m) = half_m;
    }
    return back ? -enough_m : enough_m;
}

}  // namespace

Parallax parallax_of(const Screen& screen, const Eyes& eyes, const Vec3& point_world) {
    const Plane plane(screen);
    const Vec3 left = plane.place(point_on_screen(screen, eyes.left_world, point_world));
    const Vec3 right = plane.place(point_on_screen(screen, eyes.right_world, point_world));
    const Vec3 middle = plane.place(point_on_screen(screen, middle_of(eyes), point_world));
    const Vec3 apart = eyes.right_world - eyes.left_world;
    const Vec3 across = apart - plane.normal * glm::dot(apart, plane.normal);
    const double l = glm::length(across);
    const double on_screen_m = l > 0.0 ? glm::dot(right - left, across) / l : 0.0;
    return {on_screen_m, kDegrees * (vergence(eyes, middle) - vergence(eyes, point_world))};
}

ComfortRange comfort_range(const ParallaxBudget& budget, double interpupillary_m, double distance_m) {
    const double half_m = 0.5 * interpupillary_m;
    const double at_screen = std::atan(half_m / distance_m);  // half the vergence angle
    const double near = at_screen + 0.5 * budget.crossed_deg / kDegrees;
    const double far = at_screen - 0.5 * budget.uncrossed_deg / kDegrees;
    ComfortRange range;
    range.nearest_m = half_m / std::tan(near);
    if (far > 0.0) range.farthest_m = half_m / std::tan(far);
    return range;
}

BudgetOnScreen budget_on_screen(const ParallaxBudget& budget, double interpupillary_m, double distance_m) {
    const ComfortRange range = comfort_range(budget, interpupillary_m, distance_m);
    const double far = range.farthest_m ? 1.0 - distance_m / *range.farthest_m : 1.0;
    return {interpupillary_m * (distance_m / range.nearest_m - 1.0), interpupillary_m * far};
}

ContentParallax largest_parallax(const Screen& screen, const Eyes& eyes, const Content& content) {
    Extremes extremes(screen, eyes);
    for (const ContentBall& ball : content.balls) extremes.include(ball);
    for (const Box& box : content.boxes_world) extremes.include(box);
    return extremes.found();
}

ComfortFinding judge(const ParallaxBudget& budget, const Screen& screen, const Eyes& eyes, const Content& content) {
    ComfortFinding finding;
    if (!can_be_seen(screen, eyes)) return finding;
    finding.parallax = largest_parallax(screen, eyes, content);
    finding.crossed_too_much = too_crossed(budget, finding.parallax);
    finding.uncrossed_too_much = too_uncrossed(budget, finding.parallax, eyes);
    if (finding.crossed_too_much == finding.uncrossed_too_much) return finding;
    const double move_m = least_move(budget, screen, eyes, content, finding.crossed_too_much);
    std::vector<ContentBall> balls;
    std::vector<Box> boxes;
    const ContentParallax there =
        largest_parallax(screen, eyes, moved(content, Plane(screen).normal * move_m, balls, boxes));
    if (!too_crossed(budget, there) && !too_uncrossed(budget, there, eyes)) finding.move_m = move_m;
    return finding;
}

std::string warning_of(const ComfortFinding& finding, const ParallaxBudget& budget) {
    if (!finding.crossed_too_much && !finding.uncrossed_too_much) return {};
    const bool front = finding.crossed_too_much;
    const Parallax& p = front ? finding.parallax.crossed : finding.parallax.uncrossed;
    std::array<char, 300> text{};
    std::array<char, 80> remedy{};
    if (finding.move_m) {
        // Rounded up, so that the displacement given suffices.
        std::snprintf(remedy.data(), remedy.size(), "move the scene %.2f m %s",
                      std::ceil(std::abs(*finding.move_m) * 100.0) / 100.0, front ? "back" : "forward");
    } else {
        std::snprintf(remedy.data(), remedy.size(), "scale the scene down, or stand farther from the screen");
    }
    std::snprintf(text.data(), text.size(),
                  "content %s the screen has %.1f degrees (%.0f mm) of %s parallax, of %.1f that are comfortable; %s",
                  front ? "in front of" : "behind", std::abs(p.deg), std::abs(p.m) * 1e3,
                  front ? "crossed" : "uncrossed", front ? budget.crossed_deg : budget.uncrossed_deg, remedy.data());
    return text.data();
}

}  // namespace burin::wall
