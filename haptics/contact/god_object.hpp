// SPDX-License-Identifier: MIT
// The god-object (proxy) of a ball on a triangle surface: it follows the haptic interface point (HIP) as far as the
// surface lets it, never through.
//
// After Zilles and Salisbury 1995 (the proxy is the point nearest to the HIP under up to three active planes) and
// Ruspini et al. 1997 (a proxy with a radius, moved by sweeps until nothing more is gained). A tick first runs a broad
// phase, once, for the triangles that its motion can reach (candidates.hpp), and repeats it only where the proxy goes
// elsewhere. Then, in each step:
//   1. Every triangle that the ball touches gives a plane through the ball's nearest point of it (touching.hpp). A ball
//      that stays in the half-space beyond that plane cannot enter the triangle, because a triangle is convex.
//   2. The goal is the point nearest to the HIP in all these half-spaces (half_spaces.hpp). At most three planes bear
//      it; these are the active ones. Shading turns them to the smooth surface's normals (shading.hpp), friction holds
//      the ball back as it slides along them (friction.hpp), and the true planes still keep it out.
//   3. The ball is swept towards the goal against all other triangles and stops at the first, which joins the contact
//      set in the next step. Only the outer side of a triangle is felt, so the material must be closed where the
//      surface is known; of a two-sided sheet it is the side on which the ball is.
//
// Rest: planes alone never take the ball away from the HIP, so that it comes to a stand. Shading may, and so may the
// longer steps that the ball takes around edges. Each step that does not bring it nearer spends leeway, which only the
// hand's motion gives and which fades; so a hand that holds still has a proxy that holds still.
//
// A ball much larger than the triangles around it touches their vertices alone (geometry/contact/surface_points.hpp),
// within kFineEdge^2 / 6 of the radius (touching.hpp).
//
// Tolerances are fractions of the ball's radius R, so that millimetres and metres behave alike (kTouch in
// touching.hpp): a triangle counts as touched within 1e-3 R; an edge or corner may sink in by as much, which lets the
// ball roll over the edge between two level facets instead of stopping at the edge's tilted plane; sweeps stop 2e-3 R
// deep, so that what the ball slides along is not hit again. A point probe is a ball of 1/500 of the mean edge.
//
// A proxy that is found inside material (after an edit, at a first contact) is put outside by the shortest
// displacement, and out of what the ball meets there, for some ticks if need be, and then at places around the hand
// (setting.hpp); until the ball fits there is no contact, so a ball that fits nowhere goes out along the hand's way
// without force. The gate fades in the force that follows. Frame: object, metres. No heap, lock, throw; the work is
// counted and bounded (contact_work.hpp).
#pragma once

#include <cstdint>

#include "geometry/contact/posed_surface.hpp"
#include "haptics/contact/contact_work.hpp"

namespace burin::haptics {

struct ProxyState {
    Vec3 position_object_m{0.0};
    std::uint64_t surface_sequence = 0;  // of the surface used in the last tick
    bool placed = false;                 // false: the next tick starts from the HIP
    bool slipping = false;               // with friction: it slid in the last tick
    // Whether the proxy was held off the HIP in the last tick, and its motion along the surface then. They serve only
    // as the first guess of the broad phase.
    bool touching = false;
    Vec3 motion_object_m{0.0};
    Vec3 hip_object_m{0.0};     // of the last tick
    double leeway_m = 0.0;      // what shading may still spend on moving the proxy away from the HIP
    double step_share = 1.0;    // of the last step under shading or around an edge
    std::uint64_t carrier = 0;  // the moving body that it touched in the last tick (moving_bodies.hpp); 0: none
    std::uint32_t stride = 1;   // among very many vertices only each so manieth is touched
    // Above 0: the ball, set here from inside material, overlaps it still after so many ticks; there is no contact.
    std::uint32_t unfit_ticks = 0;
    // Of a ball that fits nowhere near the hand yet: how far from it it was put, and places tried since (setting.hpp).
    double put_off_m = 0.0;
    std::uint32_t places_tried = 0;
};

struct ProxySettings {
    double contact_radius_m = 0.0;  // radius of the ball; 0 is a point
    // Force shading: where the surface is smooth the proxy moves on the surface that the facets' corner normals
    // describe, so that the force does not jump from facet to facet. Sharp edges stay sharp.
    bool shading = true;
    // Coulomb friction by the proxy (Salisbury, Brock, Massie et al. 1995; Harwin and Melder 2002): the proxy stays
    // until the HIP leaves the friction cone, then slides until the HIP lies on the cone of dynamic friction again.
    double static_friction = 0.0;
    double dynamic_friction = 0.0;
};

struct ProxyResult {
    ProxyState next;
    std::uint32_t active_triangle = 0xffffffffu;  // the one that bears most of the contact; none in free space
    Vec3 normal_object{0.0};                      // unit, of the contact, shaded; zero in free space
    bool sticking = false;                        // held by friction
    std::uint32_t constraints = 0;                // active planes, 0 to 3
    bool pushed_out = false;
    bool work_limited = false;
    bool coarse = false;  // the work did not suffice for the whole way at once, or for each triangle and vertex
    ContactWork work;
};

struct ProxyBudget {
    std::uint32_t max_steps = 12;
    // When it is used up the proxy waits at a safe position and continues in the next tick, for example when a tool is
    // torn out of a deep groove. A third of a period of 1 ms.
    double max_cost_ns = 333e3;
};

// Moves the proxy towards the HIP for one tick. Requires finite, non-negative settings, dynamic friction at most static
// friction, and finite positions. Reads, but does not change, what the surface refers to
// (geometry/contact/local_surface.hpp).
[[nodiscard]] ProxyResult move_proxy(const ProxyState& state, const Vec3& hip_object_m, const ProxySettings& settings,
                                     const geometry::PosedSurface& surface, const ProxyBudget& budget = {}) noexcept;

}  // namespace burin::haptics
