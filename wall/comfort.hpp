// SPDX-License-Identifier: MIT
// How much the eyes are asked to turn away from the screen they focus on: parallax of content, against a budget.
//
// Two measures of a point P, with L, R the eyes and S where the line from between the eyes through P meets the screen:
//   parallax_m    (R's picture of P - L's picture of P) . direction from L to R: metres on the screen; below 0 crossed (in
//                 front of the screen), above 0 uncrossed (behind). Eyes parallel to the screen at distance d, P at z in
//                 front: -ipd z / (d - z).
//   parallax_deg  angle LSR - angle LPR, likewise signed. On the axis 2 atan(ipd / 2d) - 2 atan(ipd / 2(d - z)).
// Pure functions, any thread; only warning_of() allocates. Metres, world frame.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "renderer/stereo/wall.hpp"

namespace burin {

struct Parallax {
    double m = 0.0;
    double deg = 0.0;
};

// The point must lie in front of the eyes: nearer to the screen's plane than they, or behind the screen.
[[nodiscard]] Parallax parallax_of(const Screen& screen, const Eyes& eyes, const Vec3& point_world);

// Distances from the eyes, straight ahead, between which content keeps the budget; the screen is distance_m away.
struct ComfortRange {
    double nearest_m = 0.0;
    std::optional<double> farthest_m;  // nothing: as far as one likes
};
[[nodiscard]] ComfortRange comfort_range(const ParallaxBudget& budget, double interpupillary_m, double distance_m);

// The parallax in metres on a screen distance_m away that uses the budget up. Uncrossed: never above interpupillary_m,
// where the eyes look straight ahead; beyond it they would have to diverge.
struct BudgetOnScreen {
    double crossed_m = 0.0;
    double uncrossed_m = 0.0;
};
[[nodiscard]] BudgetOnScreen budget_on_screen(const ParallaxBudget& budget, double interpupillary_m, double distance_m);

struct ContentBall {
    Vec3 center_world{0.0};
    double radius_m = 0.0;
};

struct Content {
    std::span<const ContentBall> balls;
    std::span<const Box> boxes_world;
};

struct ContentParallax {
    bool any = false;         // anything before the eyes
    Parallax crossed;         // the largest, 0 or below
    Parallax uncrossed;       // the largest, 0 or above
    double in_front_m = 0.0;  // how far the nearest content stands in front of the screen; below 0: behind it
};

// Of all points of the content that lie before the eyes; what is nearer to them than a tenth of the screen's distance
// counts as standing there. Looks at the points of each ball and box that are nearest to and farthest from the point between
// the eyes and from the screen; for eyes parallel to the screen what it finds is within 5 % of the largest over all points.
[[nodiscard]] ContentParallax largest_parallax(const Screen& screen, const Eyes& eyes, const Content& content);

struct ComfortFinding {
    bool crossed_too_much = false, uncrossed_too_much = false;
    ContentParallax parallax;
    // How far to move the content along the screen's normal, above 0 towards the viewer, so that it keeps the budget;
    // nothing when it is too deep to keep both sides.
    std::optional<double> move_m;
};
[[nodiscard]] ComfortFinding judge(const ParallaxBudget& budget, const Screen& screen, const Eyes& eyes,
                                   const Content& content);

// One line with numbers and the remedy; empty when nothing is wrong.
[[nodiscard]] std::string warning_of(const ComfortFinding& finding, const ParallaxBudget& budget);

}  // namespace burin
