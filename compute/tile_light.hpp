// SPDX-License-Identifier: MIT
// The light that reaches the vertices of a tile of a carved surface: how much of the lamp each sees past the workpiece itself,
// and how open it lies to its surroundings. For a renderer that lights at vertex rate and has no shadow map.
//
// Both are made of cones. A cone is a ray that steps through the clearance of the solid (clearance.hpp) and sees how closely it
// passes material: what comes nearer to it than its width at that distance takes a share of it, all of it where the ray itself
// runs into material. So a vertex that moves by a little sees a little more or less: few cones make no steps. Width is never
// more than the height above the vertex' own tangent plane, by which nothing of a convex body is ever seen in a cone's way:
// its vertices have exactly all the light there is (clearance.hpp says why).
//   sun   seven cones that cover the lamp's disc: the middle, and six around it at two thirds of its radius, each of a third of
//         the radius; each counts by how far it stands above the vertex' own horizon
//   open  the cones of kOpenDirections even directions about the whole sphere, as far as they stand above the vertex' tangent
//         plane, weighted by the cosine to its normal; material at a distance t counts (1 - (t / kOpenRange)^2)^2
// Frames: the object frame relative to the lattice's origin, counted in cells. Threads: any number at once.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "compute/clearance.hpp"
#include "geometry/surface_tile.hpp"
#include "geometry/vertex_light.hpp"

namespace burin {

// Of the vertices of a SurfaceTile, in their order. Never changes once others see it.
struct TileLight {
    std::vector<VertexLight> vertices;
};

inline constexpr int kOpenDirections = 28;
inline constexpr float kOpenRange = 24.0f;  // cells

// Share of what lies at a distance (in cells) that counts against openness.
[[nodiscard]] inline float open_fade(float distance) {
    const float x = distance * (1.0f / kOpenRange), rest = 1.0f - x * x;
    return distance < kOpenRange ? rest * rest : 0.0f;
}

// A disc far away.
struct Lamp {
    Vec3 direction_object{0.0, 1.0, 0.0};  // towards it; of any length above zero
    double tangent = 0.05;                 // of half the angle that it takes, 0.002 to 0.5
    bool operator==(const Lamp&) const = default;
};

void bake_open(const Clearance& clearance, const Lattice& lattice, const SurfaceTile& tile,
               std::span<VertexLight> light);
void bake_sun(const Clearance& clearance, const Lattice& lattice, const SurfaceTile& tile, const Lamp& lamp,
              std::span<VertexLight> light);

}  // namespace burin
