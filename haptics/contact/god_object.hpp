// SPDX-License-Identifier: MIT
// The god-object (proxy) of a ball on a triangle surface: it follows the haptic interface point (HIP) as far as the
// surface lets it, never through.
//
// After Zilles and Salisbury 1995 (the proxy is the point nearest to the HIP under up to three active planes) and
// Ruspini et al. 1997 (a proxy with a radius, moved by sweeps until nothing more is gained). A tick first gathers, once, the triangles
// that its motion can reach (candidates.hpp), and looks again only where the proxy goes elsewhere. Each step then:
//   1. Every triangle that the ball touches gives a plane through the ball's nearest point of it (touching.hpp). The half-space
//      beyond that plane keeps the ball off the triangle wherever it goes in it, because a triangle is convex.
//   2. The goal is the point nearest to the HIP in all these half-spaces (half_spaces.hpp); at most three planes bear it, and
//      those are the active ones. Shading turns these to the smooth surface's normals (shading.hpp), friction holds the ball
//      back on its way along them (friction.hpp), and the true planes keep it out all the same.
//   3. The ball is swept towards the goal against all other triangles and stops at the first; that one joins in the
//      next step. Without shading the distance to the HIP never grows, and steps stop when the ball stands still. Only the
//      outer side of a triangle is felt, so the material must be closed where the surface is known.
//
// Tolerances are fractions of the ball's radius, so that millimetres and metres behave alike (kTouch in touching.hpp): a triangle
// counts as touched within 1e-3 R; an edge or corner may sink in by as much, which lets the ball roll over the edge
// between two level facets instead of stopping at the edge's tilted plane; sweeps stop 2e-3 R deep, so that what is
// slid along is not hit again. A point probe is a ball of 1/500 of the mean edge.
//
// A proxy that finds itself inside material (an edit, a first contact) is put outside the nearest way; the force that
// follows is the gate's to fade in. Frame: object, metres. No heap, lock, throw; steps and triangles are bounded and
// counted.
#pragma once

#include <cstdint>

#include "geometry/local_surface.hpp"

namespace burin {

struct ProxyState {
    Vec3 position_object_m{0.0};
    std::uint64_t surface_sequence = 0;  // of the surface used last
    bool placed = false;                 // false: the next tick starts from the HIP
    bool slipping = false;               // with friction: it slid in the tick before
    // In the tick before it was held back from the HIP, and moved so far along the surface: where to look first, and nothing else.
    bool touching = false;
    Vec3 motion_object_m{0.0};
};

struct ProxySettings {
    double contact_radius_m = 0.0;  // of the ball; 0 is a point
    // Force shading: where the surface is smooth the proxy moves as if the facets were the surface that their corners' normals
    // describe, so that the force does not jump from facet to facet. Sharp edges stay sharp.
    bool shading = true;
    // Coulomb friction by the proxy (Salisbury, Brock, Massie et al. 1995; Harwin and Melder 2002): it stays until the HIP
    // leaves the friction cone, then slides until the HIP lies on the cone of dynamic friction again.
    double static_friction = 0.0;
    double dynamic_friction = 0.0;
};

struct ProxyWork {
    std::uint32_t triangles_tested = 0;
    std::uint32_t triangles_seen = 0;  // looked at by their bounding box or ball; a quad is one
    std::uint32_t steps = 0;
    std::uint32_t plane_solves = 0;
};

struct ProxyResult {
    ProxyState next;
    std::uint32_t active_triangle = 0xffffffffu;  // bears most of the contact; none in free space
    Vec3 normal_object{0.0};                      // unit, of the contact, shaded; zero in free space
    bool sticking = false;                        // held by friction
    std::uint32_t constraints = 0;                // active planes, 0 to 3
    bool pushed_out = false;
    bool work_limited = false;
    ProxyWork work;
};

struct ProxyBudget {
    std::uint32_t max_steps = 12;
    // Exact distance and sweep computations a tick, about 0.2 us each with all that goes with them. When used up the proxy waits
    // where it is safe, and goes on in the next tick: a tool torn out of a deep groove by force, say.
    std::uint32_t max_triangles_tested = 4000;
    // Bounding boxes looked at a tick, about 10 ns each: a large tool on a fine lattice has many. Likewise.
    std::uint32_t max_triangles_seen = 60000;
};

// All settings finite and not negative, dynamic friction at most static friction, positions finite. Only reads through the
// surface's references (geometry/local_surface.hpp).
[[nodiscard]] ProxyResult move_proxy(const ProxyState& state, const Vec3& hip_object_m, const ProxySettings& settings,
                                     const LocalSurface& surface, const ProxyBudget& budget = {}) noexcept;

}  // namespace burin
