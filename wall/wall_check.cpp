// SPDX-License-Identifier: MIT
// Checks of a wall setup (check() and check_modes() in wall.hpp). Each rule examines one property and reports it with
// numbers.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "base/space.hpp"
#include "base/text.hpp"
#include "wall/output_settings.hpp"
#include "wall/projection.hpp"
#include "wall/stereo_mode.hpp"
#include "wall/wall.hpp"

namespace burin::wall {
namespace {

constexpr double kDegreesOfRadian = 180.0 / std::numbers::pi;
constexpr double kSmallest_m = 0.1, kLargest_m = 30.0;       // a screen's side: from a telephone to a cinema
constexpr double kOnALine = 0.05;                            // sine of the angle at the corner
constexpr double kRightAngle = 1e-3;                         // cosine, as can_be_seen() demands: 3 mm over 3 m
constexpr double kLeastEyes_m = 0.045, kMostEyes_m = 0.080;  // range of almost all adults (Dodgson 2004)

class Problems {
public:
    void error(const std::string& where, std::string what, std::string remedy) {
        found_.push_back({true, where, std::move(what), std::move(remedy)});
    }
    void warning(const std::string& where, std::string what, std::string remedy) {
        found_.push_back({false, where, std::move(what), std::move(remedy)});
    }
    [[nodiscard]] std::vector<WallProblem> take() { return std::move(found_); }

private:
    std::vector<WallProblem> found_;
};

struct Sides {
    Vec3 right, up;
    double width_m, height_m;
};

Sides sides_of(const Screen& s) {
    const Vec3 right = s.lower_right_world - s.lower_left_world, up = s.upper_left_world - s.lower_left_world;
    return {right, up, glm::length(right), glm::length(up)};
}

Vec3 centre_of(const Screen& s) { return 0.5 * (s.lower_right_world + s.upper_left_world); }

// Suggests the unit in which the same numbers would give a sensible size.
std::string unit_hint(LengthUnit unit, double size_m) {
    for (const LengthUnit other : {LengthUnit::m, LengthUnit::mm, LengthUnit::cm, LengthUnit::ft, LengthUnit::inch}) {
        const double there_m = size_m / metres_in(unit) * metres_in(other);
        if (other != unit && there_m >= 0.25 && there_m <= 12.0) {
            return formatted("units = \"%s\" would make it %.3g m; correct units or the corners", name_of(other),
                             there_m);
        }
    }
    return "correct its corners";
}

// Whether the three corners form a rectangle of sensible size, which the other rules require.
bool check_shape(Problems& problems, const WallSetup& setup, const WallScreen& screen) {
    const Screen s = screen_world(setup, screen);
    if (!finite(s.lower_left_world) || !finite(s.lower_right_world) || !finite(s.upper_left_world)) {
        problems.error(screen.name, "a corner is not a number", "correct its corners");
        return false;
    }
    const Sides sides = sides_of(s);
    for (const auto& [what, size_m] : {std::pair{"wide", sides.width_m}, std::pair{"high", sides.height_m}}) {
        if (size_m >= kSmallest_m && size_m <= kLargest_m) continue;
        problems.error(screen.name, formatted("it is %.4g m %s", size_m, what), unit_hint(setup.unit, size_m));
        return false;
    }
    const double sine = glm::length(glm::cross(sides.right, sides.up)) / (sides.width_m * sides.height_m);
    const double cosine = glm::dot(sides.right, sides.up) / (sides.width_m * sides.height_m);
    if (sine < kOnALine) {
        problems.error(screen.name, "its three corners lie on a line", "give lower_left, lower_right and upper_left");
        return false;
    }
    if (std::abs(cosine) > kRightAngle) {
        problems.error(screen.name,
                       formatted("the angle at its lower left corner is %.2f degrees and not a right one",
                                 std::atan2(sine, cosine) * kDegreesOfRadian),
                       "measure it again, or let burin wall calibrate find the best rectangle");
        return false;
    }
    return true;
}

void check_pixels(Problems& problems, const WallScreen& screen, const Sides& sides) {
    const auto [across, down] = screen.pixels;
    if (across < 1 || down < 1 || across > 16384 || down > 16384) {
        problems.error(screen.name, formatted("%d by %d pixels cannot be drawn", across, down), "correct its pixels");
        return;
    }
    const double x_mm = 1e3 * sides.width_m / across, y_mm = 1e3 * sides.height_m / down;
    if (std::abs(x_mm / y_mm - 1.0) > 0.05) {
        problems.warning(screen.name, formatted("its pixels are %.2f mm wide and %.2f mm high", x_mm, y_mm),
                         "see that the picture fills the screen, and correct pixels or corners");
    }
}

void check_viewing(Problems& problems, const WallSetup& setup, const WallScreen& screen) {
    const Screen s = screen_world(setup, screen);
    const Eyes eyes = eyes_world(setup, {setup.fallback_head_tracker, setup.fallback_head_tracker});
    if (!finite(eyes.left_world) || !finite(eyes.right_world)) return;  // reported once, by check_eyes()
    const double nearest_m = std::min(distance_in_front(s, eyes.left_world), distance_in_front(s, eyes.right_world));
    const Vec3 head = 0.5 * (eyes.left_world + eyes.right_world);
    const Quat orientation = setup.world_from_tracker.orientation * setup.fallback_head_tracker.orientation;
    const bool looks_at_it = glm::dot(orientation * Vec3{0, 0, -1}, centre_of(s) - head) > 0.0;
    if (nearest_m <= 0.0) {
        problems.error(
            screen.name, formatted("its back is turned to the fallback head, which is %.2f m behind it", -nearest_m),
            looks_at_it ? "its left and right corners are exchanged: exchange lower_left and lower_right, and "
                          "set upper_left above the new lower_left"
                        : "correct the fallback head, or exchange its left and right corners");
        return;
    }
    if (nearest_m < 0.01) {
        problems.error(screen.name, formatted("the fallback head's eyes are %.1f mm before it", 1e3 * nearest_m),
                       "move the fallback head away from it");
    }
    const Sides sides = sides_of(s);
    const Vec3 normal = glm::normalize(glm::cross(sides.right, sides.up));
    if (std::abs(normal.y) < 0.7 && sides.up.y < 0.0) {
        problems.warning(screen.name, "it stands upside down", "exchange its lower and upper corners");
    }
}

double determinant(const std::array<std::array<double, 3>, 3>& h) {
    return h[0][0] * (h[1][1] * h[2][2] - h[1][2] * h[2][1]) - h[0][1] * (h[1][0] * h[2][2] - h[1][2] * h[2][0]) +
           h[0][2] * (h[1][0] * h[2][1] - h[1][1] * h[2][0]);
}

void check_homography(Problems& problems, const WallScreen& screen) {
    if (!screen.homography) return;
    const auto& h = *screen.homography;
    double largest = 0.0;
    for (const auto& row : h)
        for (const double x : row) largest = std::isfinite(x) ? std::max(largest, std::abs(x)) : HUGE_VAL;
    const std::string remedy = "measure the projector's corners again, or leave homography out";
    if (!std::isfinite(largest) || std::abs(determinant(h)) <= 1e-9 * largest * largest * largest) {
        problems.error(screen.name, "its homography is singular: it has no inverse", remedy);
        return;
    }
    double outside = 0.0;
    for (const auto& [x, y] : {std::pair{0.0, 0.0}, {1.0, 0.0}, {0.0, 1.0}, {1.0, 1.0}}) {
        const double w = h[2][0] * x + h[2][1] * y + h[2][2];
        if (w / h[2][2] <= 1e-6) {
            problems.error(screen.name, formatted("its homography sends the corner (%g, %g) beyond infinity", x, y),
                           remedy);
            return;
        }
        for (const std::size_t i : {0u, 1u}) {
            const double at = (h[i][0] * x + h[i][1] * y + h[i][2]) / w;
            outside = std::max({outside, -at, at - 1.0});
        }
    }
    if (outside > 0.01) {
        problems.warning(
            screen.name,
            formatted("its homography moves a corner off the projector's picture by %.0f %%", 100.0 * outside),
            "what lies outside 0..1 is not shown: " + remedy);
    }
}

void check_blend(Problems& problems, const WallScreen& screen) {
    const EdgeBlend& b = screen.blend;
    for (const auto& [edge, width] :
         {std::pair{"left", b.left}, {"right", b.right}, {"top", b.top}, {"bottom", b.bottom}}) {
        if (width >= 0.0 && width <= 0.5) continue;
        problems.error(screen.name, formatted("its %s edge blends over %.3g of the picture", edge, width),
                       "give the part of the picture that the neighbour covers, from 0 to 0.5");
    }
    if (!is_projector_gamma(b.gamma)) {
        problems.error(screen.name, formatted("its blend gamma is %.3g", b.gamma),
                       formatted("give the projector's, from %.3g to %.3g, about 2.2", kLeastGamma, kMostGamma));
    }
}

void check_screens(Problems& problems, const WallSetup& setup) {
    if (setup.screens.empty()) problems.error("wall", "it has no screen", "add a [[screen]]");
    std::vector<bool> shaped;
    for (const WallScreen& s : setup.screens) {
        shaped.push_back(check_shape(problems, setup, s));
        if (shaped.back()) {
            check_pixels(problems, s, sides_of(screen_world(setup, s)));
            check_viewing(problems, setup, s);
        }
        check_homography(problems, s);
        check_blend(problems, s);
    }
    for (std::size_t i = 0; i < setup.screens.size(); ++i) {
        for (std::size_t j = i + 1; j < setup.screens.size(); ++j) {
            const WallScreen &a = setup.screens[i], &b = setup.screens[j];
            if (a.name == b.name) problems.error(a.name, "two screens have this name", "give each a name of its own");
            if (a.output == b.output && a.direct.has_value() == b.direct.has_value()) {
                problems.error(b.name, "it is on output " + b.output + ", as is screen " + a.name,
                               "give each screen an output of its own");
            }
            if (!shaped[i] || !shaped[j]) continue;
            const Overlap overlap = overlap_of(screen_world(setup, a), screen_world(setup, b));
            if (overlap == Overlap::crossing) {
                problems.error(b.name, "it passes through screen " + a.name, "correct the corners of the two");
            } else if (overlap == Overlap::lying_on && !(a.blend.any() && b.blend.any())) {
                problems.warning(b.name, "it lies on a part of screen " + a.name + " without an edge blend",
                                 "give both a blend there, or correct the corners");
            }
        }
    }
}

// The screen that the fallback head faces most squarely, on which left and right are unambiguous.
const WallScreen* frontal_screen(const WallSetup& setup) {
    const Vec3 ahead =
        setup.world_from_tracker.orientation * (setup.fallback_head_tracker.orientation * Vec3{0, 0, -1});
    const WallScreen* best = nullptr;
    double most = 0.2;
    for (const WallScreen& s : setup.screens) {
        const Sides sides = sides_of(screen_world(setup, s));
        const double square = -glm::dot(ahead, glm::normalize(glm::cross(sides.right, sides.up)));
        if (square > most) most = square, best = &s;
    }
    return best;
}

void check_eyes(Problems& problems, const WallSetup& setup) {
    const Pose& head = setup.fallback_head_tracker;
    const Eyes eyes = eyes_world(setup, {head, head});
    if (!finite(eyes.left_world) || !finite(eyes.right_world)) {
        problems.error("viewer", "an eye or the fallback head is not a number", "correct [viewer]");
        return;
    }
    const Vec3 apart = eyes.right_world - eyes.left_world;
    const double apart_m = glm::length(apart);
    if (apart_m < kLeastEyes_m || apart_m > kMostEyes_m) {
        const std::string what =
            formatted("the eyes are %.4g mm apart; almost all adults have 45 to 80", 1e3 * apart_m);
        if (apart_m > 0.3 || apart_m < 0.001) {
            problems.error("viewer", what, "correct the eyes, and look whether units is right");
        } else {
            problems.warning("viewer", what, "measure the distance of the pupils; 63 mm is the mean of adults");
        }
    }
    const WallScreen* screen = frontal_screen(setup);
    if (screen == nullptr) return;
    const double rightwards = glm::dot(apart, glm::normalize(sides_of(screen_world(setup, *screen)).right));
    if (rightwards < 0.0) {
        problems.error("viewer", "left and right eye are exchanged, as seen on screen " + screen->name,
                       "exchange left_eye and right_eye, or correct the fallback head's orientation");
    } else if (apart_m > 0.0 && rightwards < 0.5 * apart_m) {
        problems.warning("viewer",
                         formatted("the fallback head's eyes stand %.0f degrees from level on screen %s",
                                   std::acos(rightwards / apart_m) * kDegreesOfRadian, screen->name.c_str()),
                         "correct the eyes or the fallback head's orientation");
    }
}

void check_budget(Problems& problems, const ParallaxBudget& budget) {
    for (const auto& [what, deg] : {std::pair{"crossed", budget.crossed_deg}, {"uncrossed", budget.uncrossed_deg}}) {
        if (!(deg > 0.0 && deg <= 20.0)) {
            problems.error("comfort", formatted("a budget of %.3g degrees of %s parallax makes no sense", deg, what),
                           "give degrees, about 2");
        } else if (deg > 3.5) {
            problems.warning("comfort",
                             formatted("%.3g degrees of %s parallax are more than most people fuse", deg, what),
                             "about 2 suits 84 % of people");
        }
    }
}

void check_timing(Problems& problems, const DisplayTiming& timing) {
    if (!(timing.refresh_Hz >= 20.0 && timing.refresh_Hz <= 1000.0)) {
        problems.error("display", formatted("a refresh rate of %.4g Hz makes no sense", timing.refresh_Hz),
                       "give fields a second, such as 60 or 120");
    } else if (timing.eye_order != EyeOrder::simultaneous && timing.refresh_Hz < 100.0) {
        problems.warning("display",
                         formatted("one eye after the other at %.4g Hz leaves %.4g Hz an eye, which flickers",
                                   timing.refresh_Hz, 0.5 * timing.refresh_Hz),
                         "use 120 Hz, or eye_order = \"simultaneous\" when both eyes are shown at once");
    }
}

// Returns what speaks against a mode where a display is driven without windows.
std::optional<WallProblem> contradiction(const WallScreen& screen, StereoMode mode) {
    if (!screen.direct) return std::nullopt;
    const std::string direct = name_of(*screen.direct);
    const ModeNeeds needs = needs_of(mode);
    if (needs.two_windows) {
        return WallProblem{true, screen.name,
                           "mode two_windows needs a window for the right eye, and it is driven without windows",
                           "choose another mode, or leave direct out"};
    }
    const bool separates = *screen.direct != DisplayStereo::none;
    if (needs.two_layers && !separates) {
        return WallProblem{true, screen.name,
                           "direct = \"plain\" gives the display one picture, mode two_layers has two",
                           "say how the display separates them: direct = \"hdmi-3d\", \"onboard-din\" or "
                           "\"inband-displayport\""};
    }
    if (separates && !needs.two_layers) {
        return WallProblem{true, screen.name,
                           "direct = \"" + direct + "\" separates two pictures, mode " + screen.mode + " has one",
                           "choose mode = \"two_layers\", or direct = \"plain\""};
    }
    return std::nullopt;
}

}  // namespace

std::vector<WallProblem> check(const WallSetup& setup) {
    Problems problems;
    check_screens(problems, setup);
    check_eyes(problems, setup);
    check_budget(problems, setup.budget);
    check_timing(problems, setup.timing);
    return problems.take();
}

std::vector<WallProblem> check_modes(const WallSetup& setup) {
    std::vector<WallProblem> problems;
    for (const WallScreen& screen : setup.screens) {
        const auto mode = parse_stereo_mode(screen.mode);
        if (!mode) {
            problems.push_back({true, screen.name, "mode: " + mode.error().what, mode.error().remedy});
        } else if (auto problem = contradiction(screen, *mode)) {
            problems.push_back(std::move(*problem));
        }
    }
    return problems;
}

std::string line_of(const WallProblem& problem) {
    return (problem.error ? "error: " : "warning: ") + problem.where + ": " + problem.what + "; " + problem.remedy;
}

}  // namespace burin::wall
