// SPDX-License-Identifier: MIT
#include "haptics/contact/moving_bodies.hpp"

#include <algorithm>
#include <cmath>

#include "haptics/contact/touching.hpp"

namespace burin::haptics {
namespace {

// How often the proxy is swept against each body in turn before it stays where the last one has put it.
constexpr int kRounds = 3;
// How often a broad phase that covers only a part of a sweep's way is repeated.
constexpr int kParts = 6;
// The ball that is swept is smaller by this part than the one that touches, so that a ball which already rests on a
// body, give or take kTouch, is still outside it: what overlaps is not held back.
constexpr double kSlimmer = 2.0 * kTouch;

Vec3 in_frame(const Pose& pose, const Vec3& p) { return glm::conjugate(pose.orientation) * (p - pose.position_m); }

// Whether the way of a ball comes near the bounding box of the mesh.
bool comes_near(const geometry::TouchedMesh& mesh, const Pose& pose, const Way& way, double radius) {
    const Box box = mesh.snapshot->bounds();
    const Vec3 from = in_frame(pose, way.from) - mesh.snapshot->origin_object;
    const Vec3 to = in_frame(pose, way.to) - mesh.snapshot->origin_object;
    const Vec3 apart = glm::max(glm::max(box.lo - glm::max(from, to), glm::min(from, to) - box.hi), Vec3(0.0));
    return glm::dot(apart, apart) <= radius * radius * 1.01;
}

// Sweeps the proxy out of the way of bodies. Positions are in the object frame.
class Carrier {
public:
    Carrier(const ProxyState& state, const MovingBodies& bodies, double contact_radius_m, double elsewhere_m,
            const ProxyBudget& budget)
        : state_(state),
          bodies_(bodies),
          posed_(bodies.surface()),
          radius_(felt_radius_m(contact_radius_m, posed_.mean_edge_m())),
          elsewhere_(elsewhere_m),
          budget_(budget) {}

    CarriedProxy carry() {
        const Vec3 began = state_.position_object_m;
        result_.state = state_;
        Vec3& at = result_.state.position_object_m;
        const std::uint32_t carrier = bodies_.with_name(state_.carrier);
        std::uint32_t mover = MovingBodies::kNone;
        if (carrier != MovingBodies::kNone && is_near_expected(carrier)) {
            mover = carrier;
            at = bodies_.carried(carrier, began);
            // Relative to the body the hand has come from there.
            result_.state.hip_object_m = bodies_.carried(carrier, state_.hip_object_m);
        }
        bool moved = true;
        for (int round = 0; moved && round < kRounds; ++round) {
            moved = false;
            if (at != began && sweep(posed_.only_resting(), began, at)) moved = true;
            for (std::uint32_t body = 0; body < bodies_.count(); ++body) {
                if (!bodies_.is_known(body) || !is_near_expected(body)) continue;
                const Vec3 from = bodies_.carried(body, began);
                const std::uint32_t mesh = bodies_.mesh_of(body);
                if (from == at || !comes_near(posed_.surface().meshes[mesh], posed_.pose(mesh), {from, at}, radius_))
                    continue;
                if (!sweep(posed_.only_mesh(mesh), from, at)) continue;
                mover = body;
                moved = true;
            }
        }
        if (mover != MovingBodies::kNone) result_.unexplained_m = bodies_.unexplained(mover, at);
        return result_;
    }

private:
    [[nodiscard]] bool is_near_expected(std::uint32_t body) const {
        const Vec3 now = bodies_.carried(body, state_.position_object_m);
        return glm::length(bodies_.unexplained(body, now)) <= elsewhere_;
    }

    // Sweeps the ball to `at`, and shortens the way where it touches. Returns whether it did.
    bool sweep(const geometry::PosedSurface& part, const Vec3& from, Vec3& at) {
        ProxyBudget left = budget_;
        left.max_cost_ns -= cost_ns(result_.work) - WorkCost::kTick_ns;
        ContactWork work;
        ContactSearch search(part, radius_ * (1.0 - kSlimmer), left, work);
        Vec3 center = from - part.origin_object();
        const Vec3 end = at - part.origin_object();
        bool arrived = false, complete = true;
        for (int i = 0; i < kParts && complete && !arrived; ++i) {
            complete = search.broad_phase({center, end});
            if (!complete) break;
            const double share = search.known_share(center, end - center);
            const auto swept = search.sweep(center, share * (end - center));
            complete = swept.complete;
            if (!complete) break;
            center += (share * swept.fraction) * (end - center);
            if (swept.fraction < 1.0) break;
            arrived = share >= 1.0;
        }
        result_.work += work;
        result_.complete = result_.complete && complete;
        if (arrived) return false;
        at = part.origin_object() + center;
        return true;
    }

