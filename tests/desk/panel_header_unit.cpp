// SPDX-License-Identifier: MIT
// What stands beside the panel's title: the workpiece's name and size, and the frames a second; what stands below
// where there is no force; and what is lit where the tool only touches.
#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>

#include "compute/engine/chosen_engine.hpp"
#include "desk/live/desk.hpp"
#include "tests/desk/panel_models.hpp"
#include "tests/session/carving_setup.hpp"

namespace burin::session {
namespace {

// Returns the letters and areas of the header that begin to the right of a place.
std::vector<renderer::PanelVertex> header_of(const renderer::PanelMesh& mesh, float left_px = 0.0f) {
    std::vector<renderer::PanelVertex> header;
    std::ranges::copy_if(mesh.vertices, std::back_inserter(header),
                         [left_px](const renderer::PanelVertex& v) { return v.x > left_px && v.y < 40.0f; });
    return header;
}

}  // namespace

TEST(PanelHeader, KeepsALongNameOffTheFramesPerSecond) {
    const auto at_the_right = [](const std::string& name) {
        PanelModel model = idle_model();
        model.workpiece.name = name;
        Panel panel = Panel::create({.size = {340, 1600}}).value();
        return header_of(panel.show(model, 0).mesh, 284.0f).size();
    };
    PanelModel no_frames = idle_model();
    no_frames.figures.frames_per_s = 0.0;
    Panel panel = Panel::create({.size = {340, 1600}}).value();
    EXPECT_GT(at_the_right("ball"), header_of(panel.show(no_frames, 0).mesh, 284.0f).size());
    EXPECT_EQ(at_the_right("a-scan-of-a-bracket-with-two-holes-of-eight-millimetres-mended.ply"), at_the_right("ball"));
}

TEST(PanelHeader, ShowsTheWorkpiecesSizeInMillimetres) {
    SessionSetup options = carving_setup();
    options.carve.workpiece = {"block:0.05,0.04,0.0305", 32, false};
    options.carve.engine = compute::EngineChoice::cpu;
    SimulatedClock clock;
    const auto desk = Desk::create(options, session_wall(options.desk).value(), clock).value();
    desk->step({16'000'000, 16'000'000, {}}, {.size = {1280, 900}}, haptics::ToolState{},
               [](const scene::SceneThread::Order&) {});
    Panel alike = Panel::create({.size = desk->panel_on(0).value().size}).value();
    alike.lie_over({1280, 900});
    PanelModel model;
    model.workpiece = {"block:0.05,0.04,0.0305", "50 x 40 x 30.5 mm, 32 cells"};
    const std::vector<renderer::PanelVertex> expected = header_of(alike.show(model, 0).mesh);
    EXPECT_TRUE(header_of(desk->panel_on(0).value().mesh) == expected);
    model.workpiece.size = "50 x 40 x 30 mm, 32 cells";
    EXPECT_FALSE(header_of(alike.show(model, 16'000'000).mesh) == expected);
}

TEST(PanelHeader, EnablesTheAmplifiersWhereTheDeviceReportsAFault) {
    PanelModel model = no_force_model();
    Panel panel = Panel::create({.size = {340, 1600}}).value();
    static_cast<void>(panel.show(model, 0));
    EXPECT_FALSE(panel.place_of("amplifiers")) << "they have nothing to do with this cause";
    model.touch.cause = haptics::GateCause::device_fault;
    static_cast<void>(panel.show(model, 16'000'000));
    const auto at = panel.place_of("amplifiers");
    ASSERT_TRUE(at);
    const Vec2 middle(at->x + 0.5 * at->width, at->y + 0.5 * at->height);
    const std::vector<InputEvent> press{{32'000'000, MouseMove{middle}},
                                        {32'000'000, MouseClick{MouseButton::left, true, {}}},
                                        {32'000'000, MouseClick{MouseButton::left, false, {}}}};
    panel.feed(press);
    EXPECT_EQ(panel.show(model, 32'000'000).actions, (std::vector<CommandInput>{{"amplifiers", {"on"}}}));
}

// Cut was lit, and what the tool did was touch.
TEST(PanelOperations, AreNotLitWhileTheToolOnlyTouches) {
    const auto look = [](compute::Operation operation, bool only_touch) {
        PanelModel model = idle_model();
        model.operation = operation;
        model.only_touch = only_touch;
        Panel panel = Panel::create({.size = {340, 1600}}).value();
        static_cast<void>(panel.show(model, 0));
        return panel.show(model, 16'000'000).mesh;
    };
    EXPECT_FALSE(look(compute::Operation::cut, false) == look(compute::Operation::smooth, false));
    EXPECT_FALSE(look(compute::Operation::cut, true) == look(compute::Operation::cut, false));
    EXPECT_TRUE(look(compute::Operation::cut, true) == look(compute::Operation::smooth, true)) << "none of them is";
}

}  // namespace burin::session
