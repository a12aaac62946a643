// SPDX-License-Identifier: MIT
#include "picture/primitives.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <span>

#include "shaders/shared/octahedral.h"

namespace burin::picture {

namespace {

constexpr double kPi = std::numbers::pi;

struct ProfilePoint {
    double radius, along;                // of a solid of revolution
    double normal_radial, normal_along;  // any length
};

std::uint32_t code_of(const Vec3& normal) {
    constexpr double kLength = 1 << 20;
    const Vec3 n = glm::normalize(normal) * kLength;
    return shared::encode_normal({std::llround(n.x), std::llround(n.y), std::llround(n.z)});
}

class Builder {
public:
    std::uint32_t vertex(const Vec3& p, const Vec3& normal) {
        out_.vertices.push_back(
            {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z), code_of(normal), 0xffffffffu});
        return static_cast<std::uint32_t>(out_.vertices.size() - 1);
    }
    // Adds a quad, counter-clockwise seen from outside.
    void quad(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
        out_.indices.insert(out_.indices.end(), {a, b, c, a, c, d});
    }
    [[nodiscard]] std::uint32_t here() const { return static_cast<std::uint32_t>(out_.indices.size()); }
    [[nodiscard]] PrimitiveRange since(std::uint32_t first) const {
        Box bounds;
        for (std::uint32_t i = first; i < here(); ++i) {
            const shared::SurfaceVertex& v = out_.vertices[out_.indices[i]];
            bounds.include({v.x, v.y, v.z});
        }
        return {first, here() - first, bounds};
    }
    Primitives take() { return std::move(out_); }

private:
    Primitives out_;
};

// Revolves a profile, listed from the axis's lower end to its upper end, around +Y (or +Z).
PrimitiveRange turned(Builder& b, std::span<const ProfilePoint> profile, int segments, bool around_z) {
    const std::uint32_t first = b.here();
    std::vector<std::uint32_t> previous, current;
    for (const ProfilePoint& p : profile) {
        current.clear();
        for (int s = 0; s <= segments; ++s) {
            const double a = 2.0 * kPi * s / segments, c = std::cos(a), d = std::sin(a);
            const Vec3 around_y_point{p.radius * c, p.along, -p.radius * d};
            const Vec3 around_y_normal{p.normal_radial * c, p.normal_along, -p.normal_radial * d};
            const auto stand = [around_z](const Vec3& v) { return around_z ? Vec3{v.x, -v.z, v.y} : v; };
            current.push_back(b.vertex(stand(around_y_point), stand(around_y_normal)));
        }
        for (std::size_t s = 0; !previous.empty() && s + 1 < current.size(); ++s) {
            b.quad(previous[s], previous[s + 1], current[s + 1], current[s]);
        }
        previous = current;
    }
    return b.since(first);
}

PrimitiveRange ball(Builder& b, int rings) {
    std::vector<ProfilePoint> profile;
    for (int i = 0; i <= rings; ++i) {
        const double a = kPi * (static_cast<double>(i) / rings - 0.5);
        profile.push_back({std::cos(a), std::sin(a), std::cos(a), std::sin(a)});
    }
    return turned(b, profile, 2 * rings, false);
}

PrimitiveRange cube(Builder& b) {
    const std::uint32_t first = b.here();
    for (int axis = 0; axis < 3; ++axis) {
        for (const double side : {-1.0, 1.0}) {
            Vec3 n(0.0), u(0.0), v(0.0);
            n[axis] = side;
            u[(axis + 1) % 3] = side;  // u x v = n for both sides
            v[(axis + 2) % 3] = 1.0;
            // Small triangles: see backdrop.vert for what happens to those that cross the picture's edge.
            constexpr int kParts = 8;
            for (int i = 0; i < kParts; ++i) {
                for (int j = 0; j < kParts; ++j) {
                    const auto corner = [&](int di, int dj) {
                        const double along_u = 2.0 * (i + di) / kParts - 1.0, along_v = 2.0 * (j + dj) / kParts - 1.0;
                        return b.vertex(0.5 * (n + along_u * u + along_v * v), n);
                    };
                    const std::uint32_t p = corner(0, 0), q = corner(1, 0), r = corner(1, 1), s = corner(0, 1);
                    b.quad(p, q, r, s);
                }
            }
        }
    }
    return b.since(first);
}

// A pen: a thin neck at the ball, a grip, a slim shaft with a rounded end.
PrimitiveRange stylus(Builder& b) {
    std::vector<ProfilePoint> profile{{0.35, 0.0, 1.0, 0.0}, {0.38, 0.10, 1.0, -0.3}, {0.95, 0.22, 1.0, -0.6},
                                      {1.0, 0.26, 1.0, 0.0}, {0.92, 0.60, 1.0, 0.05}, {0.86, 0.97, 1.0, 0.1}};
    for (int i = 1; i <= 6; ++i) {
        const double a = 0.5 * kPi * i / 6;
        profile.push_back({0.86 * std::cos(a), 0.97 + 0.03 * std::sin(a), std::cos(a), std::sin(a)});
    }
    return turned(b, profile, 48, true);
}

PrimitiveRange rod(Builder& b) {
    constexpr int kRows = 8;  // small triangles: see plinth()
    std::vector<ProfilePoint> profile{{0.0, 0.0, 0.0, -1.0}, {1.0, 0.0, 0.0, -1.0}};
    for (int i = 0; i <= kRows; ++i) profile.push_back({1.0, static_cast<double>(i) / kRows, 1.0, 0.0});
    return turned(b, profile, 32, true);
}

PrimitiveRange cone(Builder& b) {
    return turned(b,
                  std::array<ProfilePoint, 4>{
                      {{0.0, 0.0, 0.0, -1.0}, {1.0, 0.0, 0.0, -1.0}, {1.0, 0.0, 1.0, 1.0}, {0.0, 1.0, 1.0, 1.0}}},
                  48, true);
}

PrimitiveRange ring(Builder& b) {
    constexpr int kAround = 16;  // segments around the ring's own cross-section
    std::vector<ProfilePoint> profile;
    for (int i = 0; i <= kAround; ++i) {
        const double a = 2.0 * kPi * i / kAround;
        profile.push_back({1.0 + kRingThickness * std::cos(a), kRingThickness * std::sin(a), std::cos(a), std::sin(a)});
    }
    return turned(b, profile, 64, true);
}

PrimitiveRange plinth(Builder& b) {
    constexpr double kRound = 0.03, kRoundHeight = 0.012;  // of the radius; of the height
    std::vector<ProfilePoint> profile;
    // Rows of small triangles: the picture's edge may cut the
    // side, and small triangles limit the damage of a clipped one.
    constexpr int kRows = 24;
    for (int i = 0; i <= kRows; ++i) profile.push_back({1.0, -1.0 + (1.0 - kRoundHeight) * i / kRows, 1.0, 0.0});
    for (int i = 1; i <= 8; ++i) {
        const double a = 0.5 * kPi * i / 8;
        profile.push_back(
            {1.0 - kRound + kRound * std::cos(a), kRoundHeight * (std::sin(a) - 1.0), std::cos(a), std::sin(a)});
    }
    profile.push_back({0.0, 0.0, 0.0, 1.0});
    return turned(b, profile, 128, false);
}

PrimitiveRange screen_quad(Builder& b) {
    const std::uint32_t first = b.here();
    const Vec3 n{0, 0, 1};
    const std::uint32_t a = b.vertex({-1, -1, 0}, n), c = b.vertex({1, -1, 0}, n);
    const std::uint32_t d = b.vertex({1, 1, 0}, n), e = b.vertex({-1, 1, 0}, n);
    b.quad(a, c, d, e);
    return b.since(first);
}

}  // namespace

Primitives make_primitives() {
    Builder b;
    std::array<PrimitiveRange, kBallRings.size()> balls;
    for (std::size_t i = 0; i < balls.size(); ++i) balls[i] = ball(b, kBallRings[i]);
    const PrimitiveRange cube_range = cube(b), stylus_range = stylus(b), rod_range = rod(b), cone_range = cone(b),
                         ring_range = ring(b), plinth_range = plinth(b), screen_range = screen_quad(b);
    Primitives out = b.take();
    out.balls = balls;
    out.cube = cube_range;
    out.stylus = stylus_range;
    out.rod = rod_range;
    out.cone = cone_range;
    out.ring = ring_range;
    out.plinth = plinth_range;
    out.screen_quad = screen_range;
    return out;
}

}  // namespace burin::picture
