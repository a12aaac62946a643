// SPDX-License-Identifier: MIT
// Tables of descriptors: one for each enumerator, which names it and says what there is to say of it.
// Pure; any thread.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace burin {

// Makes a table of what a function says of each enumerator, in their order. The function is a switch over the
// enumerators, so that the compiler warns of a missing case, and returns a descriptor without a name for other values.
template <typename Enum, auto described>
[[nodiscard]] consteval auto table_of() {
    constexpr std::size_t kCount = [] {
        std::size_t count = 0;
        while (!described(static_cast<Enum>(count)).name.empty()) ++count;
        return count;
    }();
    std::array<decltype(described(Enum{})), kCount> table;
    for (std::size_t i = 0; i < kCount; ++i) table[i] = described(static_cast<Enum>(i));
    return table;
}

// Lists words as a sentence does: "cut, fill or paint".
[[nodiscard]] inline std::string alternatives(std::span<const std::string> words) {
    std::string text;
    for (std::size_t i = 0; i < words.size(); ++i) {
        if (i > 0) text += i + 1 == words.size() ? " or " : ", ";
        text += words[i];
    }
    return text;
}
// Returns the names in a table of descriptors.
[[nodiscard]] std::vector<std::string> names_in(const auto& descriptors) {
    std::vector<std::string> names;
    for (const auto& descriptor : descriptors) names.emplace_back(descriptor.name);
    return names;
}

}  // namespace burin
