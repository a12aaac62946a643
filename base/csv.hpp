// SPDX-License-Identifier: MIT
// One line of a CSV text (RFC 4180, but for line ends within quotes) with commas, semicolons or tabs between fields, as
// spreadsheets of different countries write them. Numbers have a decimal point whatever the separator. Any thread.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace burin {

struct CsvField {
    std::string text;        // without quotes and without blanks around it
    std::size_t column = 1;  // where it begins, in characters from 1
};

struct CsvLine {
    std::vector<CsvField> fields;
    std::size_t unclosed_quote = 0;  // its column; 0: none
};

// Splits at the separator. "a ""b"", c" in double quotes is one field: a "b", c.
[[nodiscard]] CsvLine split_csv(std::string_view line, char separator = ',');

// The separator that splits the line into most fields; of equally many tab before semicolon before comma. Comma where
// there is one field.
[[nodiscard]] char separator_in(std::string_view line);

// What a first line such as sep=; says, which spreadsheets write before the table; nothing for any other line, and \0
// for a separator that is none of the three.
[[nodiscard]] std::optional<char> declared_separator(std::string_view line);

// "a comma", "a semicolon", "a tab"
[[nodiscard]] const char* name_of_separator(char separator);

// Returns the number that is the whole text; nothing for any other text, and for nan and inf.
[[nodiscard]] std::optional<double> finite_number(std::string_view text);

// Writes a field, in quotes where it needs them.
[[nodiscard]] std::string csv_field(std::string_view text);

}  // namespace burin
