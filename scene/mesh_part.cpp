// SPDX-License-Identifier: MIT
#include "scene/mesh_part.hpp"

#include <algorithm>
#include <iterator>
#include <string>

#include "base/try.hpp"
#include "geometry/contact/local_surface.hpp"
#include "geometry/contact/touch_mesh.hpp"
#include "scene/scene_changes.hpp"
#include "scene/touch_publisher.hpp"

namespace burin::scene {
namespace {

// Returns the box around the mesh where the pose has it.
Box box_in_scene(const geometry::TouchSnapshot& snapshot, const Pose& scene_from_object) {
    const Box own = snapshot.bounds();
    const glm::dmat3 turn = glm::mat3_cast(scene_from_object.orientation);
    Vec3 half(0.0);
    for (int axis = 0; axis < 3; ++axis) half += glm::abs(turn[axis]) * (0.5 * own.extent()[axis]);
    // The rounding of the rotation, far above one part in 2^53 of any length in it.
    half += Vec3(1e-12 * (glm::length(scene_from_object.position_m) + glm::length(half)));
    const Vec3 middle = scene_from_object * (own.center() + snapshot.origin_object);
    return {middle - half, middle + half};
}

// Whether a tool that touches the object goes on touching the same surface at the same place. A material's change is
// not one of the surface: the tick eases it itself.
bool feels_alike(const SceneObject& a, const SceneObject& b) {
    return a.mesh == b.mesh && a.scale == b.scale && a.felt == b.felt && a.both_sides == b.both_sides &&
           a.pose == b.pose && a.motion.index() == b.motion.index();
}

}  // namespace

// ---- Making and editing

Result<std::unique_ptr<MeshPart>> MeshPart::create(std::vector<SceneObject> objects, MaterialTable& materials) {
    std::unique_ptr<MeshPart> part(new MeshPart(materials));
    part->objects_.reserve(objects.size());
    for (SceneObject& object : objects) BURIN_TRY_DO(part->add(std::move(object)));
    part->sort_by_motion();
    return part;
}

MeshPart::~MeshPart() {
    for (const Placed& placed : objects_)
        if (placed.snapshot) materials_.release(placed.material);
}

Result<void> MeshPart::add(SceneObject object) {
    if (object.id == 0 || index_of_.contains(object.id))
        return fail(object.name, "has an id that is 0 or another object's", "number objects from 1");
    if (std::ranges::any_of(objects_, [&](const Placed& p) { return p.object.name == object.name; }))
        return fail(object.name, "two objects have this name", "give each a name of its own");
    if (const std::vector<Problem> found = problems(object); !found.empty())
        return fail(object.name, found.front().key + " " + found.front().what, found.front().remedy);
    if (!object.mesh) return fail(object.name, "has no mesh", "give it one");
    const ObjectId id = object.id;
    Placed placed;
    BURIN_TRY_DO(replace(placed, std::move(object)));
    index_of_.emplace(id, static_cast<std::uint32_t>(objects_.size()));
    objects_.push_back(std::move(placed));
    return {};
}

// Gives the entry another state of its object, with the snapshot and the material that belong to it. Changes nothing
// where it fails.
Result<void> MeshPart::replace(Placed& placed, SceneObject object) {
    Snapshot snapshot;
    std::uint8_t material = placed.material;
    if (object.felt) {
        BURIN_TRY(made, snapshot_of(object));
        snapshot = std::move(made);
        const Result<std::uint8_t> index =
            placed.snapshot ? materials_.change(placed.material, object.material) : materials_.hold(object.material);
        if (!index) return fail(object.name, index.error().what, index.error().remedy);
        material = *index;
    } else if (placed.snapshot) {
        materials_.release(placed.material);
    }
    if (!feels_alike(placed.object, object)) ++placed.edits;
    placed.object = std::move(object);
    placed.snapshot = std::move(snapshot);
    placed.material = material;
    placed.changed = true;
    place(placed);
    unsorted_ = true;
    return {};
}

Result<MeshPart::Snapshot> MeshPart::snapshot_of(const SceneObject& object) {
    std::weak_ptr<const geometry::TouchSnapshot>& known = snapshots_[{object.mesh, object.scale}];
    if (Snapshot there = known.lock()) return there;
    std::erase_if(snapshots_, [&](const auto& entry) { return &entry.second != &known && entry.second.expired(); });
    Result<geometry::TouchMesh> touched = [&] {
        if (object.scale == 1.0) return geometry::TouchMesh::create(*object.mesh);
        geometry::TriangleMesh scaled;
        scaled.positions_m = object.mesh->positions_m;
        scaled.triangles = object.mesh->triangles;
        for (Vec3& p : scaled.positions_m) p *= object.scale;
        return geometry::TouchMesh::create(scaled);
    }();
    if (!touched) return fail(object.name, touched.error().what, touched.error().remedy);
    Snapshot snapshot = touched->snapshot();
    known = snapshot;
    return snapshot;
}

Result<void> MeshPart::edit(ObjectId id, const ObjectEdit& edit) {
    const auto at = index_of_.find(id);
    if (at == index_of_.end()) return fail("object " + std::to_string(id), "there is none with this number");
    Placed& placed = objects_[at->second];
    BURIN_TRY(changed, edited(placed.object, edit));
    return replace(placed, std::move(changed));
}

Result<void> MeshPart::let_go(ObjectId id) {
    const auto at = index_of_.find(id);
    if (at == index_of_.end() || !std::holds_alternative<HeldMotion>(objects_[at->second].object.motion)) return {};
    return edit(id, LetGo{objects_[at->second].scene_from_object});
}

Result<void> MeshPart::take_hold(ObjectId id, std::span<const std::size_t> hands, bool felt) {
    const auto at = index_of_.find(id);
    if (at == index_of_.end()) return fail("object " + std::to_string(id), "there is none with this number");
    const auto frame = frame_of(hands);
    if (!frame) return fail(objects_[at->second].object.name, "nobody knows where the hand is");
    const Pose& placed = objects_[at->second].scene_from_object;
    return edit(id, TakeHold{{hands.begin(), hands.end()}, composed(inverse(frame->scene_from_hand), placed), felt});
}

// Returns the frame in which the hands hold something; nothing where one of them is not known, or there is none.
std::optional<HandPose> MeshPart::frame_of(std::span<const std::size_t> hands) const {
    std::vector<HandPose> poses;
    for (const std::size_t hand : hands) {
        const auto known = hands_.find(hand);
        if (known == hands_.end()) return std::nullopt;
        poses.push_back(known->second);
    }
    return poses.empty() ? std::nullopt : std::optional(grip_frame(poses));
}

void MeshPart::take_ticks(std::size_t part, std::span<const haptics::TickRecord> ticks) {
    const auto known = hands_.find(part);
    if (ticks.empty()) {  // no news: it stands still
        if (known != hands_.end())
            known->second.velocity_m_per_s = known->second.angular_velocity_rad_per_s = Vec3(0.0);
        return;
    }
    const haptics::TickRecord& newest = ticks.back();
    HandPose pose{.scene_from_hand = {newest.contact.points[0].hip_object_m, newest.motion.orientation_object},
                  .time_ns = newest.time_ns};
    const bool goes_on = known != hands_.end() && known->second.time_ns > 0 && newest.time_ns > known->second.time_ns;
    if (goes_on) {
        const Velocities v = velocities_between(known->second.scene_from_hand, pose.scene_from_hand,
                                                seconds(newest.time_ns - known->second.time_ns));
        pose.velocity_m_per_s = v.linear_m_per_s;
        pose.angular_velocity_rad_per_s = v.angular_rad_per_s;
    }
    move_hand(part, pose);
    if (const auto grip_of = grips_.find(part); grip_of != grips_.end()) grip(part, grip_of->second, ticks);
}

// While the workspace moves (a phase other than editing) the same button means something else.
void MeshPart::grip(std::size_t hand, Grip& grip, std::span<const haptics::TickRecord> ticks) {
    ObjectId wanted = grip.held;
    for (const haptics::TickRecord& tick : ticks) {
        const bool down = (tick.sample.buttons & grip.button) != 0;
        const bool was_down = std::exchange(grip.down, down), pressed = down && !was_down;
        if (!down) wanted = 0;
        grip.touched = touched_in(tick, grip.touched);
        if (pressed && tick.motion.workspace.phase == haptics::WorkspacePhase::editing) wanted = to_take(grip.touched);
    }
    if (wanted == grip.held) return;
    // An activity may have given it into other hands meanwhile.
    const auto* held = grip.held != 0 ? std::get_if<HeldMotion>(&object(grip.held).motion) : nullptr;
    if (held != nullptr && held->parts == std::vector{hand}) static_cast<void>(let_go(grip.held));
    grip.held = wanted != 0 && take_hold(wanted, hand) ? wanted : 0;
}

// Returns the first of them that no hand holds and this part has; 0: none.
ObjectId MeshPart::to_take(const TouchedObjects& touched) const {
    for (const ObjectId id : touched)
        if (id != 0 && has(id) && !std::holds_alternative<HeldMotion>(object(id).motion)) return id;
    return 0;
}

void MeshPart::move_hand(std::size_t hand, const HandPose& pose) {
    if (finite(pose.scene_from_hand.position_m) && geometry::is_unit(pose.scene_from_hand.orientation) &&
        finite(pose.velocity_m_per_s) && finite(pose.angular_velocity_rad_per_s))
        hands_[hand] = pose;
}

// ---- Updates

// Puts an object where its motion has it at the time of the last update.
void MeshPart::place(Placed& placed) {
    const SceneObject& object = placed.object;
    const Pose before = placed.scene_from_object;
    placed.velocities = {};
    if (const auto* path = std::get_if<PathMotion>(&object.motion)) {
        const double time_s = seconds(now_ns_ - start_ns_), period_s = seconds(kMoving_ns);
        placed.scene_from_object = composed(object.pose, pose_on(*path, time_s));
        placed.velocities = velocities_between(placed.scene_from_object,
                                               composed(object.pose, pose_on(*path, time_s + period_s)), period_s);
    } else if (const auto* held = std::get_if<HeldMotion>(&object.motion)) {
        const auto frame = frame_of(held->parts);
        if (!frame) return;  // stays until the hands are known
        const HandPose& pose = *frame;
        placed.scene_from_object = composed(pose.scene_from_hand, held->hand_from_object);
        const Vec3 arm = placed.scene_from_object.position_m - pose.scene_from_hand.position_m;
        placed.velocities = {pose.velocity_m_per_s + glm::cross(pose.angular_velocity_rad_per_s, arm),
                             pose.angular_velocity_rad_per_s};
    } else {
        placed.scene_from_object = object.pose;
    }
    placed.scene_from_object.orientation = glm::normalize(placed.scene_from_object.orientation);
    if (placed.scene_from_object != before) placed.changed = true;
}

void MeshPart::sort_by_motion() {
    moving_.clear();
    std::vector<ObjectTree::Item> resting;
    for (std::uint32_t i = 0; i < objects_.size(); ++i) {
        const Placed& placed = objects_[i];
        if (placed.moves())
            moving_.push_back(i);
        else if (placed.snapshot && placed.snapshot->triangles() > 0)
            resting.push_back({box_in_scene(*placed.snapshot, placed.scene_from_object), i});
    }
    resting_ = ObjectTree(std::move(resting));
    unsorted_ = false;
}

Result<void> MeshPart::update(Nanoseconds now_ns, const PartSeen*) {
    now_ns_ = now_ns;
    if (!std::exchange(started_, true)) start_ns_ = now_ns;
    if (unsorted_) sort_by_motion();
    for (const std::uint32_t i : moving_) place(objects_[i]);
    return {};
}

// ---- What is felt and seen

geometry::TouchedMesh MeshPart::Placed::touched(Nanoseconds time_ns) const {
    geometry::TouchedMesh mesh{snapshot, material, object.both_sides};
    mesh.motion.object_from_mesh = scene_from_object;
    mesh.object = static_cast<std::uint32_t>(object.id);
    mesh.edits = edits;
    if (!moves()) return mesh;
    mesh.motion.body = object.id;
    mesh.motion.velocity_object_m_per_s = velocities.linear_m_per_s;
    mesh.motion.angular_velocity_object_rad_per_s = velocities.angular_rad_per_s;
    mesh.motion.time_ns = time_ns;
    return mesh;
}

void MeshPart::offer(const Placed& placed, const ProbeBall& ball, geometry::LocalSurface& draft) {
    if (!placed.snapshot || placed.snapshot->triangles() == 0) return;
    const auto* held = std::get_if<HeldMotion>(&placed.object.motion);
    if (held != nullptr && !held->felt && std::ranges::find(held->parts, ball.hand) != held->parts.end()) return;
    ++looks_;
    geometry::TouchedMesh mesh = placed.touched(now_ns_);
    if (distance_ahead_m(mesh, ball.center_scene) <= ball.radius_m) draft.meshes.push_back(std::move(mesh));
}

Result<void> MeshPart::add_near(const ProbeBall& ball, geometry::LocalSurface& draft) {
    if (unsorted_) sort_by_motion();
    for (const std::uint32_t i : moving_) offer(objects_[i], ball, draft);
    found_.clear();
    looks_ +=
        resting_.for_each_near(ball.center_scene, ball.radius_m, [&](std::uint32_t index) { found_.push_back(index); });
    std::ranges::sort(found_);  // whatever the tree's order: edits elsewhere in the scene change nothing here
    for (const std::uint32_t i : found_) offer(objects_[i], ball, draft);
    return {};
}

void MeshPart::take_changes(SceneChanges& changes) {
    std::ranges::move(take_object_updates(), std::back_inserter(changes.objects));
    if (std::exchange(told_materials_, materials_.version()) != materials_.version()) changes.materials = materials_;
}

std::vector<ObjectUpdate> MeshPart::take_object_updates() {
    std::vector<ObjectUpdate> updates;
    for (Placed& placed : objects_) {
        if (!std::exchange(placed.changed, false)) continue;
        const Pose& pose = placed.scene_from_object;
        updates.push_back({placed.object.id,
                           {pose.position_m, pose.orientation, placed.object.scale},
                           placed.object.seen,
                           placed.object.colour,
                           placed.object.corner_colours != nullptr,
                           placed.object.pose,
                           placed.object.motion,
                           placed.object.opacity});
    }
    return updates;
}

}  // namespace burin::scene
