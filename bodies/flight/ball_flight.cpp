// SPDX-License-Identifier: MIT
#include "bodies/flight/ball_flight.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "bodies/flight/falling_roots.hpp"

namespace burin::bodies {
namespace {

// Where faces, edges and corners of a box meet, rounding may put a place on the far side of either.
constexpr double kSeam_m = 1e-10;
constexpr double kInside_m = 1e-9;  // deeper is no rounding, but a ball that was put there
constexpr double kEndless_s = std::numeric_limits<double>::infinity();

struct Contact {
    double at_s = kEndless_s;
    std::uint32_t obstacle = 0;
    Vec3 normal{0.0};
    bool is_flat = true;  // a plane or a face; otherwise an edge or a corner
};

// A coordinate of the middle over the time, less a constant.
Quartic along(const Arc& arc, int axis, double less) {
    return {arc.place_m[axis] - less, arc.velocity_m_per_s[axis], 0.5 * arc.acceleration_m_per_s2[axis], 0.0, 0.0};
}

Quartic square(const Quartic& f) {  // of a quadratic
    return {f[0] * f[0], 2.0 * f[0] * f[1], f[1] * f[1] + 2.0 * f[0] * f[2], 2.0 * f[1] * f[2], f[2] * f[2]};
}

Quartic sum(const Quartic& a, const Quartic& b) {
    Quartic s{};
    for (std::size_t i = 0; i < s.size(); ++i) s[i] = a[i] + b[i];
    return s;
}

Quartic negative(Quartic f) {
    for (double& c : f) c = -c;
    return f;
}

Vec3 place_in(const Arc& arc, double t) { return arc.place_at(arc.begin_s + t); }

Contact contact_with(const HalfSpace& plane, const Arc& arc, double radius_m) {
    const Quartic height{glm::dot(plane.normal, arc.place_m) - plane.offset_m - radius_m,
                         glm::dot(plane.normal, arc.velocity_m_per_s),
                         0.5 * glm::dot(plane.normal, arc.acceleration_m_per_s2), 0.0, 0.0};
    const FallingRoots roots = falling_roots(height, arc.length_s);
    if (roots.count == 0) return {};
    return {roots.times[0], 0, plane.normal, true};
}

// Which side of the box each coordinate lies on: -1, 0 within, 1. A piece of its surface is where they are (a face
// has one that is not 0, an edge two, a corner three).
using Sides = std::array<int, 3>;

bool lies_over(const Box& box, const Sides& sides, const Vec3& place) {
    for (int axis = 0; axis < 3; ++axis) {
        const int side = sides[static_cast<std::size_t>(axis)];
        const double below = box.lo[axis] - place[axis], above = place[axis] - box.hi[axis];
        if (side < 0 ? below < -kSeam_m : side > 0 ? above < -kSeam_m : std::max(below, above) > kSeam_m) return false;
    }
    return true;
}

Contact contact_with_piece(const Box& box, const Sides& sides, const Arc& arc, double radius_m) {
    Quartic away{};
    int count = 0, last = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const int side = sides[static_cast<std::size_t>(axis)];
        if (side == 0) continue;
        away = sum(away, square(along(arc, axis, side < 0 ? box.lo[axis] : box.hi[axis])));
        ++count;
        last = axis;
    }
    if (count == 1) {
        const int side = sides[static_cast<std::size_t>(last)];
        away = along(arc, last, side < 0 ? box.lo[last] - radius_m : box.hi[last] + radius_m);
        if (side < 0) away = negative(away);
    } else {
        away[0] -= radius_m * radius_m;
    }
    const FallingRoots roots = falling_roots(away, arc.length_s);
    for (std::size_t i = 0; i < roots.count; ++i) {
        const Vec3 place = place_in(arc, roots.times[i]);
        if (!lies_over(box, sides, place)) continue;
        Vec3 normal(0.0);
        for (int axis = 0; axis < 3; ++axis) {
            const int side = sides[static_cast<std::size_t>(axis)];
            if (side != 0) normal[axis] = count == 1 ? side : place[axis] - (side < 0 ? box.lo[axis] : box.hi[axis]);
        }
        return {roots.times[i], 0, glm::normalize(normal), count == 1};
    }
    return {};
}

// Whether the arc stays so far from the box that no piece of it need be looked at.
bool stays_away(const Box& box, const Arc& arc, double radius_m) {
    for (int axis = 0; axis < 3; ++axis) {
        const double v = arc.velocity_m_per_s[axis], a = arc.acceleration_m_per_s2[axis];
        const double from = arc.place_m[axis], to = place_in(arc, arc.length_s)[axis];
        double lo = std::min(from, to), hi = std::max(from, to);
        if (const double turn = a != 0.0 ? -v / a : -1.0; turn > 0.0 && turn < arc.length_s) {
            lo = std::min(lo, place_in(arc, turn)[axis]);
            hi = std::max(hi, place_in(arc, turn)[axis]);
        }
        if (lo - radius_m - kSeam_m > box.hi[axis] || hi + radius_m + kSeam_m < box.lo[axis]) return true;
    }
    return false;
}

Contact contact_with(const Box& box, const Arc& arc, double radius_m) {
    Contact first;
    if (stays_away(box, arc, radius_m)) return first;
    for (int x = -1; x <= 1; ++x)
        for (int y = -1; y <= 1; ++y)
            for (int z = -1; z <= 1; ++z) {
                if (x == 0 && y == 0 && z == 0) continue;
                const Contact contact = contact_with_piece(box, {x, y, z}, arc, radius_m);
                if (contact.at_s < first.at_s) first = contact;
            }
    return first;
}

// The first contact, but for that with what the ball rests on.
Contact first_contact(const FlightRoom& room, const Arc& arc, const std::optional<Support>& support) {
    Contact first;
    for (std::uint32_t i = 0; i < room.obstacles.size(); ++i) {
        if (support && support->obstacle == i) continue;
        Contact contact =
            std::visit([&](const auto& of) { return contact_with(of, arc, room.radius_m); }, room.obstacles[i]);
        contact.obstacle = i;
        if (contact.at_s < first.at_s) first = contact;
    }
    return first;
}

// Where a ball that rolls on a box comes to the end of its face, and the way out beyond it.
struct FaceEnd {
    double at_s = kEndless_s;
    Vec3 out{0.0};
};
FaceEnd end_of_face(const FlightRoom& room, const Arc& arc, const Support& support) {
    const Box* box = std::get_if<Box>(&room.obstacles[support.obstacle]);
    FaceEnd end;
    if (box == nullptr) return end;
    for (int axis = 0; axis < 3; ++axis) {
        if (support.normal[axis] != 0.0) continue;
        for (const int side : {-1, 1}) {
            const Quartic beyond = along(arc, axis, side < 0 ? box->lo[axis] : box->hi[axis]);
            const FallingRoots roots = falling_roots(side < 0 ? beyond : negative(beyond), arc.length_s);
            if (roots.count == 0 || roots.times[0] >= end.at_s) continue;
            end = {roots.times[0], Vec3(0.0)};
            end.out[axis] = side;
        }
    }
    return end;
}

// The arc on which the ball goes on, for at most so long.
Arc arc_of(const FlyingBall& ball, const FlightRoom& room, double begin_s, double time_s) {
    Arc arc{begin_s, time_s, ball.place_m, ball.velocity_m_per_s, room.gravity_m_per_s2};
    if (!ball.support) return arc;
    const Vec3& n = ball.support->normal;
    const Vec3 slope = room.gravity_m_per_s2 - glm::dot(room.gravity_m_per_s2, n) * n;
    const double speed = glm::length(ball.velocity_m_per_s), loss = room.rolling_m_per_s2;
    if (glm::length(slope) > std::max(loss, 1e-9)) {
        arc.acceleration_m_per_s2 = slope;
    } else if (speed > 0.0 && loss > 0.0) {
        arc.acceleration_m_per_s2 = -loss / speed * ball.velocity_m_per_s;
        arc.length_s = std::min(time_s, speed / loss);
    } else {
        arc.acceleration_m_per_s2 = Vec3(0.0);
    }
    return arc;
}

bool stops_at_end(const Arc& arc, const FlyingBall& ball, const FlightRoom& room) {
    const double speed = glm::length(ball.velocity_m_per_s), loss = room.rolling_m_per_s2;
    return ball.support && loss > 0.0 && glm::dot(arc.acceleration_m_per_s2, ball.velocity_m_per_s) < 0.0 &&
           arc.length_s >= speed / loss;
}

// The ball behind a contact.
FlyingBall bounced(FlyingBall ball, const FlightRoom& room, const Contact& contact) {
    const Vec3& n = contact.normal;
    const double against = std::max(-glm::dot(ball.velocity_m_per_s, n), 0.0);
    const Vec3 tangential = ball.velocity_m_per_s + against * n;
    double off = room.restitution * against;
    const double pressed = -glm::dot(room.gravity_m_per_s2, n);
    if (!contact.is_flat) off = std::max(off, kLeastOffEdge_m_per_s);
    const bool stays = contact.is_flat && off < kLeastBounce_m_per_s && pressed > 1e-6;
    ball.velocity_m_per_s = room.tangential_kept * tangential + (stays ? 0.0 : off) * n;
    if (stays) {
        // Between two slopes there is no way to roll.
        if (ball.support && glm::dot(ball.support->normal, n) < 0.999) ball.velocity_m_per_s = Vec3(0.0);
        ball.support = Support{contact.obstacle, n};
    } else if (ball.support && glm::dot(ball.velocity_m_per_s, ball.support->normal) > kLeastBounce_m_per_s) {
        ball.support.reset();  // thrown off what it rolled on
    } else if (ball.support) {
        const Vec3& up = ball.support->normal;
        ball.velocity_m_per_s -= glm::dot(ball.velocity_m_per_s, up) * up;
    }
    return ball;
}

Vec3 nearest_in(const Box& box, const Vec3& place) { return glm::clamp(place, box.lo, box.hi); }

}  // namespace

