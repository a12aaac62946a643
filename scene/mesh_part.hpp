// SPDX-License-Identifier: MIT
// The meshes of a world as a part of a scene: objects with poses, materials and motions that can be touched, moved and
// changed while they are touched.
//
// Data flow: each object that is felt has a snapshot of its mesh (geometry/contact/touch_mesh.hpp) at its scale;
// objects with one mesh and one scale share it. Where an object stands is published beside the snapshot, so that moving
// one costs nothing. An update takes objects on paths to their poses at its time, and held ones along with their hands.
// A query finds resting objects in a tree of boxes (scene/object_tree.hpp) and looks at each moving one; its cost does
// not grow with the resting ones.
// Motion as published: pose at the time of the update and the mean velocity until the next one is due, so that a body
// on a path is then where the tick has followed it to.
// Hardest case: an object that is edited while it is touched. A pose set by hand is a jump: the tick puts the tool
// outside and fades its force in (haptics/contact/moving_bodies.hpp); a scale is a new snapshot, likewise. A material
// changes between two ticks.
// Threads: one at a time. The snapshots are handed to the haptic thread by the publisher alone.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "scene/contact_follower.hpp"
#include "scene/object_tree.hpp"
#include "scene/scene_object.hpp"
#include "scene/scene_part.hpp"

namespace burin::haptics {
struct TickRecord;  // haptics/tick_record.hpp
}  // namespace burin::haptics

namespace burin::geometry {
struct TouchSnapshot;  // geometry/contact/touch_patch.hpp
struct TouchedMesh;    // geometry/contact/local_surface.hpp
}  // namespace burin::geometry

namespace burin::scene {

struct ObjectUpdate;  // scene/scene_changes.hpp

class MeshPart final : public ScenePart {
public:
    static constexpr Nanoseconds kMoving_ns = 10'000'000, kResting_ns = 40'000'000;

    // The table must outlive the part. Fails on two objects of one id or name, on values out of range, on a mesh that
    // cannot be touched, and where the table has no room for a material.
    [[nodiscard]] static Result<std::unique_ptr<MeshPart>> create(std::vector<SceneObject> objects,
                                                                  MaterialTable& materials);
    ~MeshPart() override;

    // ScenePart. The first update is the time at which paths begin. A hand's newest tick tells where it is; its
    // velocities are the mean over the ticks of an update. Its buttons take hold (grip_with).
    void take_ticks(std::size_t part, std::span<const haptics::TickRecord> ticks) override;
    [[nodiscard]] Result<void> update(Nanoseconds now_ns, const PartSeen* recorded) override;
    [[nodiscard]] const PartSeen& seen() const override { return seen_; }
    // Leaves out what the hand itself holds, unless it is to be felt by it.
    [[nodiscard]] Result<void> add_near(const ProbeBall& ball, geometry::LocalSurface& draft) override;
    void take_changes(SceneChanges& changes) override;
    [[nodiscard]] Nanoseconds period_ns() const override { return moving_.empty() ? kResting_ns : kMoving_ns; }

    // Makes an edit, which the next update shows. One that fails changes nothing. take_hold() has an object move with
    // parts of hands from where all of them are; a hold that there was gives way. felt: by these parts as well
    // (HeldMotion). let_go() leaves it fixed where it was in the last update.
    [[nodiscard]] Result<void> edit(ObjectId id, const ObjectEdit& edit);
    [[nodiscard]] Result<void> take_hold(ObjectId id, std::span<const std::size_t> hands, bool felt = false);
    [[nodiscard]] Result<void> take_hold(ObjectId id, std::size_t hand) { return take_hold(id, {&hand, 1}); }
    [[nodiscard]] Result<void> let_go(ObjectId id);
    // Has a hand take hold of the object that its ticks have found touched when a button goes down (of several the one
    // that the first of its points touches), and let go with the button. button: bits of DeviceSample::buttons.
    void grip_with(std::size_t hand, std::uint32_t button) { grips_[hand].button = button; }
    // Tells where a hand is; what it holds follows with the next update.
    void move_hand(std::size_t hand, const HandPose& pose);