    const ProxyState& state_;
    const MovingBodies& bodies_;
    geometry::PosedSurface posed_;
    double radius_, elsewhere_;
    ProxyBudget budget_;
    CarriedProxy result_;
};

}  // namespace

MovingBodies::MovingBodies(BodiesState& state, const geometry::LocalSurface& surface, Nanoseconds now_ns,
                           double longest_s) noexcept
    : state_(&state), surface_(&surface) {
    const auto moves = [](const geometry::TouchedMesh& mesh) { return mesh.moves(); };
    any_ = std::ranges::any_of(surface.meshes, moves);
    if (!any_) {
        state.count = 0;
        return;
    }
    const BodiesState before = state;
    state.time_ns = now_ns;
    const auto meshes = static_cast<std::uint32_t>(surface.meshes.size());
    for (std::uint32_t mesh = 0; mesh < meshes && count_ < BodiesState::kMost; ++mesh) {
        const geometry::TouchedMesh& touched = surface.meshes[mesh];
        if (touched.snapshot != nullptr && touched.moves() && geometry::is_sensible(touched.motion))
            follow(state, before, mesh, now_ns, longest_s);
    }
    state.count = count_;
}

// Adds the body of a mesh that moves.
void MovingBodies::follow(BodiesState& state, const BodiesState& before, std::uint32_t mesh, Nanoseconds now_ns,
                          double longest_s) noexcept {
    const geometry::MeshMotion& motion = surface_->meshes[mesh].motion;
    const std::uint32_t i = count_++;
    const double followed_s = geometry::followed_s(motion, now_ns, longest_s);
    const bool stands = std::abs(followed_s) >= longest_s;
    state.bodies[i] = motion.body;
    state.meshes[i] = mesh;
    state.velocities_m_per_s[i] = stands ? Vec3(0.0) : motion.velocity_object_m_per_s;
    state.angular_velocities_rad_per_s[i] = stands ? Vec3(0.0) : motion.angular_velocity_object_rad_per_s;
    state.object_from_mesh[i] = geometry::moved_on(motion.object_from_mesh, motion.velocity_object_m_per_s,
                                                   motion.angular_velocity_object_rad_per_s, followed_s);
    Body body;
    const double since_s = seconds(now_ns - before.time_ns);
    for (std::uint32_t k = 0; k < before.count && !body.known; ++k) {
        if (before.bodies[k] != motion.body) continue;
        body.known = true;
        body.before = before.object_from_mesh[k];
        body.expected = geometry::moved_on(body.before, before.velocities_m_per_s[k],
                                           before.angular_velocities_rad_per_s[k], since_s);
    }
    bodies_.put(i, body);
}

std::uint32_t MovingBodies::with_name(std::uint64_t name) const noexcept {
    for (std::uint32_t i = 0; name != 0 && i < count_; ++i)
        if (bodies_[i].known && state_->bodies[i] == name) return i;
    return kNone;
}

// Returns the number of the body that the triangle is part of; kNone: of none that moves.
std::uint32_t MovingBodies::body_of(std::uint32_t triangle) const noexcept {
    if (!any_ || triangle >= surface_->triangles()) return kNone;
    const std::uint32_t mesh = surface_->mesh_of(triangle);
    for (std::uint32_t i = 0; i < count_; ++i)
        if (state_->meshes[i] == mesh) return i;
    return kNone;
}

std::uint64_t MovingBodies::name_of(std::uint32_t triangle) const noexcept {
    const std::uint32_t body = body_of(triangle);
    return body != kNone ? state_->bodies[body] : 0;
}

Vec3 MovingBodies::carried(std::uint32_t body, const Vec3& p) const noexcept {
    return state_->object_from_mesh[body] * in_frame(bodies_[body].before, p);
}

Vec3 MovingBodies::unexplained(std::uint32_t body, const Vec3& p) const noexcept {
    return p - bodies_[body].expected * in_frame(state_->object_from_mesh[body], p);
}

Vec3 MovingBodies::velocity_at(std::uint32_t body, const Vec3& p) const noexcept {
    const Vec3 arm = p - state_->object_from_mesh[body].position_m;
    return state_->velocities_m_per_s[body] + glm::cross(state_->angular_velocities_rad_per_s[body], arm);
}

Vec3 MovingBodies::velocity(std::uint32_t triangle, const Vec3& p) const noexcept {
    const std::uint32_t body = body_of(triangle);
    return body != kNone ? velocity_at(body, p) : Vec3(0.0);
}

Vec3 MovingBodies::velocity_of_body(std::uint64_t name, const Vec3& p) const noexcept {
    const std::uint32_t body = with_name(name);
    return body != kNone ? velocity_at(body, p) : Vec3(0.0);
}

CarriedProxy carry(const ProxyState& state, const MovingBodies& bodies, double contact_radius_m, double elsewhere_m,
                   const ProxyBudget& budget) noexcept {
    if (!state.placed || !bodies.any() || !(bodies.surface().mean_edge_m() > 0.0)) return {.state = state};
    return Carrier(state, bodies, contact_radius_m, elsewhere_m, budget).carry();
}

}  // namespace burin::haptics
