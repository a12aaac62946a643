// SPDX-License-Identifier: MIT
// Tests that documents name, so that a reader who is told of one finds it.
#pragma once

#include <set>

#include "tests/house/house_rules.hpp"

namespace burin::house {

// Returns the names of the tests and properties that a source defines: "Suite.Case".
[[nodiscard]] std::set<std::string> tests_defined_in(const std::string& source);

// Returns what stands between backticks in a document and has the form of a test's name, with the lines: two words that
// begin with capitals, a dot between them, and perhaps a star for what follows.
[[nodiscard]] std::vector<NamedPath> tests_named_in(const std::string& document);

// Finds the tests that documents name and that no source under tests/ defines: "docs/a.md:12: names Suite.Case".
[[nodiscard]] Findings missing_tests(const std::filesystem::path& root);

}  // namespace burin::house
