// SPDX-License-Identifier: MIT
#include "desk/present/key_reader.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "session/input/input_keys.hpp"

namespace burin::session {
namespace {

// Maps a key's name from the window library to the log's, which differ where the log's are easier to type.
std::optional<Key> key_of(std::string name) {
    static const std::vector<std::pair<std::string, std::string>> others{{"'", "apostrophe"},
                                                                         {",", "comma"},
                                                                         {"-", "minus"},
                                                                         {".", "period"},
                                                                         {"/", "slash"},
                                                                         {";", "semicolon"},
                                                                         {"=", "equal"},
                                                                         {"[", "left-bracket"},
                                                                         {"]", "right-bracket"},
                                                                         {"\\", "backslash"},
                                                                         {"`", "grave"},
                                                                         {"left_shift", "shift"},
                                                                         {"right_shift", "shift"},
                                                                         {"left_control", "ctrl"},
                                                                         {"right_control", "ctrl"},
                                                                         {"left_alt", "alt"},
                                                                         {"right_alt", "alt"},
                                                                         {"left_super", "super"},
                                                                         {"right_super", "super"},
                                                                         {"keypad_decimal", "keypad-period"}};
    const auto other = std::ranges::find(others, name, &std::pair<std::string, std::string>::first);
    if (other != others.end()) return key_named(other->second);
    std::ranges::replace(name, '_', '-');
    return key_named(name);
}

bool is_letter(Key key) { return key <= Key::z; }
bool is_digit(Key key) { return key >= Key::digit_0 && key <= Key::digit_9; }
bool is_sign(Key key) { return key >= Key::apostrophe && key <= Key::grave; }

// Returns whether a label is a Latin letter beyond ASCII: U+00C0 to U+024F, which UTF-8 begins with 0xC3 to 0xC9.
bool is_other_latin(const std::string& label) {
    if (label.empty()) return false;
    const auto first = static_cast<unsigned char>(label[0]);
    return first >= 0xc3 && first <= 0xc9;
}

// Returns the key that is meant by a key at this position with this label; nothing for one that is no key here.
std::optional<Key> key_of(const std::string& position, const std::string& label) {
    const std::optional<Key> there = key_of(position);
    const bool is_character = there && (is_letter(*there) || is_sign(*there));
    // Beside the left Shift, and beside Enter: keys that a US keyboard does not have.
    if (there ? !is_character : !position.starts_with("world_")) return there;
    if (label.size() == 1)
        if (const auto labelled = key_of(label); labelled && (is_letter(*labelled) || is_sign(*labelled)))
            return labelled;
    if (!there || !is_letter(*there)) return there;
    const bool is_ascii = label.size() == 1;  // a sign without a name
    return is_ascii || is_other_latin(label) ? std::nullopt : there;
}

std::string utf8_of(char32_t c) {
    std::string text;
    const auto byte = [&](std::uint32_t value) { text.push_back(static_cast<char>(value)); };
    const auto code = static_cast<std::uint32_t>(c);
    if (code < 0x80) {
        byte(code);
    } else if (code < 0x800) {
        byte(0xc0 | (code >> 6));
        byte(0x80 | (code & 0x3f));
    } else if (code < 0x10000) {
        byte(0xe0 | (code >> 12));
        byte(0x80 | ((code >> 6) & 0x3f));
        byte(0x80 | (code & 0x3f));
    } else {
        byte(0xf0 | (code >> 18));
        byte(0x80 | ((code >> 12) & 0x3f));
        byte(0x80 | ((code >> 6) & 0x3f));
        byte(0x80 | (code & 0x3f));
    }
    return text;
}

// Returns the modifiers that a short cut sees: Shift that makes a digit of a sign is no modifier of that digit.
Modifiers modifiers_with(Key key, const window::KeyEvent& event) {
    Modifiers held = modifiers_of(event.held);
    if (is_digit(key) && !held.ctrl && !held.alt && !held.super && !event.label.empty() && event.label != event.key)
        held.shift = false;
    return held;
}

}  // namespace

Modifiers modifiers_of(const window::Modifiers& held) { return {held.shift, held.control, held.alt, held.super}; }

// Returns the key that goes down; nothing where there is none.
std::optional<Key> KeyReader::pressed_key(const window::KeyEvent& event) const {
    const std::optional<Key> key = key_of(event.key, event.label);
    // Where the right Alt is AltGr, it is no Alt to what is pressed with it.
    const bool alt_gr = right_alt_ && !event.held.alt;
    if (key && alt_gr && (is_letter(*key) || is_sign(*key) || is_digit(*key))) return std::nullopt;
    return key;
}

std::vector<Input> KeyReader::read(const window::KeyEvent& event) {
    before_text_.reset();
    if (event.key == "right_alt") right_alt_ = event.press != window::Press::up;
    const auto down = down_.find(event.key);
    if (event.press == window::Press::up) {
        if (down == down_.end()) return {};
        const Key key = down->second;
        down_.erase(down);
        return {KeyInput{key, KeyMotion::release, modifiers_with(key, event)}};
    }
    const bool repeats = event.press == window::Press::repeat && down != down_.end();
    const std::optional<Key> key = repeats ? std::optional(down->second) : pressed_key(event);
    if (!key) return {};
    if (event.key != "unknown") down_[event.key] = *key;
    before_text_ = key;
    return {KeyInput{*key, repeats ? KeyMotion::repeat : KeyMotion::press, modifiers_with(*key, event)}};
}

std::vector<Input> KeyReader::read(const window::TextEvent& event) {
    const std::optional<Key> pressed = std::exchange(before_text_, std::nullopt);
    const Input text = TextInput{utf8_of(event.character)};
    const std::optional<Key> bracket = event.character == U'['   ? std::optional(Key::left_bracket)
                                       : event.character == U']' ? std::optional(Key::right_bracket)
                                                                 : std::nullopt;
    if (!bracket || pressed == bracket) return {text};
    return {KeyInput{*bracket, KeyMotion::press, {}}, text, KeyInput{*bracket, KeyMotion::release, {}}};
}

}  // namespace burin::session
