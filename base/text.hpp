// SPDX-License-Identifier: MIT
// Text for messages, tables and figures: formatted numbers, and the name that a mistyped one may have meant.
// Pure; any thread; allocates.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdio>
#include <numeric>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace burin {

// Formats as printf does. For short texts: cut off after 399 bytes.
[[nodiscard]] std::string formatted(const char* format, auto... values) {
    std::array<char, 400> text{};
    std::snprintf(text.data(), text.size(), format, values...);
    return text.data();
}

// Returns the names with a comma and a blank between them.
[[nodiscard]] inline std::string joined(std::span<const std::string_view> names) {
    std::string text;
    for (const std::string_view name : names) {
        if (!text.empty()) text += ", ";
        text += name;
    }
    return text;
}

// Returns the number of letters to insert, delete or replace to make one word of the other (Levenshtein, "Binary codes
// capable of correcting deletions, insertions, and reversals", 1966). Cost: the product of the lengths.
[[nodiscard]] inline std::size_t edit_distance(std::string_view a, std::string_view b) {
    // One row of the table of distances between beginnings of a and of b.
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 1; i <= a.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
            diagonal = row[j];
            row[j] = std::min({replaced, row[j] + 1, row[j - 1] + 1});
        }
    }
    return row[b.size()];
}

// Returns the name with the least edit distance; the first of equals. Only the first 64 characters of each count, so
// that a whole file pasted as a name is not slow. names must not be empty.
[[nodiscard]] inline std::string_view nearest_name(std::string_view wrong, std::span<const std::string_view> names) {
    constexpr std::size_t kLongestCompared = 64;
    return *std::ranges::min_element(names, {}, [&](std::string_view name) {
        return edit_distance(wrong.substr(0, kLongestCompared), name.substr(0, kLongestCompared));
    });
}

}  // namespace burin
