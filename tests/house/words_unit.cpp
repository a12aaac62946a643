// SPDX-License-Identifier: MIT
// ctest house.words: the rules on the text of files hold in this repository, and each rule can be seen to fail.
#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "tests/house/house_rules.hpp"
#include "tests/house/source_tree.hpp"
#include "tests/house/test_names.hpp"
#include "tests/house/throwing_rules.hpp"

namespace burin::house {
namespace {

namespace fs = std::filesystem;

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

TEST(Words, NoSourceLineIsTooLong) {
    const Findings found = long_lines(BURIN_SOURCE_FOLDER);
    for (const std::string& place : found.places)
        ADD_FAILURE() << place << " has more than " << kMostColumns << " columns";
    EXPECT_GE(found.looked_at, 10u) << "hardly any source was read";
}

TEST(Words, EveryPathThatADocumentNamesExists) {
    const Findings found = missing_document_paths(BURIN_SOURCE_FOLDER);
    for (const std::string& place : found.places) ADD_FAILURE() << place << ", which does not exist";
    EXPECT_GE(found.looked_at, 100u) << "hardly any path was found in the documents";
}

TEST(Words, EveryFileThatACommentNamesExists) {
    const Findings found = missing_comment_paths(BURIN_SOURCE_FOLDER);
    for (const std::string& place : found.places) ADD_FAILURE() << place << ", which does not exist";
    EXPECT_GE(found.looked_at, 100u) << "hardly any path was found in comments";
}

TEST(Words, EveryTestThatADocumentNamesExists) {
    const Findings found = missing_tests(BURIN_SOURCE_FOLDER);
    for (const std::string& place : found.places) ADD_FAILURE() << place << ", which no test is called";
    EXPECT_GE(found.looked_at, 5u) << "hardly any test was named in the documents";
}

TEST(Words, HaveCleanLineEnds) {
    expect_everywhere([](const std::string& path) { return !keeps_its_own_line_ends(path); }, complaint_on_whitespace);
}

TEST(Words, EveryHeaderCanBeIncludedTwice) {
    expect_everywhere([](const std::string& path) { return path.ends_with(".hpp"); }, complaint_on_guard);
}

// So compiling the source proves that its header, read first, can stand alone, where each source is compiled alone.
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

// Sources below tests/ are left aside: a test may end with a throw.
TEST(Words, NoSourceCallsAFunctionOfTheFileSystemThatThrows) {
    std::size_t looked_at = 0;
    for (const std::string& path : repository_files(BURIN_SOURCE_FOLDER)) {
        if (path.starts_with("tests/") || !(path.ends_with(".cpp") || path.ends_with(".hpp"))) continue;
        const std::string text = read_text(fs::path(BURIN_SOURCE_FOLDER) / path);
        if (!text.contains("filesystem")) continue;
        ++looked_at;
        for (const std::string& call : throwing_calls(text))
            ADD_FAILURE() << path << ", " << call << ": give it a std::error_code, or use base/places.hpp";
    }
    EXPECT_GE(looked_at, 10u) << "hardly any source was read";
}

TEST(WordsRules, SeeACallThatThrows) {
    const auto calls = [](const std::string& text) { return throwing_calls("std::error_code error, none;\n" + text); };
    using Calls = std::vector<std::string>;
    EXPECT_EQ(calls("if (std::filesystem::exists(path)) f();"), (Calls{"line 2: exists() throws"}));
    EXPECT_EQ(calls("a = fs::absolute(b / \"c\");"), (Calls{"line 2: absolute() throws"}));
    EXPECT_EQ(calls("a = fs::weakly_canonical(fs::absolute(b), error);"), (Calls{"line 2: absolute() throws"}));
    EXPECT_EQ(calls("a = fs::current_path();\nfs::rename(a, b);"),
              (Calls{"line 2: current_path() throws", "line 3: rename() throws"}));
    EXPECT_EQ(calls("for (const auto& e : fs::directory_iterator(a, error)) f(e);"),
              (Calls{"line 2: directory_iterator() throws"}));
    EXPECT_EQ(calls("for (const auto& e : std::filesystem::recursive_directory_iterator(a)) f(e);"),
              (Calls{"line 2: recursive_directory_iterator() throws"}));
    EXPECT_EQ(calls("return entry.is_regular_file();"), (Calls{"line 2: is_regular_file() throws"}));
    EXPECT_EQ(calls("if (fs::exists(path, error) && entry.is_directory(none)) f();"), Calls{});
    EXPECT_EQ(calls("if (fs::exists(fs::symlink_status(path, error))) f();"), Calls{});
    EXPECT_EQ(calls("for (fs::directory_iterator at(a, error), end; at != end; at.increment(error)) f();"), Calls{});
    EXPECT_EQ(calls("// fs::absolute(path)\nconst char* a = \"fs::absolute(path)\";"), Calls{});
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

TEST(WordsRules, SeeALineThatIsTooLong) {
    const std::string full(120, 'x');
    EXPECT_EQ(lines_too_long(full + "\n" + full), std::vector<int>{});
    EXPECT_EQ(lines_too_long(""), std::vector<int>{});
    EXPECT_EQ(lines_too_long("a\n" + full + "x\nb\n// " + full + "\n"), (std::vector<int>{2, 4}));
    EXPECT_EQ(lines_too_long(full + "x"), std::vector<int>{1});  // also without a line end
    std::string umlauts;
    for (int i = 0; i < 120; ++i) umlauts += "\xc3\xa4";  // two bytes, one column
    EXPECT_EQ(lines_too_long(umlauts + "\n"), std::vector<int>{});
    EXPECT_EQ(lines_too_long(umlauts + "x\n"), std::vector<int>{1});
}

TEST(WordsRules, SeeThePathsThatADocumentNames) {
    const std::vector<std::string> tops{"docs", "gpu"};
    const auto paths = [&](const std::string& text) { return paths_named_in(text, "docs", tops); };
    using Paths = std::vector<NamedPath>;
    EXPECT_EQ(paths("a\nsee `gpu/device.hpp`, and `gpu/`.\n"), (Paths{{"gpu/device.hpp", 2}, {"gpu/", 2}}));
    EXPECT_EQ(paths("`gone/away.hpp` and (`old/notes.md`)\n"), (Paths{{"gone/away.hpp", 1}, {"old/notes.md", 1}}));
    EXPECT_EQ(paths("`run gpu/a.comp,\ngpu/b.comp`\n"), (Paths{{"gpu/a.comp", 1}, {"gpu/b.comp", 2}}));
    EXPECT_EQ(paths("```sh\nscript gpu/a.txt\n```\ngpu/b.txt\n"), (Paths{{"gpu/a.txt", 2}}));
    EXPECT_EQ(paths("an open ` ends here\n\nand gpu/a.hpp is none\n"), Paths{});
}

TEST(WordsRules, SeeTheTestsThatADocumentNames) {
    EXPECT_EQ(tests_named_in("see `Carve.EqualsReference`\nand `Carve.*`, `a.B`, `README.md`, `--gtest_filter=A.B`\n"
                             "`Felt.AToolIs*`"),
              (std::vector<NamedPath>{{"Carve.EqualsReference", 1}, {"Felt.AToolIs*", 3}}));
    EXPECT_EQ(tests_defined_in("TEST(A, One) {}\nTEST_F(Bb, Two2) {\nRC_GTEST_PROP(C, Three, (int x)) {\n// A.Four"),
              (std::set<std::string>{"A.One", "Bb.Two2", "C.Three"}));
}

TEST(WordsRules, SeeWhereADocumentsLinksLead) {
    const auto paths = [](const std::string& text) { return paths_named_in(text, "docs", {}); };
    using Paths = std::vector<NamedPath>;
    EXPECT_EQ(paths("[a](formats.md#walls) [b](../LICENSE)\n![c](pictures/wall.png)\n"),
              (Paths{{"docs/formats.md", 1}, {"LICENSE", 1}, {"docs/pictures/wall.png", 2}}));
    EXPECT_EQ(paths("[a](https://example.org/x.md) [b](#here)\n```cpp\nf[0](gone.md)\n```\n"), Paths{});
    EXPECT_EQ(paths_named_in("[a](docs/formats.md)\n", "", {}), (Paths{{"docs/formats.md", 1}}));
}

TEST(WordsRules, TakeNoOptionPatternOrBuildForAPath) {
    const std::vector<std::string> tops{"docs", "gpu"};
    EXPECT_EQ(paths_named_in("`gpu/*_unit.cpp` `build/ci/a.json` `out/a.png` `A=gpu/a.hpp` `udp:gpu/x` `a/b` `/x.md`\n",
                             "", tops),
              std::vector<NamedPath>{});
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
