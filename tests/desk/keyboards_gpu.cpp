// SPDX-License-Identifier: MIT
// Real keys of three keyboards, pressed by their places in a real window: what is printed on a key is what it does.
#include <gtest/gtest.h>

#include <cstdlib>

#include "desk/input/desk_input_table.hpp"
#include "desk/present/session_window.hpp"
#include "tests/window/xvfb.hpp"

namespace burin::session {
namespace {

// X11's numbers of keys by their place on a US keyboard.
constexpr const char *kPlaceOfQ = "24", *kPlaceOfW = "25", *kPlaceOfY = "29", *kPlaceOfA = "38", *kPlaceOfZ = "52",
                     *kPlaceOf5 = "14", *kPlaceOf8 = "17", *kPlaceOf9 = "18", *kPlaceOfBracket = "34", *kCtrl = "37",
                     *kRightAlt = "108", *kEscape = "Escape";  // of one digit alone xdotool makes a digit

bool runs(const std::string& command) { return std::system((command + " >/dev/null 2>&1").c_str()) == 0; }

class Keyboards : public testing::Test {
protected:
    void SetUp() override {
        if (window::Xvfb::running().name().empty()) GTEST_SKIP() << "Xvfb does not start: install xvfb (scripts/setup)";
        if (!runs("command -v xdotool") || !runs("command -v setxkbmap"))
            GTEST_SKIP() << "xdotool or setxkbmap is not installed: install xdotool and x11-xkb-utils (scripts/setup)";
    }
    void TearDown() override {
        if (!IsSkipped()) runs("setxkbmap us");
    }

    // Presses keys at a keyboard with this layout, each with the keys that are held meanwhile, and returns what their
    // short cuts do. Escape, which has a short cut of its own on all of them, ends each of them.
    std::vector<Action> actions_at(const std::string& layout, const std::vector<std::vector<const char*>>& pressed) {
        EXPECT_TRUE(runs("setxkbmap " + layout));
        auto window = SessionWindow::open("keyboards", "", {320, 200}, window::Window::Position{0, 0});
        EXPECT_TRUE(window) << window.error().line();
        if (!window) return {};
        EXPECT_TRUE(runs("xdotool mousemove 100 100"));  // without a window manager the pointer gives the keyboard
        std::vector<Action> done;
        for (const auto& keys : pressed) {
            std::string down, up;
            for (const char* key : keys) {
                down += std::string(" keydown ") + key;
                up = std::string(" keyup ") + key + up;
            }
            EXPECT_TRUE(runs("xdotool" + down + up));
            EXPECT_TRUE(runs(std::string("xdotool key ") + kEscape));
            if (!add_until_escape(**window, done)) ADD_FAILURE() << layout << ": Escape did not arrive";
        }
        return done;
    }

private:
    static bool add_until_escape(SessionWindow& window, std::vector<Action>& done) {
        for (int i = 0; i < 600; ++i) {  // a guard for the run, not a measure
            bool ended = false;
            for (const Input& input : window.inputs(0.05)) {
                const auto* key = std::get_if<KeyInput>(&input);
                if (key == nullptr || key->motion != KeyMotion::press) continue;
                ended = ended || key->key == Key::escape;
                for (const ShortCut& s : short_cuts())
                    if (s.key == key->key && s.modifiers == key->modifiers && s.only != MouseMode::free &&
                        s.key != Key::escape)
                        done.push_back(s.action);
            }
            if (ended) return true;
        }
        return false;
    }
};

using Actions = std::vector<Action>;

}  // namespace

TEST_F(Keyboards, OfGermansUndoWithZAndHaveBracketsBehindAltGr) {
    EXPECT_EQ(
        actions_at("de", {{kCtrl, kPlaceOfY}, {kCtrl, kPlaceOfZ}, {kRightAlt, kPlaceOf8}, {kRightAlt, kPlaceOf9}}),
        (Actions{Action::undo, Action::redo, Action::smaller_radius, Action::larger_radius}));
}

TEST_F(Keyboards, OfFrenchmenUndoWithZQuitWithQAndHaveABracketBehindAltGr) {
    EXPECT_EQ(
        actions_at(
            "fr",
            {{kCtrl, kPlaceOfW}, {kCtrl, kPlaceOfZ}, {kCtrl, kPlaceOfA}, {kCtrl, kPlaceOfQ}, {kRightAlt, kPlaceOf5}}),
        (Actions{Action::undo, Action::quit, Action::smaller_radius}));
}

TEST_F(Keyboards, OfAmericansAreAsTheyWere) {
    EXPECT_EQ(actions_at("us", {{kCtrl, kPlaceOfZ}, {kCtrl, kPlaceOfY}, {kPlaceOfBracket}, {kPlaceOf5}}),
              (Actions{Action::undo, Action::redo, Action::smaller_radius, Action::tool_5}));
}

}  // namespace burin::session
