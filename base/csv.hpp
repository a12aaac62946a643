// SPDX-License-Identifier: MIT
// The records of a CSV text (RFC 4180) with commas, semicolons or tabs between fields, as spreadsheets of different
// countries write them. Numbers have a decimal point whatever the separator. Any thread.
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

// A record of a text: a line, or several where line ends stand within a field in double quotes.
struct CsvRecord {
    std::string_view text;  // without the line end behind it
    std::size_t lines = 1;
};
// Takes the next record off the text, which must not be empty. A quote that is not closed within kMostLinesOfField
// lines ends with its line, so that split_csv() finds it unclosed there; so does a line that begins with #.
inline constexpr std::size_t kMostLinesOfField = 100;
[[nodiscard]] CsvRecord take_record(std::string_view& text, std::optional<char> separator);

// The name of a column as programs compare it: in lower case, and with a blank for each line end.
[[nodiscard]] std::string column_name(std::string_view field);

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

// The shortest text that is read back as the same bits; empty for what is not finite.
[[nodiscard]] std::string csv_number(double value);

// Writes a field, in quotes where it needs them.
[[nodiscard]] std::string csv_field(std::string_view text);

}  // namespace burin
