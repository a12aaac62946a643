// SPDX-License-Identifier: MIT
// Edits of a world's objects are undone and repeated: one step for each thing that a user did.
#include "scene/scene_motion.hpp"
#include "scene/scene_object.hpp"
#include "session/objects/world_history.hpp"
#include "session/objects/world_objects.hpp"

#include <gtest/gtest.h>

namespace burin::session {
namespace {

using Object = std::shared_ptr<const scene::SceneObject>;
using scene::ObjectProperty;

Object object_with(double scale, scene::ObjectId id = 1, scene::ObjectMotion motion = {}) {
    auto object = std::make_shared<scene::SceneObject>();
    object->id = id;
    object->scale = scale;
    object->motion = std::move(motion);
    return object;
}

WorldObjects world_of(std::vector<Object> objects) { return {"w", std::move(objects), scene::MaterialTable()}; }

}  // namespace

TEST(WorldHistory, TakesBackADraggedSliderAtOnce) {
    WorldHistory history;
    const Object first = object_with(1.0), last = object_with(1.5);
    history.note(first, object_with(1.1), ObjectProperty::scale, true);
    history.rest(0.1);
    history.note(object_with(1.1), object_with(1.2), ObjectProperty::scale, true);
    history.rest(0.4);
    history.note(object_with(1.2), last, ObjectProperty::scale, true);
    ASSERT_EQ(history.undoable(), 1u);
    EXPECT_EQ(history.back()->before, first);
    EXPECT_EQ(history.back()->after, last);
}

TEST(WorldHistory, TakesBackOneByOneWhatWasDoneOneByOne) {
    WorldHistory history;
    const Object a = object_with(1.0), b = object_with(2.0), c = object_with(3.0), other = object_with(1.0, 2);
    history.note(a, b, ObjectProperty::scale, true);
    history.rest(0.6);
    history.note(b, c, ObjectProperty::scale, true);                        // after a rest
    history.note(c, object_with(4.0), ObjectProperty::stiffness, true);     // another property
    history.note(other, object_with(5.0, 2), ObjectProperty::scale, true);  // another object
    EXPECT_EQ(history.undoable(), 4u);
}

TEST(WorldHistory, IsInTheStateThatItWasInAfterUndoAndInANewOneAfterAnEdit) {
    WorldHistory history;
    const std::uint64_t first = history.state();
    history.note(object_with(1.0), object_with(2.0), ObjectProperty::scale, true);
    const std::uint64_t second = history.state();
    EXPECT_NE(second, first);
    history.went_back();
    EXPECT_EQ(history.state(), first);
    EXPECT_EQ(history.redoable(), 1u);
    history.went_forward();
    EXPECT_EQ(history.state(), second);
    history.went_back();
    history.note(object_with(1.0), object_with(2.0), ObjectProperty::scale, true);
    EXPECT_EQ(history.redoable(), 0u) << "what was taken back is gone";
    EXPECT_NE(history.state(), second) << "equal values are another state";
    history.note(object_with(2.0), object_with(2.5), ObjectProperty::scale, true);
    EXPECT_NE(history.state(), second + 1) << "a drag that goes on is not saved";
}

TEST(WorldHistory, DoesNotGoOnWithAStepThatWasTakenBack) {
    WorldHistory history;
    history.note(object_with(1.0), object_with(2.0), ObjectProperty::scale, true);
    history.rest(1.0);
    history.note(object_with(2.0), object_with(3.0), ObjectProperty::scale, true);
    history.went_back();
    history.note(object_with(2.0), object_with(4.0), ObjectProperty::scale, true);
    EXPECT_EQ(history.undoable(), 2u);
}

TEST(WorldHistory, TakesBackAMoveByHandToWhereTheHandTookHold) {
    WorldHistory history;
    const scene::HeldMotion held{.parts = {0}, .hand_from_object = {}};
    const Object lies = object_with(1.0), other = object_with(1.0, 2), first = object_with(1.0, 1, held),
                 further = object_with(1.0, 1, held), there = object_with(1.0);
    history.follow(world_of({lies, other}), world_of({first, other}));
    history.follow(world_of({first, other}), world_of({further, other}));
    EXPECT_EQ(history.undoable(), 0u);
    history.follow(world_of({further, other}), world_of({there, other}));
    ASSERT_EQ(history.undoable(), 1u);
    EXPECT_EQ(history.back()->before, lies);
    EXPECT_EQ(history.back()->after, there);
}

TEST(WorldHistory, ForgetsTheOldestStepsAndKnowsItsStatesNevertheless) {
    WorldHistory history;
    for (std::size_t i = 0; i < WorldHistory::kMostSteps + 5; ++i) {
        history.note(object_with(1.0), object_with(2.0), ObjectProperty::scale, true);
        history.rest(1.0);
    }
    EXPECT_EQ(history.undoable(), WorldHistory::kMostSteps);
    while (history.undoable() > 0) history.went_back();
    EXPECT_EQ(history.state(), 5u);
}

}  // namespace burin::session
