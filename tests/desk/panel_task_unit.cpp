// SPDX-License-Identifier: MIT
// What a person sees who does an exercise: the task over the picture, and nothing of the scene; and what who leads it
// sees in a window of its own.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "tests/desk/panel_models.hpp"

namespace burin::session {
namespace {

PanelModel exercise_model() {
    PanelModel model = idle_model();
    ActivityPanel activity{
        .title = "Ball",
        .page = "Squeeze the ball.",
    };
    activity.add<ActivityPanel::Button>(
        {{"Start", {"start"}, false, {}, Key::f5}, {"Pause", {"pause"}, true, {}, Key::f6}});
    activity.hides_scene = true;
    activity.task = ActivityPanel::Task{.state = "", .next = "Hold it so", .progress = "1 of 5"};
    activity.task->bars = {{"index", 0.7, 0.6, 0.2, 1.0, 0xd55e00}, {"together", 2.1, 2.0, 2.0, 3.0, 0xd0d4d8}};
    activity.task->hold_s = 1.0;
    activity.task->held_s = 0.5;
    activity.tables = {{"Measures so far", {"", "peak N"}, {{"index", "0.70"}}}};
    activity.help = {"The ball trains the strength of the grip."};
    model.activity = activity;
    return model;
}

constexpr ImageSize kTaskPicture{1280, 900};

Panel panel_beside_task() {
    Panel panel = Panel::create({.size = {340, 900}}).value();
    panel.lie_over(kTaskPicture);
    return panel;
}

}  // namespace

TEST(PanelTask, LiesOverThePictureBesideTheColumn) {
    Panel panel = panel_beside_task();
    static_cast<void>(panel.show(exercise_model(), 0));
    const auto task = panel.place_over_picture("task");
    ASSERT_TRUE(task);
    EXPECT_LE(task->x + task->width, kTaskPicture.width - 340) << "nothing of it below the column";
    EXPECT_LE(task->y + task->height, kTaskPicture.height);
    EXPECT_GT(task->width, 800u) << "large";
    PanelModel hidden = exercise_model();
    hidden.visible = false;
    static_cast<void>(panel.show(hidden, 16'000'000));
    EXPECT_TRUE(panel.place_over_picture("task")) << "whoever hides the panel sees the task still";
}

TEST(PanelTask, IsDrawnAnewWithEachForceThatItShows) {
    Panel panel = panel_beside_task();
    PanelModel model = exercise_model();
    const renderer::PanelMesh before = panel.show(model, 0).mesh;
    model.activity->task->bars[0].given_N = 0.62;
    EXPECT_FALSE(panel.show(model, 16'000'000).mesh == before);
    model = exercise_model();
    model.activity->task->held_s = 0.52;
    EXPECT_FALSE(panel.show(model, 32'000'000).mesh == before);
}

TEST(PanelTask, HidesWhatIsTheScenesAndKeepsTheButtons) {
    Panel panel = Panel::create({.size = {340, 1600}}).value();
    static_cast<void>(panel.show(idle_model(), 0));
    ASSERT_TRUE(panel.place_of("radius") && panel.place_of("Touch")) << "what a panel shows otherwise";
    static_cast<void>(panel.show(exercise_model(), 16'000'000));
    for (const char* label : {"radius", "Tool", "Material", "Touch", "View", "stiffness", "Measures so far"})
        EXPECT_FALSE(panel.place_of(label)) << label;
    for (const char* label : {"do start", "do pause", "State"}) EXPECT_TRUE(panel.place_of(label)) << label;
}

TEST(PanelTask, GivesWhoLeadsItTheTablesInItsOwnWindow) {
    Panel panel = Panel::create({.size = {340, 1600}}).value();
    PanelModel model = exercise_model();
    model.for_operator = true;
    static_cast<void>(panel.show(model, 0));
    EXPECT_TRUE(panel.place_of("Measures so far"));
    EXPECT_TRUE(panel.place_of("do pause"));
    EXPECT_FALSE(panel.place_of("radius"));
}

TEST(PanelTask, HasHelpOfItsOwnBeforeAllOther) {
    Panel panel = Panel::create({.size = {340, 1600}}).value();
    PanelModel model = exercise_model();
    model.show_help = true;
    static_cast<void>(panel.show(model, 0));
    ASSERT_TRUE(panel.place_of("Ball") && panel.place_of("Keys"));
    EXPECT_LT(panel.place_of("Ball")->y, panel.place_of("Keys")->y);
    EXPECT_FALSE(panel.place_of("Commands for scripts")) << "no help for what is not shown";
}

}  // namespace burin::session
