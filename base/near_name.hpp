// SPDX-License-Identifier: MIT
// Guesses which of the known names a misspelt word was meant to be, for messages. A word that is far from all of them
// was no slip of the keys, and a guess would send its reader somewhere else. Pure; any thread.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include "base/text.hpp"

namespace burin {

// Returns whether two words differ by two neighbouring letters that are exchanged: two edits, and one slip.
[[nodiscard]] inline bool are_swapped(std::string_view a, std::string_view b) {
    if (a.size() != b.size()) return false;
    const std::size_t at = static_cast<std::size_t>(std::ranges::mismatch(a, b).in1 - a.begin());
    return at + 1 < a.size() && a[at] == b[at + 1] && a[at + 1] == b[at] && a.substr(at + 2) == b.substr(at + 2);
}

// Returns the nearest name where it is at most a third of the longer word's letters away, or one letter, or two
// letters that are exchanged; else an empty text.
[[nodiscard]] inline std::string_view near_name(std::string_view wrong, std::span<const std::string_view> names) {
    if (wrong.empty() || names.empty()) return {};
    const std::string_view nearest = nearest_name(wrong, names);
    const std::size_t longer = std::max(wrong.size(), nearest.size());
    if (longer > 2 * nearest.size()) return {};
    const bool is_near = edit_distance(wrong, nearest) <= std::max<std::size_t>(1, longer / 3);
    return is_near || are_swapped(wrong, nearest) ? nearest : std::string_view{};
}

// Returns "did you mean NAME? " where a name is near, else an empty text.
[[nodiscard]] inline std::string meant_by(std::string_view wrong, std::span<const std::string_view> names) {
    const std::string_view near = near_name(wrong, names);
    return near.empty() ? std::string() : "did you mean " + std::string(near) + "? ";
}

}  // namespace burin
