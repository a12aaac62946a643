// SPDX-License-Identifier: MIT
// What was done to the objects of a session's world, so that it can be undone and repeated: each step is an object as
// it was before and after, which states of the session share.
//
// What goes on is one step: a slider that is dragged sets its value many times. What a hand has moved is one from where
// it took hold to where it let go.
// Where a workpiece is carved as well, strokes and edits are undone in the order in which they were done: a step knows
// how many strokes could be undone when it was made.
// Pure; any thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "scene/object_id.hpp"
#include "scene/property_value.hpp"

namespace burin::scene {
struct SceneObject;  // scene/scene_object.hpp
}  // namespace burin::scene

namespace burin::session {

struct WorldObjects;  // session/objects/world_objects.hpp

struct WorldStep {
    std::shared_ptr<const scene::SceneObject> before, after;
    std::size_t strokes = 0;  // that could be undone when it was made
};

class WorldHistory {
public:
    static constexpr std::size_t kMostSteps = 10'000;
    static constexpr double kGoesOn_s = 0.5;  // without a change of the same value, a step is whole

    // Takes an edit of one property of an object.
    void note(std::shared_ptr<const scene::SceneObject> before, std::shared_ptr<const scene::SceneObject> after,
              scene::ObjectProperty property, std::size_t strokes);
    // Takes what hands have done between two states of the world.
    void follow(const WorldObjects& before, const WorldObjects& after, std::size_t strokes);
    void rest(double dt_s) { rests_s_ += dt_s; }

    [[nodiscard]] std::size_t undoable() const { return done_; }
    [[nodiscard]] std::size_t redoable() const { return steps_.size() - done_; }
    // The next step back, and the next forward; null: there is none.
    [[nodiscard]] const WorldStep* back() const { return done_ > 0 ? &steps_[done_ - 1].step : nullptr; }
    [[nodiscard]] const WorldStep* forward() const { return redoable() > 0 ? &steps_[done_].step : nullptr; }
    // Says that the step was taken back, or repeated.
    void went_back();
    void went_forward();
    // Returns the number of the state that the objects are in, which undo brings back.
    [[nodiscard]] std::uint64_t state() const { return done_ > 0 ? steps_[done_ - 1].state : first_state_; }

private:
    struct Kept {
        WorldStep step;
        std::uint64_t state = 0;  // after it
        std::optional<scene::ObjectProperty> property = {};
    };
    void add(Kept kept);

    std::vector<Kept> steps_;
    std::size_t done_ = 0;  // those behind were taken back
    std::uint64_t first_state_ = 0, newest_state_ = 0;
    double rests_s_ = 0.0;  // since the newest step was made or went on
    bool is_open_ = false;  // the newest step may go on
    std::map<scene::ObjectId, std::shared_ptr<const scene::SceneObject>> held_from_;  // when a hand took hold of it
};

}  // namespace burin::session
