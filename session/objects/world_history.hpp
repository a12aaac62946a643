// SPDX-License-Identifier: MIT
// What was done to the objects of a session's world, so that it can be undone and repeated: each step is an object as
// it was before and after, which states of the session share.
//
// What goes on is one step: a slider that is dragged sets its value many times. What a hand has moved is one from where
// it took hold to where it let go.
// Steps have numbers that follow each other (scene/part_steps.hpp); whose turn it is where a workpiece is carved as
// well, the session's history says (document/history.hpp).
// Pure; any thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <span>

#include "scene/object_id.hpp"
#include "scene/object_step.hpp"
#include "scene/part_steps.hpp"
#include "scene/property_value.hpp"

namespace burin::session {

struct WorldObjects;  // session/objects/world_objects.hpp

class WorldHistory {
public:
    static constexpr std::size_t kMostSteps = 10'000;
    static constexpr double kGoesOn_s = 0.5;  // without a change of the same value, a step is whole

    WorldHistory() = default;
    // Goes on with steps of an earlier session, of which the first is numbered so and the last that leads back `done`.
    WorldHistory(std::int64_t first, std::int64_t done, std::span<const scene::ObjectStep> steps);

    // Takes an edit of one property of an object. is_newest: no other part has made a step since this one's last.
    void note(std::shared_ptr<const scene::SceneObject> before, std::shared_ptr<const scene::SceneObject> after,
              scene::ObjectProperty property, bool is_newest);
    // Takes what hands have done between two states of the world.
    void follow(const WorldObjects& before, const WorldObjects& after);
    void rest(double dt_s) { rests_s_ += dt_s; }

    [[nodiscard]] std::size_t undoable() const { return done_; }
    [[nodiscard]] std::size_t redoable() const { return steps_.size() - done_; }
    [[nodiscard]] scene::PartSteps steps() const;
    // The next step back, and the next forward; null: there is none.
    [[nodiscard]] const scene::ObjectStep* back() const { return done_ > 0 ? &steps_[done_ - 1].step : nullptr; }
    [[nodiscard]] const scene::ObjectStep* forward() const { return redoable() > 0 ? &steps_[done_].step : nullptr; }
    // Says that the step was taken back, or repeated.
    void went_back();
    void went_forward();
    // Forgets what was taken back.
    void forget_undone() { steps_.resize(done_); }
    // Returns the number of the state that the objects are in, which undo brings back.
    [[nodiscard]] std::uint64_t state() const { return done_ > 0 ? steps_[done_ - 1].state : first_state_; }

    // A step by its number, from steps().first to steps().last, and the state after it, which no other step leads to.
    [[nodiscard]] const scene::ObjectStep& step(std::int64_t number) const { return kept(number).step; }
    [[nodiscard]] std::uint64_t state_after(std::int64_t number) const { return kept(number).state; }

private:
    struct Kept {
        scene::ObjectStep step;
        std::uint64_t state = 0;  // after it
        std::optional<scene::ObjectProperty> property = {};
    };
    void add(Kept kept);
    [[nodiscard]] const Kept& kept(std::int64_t number) const {
        return steps_[static_cast<std::size_t>(number - first_)];
    }

    std::deque<Kept> steps_;
    std::int64_t first_ = 1;  // number of the oldest
    std::size_t done_ = 0;    // those behind were taken back
    std::uint64_t first_state_ = 0, newest_state_ = 0, made_ = 0;
    double rests_s_ = 0.0;  // since the newest step was made or went on
    bool is_open_ = false;  // the newest step may go on
    std::map<scene::ObjectId, std::shared_ptr<const scene::SceneObject>> held_from_;  // when a hand took hold of it
};

}  // namespace burin::session
