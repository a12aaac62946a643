// SPDX-License-Identifier: MIT
// Shapes whose contact has a closed form, as LocalSurfaces ready to touch. Metres, object frame.
#pragma once

#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <numbers>
#include <utility>

#include "devices/haptic/haptic_device.hpp"
#include "geometry/contact/local_surface.hpp"

namespace burin::haptics::test {

// A device that limits nothing by itself, for ticks without a gate.
inline constexpr devices::DeviceDescription kStrongDevice{
    .name = "strong", .max_force_N = 100.0, .max_torque_Nm = Vec3(10.0), .max_stiffness_N_per_m = 1e6};

using Surface = std::unique_ptr<geometry::LocalSurface>;

// Collects triangles in any position and scale, then publishes them with everything known.
class SurfaceBuilder {
public:
    explicit SurfaceBuilder(Vec3 origin = Vec3(0.0)) : origin_(origin) {}

    std::uint32_t vertex(const Vec3& p_object) {
        piece_.positions_m.emplace_back(p_object - origin_);
        return static_cast<std::uint32_t>(piece_.positions_m.size() - 1);
    }
    void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) { piece_.triangles.push_back({a, b, c}); }
    void quad(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
        triangle(a, b, c);
        triangle(a, c, d);
    }
    void quad(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
        const std::uint32_t va = vertex(a), vb = vertex(b), vc = vertex(c), vd = vertex(d);
        quad(va, vb, vc, vd);
    }
    Surface finish(double known_radius_m = 1e3, std::uint64_t sequence = 1) {
        auto surface = std::make_unique<geometry::LocalSurface>();
        surface->sequence = sequence;
        surface->origin_object = origin_;
        surface->center_object = origin_;
        surface->radius_m = known_radius_m;
        geometry::build_search(piece_);
        surface->loose = std::make_shared<geometry::GriddedTriangles>(std::move(piece_));
        return surface;
    }

private:
    Vec3 origin_;
    geometry::GriddedTriangles piece_;
};

// height(x, z) over a square of side 2 half, n by n squares, material below.
inline Surface height_field(double half, int n, const std::function<double(double, double)>& height,
                            Vec3 origin = Vec3(0.0)) {
    SurfaceBuilder b(origin);
    const double s = 2.0 * half / n;
    for (int j = 0; j <= n; ++j)
        for (int i = 0; i <= n; ++i) {
            const double x = -half + i * s, z = -half + j * s;
            b.vertex({x, height(x, z), z});
        }
    const auto at = [&](int i, int j) { return static_cast<std::uint32_t>(j * (n + 1) + i); };
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) b.quad(at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j));
    return b.finish();
}

inline Surface plane(double half = 0.05, int n = 10, double y = 0.0) {
    return height_field(half, n, [y](double, double) { return y; });
}

// A closed box, outward.
inline Surface box(const Vec3& lo, const Vec3& hi, int n = 1) {
    SurfaceBuilder b;
    const auto face = [&](const Vec3& o, const Vec3& u, const Vec3& v) {  // u x v points outwards
        for (int j = 0; j < n; ++j)
            for (int i = 0; i < n; ++i) {
                const Vec3 p = o + u * (double(i) / n) + v * (double(j) / n);
                b.quad(p, p + u / double(n), p + u / double(n) + v / double(n), p + v / double(n));
            }
    };
    const Vec3 d = hi - lo, x{d.x, 0, 0}, y{0, d.y, 0}, z{0, 0, d.z};
    face(lo, y, x), face(lo, z, y), face(lo, x, z);
    face(hi, -y, -z), face(hi, -z, -x), face(hi, -x, -y);
    return b.finish();
}

// Icosahedron subdivided `times` times, vertices on the sphere.
inline Surface sphere(double radius, int times, const Vec3& center = Vec3(0.0)) {
    SurfaceBuilder b(center);
    std::vector<Vec3> v;
    std::vector<std::array<std::uint32_t, 3>> f;
    const double g = std::numbers::phi;
    for (const double s : {-1.0, 1.0})
        for (const double t : {-g, g}) v.insert(v.end(), {{0, s, t}, {s, t, 0}, {t, 0, s}});
    for (std::uint32_t i = 0; i < 12; ++i)
        for (std::uint32_t j = i + 1; j < 12; ++j)
            for (std::uint32_t k = j + 1; k < 12; ++k) {
                const auto edge = [&](std::uint32_t a, std::uint32_t c) {
                    return std::abs(glm::length(v[a] - v[c]) - 2.0) < 1e-9;
                };
                if (!edge(i, j) || !edge(j, k) || !edge(k, i)) continue;
                const bool out = glm::dot(glm::cross(v[j] - v[i], v[k] - v[i]), v[i]) > 0;
                f.push_back(out ? std::array{i, j, k} : std::array{i, k, j});
            }
    for (int s = 0; s < times; ++s) {
        std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
        const auto middle = [&](std::uint32_t a, std::uint32_t c) {
            const auto key = std::minmax(a, c);
            if (const auto at = middles.find(key); at != middles.end()) return at->second;
            v.push_back(0.5 * (v[a] + v[c]));
            v.back() = glm::normalize(v.back()) * glm::length(v[0]);
            return middles[key] = static_cast<std::uint32_t>(v.size() - 1);
        };
        std::vector<std::array<std::uint32_t, 3>> finer;
        for (const auto& [a, c, e] : f) {
            const auto ac = middle(a, c), ce = middle(c, e), ea = middle(e, a);
            finer.insert(finer.end(), {{a, ac, ea}, {ac, c, ce}, {ea, ce, e}, {ac, ce, ea}});
        }
        f = std::move(finer);
    }
    for (const Vec3& p : v) b.vertex(center + radius * glm::normalize(p));
    for (const auto& [a, c, e] : f) b.triangle(a, c, e);
    return b.finish();
}

// A groove along z in the plane y = 0, its bottom a half circle of this radius: what a ball of this radius carves, with
// facets whose corners lie on the circle, give or take `noise` metres (a fixed pattern).
inline Surface groove(double radius, double length, int facets, int slices, double noise) {
    SurfaceBuilder b;
    auto jitter = [noise, k = 1u]() mutable {
        k = k * 1664525u + 1013904223u;
        return noise * (static_cast<double>(k >> 8) / double(1u << 23) - 1.0);
    };
    const double out = 3.0 * radius;
    const int n = facets + 2;  // one flat strip each side
    for (int j = 0; j <= slices; ++j) {
        const double z = length * (double(j) / slices - 0.5);
        b.vertex({-out, 0, z});
        for (int i = 0; i <= facets; ++i) {
            const double angle = std::numbers::pi * i / facets;
            b.vertex({-(radius + jitter()) * std::cos(angle), -(radius + jitter()) * std::sin(angle), z});
        }
        b.vertex({out, 0, z});
    }
    const auto at = [&](int i, int j) { return static_cast<std::uint32_t>(j * (n + 1) + i); };
    for (int j = 0; j < slices; ++j)
        for (int i = 0; i < n; ++i) b.quad(at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j));
    return b.finish();
}

}  // namespace burin::haptics::test
