// SPDX-License-Identifier: MIT
// Names of keys, buttons and modifiers as logs, short cuts and messages write them, and the nearest name to a wrong one.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "app/session/input_event.hpp"

namespace burin {

[[nodiscard]] std::string_view name_of(Key key);
[[nodiscard]] std::string_view name_of(MouseButton button);
[[nodiscard]] std::optional<Key> key_named(std::string_view name);
[[nodiscard]] std::optional<MouseButton> mouse_button_named(std::string_view name);

// "ctrl+shift"; empty for none.
[[nodiscard]] std::string name_of(const Modifiers& modifiers);
[[nodiscard]] std::optional<Modifiers> modifiers_named(std::string_view name);

// All names of keys, for messages.
[[nodiscard]] std::span<const std::string_view> key_names();
[[nodiscard]] std::span<const std::string_view> mouse_button_names();

// The name with the fewest insertions, deletions and replacements (Levenshtein 1966); the first of equals. Only the first 64
// characters count. names must not be empty.
[[nodiscard]] std::string_view nearest_name(std::string_view wrong, std::span<const std::string_view> names);

}  // namespace burin
