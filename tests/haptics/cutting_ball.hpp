// SPDX-License-Identifier: MIT
// A ball as a cutting tool, and the closed form of what it meets in a plane.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include "toolbox/tool_samples.hpp"

namespace burin::haptics::test {

// An icosahedron whose faces are divided in four several times, on the sphere.
inline geometry::TriangleMesh ball_mesh(double radius_m, int divisions = 4) {
    geometry::TriangleMesh mesh;
    const double phi = 0.5 * (1.0 + std::sqrt(5.0));
    for (const double a : {-1.0, 1.0})
        for (const double b : {-phi, phi})
            for (const Vec3& p : {Vec3(0, a, b), Vec3(a, b, 0), Vec3(b, 0, a)}) mesh.positions_m.push_back(p);
    const auto near = [&](std::uint32_t i, std::uint32_t j) {
        return glm::length(mesh.positions_m[i] - mesh.positions_m[j]) < 2.1;
    };
    for (std::uint32_t i = 0; i < 12; ++i)
        for (std::uint32_t j = i + 1; j < 12; ++j)
            for (std::uint32_t k = j + 1; k < 12; ++k) {
                if (!near(i, j) || !near(j, k) || !near(i, k)) continue;
                const auto &a = mesh.positions_m[i], &b = mesh.positions_m[j], &c = mesh.positions_m[k];
                const bool out = glm::dot(glm::cross(b - a, c - a), a) > 0.0;
                mesh.triangles.push_back(out ? std::array{i, j, k} : std::array{i, k, j});
            }
    for (int division = 0; division < divisions; ++division) {
        std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
        const auto middle = [&](std::uint32_t i, std::uint32_t j) {
            const auto [at, is_new] =
                middles.try_emplace(std::minmax(i, j), static_cast<std::uint32_t>(mesh.positions_m.size()));
            if (is_new) mesh.positions_m.push_back(mesh.positions_m[i] + mesh.positions_m[j]);
            return at->second;
        };
        std::vector<std::array<std::uint32_t, 3>> finer;
        for (const auto& [a, b, c] : mesh.triangles) {
            const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
            for (const auto& t : {std::array{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}}) finer.push_back(t);
        }
        mesh.triangles = std::move(finer);
        for (Vec3& p : mesh.positions_m) p *= radius_m / glm::length(p);
    }
    return mesh;
}

inline ToolSurface ball_tool(double radius_m) { return toolbox::tool_surface(ball_mesh(radius_m), radius_m); }

// What of a ball of radius R at depth d in a plane is engaged, x = d / R <= 1: integrals over the cap, n into the
// material, t across it, with m the ball's normal. Across and lift are of its front half.
struct EngagedAreas {
    double into_m2 = 0.0;     // of m_n^2: 2 pi R^2 (x - x^2 + x^3 / 3)
    double across_m2 = 0.0;   // of m_t^2: pi / 2 R^2 (x^2 - x^3 / 3)
    double lift_m2 = 0.0;     // of m_n m_t: 2/3 R^2 (x (2 - x))^(3/2)
    double section_m2 = 0.0;  // of m_n over the whole cap: pi R^2 x (2 - x)
};
inline EngagedAreas engaged_areas(double radius_m, double depth_m) {
    const double x = std::clamp(depth_m / radius_m, 0.0, 1.0), rim = x * (2.0 - x), R2 = radius_m * radius_m;
    return {2.0 * std::numbers::pi * R2 * x * (1.0 - x + x * x / 3.0),
            0.5 * std::numbers::pi * R2 * x * x * (1.0 - x / 3.0), 2.0 / 3.0 * R2 * rim * std::sqrt(rim),
            std::numbers::pi * R2 * rim};
}

}  // namespace burin::haptics::test
