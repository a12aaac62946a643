// SPDX-License-Identifier: MIT
// Stereo comfort: the parallax of content, the angle by which the eyes turn away from the screen they focus on, against
// a budget.
//
// Two measures of a point P, with L, R the eyes and S where the line from between the eyes through P meets the screen:
//   parallax_m    (R's picture of P - L's picture of P) . direction from L to R: metres on the screen; below 0 crossed
//                 (in front of the screen), above 0 uncrossed (behind). Eyes parallel to the screen at distance d, P at
//                 z in front: -ipd z / (d - z).
//   parallax_deg  angle LSR - angle LPR, likewise signed. On the axis 2 atan(ipd / 2d) - 2 atan(ipd / 2(d - z)).
// Pure functions, any thread; of the parts of this file only judge() and warning_of() allocate. Metres, world frame.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "wall/wall.hpp"

namespace burin::wall {

struct Parallax {
    double m = 0.0;
    double deg = 0.0;
};

// The parallax of a point. The point must lie in front of the eyes: nearer to the screen's plane than they, or behind
// the screen.
[[nodiscard]] Parallax parallax_of(const Screen& screen, const Eyes& eyes, const Vec3& point_world);

// Distances from the eyes, straight ahead, between which content keeps the budget; the screen is distance_m away.
struct ComfortRange {
    double nearest_m = 0.0;
    std::optional<double> farthest_m;  // nothing: no limit
};
[[nodiscard]] ComfortRange comfort_range(const ParallaxBudget& budget, double interpupillary_m, double distance_m);

// The parallax in metres that uses up the budget on a screen distance_m away. Uncrossed parallax never exceeds
// interpupillary_m, where the eyes look straight ahead; beyond it they would have to diverge.
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
    bool any = false;         // there is content
    Parallax crossed;         // the largest, 0 or below
    Parallax uncrossed;       // the largest, 0 or above
    double in_front_m = 0.0;  // how far the nearest content stands in front of the screen; below 0: behind it
};

// The extreme parallax of the content. Points nearer to the eyes than a tenth of the screen's distance, or behind them,
// count as at that distance. Tests the points of each ball and box that are nearest to and farthest from the point
// between the eyes and from the screen; for eyes parallel to the screen the result is within 5 % of the largest over
// all points.
[[nodiscard]] ContentParallax largest_parallax(const Screen& screen, const Eyes& eyes, const Content& content);

struct ComfortFinding {
    bool crossed_too_much = false, uncrossed_too_much = false;
    ContentParallax parallax;
    // Displacement of the content along the screen's normal, above 0 towards the viewer, with which it keeps the
    // budget; nothing when the content is too deep to keep both sides.
    std::optional<double> move_m;
};
// Compares content with the budget.
[[nodiscard]] ComfortFinding judge(const ParallaxBudget& budget, const Screen& screen, const Eyes& eyes,
                                   const Content& content);

// The warning in one line with numbers and the remedy; empty when nothing is wrong.
[[nodiscard]] std::string warning_of(const ComfortFinding& finding, const ParallaxBudget& budget);

}  // namespace burin::wall
