// SPDX-License-Identifier: MIT
#include "bench/measure/bumpy_sphere.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <unordered_map>

namespace burin::bench {
namespace {

constexpr double kBendOfPath = 0.31;  // radians that the path turns for each radian that it advances

// Returns the Hessian, by central differences of the gradient.
glm::dmat3 curvature(const BumpySphere& shape, const Vec3& p) {
    const double h = 1e-5 * shape.radius_m;
    glm::dmat3 hessian(0.0);
    for (int k = 0; k < 3; ++k) {
        Vec3 step(0.0);
        step[k] = h;
        hessian[k] = (shape.gradient(p + step) - shape.gradient(p - step)) / (2.0 * h);
    }
    return hessian;
}

}  // namespace

double BumpySphere::radius_at_m(const Vec3& n) const {
    return radius_m * (1.0 + bumps * std::sin(waves * n.x) * std::sin(waves * n.y) * std::sin(waves * n.z));
}

double BumpySphere::value_m(const Vec3& p) const {
    const double length = glm::length(p);
    return length - radius_at_m(p / length);
}

Vec3 BumpySphere::gradient(const Vec3& p) const {
    const double length = glm::length(p);
    const Vec3 n = p / length, sine = glm::sin(waves * n), cosine = glm::cos(waves * n);
    const Vec3 by_n = radius_m * bumps * waves *
                      Vec3(cosine.x * sine.y * sine.z, sine.x * cosine.y * sine.z, sine.x * sine.y * cosine.z);
    return n - (by_n - glm::dot(by_n, n) * n) / length;  // n changes by (1 - n n^T) / |p| for each step of p
}

double BumpySphere::distance_m(const Vec3& p) const { return value_m(p) / glm::length(gradient(p)); }

// Solves x - from + l g(x) = 0 and f(x) = 0. With A = 1 + l H, a step
// is dx = -A^-1 (x - from + l g + dl g), where dl makes f + g dx zero.
BumpySphere::Nearest BumpySphere::nearest(const Vec3& from, const Vec3& begin) const {
    Vec3 x = begin;
    const Vec3 g0 = gradient(x);
    double l = glm::dot(from - x, g0) / glm::dot(g0, g0);
    for (int i = 0; i < 30; ++i) {
        const Vec3 g = gradient(x);
        const double f = value_m(x);
        const Vec3 residual = x - from + l * g;
        if (glm::length(residual) < 1e-11 * radius_m && std::abs(f) < 1e-12 * radius_m) return {x, true};
        const glm::dmat3 inverse = glm::inverse(glm::dmat3(1.0) + l * curvature(*this, x));
        const double dl = (f - glm::dot(g, inverse * residual)) / glm::dot(g, inverse * g);
        x -= inverse * (residual + dl * g);
        l += dl;
    }
    return {x, false};
}

geometry::TriangleMesh mesh_of(const BumpySphere& shape, int n) {
    geometry::TriangleMesh mesh;
    // Vertices by their position on the cube, counted in squares.
    std::unordered_map<std::uint64_t, std::uint32_t> vertex_of;
    const auto vertex = [&](const std::array<int, 3>& at) {
        const auto side = static_cast<std::uint64_t>(n) + 1;
        const std::uint64_t key =
            (static_cast<std::uint64_t>(at[0]) * side + static_cast<std::uint64_t>(at[1])) * side +
            static_cast<std::uint64_t>(at[2]);
        const auto [known, is_new] = vertex_of.try_emplace(key, static_cast<std::uint32_t>(mesh.positions_m.size()));
        if (is_new) {
            const auto place = [&](int i) { return std::tan((2.0 * i / n - 1.0) * std::numbers::pi / 4.0); };
            const Vec3 direction = glm::normalize(Vec3(place(at[0]), place(at[1]), place(at[2])));
            mesh.positions_m.push_back(shape.radius_at_m(direction) * direction);
        }
        return known->second;
    };
    for (std::size_t axis = 0; axis < 3; ++axis)
        for (const int end : {0, n})
            for (int j = 0; j < n; ++j)
                for (int i = 0; i < n; ++i) {
                    const auto corner = [&](int u, int v) {
                        std::array<int, 3> at{};
                        at[axis] = end, at[(axis + 1) % 3] = u, at[(axis + 2) % 3] = end > 0 ? v : n - v;
                        return vertex(at);
                    };
                    const std::uint32_t a = corner(i, j), b = corner(i + 1, j), c = corner(i + 1, j + 1),
                                        d = corner(i, j + 1);
                    mesh.triangles.push_back({a, b, c});
                    mesh.triangles.push_back({a, c, d});
                }
    return mesh;
}

int squares_for(std::size_t triangles) {
    return std::max(1, static_cast<int>(std::lround(std::sqrt(static_cast<double>(triangles) / 12.0))));
}

void SphereWalk::step(double angle) {
    const Vec3 across = glm::cross(along_, outward_);
    along_ = glm::normalize(std::cos(kBendOfPath * angle) * along_ + std::sin(kBendOfPath * angle) * across);
    const Vec3 on = glm::normalize(std::cos(angle) * outward_ + std::sin(angle) * along_);
    along_ = glm::normalize(along_ - glm::dot(along_, on) * on);
    outward_ = on;
}

Quat SphereWalk::orientation() const {
    return glm::normalize(glm::quat_cast(glm::dmat3(along_, outward_, glm::cross(along_, outward_))));
}

}  // namespace burin::bench
