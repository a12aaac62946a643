// SPDX-License-Identifier: MIT
// Bodies that move under the proxy: where they are in this tick, how they carry and push the proxy, and how much of
// their motion nobody has announced.
//
// Data flow. The publisher gives each moving mesh a name, a pose, velocities and the time at which they hold
// (geometry/contact/mesh_motion.hpp), some hundred times a second. A tick
//   1. follows each to its own time at constant velocity (MovingBodies), never longer than the surface may be old;
//   2. compares with where the body was in the last tick: the velocity known then explains a part of the way, the rest
//      (a collision since, an acceleration, a body set elsewhere) is unexplained;
//   3. carries the proxy that touched a body with it, as if glued (carry), and pushes the proxy out of the way of all
//      others: in the frame of each body the proxy goes from where it was to where it is now, and is swept along that
//      way as along any other, so that nothing tunnels, however thin and fast it is; what rests is swept likewise where
//      a body carries the proxy;
//   4. moves the proxy towards the HIP as ever (god_object.hpp), among the bodies as they stand now. So friction holds
//      and slides against the body, and a body at rest with a moving hand is the same as a hand at rest with a moving
//      body;
//   5. damps by the velocity relative to the surface touched, tells the energy account what the body does to the hand
//      (haptics/stability/passivity.hpp), and leaves out of the spring what an unexplained motion has added to it.
//
// The rule for ramps, in lengths at the device: in one tick an unexplained motion may lengthen the spring between HIP
// and proxy by kJump (0.5 mm; at 600 N/m a third of a newton); what it adds beyond is left out of the force at first
// and comes back over the gate's ramp for contacts (haptics/probe_contact.cpp). One that takes load off makes up for
// what was left out, and needs no ramp. An edit or a deformation of a mesh is unexplained as a whole; so a surface that
// is published at 100 Hz may deform at up to 50 mm/s, and faster the more often it is published. Free fall is
// unexplained by g T^2 / 2 = 0.49 mm at 100 Hz, less if the velocity published is the mean until the next publication.
// A body that is found farther than kElsewhere from where it was expected was set there: it neither carries nor sweeps.
//
// The hardest case is a proxy between two bodies, or a body and a wall, that close on it until it has no room. Each
// pushes it into the other; after kRounds it stays where the last one has put it, that is at most the others' way of
// one tick deep in them, and the planes push it out sideways where there is a way out. Where there is none, they come
// to pass through it: it is inside one of them, is then put outside by the shortest way (god_object.hpp) and its force
// fades in. Nothing bounds the force of such a squeeze but the spring's length and the gate. The next hardest is a fast
// body that has stopped or bounced since it was published: until the next publication it is felt up to speed times age
// too near, and then it is set back at once, which takes load off.
//
// Sources: Ruspini, Kolarov and Khatib 1997 sweep a proxy among things that stand; CHAI3D (cAlgorithmFingerProxy with
// its dynamic proxy) takes the proxy along with the frame of the object, from the last pose to the new one, and sweeps
// from there; Mitra and Niemeyer 2005 use the velocity of the surface at the proxy for contact and friction with moving
// objects. Here poses are also followed between publications, and the work of the bodies is accounted for.
//
// Frame: object, metres. Turning by w in a tick of T bends the way of the proxy in a body's frame, which is taken as
// straight, by r (w T)^2 / 8: 1 um at 0.1 m and 10 rad/s. No heap, lock, throw. Cost: nothing where nothing moves; for
// each moving body its pose, and a broad phase with a sweep where the proxy's way comes near it. At most
// PosedSurface::kMostFollowed bodies are followed; meshes that rest do not count.
#pragma once

#include <array>
#include <cstdint>

#include "geometry/contact/posed_surface.hpp"
#include "haptics/contact/god_object.hpp"
#include "haptics/contact/static_vector.hpp"

namespace burin::haptics {

inline constexpr double kElsewhere_m = 0.02;  // at the device: a stop from 2 m/s within 10 ms is found out at once

// Where the bodies were in the last tick: the moving meshes, in the surface's order.
struct BodiesState {
    static constexpr std::uint32_t kMost = geometry::PosedSurface::kMostFollowed;

