// SPDX-License-Identifier: MIT
#include "wall/rectangle_fit.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <array>

namespace burin::wall {
namespace {

constexpr int kUnknowns = 8;  // small rotation about right, up, out; centre along them; width; height
constexpr int kMostSteps = 30;

// Least share of a unit weight that an observation must leave to the least determined unknown. The unknowns are of
// similar size (metres, and rotations of a screen of about a metre), so one threshold suits all.
constexpr double kLeastWeight = 1e-9;

using Unknowns = Eigen::Vector<double, kUnknowns>;

// Solves `rows` x = `values` for each column of values, in the sense of least squares. Returns nothing when the rows do
// not determine all unknowns: the squares on the diagonal of R are the pivots of the normal equations, largest first.
template <typename Rows, typename Values>
std::optional<Eigen::MatrixXd> solve(const Rows& rows, const Values& values, double least_pivot) {
    if (rows.rows() < rows.cols()) return std::nullopt;
    const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(rows);
    if (!(qr.matrixR().diagonal().cwiseAbs2().minCoeff() > least_pivot)) return std::nullopt;
    return qr.solve(values);
}

// The observation equations of a step.
struct Equations {
    explicit Equations(std::size_t points)
        : rows(3 * static_cast<Eigen::Index>(points), kUnknowns), values(rows.rows()) {}

    void add(const std::array<double, kUnknowns>& row, double value) {
        rows.row(count) = Eigen::Map<const Unknowns>(row.data()).transpose();
        values[count++] = value;
    }

    Eigen::Matrix<double, Eigen::Dynamic, kUnknowns> rows;
    Eigen::VectorXd values;
    Eigen::Index count = 0;
};

// Position of a point's place on the rectangle, from its centre.
Vec2 place_m(const FitRectangle& r, const FitPoint& p) {
    const Vec3 d = p.at_tracker - r.centre;
    return {p.place.u ? (*p.place.u - 0.5) * r.width_m : glm::dot(d, r.right),
            p.place.v ? (*p.place.v - 0.5) * r.height_m : glm::dot(d, r.up)};
}

// Adds a point's equations. A small rotation w moves the place (x, y, 0) by w x (x, y, 0) = (-w3 y, w3 x, w1 y - w2 x).
void add_point(Equations& e, const FitRectangle& r, const FitPoint& p) {
    const Vec2 at = place_m(r, p);
    const FitResidual d = residual(r, p);
    if (p.place.u) e.add({0, 0, -at.y, 1, 0, 0, *p.place.u - 0.5, 0}, d.right_m);
    if (p.place.v) e.add({0, 0, at.x, 0, 1, 0, 0, *p.place.v - 0.5}, d.up_m);
    e.add({at.y, -at.x, 0, 0, 0, 1, 0, 0}, d.out_m);
}

void move(FitRectangle& r, const Unknowns& x) {
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
    // Fits x = c + u a + v b by least squares, then makes a and b orthogonal unit vectors.
    Eigen::MatrixX3d rows(points.size(), 3), at(points.size(), 3);
    for (Eigen::Index i = 0; i < rows.rows(); ++i) {
        const FitPoint& p = points[static_cast<std::size_t>(i)];
        rows.row(i) << 1.0, *p.place.u - 0.5, *p.place.v - 0.5;
        at.row(i) << p.at_tracker.x, p.at_tracker.y, p.at_tracker.z;
    }
    // A pivot threshold of 1e-6: places spread over less than about a thousandth of the screen determine nothing.
    const auto x = solve(rows, at, 1e3 * kLeastWeight);
    if (!x) return std::nullopt;
    const auto vector = [&](Eigen::Index row) { return Vec3{(*x)(row, 0), (*x)(row, 1), (*x)(row, 2)}; };
    const Vec3 c = vector(0), a = vector(1), b = vector(2);
    const double width_m = glm::length(a), height_m = glm::length(b);
    if (!(glm::length(glm::cross(a, b)) > 0.05 * width_m * height_m) || !(width_m * height_m > 0.0))
        return std::nullopt;
    // Rotates both by equal and opposite angles until they are at right angles.
    const Vec3 sum = glm::normalize(a / width_m + b / height_m),
               difference = glm::normalize(a / width_m - b / height_m);
    return FitRectangle{c, glm::normalize(sum + difference), glm::normalize(sum - difference), width_m, height_m};
}

std::optional<FitRectangle> refine(FitRectangle rectangle, std::span<const FitPoint> points, bool keep_size) {
    for (int step = 0; step < kMostSteps; ++step) {
        Equations e(points.size());
        for (const FitPoint& p : points) add_point(e, rectangle, p);
        const Eigen::Index unknowns = keep_size ? kUnknowns - 2 : kUnknowns;  // the sizes stand last
        const auto x = solve(e.rows.topLeftCorner(e.count, unknowns), e.values.head(e.count),
                             kLeastWeight * static_cast<double>(points.size()));
        if (!x) return std::nullopt;
        Unknowns change = Unknowns::Zero();
        change.head(unknowns) = *x;
        move(rectangle, change);
        if (change.cwiseAbs().maxCoeff() < 1e-12) break;
    }
    return rectangle;
}

}  // namespace burin::wall
