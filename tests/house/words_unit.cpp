// SPDX-License-Identifier: MIT
// ctest house.words: the rules on the text of files hold in this repository, and each rule can be seen to fail.
#include <gtest/gtest.h>
#include <stdio.h>

#include <array>
#include <filesystem>
#include <functional>
#include <memory>
#include <sstream>

#include "tests/house/house_rules.hpp"
#include "tests/house/source_tree.hpp"

namespace burin::house {
namespace {

namespace fs = std::filesystem;

// What git tracks or would track; all files of the tree where git is missing or there is no repository (a source archive).
std::vector<std::string> repository_files(const fs::path& root) {
    const std::string command = "git -c safe.directory='*' -C '" + root.string() +
                                "' ls-files --cached --others --exclude-standard 2>/dev/null";
    std::string listing;
    if (const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"), pclose); pipe) {
        std::array<char, 4096> part{};
        while (fgets(part.data(), part.size(), pipe.get()) != nullptr) listing += part.data();
    }
    if (listing.empty()) return all_files(root);
    std::vector<std::string> files;
    std::istringstream lines(listing);
    for (std::string line; std::getline(lines, line);) {
        if (fs::is_regular_file(root / line)) files.push_back(line);  // deleted but not yet committed: not there
    }
    return files;
}

bool is_text(const std::string& content) { return !content.contains('\0'); }

bool keeps_its_own_line_ends(const std::string& path) {
    return path.ends_with(".obj") || path.ends_with(".off") || path.ends_with(".stl") || path.ends_with(".ply") ||
           path.contains("/corpus/");
}

void expect_everywhere(const std::function<bool(const std::string& path)>& applies,
                       const std::function<std::string(const std::string& text)>& complaint) {
    std::size_t looked_at = 0;
    for (const std::string& path : repository_files(BURIN_SOURCE_FOLDER)) {
        if (!applies(path)) continue;
        const std::string text = read_text(fs::path(BURIN_SOURCE_FOLDER) / path);
        if (!is_text(text)) continue;
        ++looked_at;
        const std::string found = complaint(text);
        if (!found.empty()) ADD_FAILURE() << path << ": " << found;
    }
    EXPECT_GE(looked_at, 10u) << "hardly any file was read";
}

TEST(Words, NameNoMachinesPath) {
    expect_everywhere([](const std::string&) { return true; }, complaint_on_paths);
}

TEST(Words, EverySourceNamesItsLicence) { expect_everywhere(is_source, complaint_on_licence); }

TEST(Words, NoSourceIsTooLong) { expect_everywhere(is_source, complaint_on_length); }

TEST(Words, HaveCleanLineEnds) {
    expect_everywhere([](const std::string& path) { return !keeps_its_own_line_ends(path); }, complaint_on_whitespace);
}

TEST(Words, EveryHeaderCanBeIncludedTwice) {
    expect_everywhere([](const std::string& path) { return path.ends_with(".hpp"); }, complaint_on_guard);
}

// house.headers compiles only the headers without a source of their own, and counts on this.
TEST(Words, EverySourceIncludesItsOwnHeaderFirst) {
    const fs::path root = BURIN_SOURCE_FOLDER;
    std::size_t looked_at = 0;
    for (const std::string& path : repository_files(root)) {
        const std::string header = fs::path(path).replace_extension(".hpp").generic_string();
        if (!path.ends_with(".cpp") || !fs::is_regular_file(root / header)) continue;
        ++looked_at;
        const std::string found = complaint_on_first_include(read_text(root / path), header);
        if (!found.empty()) ADD_FAILURE() << path << ": " << found;
    }
    EXPECT_GE(looked_at, 10u) << "hardly any source was read";
}

TEST(WordsRules, SeeAMachinesPath) {
    const std::string home = std::string("/ho") + "me/";
    EXPECT_NE(complaint_on_paths("a\nsee " + home + "anna/burin\n"), "");
    EXPECT_TRUE(complaint_on_paths("a\nsee " + home + "anna/burin\n").contains("line 2"));
    EXPECT_NE(complaint_on_paths(home + "anna"), "");
    EXPECT_NE(complaint_on_paths(std::string("\"/wo") + "rk/main/x\""), "");
    EXPECT_EQ(complaint_on_paths("assets/home/chair.obj and frame/work/out"), "");
    EXPECT_EQ(complaint_on_paths("the folder " + home + " in general"), "");
}

TEST(WordsRules, SeeAMissingLicenceLine) {
    EXPECT_NE(complaint_on_licence("#pragma once\n"), "");
    EXPECT_NE(complaint_on_licence(""), "");
    EXPECT_NE(complaint_on_licence("\n// SPDX-License-Identifier: MIT\n"), "");
    EXPECT_EQ(complaint_on_licence("// SPDX-License-Identifier: MIT\n#pragma once\n"), "");
    EXPECT_EQ(complaint_on_licence("#version 460\n// SPDX-License-Identifier: MIT\n"), "");
}

TEST(WordsRules, SeeAFileThatIsTooLong) {
    EXPECT_EQ(complaint_on_length(std::string(500, '\n')), "");
    EXPECT_NE(complaint_on_length(std::string(501, '\n')), "");
}

TEST(WordsRules, SeeAHeaderWithoutItsGuard) {
    EXPECT_EQ(complaint_on_guard("// licence\n/* what\n it is */\n#pragma once\n#include <vector>\n"), "");
    EXPECT_NE(complaint_on_guard("// licence\n#include <vector>\n#pragma once\n"), "");
    EXPECT_NE(complaint_on_guard("// #pragma once\nint i;\n"), "");
    EXPECT_NE(complaint_on_guard(""), "");
}

TEST(WordsRules, SeeAnotherIncludeBeforeTheOwnHeader) {
    EXPECT_EQ(complaint_on_first_include("// #include <a>\n#include \"gpu/a.hpp\"\n#include <vector>\n", "gpu/a.hpp"),
              "");
    EXPECT_NE(complaint_on_first_include("#include <vector>\n#include \"gpu/a.hpp\"\n", "gpu/a.hpp"), "");
    EXPECT_NE(complaint_on_first_include("#include \"gpu/b.hpp\"\n", "gpu/a.hpp"), "");
    EXPECT_NE(complaint_on_first_include("int i;\n", "gpu/a.hpp"), "");
}

TEST(WordsRules, SeeUncleanWhitespace) {
    EXPECT_EQ(complaint_on_whitespace("a b\n"), "");
    EXPECT_EQ(complaint_on_whitespace(""), "");
    EXPECT_NE(complaint_on_whitespace("a"), "");
    EXPECT_NE(complaint_on_whitespace("a \n"), "");
    EXPECT_NE(complaint_on_whitespace("a\tb\n"), "");
    EXPECT_NE(complaint_on_whitespace("a\r\n"), "");
    EXPECT_NE(complaint_on_whitespace(std::string(7, '<') + " ours\n"), "");
}

}  // namespace
}  // namespace burin::house
