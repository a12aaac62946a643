// SPDX-License-Identifier: MIT
#include "scene/touch_publisher.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "base/newest_slot.hpp"
#include "base/try.hpp"
#include "geometry/contact/local_surface.hpp"
#include "geometry/contact/posed_surface.hpp"
#include "haptics/forces/touch_force.hpp"

namespace burin::scene {
namespace {

// Lets go of all that a draft refers to, and keeps the memory of its lists.
void clear(geometry::LocalSurface& draft) {
    auto places = std::move(draft.tiles.places);
    auto meshes = std::move(draft.meshes);
    places.clear();
    meshes.clear();
    draft = {};
    draft.tiles.places = std::move(places);
    draft.meshes = std::move(meshes);
}

// Whether the tick would touch the mesh at all.
bool can_be_touched(const geometry::TouchedMesh& mesh) {
    return geometry::triangles_of(mesh) > 0 && (!mesh.has_pose() || geometry::is_sensible(mesh.motion));
}

Result<void> check_material(const geometry::TouchedMesh& mesh) {
    if (mesh.material < haptics::kMostMaterials) return {};
    return fail("object " + std::to_string(mesh.object),
                "has material " + std::to_string(mesh.material) + ", and a tick knows those from 0 to " +
                    std::to_string(haptics::kMostMaterials - 1),
                "give it the index that MaterialTable::hold() returns");
}

}  // namespace

double distance_ahead_m(const geometry::TouchedMesh& mesh, const Vec3& point_scene) noexcept {
    const geometry::MeshMotion& motion = mesh.motion;
    const Box box = mesh.snapshot->bounds();
    const Vec3 point_mesh =
        glm::conjugate(motion.object_from_mesh.orientation) * (point_scene - motion.object_from_mesh.position_m) -
        mesh.snapshot->origin_object;
    const double away_m = glm::length(glm::max(glm::max(box.lo - point_mesh, point_mesh - box.hi), Vec3(0.0)));
    if (!mesh.moves()) return away_m;
    // The farthest corner from the point about which it turns.
    const Vec3 lo = box.lo + mesh.snapshot->origin_object, hi = box.hi + mesh.snapshot->origin_object;
    const double arm_m = glm::length(glm::max(glm::abs(lo), glm::abs(hi)));
    const double speed_m_per_s =
        glm::length(motion.velocity_object_m_per_s) + arm_m * glm::length(motion.angular_velocity_object_rad_per_s);
    return std::max(away_m - kAhead_s * speed_m_per_s, 0.0);
}

struct TouchPublisher::Placed {
    double distance_m = 0.0;
    bool moves = false;
    geometry::TouchedMesh mesh;
};

TouchPublisher::TouchPublisher(std::span<Slot* const> hands) {
    for (Slot* slot : hands) hands_.push_back({slot, 0});
}

TouchPublisher::~TouchPublisher() = default;

Result<void> TouchPublisher::publish(const ProbeBall& ball, std::span<ScenePart* const> parts, Nanoseconds now_ns) {
    BURIN_CHECK(ball.hand < hands_.size());
    if (ball.hand >= hands_.size() || hands_[ball.hand].slot == nullptr) return {};
    Hand& hand = hands_[ball.hand];
    geometry::LocalSurface& draft = hand.slot->draft();
    clear(draft);
    draft.center_object = draft.origin_object = ball.center_scene;
    draft.radius_m = ball.radius_m;
    for (ScenePart* part : parts) BURIN_TRY_DO(part->add_near(ball, draft));
    for (const geometry::TouchedMesh& mesh : draft.meshes) BURIN_TRY_DO(check_material(mesh));
    draft.center_object = ball.center_scene;
    arrange(draft);
    draft.sequence = ++hand.sequence;
    draft.made_ns = now_ns;
    hand.slot->publish();
    return {};
}

void TouchPublisher::arrange(geometry::LocalSurface& draft) {
    for (geometry::TouchedMesh& mesh : draft.meshes) {
        if (!can_be_touched(mesh)) continue;
        const double distance_m = distance_ahead_m(mesh, draft.center_object);
        sorted_.push_back({distance_m, mesh.moves(), std::move(mesh)});
    }
    draft.meshes.clear();
    // Stable: parts add in an order of their own, which a replay repeats.
    std::ranges::stable_sort(sorted_, {}, [](const Placed& p) { return std::pair(!p.moves, p.distance_m); });
    std::uint32_t moving = 0, all = 0;
    for (Placed& placed : sorted_) {
        const bool fits = all < kMaxMeshes && (!placed.moves || moving < geometry::PosedSurface::kMostFollowed);
        if (!fits) {
            draft.radius_m = std::min(draft.radius_m, placed.distance_m);
            continue;
        }
        draft.meshes.push_back(std::move(placed.mesh));
        ++all;
        moving += placed.moves ? 1 : 0;
    }
    sorted_.clear();
}

}  // namespace burin::scene
