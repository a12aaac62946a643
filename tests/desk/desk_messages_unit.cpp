// SPDX-License-Identifier: MIT
// What a person at a desk is told, and where it stands: over the picture, where it moves no widget.
#include <map>

#include "desk/panel/panel_sections.hpp"
#include "session/notices/message_log.hpp"
#include "tests/desk/mouse_desk.hpp"
#include "tests/desk/panel_models.hpp"

namespace burin::session {
namespace {

constexpr ImageSize kPicture{1280, 720};

Panel panel_over_picture() {
    Panel panel = Panel::create({.size = {340, 720}}).value();
    panel.lie_over(kPicture);
    return panel;
}

PanelNote note_told(const std::string& text, MessageKind kind) { return {text, kind, 1, 0}; }

std::map<std::string, Vec2> places_in(const Panel& panel) {
    std::map<std::string, Vec2> places;
    for (const std::string& label : panel.labels())
        if (const auto at = panel.place_of(label); at && at->x < 340) places[label] = {at->x, at->y};
    return places;
}

std::vector<CommandInput> click_at(Panel& panel, const PanelModel& model, const Vec2& picture_px, Nanoseconds time_ns) {
    const std::vector<InputEvent> click{{time_ns, MouseMove{picture_px}},
                                        {time_ns, MouseClick{MouseButton::left, true, {}}},
                                        {time_ns, MouseClick{MouseButton::left, false, {}}}};
    panel.feed(click, {{kPicture.width - 340.0, 0.0}, {1.0, 1.0}});
    return panel.show(model, time_ns).actions;
}

Vec2 middle_of(const PixelRect& at) { return {at.x + 0.5 * at.width, at.y + 0.5 * at.height}; }

std::size_t times_told(const Desk& desk) { return desk.session().notices().log().all().size(); }

}  // namespace

// Two warnings of late pictures pushed the cards of the panel down while the hand was on its way to a button.
TEST(DeskMessages, MoveNoWidget) {
    for (const bool over_picture : {true, false}) {
        Panel panel = Panel::create({.size = {340, 1600}}).value();
        if (over_picture) panel.lie_over({1280, 1600});
        PanelModel model = idle_model();
        static_cast<void>(panel.show(model, 0));
        const auto before = places_in(panel);
        model.warnings = {"Picture 61 ms behind the hand; 15 is noticed", "Picture 40 ms behind the head"};
        model.notes = {note_told("wrote part.stl", MessageKind::info), note_told("lost", MessageKind::error)};
        model.log = model.notes;
        model.touch.cause = haptics::GateCause::device_fault;
        static_cast<void>(panel.show(model, 16'000'000));
        auto after = places_in(panel);
        std::erase_if(after, [&](const auto& one) { return !before.contains(one.first); });  // of the messages
        EXPECT_EQ(after, before) << over_picture;
    }
}

TEST(DeskMessages, StandInThePicturesCornerThatIsFreeOfThePanel) {
    Panel panel = panel_over_picture();
    PanelModel model = idle_model();
    EXPECT_EQ(panel.show(model, 0).size, (ImageSize{340, 720})) << "nothing lies over the picture";
    model.notes = {note_told("first", MessageKind::warning), note_told("second", MessageKind::info)};
    const PanelFrame& frame = panel.show(model, 16'000'000);
    EXPECT_EQ(frame.size, kPicture);
    const auto first = panel.place_over_picture("message 0"), second = panel.place_over_picture("message 1");
    ASSERT_TRUE(first && second);
    EXPECT_LT(first->x + first->width, kPicture.width - 340);
    EXPECT_LT(first->y, second->y) << "the newest is at the bottom";
    EXPECT_GT(second->y + second->height, 680u);
    // The panel is where it was, hidden or not what lies over the picture stays.
    model.visible = false;
    EXPECT_FALSE(panel.show(model, 32'000'000).mesh.indices.empty());
    EXPECT_FALSE(panel.place_of("undo"));
    EXPECT_TRUE(panel.place_over_picture("message 1"));
}

TEST(DeskMessages, AnErrorIsPutAwayByAClickAndInfoTakesNoMouse) {
    Panel panel = panel_over_picture();
    PanelModel model = idle_model();
    model.notes = {note_told("the disk is full", MessageKind::error), note_told("wrote it", MessageKind::info)};
    for (int i = 0; i < 4; ++i) static_cast<void>(panel.show(model, i));
    const Vec2 info = middle_of(*panel.place_over_picture("message 1"));
    EXPECT_TRUE(click_at(panel, model, info, 16'000'000).empty());
    EXPECT_FALSE(panel.show(model, 17'000'000).wants_mouse) << "a stroke may begin there";
    const Vec2 error = middle_of(*panel.place_over_picture("message 0"));
    EXPECT_EQ(click_at(panel, model, error, 32'000'000), (std::vector<CommandInput>{{"put-away", {}}}));
}

TEST(DeskMessages, GoAfterAWhileByTheirKindAndAreCounted) {
    testing::internal::CaptureStderr();
    MessageLog log;
    log.begin_step(1'000'000'000);
    log.notify("saved", MessageKind::info);
    log.notify("nothing was touched", MessageKind::warning);
    log.notify("lost", MessageKind::error);
    EXPECT_EQ(log.next_change_ns(), 1'000'000'000 + MessageLog::kInfo_ns);
    log.begin_step(2'000'000'000);
    log.notify("nothing was touched", MessageKind::warning);
    ASSERT_EQ(log.all().size(), 3u);
    EXPECT_EQ(log.all().back().count, 2u);
    const auto shown = [&] {
        std::string texts;
        for (const Message& message : log.all())
            if (log.is_shown(message)) texts += message.text + "|";
        return texts;
    };
    EXPECT_EQ(shown(), "saved|lost|nothing was touched|");
    log.begin_step(7'000'000'000);
    EXPECT_EQ(shown(), "lost|nothing was touched|");
    log.begin_step(100'000'000'000);
    EXPECT_EQ(shown(), "lost|");
    EXPECT_FALSE(log.next_change_ns());
    log.dismiss();
    EXPECT_EQ(shown(), "");
    log.notify("nothing was touched", MessageKind::warning);
    EXPECT_EQ(log.all().back().count, 1u) << "the other is over";
    EXPECT_EQ(log.all().size(), 4u) << "all can be read again";
    static_cast<void>(testing::internal::GetCapturedStderr());
}

TEST(DeskMessages, AreKeptInACardOfOneHeight) {
    const auto state_at = [](std::size_t messages) {
        Panel panel = Panel::create({.size = {340, 1600}}).value();
        PanelModel model = idle_model();
        for (std::size_t i = 0; i < messages; ++i)
            model.log.push_back(note_told("message of some length, " + std::to_string(i), MessageKind::warning));
        static_cast<void>(panel.show(model, 0));
        return panel.place_of("State").value().y;
    };
    EXPECT_EQ(state_at(0), state_at(1));
    EXPECT_EQ(state_at(0), state_at(100));
}

TEST(DeskMessages, EscapePutsThemAway) {
    MouseDesk desk(plate(12.0));
    desk.move_to({30, 60});
    static_cast<void>(
        desk.told_while({{MouseClick{}, 8'000'000}, {MouseClick{MouseButton::left, false, {}}, 50'000'000}}));
    desk.rest(0.1);
    ASSERT_TRUE(desk.desk->panel_on(0));
    EXPECT_EQ(desk.desk->panel_on(0)->size, MouseDesk::kWindow) << "the panel is hidden, the message is not";
    desk.run({{KeyInput{Key::escape, KeyMotion::press, {}}, 8'000'000}}, 100'000'000);
    EXPECT_TRUE(desk.desk->panel_on(0)->mesh.indices.empty());
}

// Whoever leads a simulated hand with a mouse can do nothing about it, and feels nothing that could be late.
TEST(DeskMessages, AreSilentOfLatePicturesForAMouse) {
    MouseDesk desk(plate(12.0));
    PanelMeasured late;
    late.numbers.emplace();
    late.numbers->warnings = {"Picture 61 ms behind the hand; 15 is noticed"};
    late.numbers->figures.frames_per_s = 12.0;
    desk.desk->measure_again(late);
    desk.move_to({640, 360});
    desk.rest(2.0);
    EXPECT_TRUE(desk.desk->panel_on(0)->mesh.indices.empty());
}

TEST(DeskMessages, AStrokeThatRemovesNothingSaysWhy) {
    MouseDesk desk(plate(12.0), "ball:0.002", 60, 32);
    const auto told_of = [&](const std::vector<Vec3>& places_mm) {
        testing::internal::CaptureStderr();
        desk.stroke(places_mm);
        desk.rest(1.0);
        return testing::internal::GetCapturedStderr();
    };
    EXPECT_EQ(told_of({{20, 30, 12}, {60, 30, 12}}), "");
    EXPECT_EQ(desk.strokes(), 1u);
    desk.run({{CommandInput{"strength", {"0.02"}}, 8'000'000}});
    const std::string shallow = told_of({{20, 45, 12}, {60, 45, 12}});
    EXPECT_NE(shallow.find("nothing was removed: the stroke is 0.04 mm deep"), std::string::npos) << shallow;
    desk.run({{CommandInput{"strength", {"0.3"}}, 8'000'000}, {CommandInput{"tool-5", {}}, 8'000'000}});
    EXPECT_NE(told_of({{20, 15, 12}, {60, 15, 12}}).find("only touches"), std::string::npos);
    EXPECT_EQ(desk.strokes(), 1u);
    EXPECT_GE(times_told(*desk.desk), 2u);
}

TEST(DeskLetters, OfOtherScriptsAreShownWhereAFontHasThem) {
    Panel panel = Panel::create({.size = {340, 720}}).value();
    PanelModel model = idle_model();
    static_cast<void>(panel.show(model, 0));
    if (!panel.notice().empty()) GTEST_SKIP() << "Roboto, which has Cyrillic, is not installed: " << panel.notice();
    const std::uint64_t before = panel.atlases();
    model.workpiece.name = "\xD0\x94\xD0\xB5\xD1\x82\xD0\xB0\xD0\xBB\xD1\x8C \xE2\x84\x96 7.stl";
    const renderer::PanelMesh cyrillic = panel.show(model, 16'000'000).mesh;
    EXPECT_EQ(panel.atlases(), before + 1);
    EXPECT_EQ(panel.notice(), "");
    model.workpiece.name = "?????? ? 7.stl";
    EXPECT_NE(panel.show(model, 32'000'000).mesh, cyrillic);
    EXPECT_EQ(panel.atlases(), before + 1) << "letters stay";
    EXPECT_EQ(panel::letters_beyond_latin("a\xC3\xA9\xE2\x84\x96\xF0\x9F\x98\x80"),
              (std::vector<std::uint32_t>{0x2116}));
    // A letter of no script: private use.
    model.workpiece.name = "\xEE\xA0\x80.stl";
    static_cast<void>(panel.show(model, 48'000'000));
    EXPECT_EQ(panel.atlases(), before + 2);
}

TEST(DeskTips, SayWhatACommandDoesAndItsKeys) {
    EXPECT_EQ(panel::tip_of("undo"), "Undo (Ctrl+Z)");
    EXPECT_EQ(panel::tip_of("Tool"), "") << "a card is no command";
    for (const char* label : {"radius", "operation cut", "stiffness", "export", "stereo-mode", "first-steps"})
        EXPECT_GT(panel::tip_of(label).size(), 8u) << label;
}

TEST(DeskTips, WhatCannotBeDoneIsGreyWithItsReason) {
    PanelModel model = idle_model();
    model.mouse = MouseMode::surface;
    for (const char* label : {"undo", "redo", "stiffness", "swap-eyes", "eye-distance"}) {
        Panel panel = Panel::create({.size = {340, 1600}}).value();
        panel.lie_over({1280, 1600});
        static_cast<void>(panel.show(model, 0));
        const auto at = panel.place_over_picture(label);
        ASSERT_TRUE(at) << label;
        EXPECT_TRUE(click_at(panel, model, middle_of(*at), 16'000'000).empty()) << label;
        for (int i = 2; i < 8; ++i) static_cast<void>(panel.show(model, i * 16'000'000));
        EXPECT_FALSE(panel.place_over_picture("tip")) << label;
        const PanelFrame& resting = panel.show(model, 140'000'000);
        ASSERT_TRUE(resting.changes_ns) << label << ": the session has to wake for it";
        static_cast<void>(panel.show(model, *resting.changes_ns));
        const auto tip = panel.place_over_picture("tip");
        ASSERT_TRUE(tip) << label;
        EXPECT_LE(tip->x + tip->width, 940u) << label << ": beside the panel";
    }
}

}  // namespace burin::session
