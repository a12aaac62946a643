// SPDX-License-Identifier: MIT
// Draws the plan (from above) and the side view (from the left) of a wall: burin wall show --svg.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <vector>

#include "base/plot/svg.hpp"
#include "base/text.hpp"
#include "wall/comfort.hpp"
#include "wall/projection.hpp"
#include "wall/wall_figures.hpp"

namespace burin::wall {
namespace {

// Layout in pixels.
constexpr double kView = 430, kMargin = 46, kTop = 92;

// Returns the colour of a screen. Black, which is the head's, is left out.
const char* colour_of_screen(std::size_t index) {
    constexpr std::size_t kBlack = 4;
    index %= plot::kColours.size() - 1;
    return plot::kColours[index < kBlack ? index : index + 1];
}

std::string write(const Vec2& at, std::string_view attributes, std::string_view text) {
    return plot::write(at.x, at.y, attributes, text);
}

std::array<Vec3, 4> corners_of(const Screen& s) {
    return {s.lower_left_world, s.lower_right_world, s.lower_right_world + s.upper_left_world - s.lower_left_world,
            s.upper_left_world};
}

// A view of the environment along one of its axes: metres to pixels, y of the picture downwards.
struct View {
    const char* title;
    const char *x_label, *y_label;
    std::function<Vec2(const Vec3&)> flat;  // metres, x rightwards, y upwards on paper
    double left = 0.0;
    Vec2 lo_m{0.0};
    double size_m = 1.0;