// Out of several obstacles one after another.
Vec3 outside(const FlightRoom& room, const Vec3& place_m) {
    Vec3 place = place_m;
    constexpr int kRounds = 4;
    for (int round = 0; round < kRounds; ++round) {
        bool moved = false;
        for (const Obstacle& obstacle : room.obstacles) {
            const double clear_m = clearance_m(obstacle, place, room.radius_m);
            if (clear_m >= -kInside_m) continue;
            moved = true;
            if (const auto* plane = std::get_if<HalfSpace>(&obstacle)) {
                place -= clear_m * plane->normal;
                continue;
            }
            const Box& box = std::get<Box>(obstacle);
            const Vec3 away = place - nearest_in(box, place);
            if (const double far = glm::length(away); far > 0.0) {
                place -= clear_m / far * away;
                continue;
            }
            Vec3 out(0.0);
            double least = kEndless_s;
            for (int axis = 0; axis < 3; ++axis)
                for (const bool high : {false, true}) {
                    const double way = high ? box.hi[axis] - place[axis] : place[axis] - box.lo[axis];
                    if (way >= least) continue;
                    least = way;
                    out = Vec3(0.0);
                    out[axis] = (high ? 1.0 : -1.0) * (way + room.radius_m);
                }
            place += out;
        }
        if (!moved) break;
    }
    return place;
}

