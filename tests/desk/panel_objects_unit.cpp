// SPDX-License-Identifier: MIT
// The panel's rows of a world's object: it can be turned, what a row does is said in words, and several colours are
// called that.
#include <gtest/gtest.h>

#include "desk/panel/panel_sections.hpp"
#include "session/objects/object_turn.hpp"
#include "session/state/command_table.hpp"
#include "tests/desk/panel_models.hpp"

namespace burin::session {
namespace {

PanelModel model_of_stone() {
    PanelModel model = idle_model();
    model.carves = false;
    model.object = PanelObject{};
    model.object->name = "stone";
    model.object_names = {"stone"};
    return model;
}

std::vector<CommandInput> pressed_at(Panel& panel, const PanelModel& model, const std::string& label, double part) {
    static_cast<void>(panel.show(model, 0));
    const auto at = panel.place_of(label);
    if (!at) {
        ADD_FAILURE() << label << " is not shown";
        return {};
    }
    const Vec2 place(at->x + part * at->width, at->y + 0.5 * at->height);
    const std::vector<InputEvent> events{{1, MouseMove{place}}, {1, MouseClick{MouseButton::left, true, {}}}};
    panel.feed(events);
    return panel.show(model, 1).actions;
}

}  // namespace

TEST(PanelObjects, AnObjectCanBeTurnedAboutEachOfThreeAxes) {
    const PanelModel model = model_of_stone();
    const std::array<std::pair<const char*, std::size_t>, 3> rows{
        {{"object orientation", 0}, {"object orientation Nod", 1}, {"object orientation Lean", 2}}};
    for (const auto& [label, angle] : rows) {
        Panel panel = Panel::create({.size = {340, 1600}}).value();
        const auto given = pressed_at(panel, model, label, 0.75);
        ASSERT_EQ(given.size(), 1u) << label;
        const auto command = parse_command(given.front());
        ASSERT_TRUE(command) << command.error().line();
        const auto& edit = std::get<EditObject>(*command);
        EXPECT_EQ(edit.property, scene::ObjectProperty::orientation);
        const Vec3 axis(edit.value[0], edit.value[1], edit.value[2]);
        const ObjectTurn turned = turn_of(glm::angleAxis(edit.value[3], glm::normalize(axis)));
        for (std::size_t i = 0; i < 3; ++i) {
            if (i == angle)
                EXPECT_GT(turned.at(i), 5.0) << label;
            else
                EXPECT_NEAR(turned.at(i), 0.0, 1e-3) << label;
        }
    }
}

TEST(PanelObjects, TheRowsOfAnObjectSayInWordsWhatTheyDo) {
    for (const scene::PropertyDescriptor& property : scene::object_properties()) {
        const std::string tip = panel::tip_of("object " + std::string(property.name));
        EXPECT_GT(tip.size(), 20u) << property.name;
        EXPECT_EQ(tip.find("stiffness, damping"), std::string::npos) << "a raw text: " << tip;
    }
    EXPECT_EQ(panel::tip_of("object scale"), "How large the object is: 1 as its file has it");
}

TEST(PanelObjects, SeveralColoursAreNotShownAsOne) {
    PanelModel model = model_of_stone();
    Panel panel = Panel::create({.size = {340, 1600}}).value();
    static_cast<void>(panel.show(model, 0));
    const auto plain = panel.place_of("object colour");
    model.object->own_colours = true;
    static_cast<void>(panel.show(model, 1));
    const auto several = panel.place_of("object colour");
    ASSERT_TRUE(plain && several);
    EXPECT_GT(several->y, plain->y) << "a line says that it has its own";
}

}  // namespace burin::session