    [[nodiscard]] Vec2 at(const Vec3& p) const {
        const Vec2 m = flat(p) - lo_m;
        const double scale = kView / size_m;
        return {left + kMargin + m.x * scale, kTop + kView - m.y * scale};
    }
};

// Fits a square view to the points with a margin of a tenth of the larger extent on each side. Returns its size in
// metres.
double fit(View& view, const std::vector<Vec3>& points) {
    Vec2 lo = view.flat(points[0]), hi = lo;
    for (const Vec3& p : points) lo = glm::min(lo, view.flat(p)), hi = glm::max(hi, view.flat(p));
    const double size_m = 1.2 * std::max({hi.x - lo.x, hi.y - lo.y, 0.1});
    view.lo_m = 0.5 * (lo + hi) - 0.5 * Vec2(size_m);
    return size_m;
}

constexpr int kMostLines = 20;  // of a grid in one direction

// Returns where lines lie within an extent: at multiples of a step that gives at most a dozen of them, however large
// the wall is.
std::vector<double> grid_lines(double from_m, double size_m) {
    double step = size_m > 2.5 ? 1.0 : size_m > 1.2 ? 0.5 : 0.1;
    if (size_m > 12.0) step = 5.0 * std::max(1.0, std::pow(10.0, std::ceil(std::log10(size_m / 60.0))));
    std::vector<double> lines;
    const double first = std::ceil(from_m / step);
    for (int i = 0; i <= kMostLines && (first + i) * step < from_m + size_m; ++i) lines.push_back((first + i) * step);
    return lines;
}

std::string grid(const View& v) {
    const double scale = kView / v.size_m, x0 = v.left + kMargin;
    std::string text = plot::rectangle(x0, kTop, kView, kView, "#fafafa", "#888888");
    for (const double m : grid_lines(v.lo_m.x, v.size_m)) {
        const double x = x0 + (m - v.lo_m.x) * scale;
        text += plot::line_down(x, kTop, kView, "#e2e2e2");
        text +=
            write({x, kTop + kView + 15}, "text-anchor=\"middle\"", formatted("%.3g", std::abs(m) < 1e-9 ? 0.0 : m));
    }
    for (const double m : grid_lines(v.lo_m.y, v.size_m)) {
        const double y = kTop + kView - (m - v.lo_m.y) * scale;
        text += plot::line_across(x0, y, kView, "#e2e2e2");
        const double shown = v.y_label[0] == 'z' ? -m : m;
        text += write({x0 - 6, y + 4}, "text-anchor=\"end\"", formatted("%.3g", std::abs(shown) < 1e-9 ? 0.0 : shown));
    }
    text += write({x0, kTop - 12}, "font-size=\"13\" font-weight=\"bold\"", v.title);
    text += write({x0 + kView / 2, kTop + kView + 32}, "text-anchor=\"middle\"", v.x_label);
    return text + plot::write_upright(v.left + 14, kTop + kView / 2, v.y_label);
}

std::string polygon(const View& v, const std::vector<Vec3>& points, const std::string& attributes) {
    std::string path = "<path d=\"";
    for (const Vec3& p : points) path += formatted("%s%.1f %.1f", path.size() < 10 ? "M" : "L", v.at(p).x, v.at(p).y);
    return path + "Z\" " + attributes + "/>\n";
}

std::string screen_lines(const View& v, const Screen& s, const Vec3& eye, const char* colour) {
    const auto corners = corners_of(s);
    std::string text;
    // The fallback head's view pyramid.
    for (std::size_t i = 0; i < 4; ++i) {
        text += polygon(v, {eye, corners[i], corners[(i + 1) % 4]},
                        formatted("fill=\"%s\" fill-opacity=\"0.05\" stroke=\"none\"", colour));
    }
    text += polygon(
        v, {corners.begin(), corners.end()},
        formatted("fill=\"%s\" fill-opacity=\"0.12\" stroke=\"%s\" stroke-width=\"3\" stroke-linejoin=\"round\"",
                  colour, colour));
    const Vec3 middle = 0.5 * (s.lower_right_world + s.upper_left_world);
    const Vec3 right = s.lower_right_world - s.lower_left_world, up = s.upper_left_world - s.lower_left_world;
    const Vec2 a = v.at(middle), b = v.at(middle + 0.08 * v.size_m * glm::normalize(glm::cross(right, up)));
    if (glm::length(b - a) < 3.0) return text;  // the normal points at the reader
    const Vec2 d = glm::normalize(b - a), n{-d.y, d.x};
    const Vec2 l = b - 7.0 * d + 3.5 * n, r = b - 7.0 * d - 3.5 * n;
    return text +
           formatted("<path d=\"M%.1f %.1f L%.1f %.1f\" stroke=\"%s\" stroke-width=\"1.2\"/>\n", a.x, a.y, b.x, b.y,
                     colour) +
           formatted("<path d=\"M%.1f %.1f L%.1f %.1f L%.1f %.1fZ\" fill=\"%s\"/>\n", b.x, b.y, l.x, l.y, r.x, r.y,
                     colour);
}

// Marks where comfortable content begins: a piece of the plane parallel to the screen.
std::string comfort_lines(const View& v, const WallSetup& setup, const Screen& s, const Eyes& eyes,
                          const char* colour) {
    if (!can_be_seen(s, eyes)) return {};
    const Vec3 eye = 0.5 * (eyes.left_world + eyes.right_world);
    const double distance_m = distance_in_front(s, eye);
    const double share =
        comfort_range(setup.budget, glm::length(eyes.right_world - eyes.left_world), distance_m).nearest_m / distance_m;
    std::vector<Vec3> points;
    for (const Vec3& c : corners_of(s)) points.push_back(eye + share * (c - eye));
    return polygon(v, points,
                   formatted("fill=\"none\" stroke=\"%s\" stroke-width=\"1.2\" stroke-dasharray=\"5 4\"", colour));
}

std::string head_mark(const View& v, const WallSetup& setup, const Eyes& eyes) {
    std::string text;
    for (const Vec3& e : {eyes.left_world, eyes.right_world}) {
        text += formatted("<circle cx=\"%.1f\" cy=\"%.1f\" r=\"3.4\" fill=\"#000000\"/>\n", v.at(e).x, v.at(e).y);
    }
    const Vec3 middle = 0.5 * (eyes.left_world + eyes.right_world);
    const Vec3 ahead =
        setup.world_from_tracker.orientation * (setup.fallback_head_tracker.orientation * Vec3{0, 0, -1});
    const Vec2 a = v.at(middle), b = v.at(middle + 0.1 * v.size_m * ahead);
    text += formatted("<path d=\"M%.1f %.1f L%.1f %.1f\" stroke=\"#000000\"/>\n", a.x, a.y, b.x, b.y);
    return text +
           write(a + Vec2{8, 14}, a.x - v.left > kMargin + kView - 100 ? "text-anchor=\"end\"" : "", "fallback head");
}

std::string legend(const WallSetup& setup) {
    std::string text;
    double x = kMargin;
    for (std::size_t i = 0; i < setup.screens.size(); ++i) {
        text += formatted("<path d=\"M%.1f 53 h18\" stroke=\"%s\" stroke-width=\"3\"/>\n", x, colour_of_screen(i));
        text += write({x + 23, 57}, "", setup.screens[i].name);
        x += 46 + 6.6 * static_cast<double>(setup.screens[i].name.size());
    }
    text +=
        formatted("<path d=\"M%.1f 53 h18\" stroke=\"#444444\" stroke-width=\"1.2\" stroke-dasharray=\"5 4\"/>\n", x);
    return text + write({x + 23, 57}, "", "comfortable content begins here");
}

}  // namespace

std::string wall_drawing(const WallSetup& setup) {
    const Eyes eyes = eyes_world(setup, {setup.fallback_head_tracker, setup.fallback_head_tracker});
    const Vec3 eye = 0.5 * (eyes.left_world + eyes.right_world);
    std::vector<Vec3> points{eye};
    for (const WallScreen& s : setup.screens) {
        for (const Vec3& c : corners_of(screen_world(setup, s))) points.push_back(c);
    }
    std::array<View, 2> views{{{"Plan, from above", "x, m", "z, m", [](const Vec3& p) { return Vec2{p.x, -p.z}; }},
                               {"Side view, from the left", "z, m (wall left, viewer right)", "y, m",
                                [](const Vec3& p) { return Vec2{p.z, p.y}; }}}};
    const double width = 2 * (kView + kMargin) + 30, height = kTop + kView + 46;
    std::string text = plot::svg_begin(width, height, setup.name.empty() ? "wall" : setup.name, 28);
    text += legend(setup);
    views[1].left = kView + kMargin + 14;
    for (View& v : views) {
        v.size_m = fit(v, points);
        text += grid(v);
        for (std::size_t i = 0; i < setup.screens.size(); ++i) {
            text += screen_lines(v, screen_world(setup, setup.screens[i]), eye, colour_of_screen(i));
        }
        for (std::size_t i = 0; i < setup.screens.size(); ++i) {
            text += comfort_lines(v, setup, screen_world(setup, setup.screens[i]), eyes, colour_of_screen(i));
        }
        text += head_mark(v, setup, eyes);
    }
    return text + "</svg>\n";
}

}  // namespace burin::wall
