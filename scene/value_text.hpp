// SPDX-License-Identifier: MIT
// Values of a world's files in messages. Pure; any thread.
#pragma once

#include <algorithm>
#include <array>
#include <charconv>
#include <string>
#include <string_view>

namespace burin::scene {

// Returns the shortest text that is read as the same number, so that what is refused differs from its bound.
[[nodiscard]] inline std::string number_text(double value) {
    std::array<char, 32> digits{};
    return {digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr};
}

// Tells whether a name would do something to a terminal besides standing there.
[[nodiscard]] inline bool has_control_characters(std::string_view name) {
    return std::ranges::any_of(name, [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; });
}

}  // namespace burin::scene
