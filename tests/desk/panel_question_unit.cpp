// SPDX-License-Identifier: MIT
// The question about the document as the panel asks it: in every window it can be read and answered.
#include <gtest/gtest.h>

#include "desk/panel/panel.hpp"
#include "tests/desk/panel_models.hpp"

namespace burin::session {
namespace {

using What = PanelQuestion::What;

struct AskingPanel {
    Panel panel;
    PanelModel model = idle_model();
    ImageSize picture;
    Nanoseconds now_ns = 0;

    AskingPanel(What what, ImageSize over, double scale = 1.0)
        : panel(std::move(
              Panel::create({.size = {static_cast<std::uint32_t>(kPanelWidth_px * scale), over.height}, .scale = scale})
                  .value())),
          picture(over) {
        model.question = PanelQuestion{what, "bracket.burin", "kept: all 12 strokes", "bracket.burin", true};
        panel.lie_over(picture);
        show();
    }
    std::vector<CommandInput> show(std::vector<Input> inputs = {}) {
        std::vector<InputEvent> events;
        for (Input& input : inputs) events.push_back({now_ns, std::move(input)});
        panel.feed(events);
        now_ns += 16'000'000;
        return panel.show(model, now_ns).actions;
    }
    std::vector<CommandInput> key(Key key) {
        std::vector<CommandInput> given = show({KeyInput{key, KeyMotion::press, {}}});
        show({KeyInput{key, KeyMotion::release, {}}});
        return given;
    }
};

// Whether one lies to the left of the other, or above it.
bool is_before(const PixelRect& one, const PixelRect& other) {
    return one.x + one.width <= other.x || one.y + one.height <= other.y;
}

using Given = std::vector<CommandInput>;

TEST(PanelQuestion, FitsIntoEveryWindowWithItsAnswersApart) {
    for (const ImageSize window : {ImageSize{1920, 1080}, {1280, 720}, {640, 400}, {500, 360}, {360, 300}})
        for (const double scale : {1.0, 1.5, 2.0})
            for (const What what : {What::close, What::saving, What::name, What::replace}) {
                const double shown = std::min(scale, std::max(1.0, window.width / (2.0 * kPanelWidth_px)));
                AskingPanel desk(what, window, shown);
                const auto card = desk.panel.place_over_picture("question");
                ASSERT_TRUE(card);
                EXPECT_LE(card->x + card->width, window.width) << window.width << " x " << scale;
                EXPECT_LE(card->y + card->height, window.height) << window.width << " x " << scale;
                std::vector<PixelRect> answers;
                for (const char* const label : {"quit save", "save-as", "quit discard", "quit stay", "save-as ok",
                                                "save-as no", "save-as replaced", "save-as again", "name"})
                    if (const auto at = desk.panel.place_over_picture(label)) answers.push_back(*at);
                EXPECT_EQ(answers.size(), what == What::close    ? 4u
                                          : what == What::saving ? 1u
                                          : what == What::name   ? 3u
                                                                 : 2u);
                for (std::size_t i = 0; i < answers.size(); ++i) {
                    EXPECT_GE(answers[i].height, 28u);
                    EXPECT_LE(answers[i].y + answers[i].height, card->y + card->height);
                    for (std::size_t j = i + 1; j < answers.size(); ++j)
                        EXPECT_TRUE(is_before(answers[i], answers[j]) || is_before(answers[j], answers[i]))
                            << "answers " << i << " and " << j << " of " << window.width << " x " << scale;
                }
            }
}

TEST(PanelQuestion, IsAnsweredByKeysAlone) {
    AskingPanel desk(What::close, {1280, 720});
    EXPECT_EQ(desk.key(Key::escape), (Given{{"quit", {"stay"}}}));
    EXPECT_EQ(desk.key(Key::enter), (Given{{"quit", {"save"}}}));
    EXPECT_TRUE(desk.key(Key::tab).empty());
    EXPECT_EQ(desk.key(Key::enter), (Given{{"save-as", {}}}));
    EXPECT_TRUE(desk.key(Key::right).empty());
    EXPECT_EQ(desk.key(Key::keypad_enter), (Given{{"quit", {"discard"}}}));
    EXPECT_TRUE(desk.key(Key::left).empty());
    EXPECT_EQ(desk.key(Key::space), (Given{{"save-as", {}}}));
    EXPECT_TRUE(desk.key(Key::d).empty());
}

TEST(PanelQuestion, HasMouseAndKeyboardToItself) {
    for (const What what : {What::close, What::saving, What::name, What::replace}) {
        AskingPanel desk(what, {1280, 720});
        const PanelFrame& frame = desk.panel.show(desk.model, desk.now_ns);
        EXPECT_TRUE(frame.wants_mouse && frame.wants_keyboard);
        const auto undo = desk.panel.place_over_picture("force");
        ASSERT_TRUE(undo);
        const Vec2 at(undo->x + 0.5 * undo->width, undo->y + 0.5 * undo->height);
        EXPECT_TRUE(desk.show({MouseMove{at}, MouseClick{}, MouseClick{MouseButton::left, false, {}}}).empty())
            << "what lies below is not pressed";
    }
}

TEST(PanelQuestion, OfANameTakesWhatIsTypedAndAddsTheEnding) {
    AskingPanel desk(What::name, {1280, 720});
    desk.show();
    EXPECT_EQ(desk.key(Key::enter), (Given{{"save-as", {"bracket.burin"}}}));
    for (int i = 0; i < 3; ++i) desk.show();  // the field has the keyboard again
    desk.show({TextInput{"my part"}});
    EXPECT_EQ(desk.key(Key::enter), (Given{{"save-as", {"my part.burin"}}}));
    EXPECT_EQ(desk.key(Key::escape), (Given{{"save-as", {}}}));
}

TEST(PanelQuestion, ComesFromButtonsWhoseTitlesAreWhole) {
    const auto atlases_of = [](bool has_document) {
        Panel panel = std::move(Panel::create({.size = {340, 900}}).value());
        PanelModel model = idle_model();
        if (has_document) model.document = PanelDocument{"bracket.burin", "saved", "all of it is saved"};
        static_cast<void>(panel.show(model, 0));
        return panel.atlases();
    };
    EXPECT_GT(atlases_of(true), atlases_of(false)) << "the dots of \"Save as\" are no letter of Latin 1";
}

TEST(PanelQuestion, IsAskedWherePanelIsHidden) {
    AskingPanel desk(What::close, {1280, 720});
    desk.model.visible = false;
    desk.show();
    EXPECT_TRUE(desk.panel.place_over_picture("quit stay"));
    EXPECT_EQ(desk.key(Key::enter), (Given{{"quit", {"save"}}}));
}

}  // namespace
}  // namespace burin::session
