// SPDX-License-Identifier: MIT
// Names of keys, buttons and modifiers as logs, short cuts and messages write them.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "session/input/input_event.hpp"

namespace burin::session {

[[nodiscard]] std::string_view name_of(Key key);
[[nodiscard]] std::string_view name_of(MouseButton button);
[[nodiscard]] std::optional<Key> key_named(std::string_view name);
[[nodiscard]] std::optional<MouseButton> mouse_button_named(std::string_view name);

// "ctrl+shift"; empty for none.
[[nodiscard]] std::string name_of(const Modifiers& modifiers);
[[nodiscard]] std::optional<Modifiers> modifiers_named(std::string_view name);

// Return all names, for messages.
[[nodiscard]] std::span<const std::string_view> key_names();
[[nodiscard]] std::span<const std::string_view> mouse_button_names();

}  // namespace burin::session
