// SPDX-License-Identifier: MIT
// Keys of keyboards that are not American: what is printed on a key is what it does. The tables hold what X11 tells of
// these layouts (setxkbmap de, fr, ru, us): position, label, text.
#include <gtest/gtest.h>

#include "desk/input/desk_input_table.hpp"
#include "desk/present/key_reader.hpp"

namespace burin::session {
namespace {

using window::KeyEvent;
using window::Press;
using window::TextEvent;

// A keyboard at which somebody types, and the actions that short cuts make of it.
struct Typist {
    KeyReader reader;
    std::vector<Input> inputs = {};

    void add(const std::vector<Input>& more) { inputs.insert(inputs.end(), more.begin(), more.end()); }
    void key(const char* position, const char* label, Press press, window::Modifiers held = {}) {
        add(reader.read(KeyEvent{position, label, press, held}));
    }
    void tap(const char* position, const char* label, window::Modifiers held = {}, char32_t text = 0) {
        key(position, label, Press::down, held);
        if (text != 0) add(reader.read(TextEvent{text}));
        key(position, label, Press::up, held);
    }
    [[nodiscard]] std::vector<Action> actions() const {
        std::vector<Action> done;
        for (const Input& input : inputs) {
            const auto* key = std::get_if<KeyInput>(&input);
            if (key == nullptr || key->motion == KeyMotion::release) continue;
            for (const ShortCut& s : short_cuts())
                if (s.key == key->key && s.modifiers == key->modifiers && s.only != MouseMode::free)
                    done.push_back(s.action);
        }
        return done;
    }
    [[nodiscard]] std::string text() const {
        std::string all;
        for (const Input& input : inputs)
            if (const auto* typed = std::get_if<TextInput>(&input)) all += typed->utf8;
        return all;
    }
    // Every key that went down has come up again, and none twice.
    [[nodiscard]] bool is_at_rest() const {
        std::map<Key, int> down;
        for (const Input& input : inputs)
            if (const auto* key = std::get_if<KeyInput>(&input)) {
                if (key->motion == KeyMotion::press && ++down[key->key] != 1) return false;
                if (key->motion == KeyMotion::release && --down[key->key] != 0) return false;
            }
        return true;
    }
};

constexpr window::Modifiers kCtrl{.control = true};
constexpr window::Modifiers kShift{.shift = true};
using Actions = std::vector<Action>;

}  // namespace

TEST(KeyReader, UndoesWithTheKeyLabelledZ) {
    Typist german, french, american;
    german.tap("y", "z", kCtrl);
    EXPECT_EQ(german.actions(), Actions{Action::undo});
    german.tap("z", "y", kCtrl);
    EXPECT_EQ(german.actions(), (Actions{Action::undo, Action::redo}));
    french.tap("w", "z", kCtrl);
    french.tap("z", "w", kCtrl);  // says nothing
    EXPECT_EQ(french.actions(), Actions{Action::undo});
    american.tap("z", "z", kCtrl);
    american.tap("y", "y", kCtrl);
    EXPECT_EQ(american.actions(), (Actions{Action::undo, Action::redo}));
}

TEST(KeyReader, DoesNotCloseWithTheKeyLabelledA) {
    Typist french;
    french.tap("q", "a", kCtrl);
    EXPECT_EQ(french.actions(), Actions{});
    french.tap("a", "q", kCtrl);
    EXPECT_EQ(french.actions(), Actions{Action::quit});
    french.tap(";", "m", {}, U'm');
    EXPECT_EQ(french.actions(), (Actions{Action::quit, Action::next_stereo_mode}));
    french.tap("m", ",", {}, U',');
    EXPECT_EQ(french.actions().back(), Action::roll_left) << "what is printed there is a comma";
}

TEST(KeyReader, TakesBracketsAsTheyAreTyped) {
    Typist german;
    german.key("right_alt", "", Press::down);
    german.tap("8", "8", {}, U'[');
    german.tap("9", "9", {}, U']');
    german.key("right_alt", "", Press::up);
    EXPECT_EQ(german.actions(), (Actions{Action::smaller_radius, Action::larger_radius}));
    EXPECT_EQ(german.text(), "[]");
    EXPECT_TRUE(german.is_at_rest());
    Typist american;
    american.tap("[", "[", {}, U'[');
    EXPECT_EQ(american.actions(), Actions{Action::smaller_radius}) << "once, though it comes as a key and as text";
    EXPECT_TRUE(american.is_at_rest());
}

TEST(KeyReader, TakesNoDigitBehindAltGr) {
    Typist french;
    french.key("right_alt", "", Press::down);
    french.tap("5", "(", {}, U'[');
    french.tap("4", "'", {}, U'{');
    french.tap("e", "e", {}, U'€');
    french.key("right_alt", "", Press::up);
    EXPECT_EQ(french.actions(), Actions{Action::smaller_radius}) << "and neither Only touch nor Smooth";
    EXPECT_EQ(french.text(), "[{€");
    EXPECT_TRUE(french.is_at_rest());
}

// With a US layout the right Alt is an Alt.
TEST(KeyReader, LeavesTheRightAltOfAnAmericanKeyboardAsItIs) {
    Typist american;
    american.key("right_alt", "", Press::down);
    american.tap("5", "5", {.alt = true});
    american.key("right_alt", "", Press::up, {.alt = true});
    const auto* five = std::get_if<KeyInput>(&american.inputs.at(1));
    ASSERT_NE(five, nullptr);
    EXPECT_EQ(five->key, Key::digit_5);
    EXPECT_TRUE(five->modifiers.alt);
}

TEST(KeyReader, TakesDigitsThatNeedShiftWithAndWithoutIt) {
    Typist french;
    french.tap("2", "é", {}, U'é');
    french.tap("2", "é", kShift, U'2');
    EXPECT_EQ(french.actions(), (Actions{Action::tool_2, Action::tool_2}));
    Typist american;
    american.tap("2", "2", kShift, U'@');
    EXPECT_EQ(american.actions(), Actions{});
    Typist with_ctrl;
    with_ctrl.tap("2", "é", {.shift = true, .control = true});
    EXPECT_EQ(with_ctrl.actions(), Actions{Action::view_left});
}

TEST(KeyReader, TakesKeysWithoutLatinLettersByTheirPosition) {
    Typist russian;
    russian.tap("z", "я", kCtrl);
    EXPECT_EQ(russian.actions(), Actions{Action::undo});
    Typist turkish;  // two kinds of i, of which one is no Latin letter that any short cut has
    turkish.tap("i", "ı");
    EXPECT_TRUE(turkish.inputs.empty());
    turkish.tap("'", "i");
    ASSERT_FALSE(turkish.inputs.empty());
    EXPECT_EQ(std::get<KeyInput>(turkish.inputs.front()).key, Key::i);
}

TEST(KeyReader, LetsAKeyGoThatChangedItsLabelMeanwhile) {
    Typist typist;
    typist.key("w", "w", Press::down);
    typist.key("w", "w", Press::repeat);
    typist.key("w", "z", Press::up);
    ASSERT_EQ(typist.inputs.size(), 3u);
    EXPECT_EQ(std::get<KeyInput>(typist.inputs[2]).key, Key::w);
    EXPECT_EQ(std::get<KeyInput>(typist.inputs[2]).motion, KeyMotion::release);
    typist.key("left", "", Press::up);
    EXPECT_EQ(typist.inputs.size(), 3u) << "what did not go down does not come up";
}

}  // namespace burin::session