    std::array<std::uint64_t, kMost> bodies{};  // their names
    std::array<std::uint32_t, kMost> meshes{};  // their indices in the surface
    std::array<Pose, kMost> object_from_mesh{};
    std::array<Vec3, kMost> velocities_m_per_s{}, angular_velocities_rad_per_s{};
    std::uint32_t count = 0;
    Nanoseconds time_ns = 0;
};

// The bodies of a surface at the time of a tick.
class MovingBodies {
public:
    MovingBodies() noexcept {}  // none, and no surface
    // Writes where they are to `state`, which holds where they were, and which must outlive the object, as `surface`
    // must. A body is followed for at most longest_s beyond its time.
    MovingBodies(BodiesState& state, const geometry::LocalSurface& surface, Nanoseconds now_ns,
                 double longest_s) noexcept;

    [[nodiscard]] bool any() const noexcept { return any_; }
    [[nodiscard]] geometry::PosedSurface surface() const noexcept {
        return count_ > 0 ? geometry::PosedSurface(*surface_, {state_->meshes.data(), count_},
                                                   {state_->object_from_mesh.data(), count_})
                          : geometry::PosedSurface(*surface_);
    }

    // Bodies are numbered from 0 to count() - 1.
    static constexpr std::uint32_t kNone = 0xffffffffu;
    [[nodiscard]] std::uint32_t count() const noexcept { return count_; }
    // The number of a body by its name; kNone: there is none now, or there was none in the last tick.
    [[nodiscard]] std::uint32_t with_name(std::uint64_t name) const noexcept;
    // Whether the body was there in the last tick.
    [[nodiscard]] bool is_known(std::uint32_t body) const noexcept { return body < count_ && bodies_[body].known; }
    // The index of its mesh in the surface.
    [[nodiscard]] std::uint32_t mesh_of(std::uint32_t body) const noexcept { return state_->meshes[body]; }
    // The name of the body that this triangle is part of; 0: of none that moves.
    [[nodiscard]] std::uint64_t name_of(std::uint32_t triangle) const noexcept;

    // These require a body that is known.
    // Where a point that is fixed to the body, and was at p in the last tick, is now.
    [[nodiscard]] Vec3 carried(std::uint32_t body, const Vec3& p) const noexcept;
    // How far from where the velocity would have it a point of the body is that is now at p.
    [[nodiscard]] Vec3 unexplained(std::uint32_t body, const Vec3& p) const noexcept;

    // The velocity of the surface at p, for a triangle of it; zero where it does not move.
    [[nodiscard]] Vec3 velocity(std::uint32_t triangle, const Vec3& p) const noexcept;
    [[nodiscard]] Vec3 velocity_of_body(std::uint64_t name, const Vec3& p) const noexcept;

private:
    struct Body {
        bool known = false;
        Pose before, expected;
    };
    void follow(BodiesState& state, const BodiesState& before, std::uint32_t mesh, Nanoseconds now_ns,
                double longest_s) noexcept;
    [[nodiscard]] std::uint32_t body_of(std::uint32_t triangle) const noexcept;
    [[nodiscard]] Vec3 velocity_at(std::uint32_t body, const Vec3& p) const noexcept;

    const BodiesState* state_ = nullptr;
    const geometry::LocalSurface* surface_ = nullptr;
    StaticVector<Body, BodiesState::kMost> bodies_;
    std::uint32_t count_ = 0;
    bool any_ = false;
};

struct CarriedProxy {
    ProxyState state;         // from which the proxy goes on to the HIP
    Vec3 unexplained_m{0.0};  // the motion among that of the bodies which carried or pushed it that nothing explains
    bool complete = true;     // false: the work did not suffice, and it waits with the last body
    ContactWork work{};
};

// Takes the proxy along with the body that it touches and out of the way of the others. elsewhere_m: kElsewhere_m in
// the scene.
[[nodiscard]] CarriedProxy carry(const ProxyState& state, const MovingBodies& bodies, double contact_radius_m,
                                 double elsewhere_m, const ProxyBudget& budget) noexcept;

}  // namespace burin::haptics
