// SPDX-License-Identifier: MIT
// The words of a C++ text: identifiers and single signs, with comments, literals and #include lines left out. Pure.
#pragma once

#include <string>
#include <vector>

namespace burin::house {

struct SourceWord {
    std::string text;  // an identifier, "::", "->", or one sign
    int line = 0;
    bool directive = false;  // it stands in a line that begins with '#', or goes on from one
};

[[nodiscard]] std::vector<SourceWord> words_of_source(const std::string& source);
[[nodiscard]] bool is_identifier(const std::string& word);

// The names that a header declares in a namespace, outside all classes and functions: types, aliases, concepts,
// functions, constants. Also names that stand in a default argument, which hardly any reader would call declared.
[[nodiscard]] std::vector<std::string> declared_names(const std::vector<SourceWord>& words);

}  // namespace burin::house
