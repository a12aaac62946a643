// SPDX-License-Identifier: MIT
#include "tests/house/house_rules.hpp"

#include <algorithm>
#include <cctype>
#include <sstream>
#include <vector>

#include "tests/house/layer_rules.hpp"
#include "tests/house/source_tree.hpp"

namespace burin::house {

namespace {

std::string line_number_of(const std::string& text, std::size_t at) {
    return std::to_string(1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n'));
}

std::string slashed(const std::string& name) { return "/" + name + "/"; }

bool continues_a_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '.'; }

}  // namespace

std::string complaint_on_paths(const std::string& text) {
    // Put together here, so that this file does not complain about itself.
    static const std::vector<std::string> kPlaces = {slashed("home"), slashed("root"), slashed("Users"),
                                                     slashed("work"), std::string("C:") + "\\Users"};
    for (const std::string& place : kPlaces) {
        for (std::size_t at = text.find(place); at != std::string::npos; at = text.find(place, at + 1)) {
            const bool inside_relative_path = at > 0 && continues_a_word(text[at - 1]);  // e.g. assets/home/
            const char after = at + place.size() < text.size() ? text[at + place.size()] : ' ';
            if (!inside_relative_path && (continues_a_word(after) || after == '\\')) {
                return "line " + line_number_of(text, at) + " names a machine's own path (" + place + "...)";
            }
        }
    }
    return "";
}

std::string complaint_on_licence(const std::string& text) {
    std::istringstream lines(text);
    std::string first, second;
    std::getline(lines, first);
    std::getline(lines, second);
    const std::string wanted = "SPDX-License-Identifier: MIT";
    const bool in_second = (first.starts_with("#version") || first.starts_with("#!")) && second.contains(wanted);
    return first.contains(wanted) || in_second ? "" : "the first line does not say '// " + wanted + "'";
}

std::string complaint_on_length(const std::string& text) {
    const auto lines = std::count(text.begin(), text.end(), '\n');
    return lines <= kMostLines
               ? ""
               : "has " + std::to_string(lines) + " lines; split it (at most " + std::to_string(kMostLines) + ")";
}

std::string complaint_on_guard(const std::string& text) {
    const std::string code = without_comments(text);
    const std::size_t first = code.find_first_not_of(" \n");
    return first != std::string::npos && code.compare(first, 12, "#pragma once") == 0
               ? ""
               : "does not begin with #pragma once";
}

std::string complaint_on_first_include(const std::string& text, const std::string& own_header) {
    const std::vector<Include> includes = includes_of(text);
    return !includes.empty() && includes.front().name == own_header ? "" : "does not include " + own_header + " first";
}

std::string complaint_on_whitespace(const std::string& text) {
    if (!text.empty() && text.back() != '\n') return "does not end with a newline";
    std::istringstream lines(text);
    std::string line;
    for (int number = 1; std::getline(lines, line); ++number) {
        const std::string where = "line " + std::to_string(number);
        if (line.contains('\t')) return where + " has a tab";
        if (line.ends_with('\r')) return where + " ends with a carriage return";
        if (line.ends_with(' ')) return where + " ends with a blank";
        if (line.starts_with("<<<<<<< ") || line.starts_with(">>>>>>> ")) return where + " is a merge marker";
    }
    return "";
}

}  // namespace burin::house
