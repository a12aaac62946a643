// SPDX-License-Identifier: MIT
// The piece of surface near the tool that the carving side publishes to the haptic thread, and that the tick touches.
//
// Data flow: after each update the carving side fills a LocalSurface (the draft of a NewestSlot) and publishes it; the tick
// borrows the newest one. Plain data of fixed capacity: filling it never allocates, borrowing it never copies.
// Positions are float, in metres, relative to origin_object, so that they keep 1e-7 of the neighbourhood's size however
// far it lies from the object's origin. A triangle winds counter-clockwise seen from outside the material.
// Outside the ball (center_object, radius_m) nothing is known: a tick whose tool leaves it must say so (stale surface).
#pragma once

#include <array>
#include <cstdint>

#include "base/clock.hpp"
#include "base/space.hpp"

namespace burin {

struct LocalSurface {
    static constexpr std::uint32_t kMaxVertices = 32768;
    static constexpr std::uint32_t kMaxTriangles = 65536;

    std::uint64_t sequence = 0;   // 0: never published; a tick record names the surface it used
    Nanoseconds made_ns = 0;      // when the carving side published it
    Vec3 origin_object{0.0};      // what the float positions are relative to
    Vec3 center_object{0.0};      // the ball within which the surface is complete
    double radius_m = 0.0;
    std::uint32_t vertex_count = 0;
    std::uint32_t triangle_count = 0;
    std::uint32_t dropped_triangles = 0;  // did not fit; then radius_m has been reduced so that the ball is still complete
    std::array<Vec3f, kMaxVertices> positions_m;
    std::array<std::array<std::uint32_t, 3>, kMaxTriangles> triangles;
};

}  // namespace burin
