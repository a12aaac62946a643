// SPDX-License-Identifier: MIT
// Tests that can fail: each says what it expects, itself or by a function that it calls.
#pragma once

#include <map>
#include <set>
#include <string>

#include "tests/house/house_rules.hpp"

namespace burin::house {

// What stands between the braces of the functions that a source defines, by their names, without comments and the
// content of literals; of a test by "Suite.Case". Functions of one name are taken together.
[[nodiscard]] std::map<std::string, std::string> bodies_in(const std::string& source);

// Returns those of the bodies that expect something: by a macro of GoogleTest or rapidcheck, or by calling one that
// does.
[[nodiscard]] std::set<std::string> expecting(const std::map<std::string, std::string>& bodies);

// Finds the tests under tests/ that expect nothing: "tests/a_unit.cpp: Suite.Case".
[[nodiscard]] Findings tests_without_expectation(const std::filesystem::path& root);

}  // namespace burin::house
