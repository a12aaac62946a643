// SPDX-License-Identifier: MIT
// Bakes the light that reaches the vertices of a tile of a carved surface: how much of the lamp each vertex sees past
// the workpiece itself (sun), and how open its surroundings are (open). For a renderer that lights at vertex rate and
// has no shadow map.
//
// Sun and openness come from cones. A cone is a ray that steps through the clearance of the solid (clearance.hpp) and
// measures how closely it passes material: material nearer to the ray than the cone's width at that distance blocks a
// share of the cone, all of it where the ray itself runs into material. So a vertex that moves a little sees a little
// more or less, and few cones suffice without visible steps. The width never exceeds the height above the vertex's own
// tangent plane, so no part of a convex body ever blocks a cone: its vertices have exactly full light (clearance.hpp
// gives the reason).
//   sun   seven cones that cover the lamp's disc: the centre, and six around it at two thirds of its radius, each of a
//         third of the radius; each is weighted by how far it stands above the vertex's own horizon
//   open  the cones of kOpenDirections even directions over the whole sphere, as far as they stand above the vertex's
//         tangent plane, weighted by the cosine to its normal; material at a distance t counts
//         (1 - (t / kOpenRange)^2)^2
// Frames: the object frame relative to the lattice's origin, in cells. Threads: any number at once.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "compute/light/clearance.hpp"
#include "compute/light/lamp.hpp"
#include "geometry/contact/surface_tile.hpp"

namespace burin::compute {

// The light of the vertices of a SurfaceTile, in their order. Never changes once it is shared.
struct TileLight {
    std::vector<geometry::VertexLight> vertices;
};

inline constexpr int kOpenDirections = 28;
inline constexpr float kOpenRange = 24.0f;  // cells

// Returns the weight with which material at a distance (in cells) counts against openness.
[[nodiscard]] inline float open_fade(float distance) {
    const float x = distance * (1.0f / kOpenRange), rest = 1.0f - x * x;
    return distance < kOpenRange ? rest * rest : 0.0f;
}

void bake_open(const Clearance& clearance, const Lattice& lattice, const geometry::SurfaceTile& tile,
               std::span<geometry::VertexLight> light);
void bake_sun(const Clearance& clearance, const Lattice& lattice, const geometry::SurfaceTile& tile, const Lamp& lamp,
              std::span<geometry::VertexLight> light);

}  // namespace burin::compute
