// SPDX-License-Identifier: MIT
// What docs/figures.md prints of the demonstration is what the demonstration prints, but for times and the engine's
// name.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/places.hpp"
#include "tests/support/run_command.hpp"

namespace burin {
namespace {

// Rows of the table that are counts and forces, the same on every machine.
constexpr std::array kRows{"  updates ",
                           "  rays touched an update",
                           "  triangles re-meshed",
                           "  volume removed ",
                           "  largest, mean force",
                           "  mean force while cutting",
                           "  mesh "};

std::vector<std::string> rows_in(const std::string& text) {
    std::vector<std::string> found;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);)
        if (std::ranges::any_of(kRows, [&](const char* row) { return line.starts_with(row); })) found.push_back(line);
    return found;
}

}  // namespace

TEST(Demonstration, HasTheCountsThatTheDocumentsPrint) {
    const Workplace place;
    const auto carved = place.run(std::string(kBurinCommand) + " demo --engine cpu --out out");
    ASSERT_EQ(carved.status, 0) << carved.output;
    const std::vector<std::string> printed = rows_in(carved.output);
    ASSERT_EQ(printed.size(), kRows.size()) << carved.output;
    const auto figures = std::filesystem::path(kSessionsFolder).parent_path().parent_path() / "docs" / "figures.md";
    std::ostringstream told;
    told << std::ifstream(figures).rdbuf();
    EXPECT_EQ(rows_in(told.str()), printed);
}

}  // namespace burin
