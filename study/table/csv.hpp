// SPDX-License-Identifier: MIT
// One line of a CSV text (RFC 4180, but for line ends within quotes). Any thread.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace burin::study {

struct CsvField {
    std::string text;        // without quotes and without blanks around it
    std::size_t column = 1;  // where it begins, in characters from 1
};

struct CsvLine {
    std::vector<CsvField> fields;
    std::size_t unclosed_quote = 0;  // its column; 0: none
};

// Splits at commas. "a ""b"", c" in double quotes is one field: a "b", c.
[[nodiscard]] CsvLine split_csv(std::string_view line);

// Returns the number that is the whole text; nothing for any other text, and for nan and inf.
[[nodiscard]] std::optional<double> finite_number(std::string_view text);

// Writes a field, in quotes where it needs them.
[[nodiscard]] std::string csv_field(std::string_view text);

}  // namespace burin::study
