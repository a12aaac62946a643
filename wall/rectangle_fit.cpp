// SPDX-License-Identifier: MIT
#include "renderer/stereo/rectangle_fit.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace burin {
namespace {

constexpr std::size_t kUnknowns = 8;  // small rotation about right, up, out; centre along them; width; height
constexpr int kMostSteps = 30;

using Row = std::array<double, kUnknowns>;

struct NormalEquations {
    std::array<Row, kUnknowns> a{};
    Row b{};

    void add(const Row& row, double value) {
        for (std::size_t i = 0; i < kUnknowns; ++i) {
            for (std::size_t j = 0; j < kUnknowns; ++j) a[i][j] += row[i] * row[j];
            b[i] += row[i] * value;
        }
    }
};

// Gauss with pivots; nothing when the first n unknowns are not all determined. The unknowns are of one size (metres, and
// turns of a screen of about a metre), so one threshold suits all.
std::optional<Row> solve(NormalEquations e, std::size_t n, double count) {
    for (std::size_t i = 0; i < n; ++i) {
        std::size_t best = i;
        for (std::size_t r = i + 1; r < n; ++r) {
            if (std::abs(e.a[r][i]) > std::abs(e.a[best][i])) best = r;
        }
        if (!(std::abs(e.a[best][i]) > 1e-9 * count)) return std::nullopt;
        std::swap(e.a[i], e.a[best]);
        std::swap(e.b[i], e.b[best]);
        for (std::size_t r = i + 1; r < n; ++r) {
            const double factor = e.a[r][i] / e.a[i][i];
            for (std::size_t c = i; c < n; ++c) e.a[r][c] -= factor * e.a[i][c];
            e.b[r] -= factor * e.b[i];
        }
    }
    Row x{};
    for (std::size_t i = n; i-- > 0;) {
        double sum = e.b[i];
        for (std::size_t c = i + 1; c < n; ++c) sum -= e.a[i][c] * x[c];
        x[i] = sum / e.a[i][i];
    }
    return x;
}

// Where a point's place is on the rectangle, from its centre.
Vec2 place_m(const FitRectangle& r, const FitPoint& p) {
    const Vec3 d = p.at_tracker - r.centre;
    return {p.place.u ? (*p.place.u - 0.5) * r.width_m : glm::dot(d, r.right),
            p.place.v ? (*p.place.v - 0.5) * r.height_m : glm::dot(d, r.up)};
}

// A small rotation w moves the place (x, y, 0) by w x (x, y, 0) = (-w3 y, w3 x, w1 y - w2 x).
void add_point(NormalEquations& e, const FitRectangle& r, const FitPoint& p) {
    const Vec2 at = place_m(r, p);
    const FitResidual d = residual(r, p);
    if (p.place.u) e.add({0, 0, -at.y, 1, 0, 0, *p.place.u - 0.5, 0}, d.right_m);
    if (p.place.v) e.add({0, 0, at.x, 0, 1, 0, 0, *p.place.v - 0.5}, d.up_m);
    e.add({at.y, -at.x, 0, 0, 0, 1, 0, 0}, d.out_m);
}

void move(FitRectangle& r, const Row& x) {
    const Vec3 out = glm::cross(r.right, r.up);
    const Vec3 turn = x[0] * r.right + x[1] * r.up + x[2] * out;
    r.centre += x[3] * r.right + x[4] * r.up + x[5] * out;
    r.width_m += x[6];
    r.height_m += x[7];
    const double angle = glm::length(turn);
    if (angle > 0.0) {
        const Quat q = glm::angleAxis(angle, turn / angle);
        r.right = q * r.right;
        r.up = q * r.up;
    }
    r.right = glm::normalize(r.right);
    r.up = glm::normalize(r.up - r.right * glm::dot(r.up, r.right));
}

}  // namespace

FitResidual residual(const FitRectangle& r, const FitPoint& p) {
    const Vec3 d = p.at_tracker - r.centre;
    const Vec2 at = place_m(r, p);
    return {glm::dot(d, r.right) - at.x, glm::dot(d, r.up) - at.y, glm::dot(d, glm::cross(r.right, r.up))};
}

std::optional<FitRectangle> rough_rectangle(std::span<const FitPoint> points) {
    // x = c + u a + v b by least squares, each coordinate alone; then a and b made unit vectors at right angles.
    std::array<NormalEquations, 3> equations{};
    for (const FitPoint& p : points) {
        const Row row{1.0, *p.place.u - 0.5, *p.place.v - 0.5};
        for (int axis = 0; axis < 3; ++axis) equations[static_cast<std::size_t>(axis)].add(row, p.at_tracker[axis]);
    }
    Vec3 c{0.0}, a{0.0}, b{0.0};
    for (int axis = 0; axis < 3; ++axis) {
        const auto x = solve(equations[static_cast<std::size_t>(axis)], 3, 1e3);  // 1e-6: a thousandth of the screen
        if (!x) return std::nullopt;
        c[axis] = (*x)[0], a[axis] = (*x)[1], b[axis] = (*x)[2];
    }
    const double width_m = glm::length(a), height_m = glm::length(b);
    if (!(glm::length(glm::cross(a, b)) > 0.05 * width_m * height_m) || !(width_m * height_m > 0.0))
        return std::nullopt;
    // Turned by equal angles towards each other or apart, until at right angles.
    const Vec3 sum = glm::normalize(a / width_m + b / height_m),
               difference = glm::normalize(a / width_m - b / height_m);
    return FitRectangle{c, glm::normalize(sum + difference), glm::normalize(sum - difference), width_m, height_m};
}

std::optional<FitRectangle> refine(FitRectangle rectangle, std::span<const FitPoint> points, bool keep_size) {
    for (int step = 0; step < kMostSteps; ++step) {
        NormalEquations equations;
        for (const FitPoint& p : points) add_point(equations, rectangle, p);
        const auto x = solve(equations, keep_size ? 6 : kUnknowns, static_cast<double>(points.size()));
        if (!x) return std::nullopt;
        move(rectangle, *x);
        const double largest = std::abs(*std::ranges::max_element(*x, {}, [](double v) { return std::abs(v); }));
        if (largest < 1e-12) break;
    }
    return rectangle;
}

}  // namespace burin
