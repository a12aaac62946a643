// SPDX-License-Identifier: MIT
// A ball's flight and its bounces in closed form, event by event: no step, so nothing is gained or lost by one, and
// nothing is passed through however fast it is.
//
//   arc: a parabola of the ball's middle -> the first contact with an obstacle -> bounce -> the next arc ...
// A bounce keeps `restitution` of the speed against the surface, so a ball comes back to e^2 of the height that it fell
// from, and `tangential_kept` of that along it. Where it would rise by less than some hundredths of a millimetre it
// stays and rolls: endless bounces in a finite time (Zeno) do not come about. It rolls straight and slows down evenly,
// or down a slope without loss, and falls where the top of a box ends.
// A ball against a plane or the face of a box is a quadratic in time; against a box' edge or corner a quartic. A box is
// met as a round body meets it: at the distance of the ball's radius from it.
// Hardest cases: a corner (two contacts at one time), a wedge or a gap that the ball hardly fits in, where bounces
// crowd: after kMostBounces of one call it stands still. A ball that rolls off an edge: each touch of an edge or a
// corner throws it off by at least kLeastOffEdge_m_per_s.
// Units: SI. Frame: the scene's; any, in which the obstacles rest. Pure and deterministic; any thread. Allocates.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <variant>
#include <vector>

#include "base/space.hpp"

namespace burin::bodies {

// All below a plane: normal . p <= offset. The normal is of length 1.
struct HalfSpace {
    Vec3 normal{0.0, 1.0, 0.0};
    double offset_m = 0.0;
};
using Obstacle = std::variant<HalfSpace, Box>;

struct FlightRoom {
    Vec3 gravity_m_per_s2{0.0, -9.81, 0.0};
    double radius_m = 0.03;
    double restitution = 0.75;      // 0 to 1: speed against the surface behind a bounce over that before
    double tangential_kept = 1.0;   // 0 to 1: the share of the speed along the surface that a bounce leaves
    double rolling_m_per_s2 = 0.3;  // 0 or more: by which a ball that rolls slows down
    std::vector<Obstacle> obstacles;
};

// What a ball rests or rolls on.
struct Support {
    std::uint32_t obstacle = 0;
    Vec3 normal{0.0};
    bool operator==(const Support&) const = default;
};

struct FlyingBall {
    Vec3 place_m{0.0}, velocity_m_per_s{0.0};  // of its middle
    std::optional<Support> support;            // none: it flies

    [[nodiscard]] bool rests() const { return support && velocity_m_per_s == Vec3(0.0); }
    bool operator==(const FlyingBall&) const = default;
};

// A part of its way without an event.
struct Arc {
    double begin_s = 0.0, length_s = 0.0;  // since the beginning of the flight that was asked for
    Vec3 place_m{0.0}, velocity_m_per_s{0.0}, acceleration_m_per_s2{0.0};

    [[nodiscard]] Vec3 place_at(double since_begin_s) const {
        const double t = since_begin_s - begin_s;
        return place_m + t * velocity_m_per_s + 0.5 * t * t * acceleration_m_per_s2;
    }
};

struct Bounce {
    double at_s = 0.0;
    std::uint32_t obstacle = 0;
    Vec3 place_m{0.0};           // of the ball's middle
    Vec3 normal{0.0};            // out of the obstacle
    double speed_m_per_s = 0.0;  // against the surface, before
    bool operator==(const Bounce&) const = default;
};

struct Flight {
    FlyingBall ball;  // at its end
    std::vector<Arc> arcs;
    std::vector<Bounce> bounces;
};

inline constexpr std::size_t kMostBounces = 64;
inline constexpr double kLeastBounce_m_per_s = 0.02, kLeastOffEdge_m_per_s = 0.01;

// Returns the flight of a time. A ball that is in an obstacle begins at the nearest place outside it. Requires finite
// figures, a time of 0 or more, and a room as its fields say.
[[nodiscard]] Flight flight_of(const FlyingBall& ball, const FlightRoom& room, double time_s);

// Returns when a flight first comes within a distance of a point that moves evenly and is at at_m when the flight
// begins; nothing where it does not.
[[nodiscard]] std::optional<double> first_within(std::span<const Arc> arcs, const Vec3& at_m,
                                                 const Vec3& velocity_m_per_s, double distance_m);

// Returns the nearest place at which the ball is in no obstacle; its own where it is in none.
[[nodiscard]] Vec3 outside(const FlightRoom& room, const Vec3& place_m);

// Returns how far the ball's surface is from an obstacle; below 0 in it.
[[nodiscard]] double clearance_m(const Obstacle& obstacle, const Vec3& place_m, double radius_m);

}  // namespace burin::bodies