    [[nodiscard]] std::size_t size() const { return objects_.size(); }
    [[nodiscard]] bool has(ObjectId id) const { return index_of_.contains(id); }
    // Requires an object of the part.
    [[nodiscard]] const SceneObject& object(ObjectId id) const { return objects_[index_of_.at(id)].object; }
    // Returns where the object was in the last update.
    [[nodiscard]] const Pose& pose(ObjectId id) const { return objects_[index_of_.at(id)].scene_from_object; }
    // Returns the index of the object's material in the table. It must be felt.
    [[nodiscard]] std::uint8_t material_index(ObjectId id) const { return objects_[index_of_.at(id)].material; }
    // Returns the objects that have changed since the last call, each once, in the order of their creation; at first
    // all.
    [[nodiscard]] std::vector<ObjectUpdate> take_object_updates();
    // Returns the number of boxes and distances computed by queries since creation: a measure of their cost.
    [[nodiscard]] std::uint64_t looks() const { return looks_; }

private:
    using Snapshot = std::shared_ptr<const geometry::TouchSnapshot>;

    struct Placed {
        SceneObject object;
        Snapshot snapshot;          // null: not felt
        std::uint8_t material = 0;  // index in the table; held while it is felt
        Pose scene_from_object;
        Velocities velocities;
        bool changed = true;      // since take_object_updates()
        std::uint32_t edits = 0;  // TouchedMesh::edits

        [[nodiscard]] bool moves() const { return !std::holds_alternative<FixedMotion>(object.motion); }
        [[nodiscard]] geometry::TouchedMesh touched(Nanoseconds time_ns) const;
    };

    explicit MeshPart(MaterialTable& materials) : materials_(materials) {}
    [[nodiscard]] Result<void> add(SceneObject object);
    [[nodiscard]] Result<void> replace(Placed& placed, SceneObject object);
    [[nodiscard]] Result<Snapshot> snapshot_of(const SceneObject& object);
    void place(Placed& placed);
    void sort_by_motion();
    // How a hand takes hold of objects.
    struct Grip {
        std::uint32_t button = 0;
        bool down = false;
        ObjectId held = 0;         // 0: none
        TouchedObjects touched{};  // in the last tick
    };
    void grip(std::size_t hand, Grip& grip, std::span<const haptics::TickRecord> ticks);
    [[nodiscard]] std::optional<HandPose> frame_of(std::span<const std::size_t> hands) const;
    [[nodiscard]] ObjectId to_take(const TouchedObjects& touched) const;
    void offer(const Placed& placed, const ProbeBall& ball, geometry::LocalSurface& draft);

    MaterialTable& materials_;
    std::vector<Placed> objects_;
    std::unordered_map<ObjectId, std::uint32_t> index_of_;
    std::vector<std::uint32_t> moving_;  // indices of those that move, felt or not
    ObjectTree resting_;                 // those that rest and are felt
    bool unsorted_ = true;               // moving_ and resting_ are out of date
    std::map<std::pair<std::shared_ptr<const geometry::TriangleMesh>, double>,
             std::weak_ptr<const geometry::TouchSnapshot>>
        snapshots_;  // by mesh and scale
    std::map<std::size_t, HandPose> hands_;
    std::map<std::size_t, Grip> grips_;
    std::vector<std::uint32_t> found_;  // by a query
    Nanoseconds start_ns_ = 0;          // of the first update
    bool started_ = false;
    std::uint64_t looks_ = 0;
    std::uint64_t told_materials_ = 0;  // version of the table, as told by take_changes()
    PartSeen seen_;
    Nanoseconds now_ns_ = 0;  // of the last update
};

}  // namespace burin::scene
