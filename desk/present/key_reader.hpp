// SPDX-License-Identifier: MIT
// Reads a window's key and text events as those of a session, whatever keyboard the user has.
//
// A key is what is printed on it: Ctrl+Z is the key labelled Z, wherever it lies. The rest follows:
//   letters, signs   by label. A key whose letters are not Latin ones (Greek, Cyrillic) by its position, since that
//                    keyboard has no Latin label; one with another Latin letter, such as an accented one, is no key
//   digits           by position: where they need Shift (French), they work with it and without it
//   AltGr            makes another sign of a key, which comes as text: the key itself is not pressed
//   [ and ]          are short cuts that many keyboards have behind AltGr, so the typed sign presses them as well
// A key goes up as the one it went down as, even if the keyboard's layout has changed meanwhile.
//
// No clock, no window; one thread at a time.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "session/input/input_event.hpp"
#include "window/window_event.hpp"

namespace burin::session {

class KeyReader {
public:
    [[nodiscard]] std::vector<Input> read(const window::KeyEvent& event);
    [[nodiscard]] std::vector<Input> read(const window::TextEvent& event);

private:
    [[nodiscard]] std::optional<Key> pressed_key(const window::KeyEvent& event) const;

    std::map<std::string, Key> down_;  // by position
    bool right_alt_ = false;           // is down
    std::optional<Key> before_text_;   // the press in the event before, whose text comes next
};

[[nodiscard]] Modifiers modifiers_of(const window::Modifiers& held);

}  // namespace burin::session