double clearance_m(const Obstacle& obstacle, const Vec3& place_m, double radius_m) {
    if (const auto* plane = std::get_if<HalfSpace>(&obstacle))
        return glm::dot(plane->normal, place_m) - plane->offset_m - radius_m;
    const Box& box = std::get<Box>(obstacle);
    const double away = glm::length(place_m - nearest_in(box, place_m));
    if (away > 0.0) return away - radius_m;
    const Vec3 in = glm::min(place_m - box.lo, box.hi - place_m);
    return -std::min({in.x, in.y, in.z}) - radius_m;
}

Flight flight_of(const FlyingBall& begin, const FlightRoom& room, double time_s) {
    Flight flight{begin, {}, {}};
    FlyingBall& ball = flight.ball;
    ball.place_m = outside(room, ball.place_m);
    double now_s = 0.0;
    std::size_t events = 0;
    while (now_s < time_s && !ball.rests()) {
        Arc arc = arc_of(ball, room, now_s, time_s - now_s);
        bool stops = stops_at_end(arc, ball, room);
        const Contact contact = first_contact(room, arc, ball.support);
        const FaceEnd face_end = ball.support ? end_of_face(room, arc, *ball.support) : FaceEnd{};
        const double event_s = std::min(contact.at_s, face_end.at_s);
        if (event_s < arc.length_s) {
            arc.length_s = event_s;
            stops = false;
        }
        flight.arcs.push_back(arc);
        now_s += arc.length_s;
        ball.place_m = place_in(arc, arc.length_s);
        ball.velocity_m_per_s += arc.length_s * arc.acceleration_m_per_s2;
        if (stops) ball.velocity_m_per_s = Vec3(0.0);
        if (event_s > arc.length_s) continue;
        if (++events > kMostBounces) {
            ball.velocity_m_per_s = Vec3(0.0);
            ball.support = Support{contact.obstacle, contact.normal};
        } else if (face_end.at_s < contact.at_s) {
            ball.support.reset();
            ball.place_m += 3.0 * kSeam_m * face_end.out;  // so far that the face does not bear it any more
        } else {
            const double against = -glm::dot(ball.velocity_m_per_s, contact.normal);
            flight.bounces.push_back({now_s, contact.obstacle, ball.place_m, contact.normal, std::max(against, 0.0)});
            ball = bounced(ball, room, contact);
        }
    }
    if (now_s < time_s) flight.arcs.push_back({now_s, time_s - now_s, ball.place_m, Vec3(0.0), Vec3(0.0)});
    return flight;
}

std::optional<double> first_within(std::span<const Arc> arcs, const Vec3& at_m, const Vec3& velocity_m_per_s,
                                   double distance_m) {
    for (const Arc& arc : arcs) {
        const Vec3 point_m = at_m + arc.begin_s * velocity_m_per_s;
        if (glm::length(arc.place_m - point_m) <= distance_m) return arc.begin_s;
        Arc seen = arc;
        seen.velocity_m_per_s -= velocity_m_per_s;
        Quartic away{};
        for (int axis = 0; axis < 3; ++axis) away = sum(away, square(along(seen, axis, point_m[axis])));
        away[0] -= distance_m * distance_m;
        const FallingRoots roots = falling_roots(away, arc.length_s);
        if (roots.count > 0) return arc.begin_s + roots.times[0];
    }
    return std::nullopt;
}

}  // namespace burin::bodies
