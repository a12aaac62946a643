// SPDX-License-Identifier: MIT
// ctest house.includes: no file of this tree relies on what its roommates include, and the checker that says so can see
// each kind of forgotten include.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "tests/house/include_rules.hpp"
#include "tests/house/source_tree.hpp"
#include "tests/house/source_words.hpp"

namespace burin::house {
namespace {

std::vector<std::string> violations_of(const std::string& text, const std::string& file = "haptics/tick.cpp") {
    const ScratchFolder tree;
    write_text(tree.path() / "base/space.hpp",
               "#include <cmath>\nnamespace burin {\nstruct Pose { double radius(); };\nconstexpr double kTurn = 1.0;\n"
               "double length_of(const Pose& pose);\nusing Metres = double;\n}\n");
    write_text(tree.path() / "haptics/tick.hpp",
               "#include <vector>\n#include \"base/space.hpp\"\nnamespace burin { struct Tick; }\n");
    write_text(tree.path() / "haptics/other.hpp",
               "namespace burin::haptics { enum class Fault { none }; void gate(int); }\n");
    write_text(tree.path() / file, text);
    return include_violations(tree.path());
}

const std::vector<std::string> kNone{};

TEST(Includes, AreForgottenNowhereInThisRepository) {
    ASSERT_TRUE(std::filesystem::exists(std::filesystem::path(BURIN_SOURCE_FOLDER) / "haptics/tick.hpp"));
    for (const std::string& violation : include_violations(BURIN_SOURCE_FOLDER)) ADD_FAILURE() << violation;
}

TEST(Includes, OfATypeAreMissedWithFileAndLine) {
    EXPECT_EQ(violations_of("\nburin::Pose here;\n"),
              std::vector<std::string>{
                  "haptics/tick.cpp:2: uses Pose of base/space.hpp, which no header that it includes mentions"});
}

TEST(Includes, OfConstantsFunctionsAliasesAndEnumerationsAreMissed) {
    EXPECT_EQ(violations_of("double a = kTurn;\n").size(), 1u);
    EXPECT_EQ(violations_of("double a() { return length_of(b); }\n").size(), 1u);
    EXPECT_EQ(violations_of("double a() { return burin::length_of(b); }\n").size(), 1u);
    EXPECT_EQ(violations_of("Metres a;\n").size(), 1u);
    EXPECT_EQ(violations_of("void a() { haptics::gate(2); auto b = Fault::none; }\n").size(), 2u);
}

TEST(Includes, ReachThroughOtherHeaders) {
    EXPECT_EQ(violations_of("#include \"haptics/tick.hpp\"\nPose a; Tick* b; std::vector<int> c;\n"), kNone);
    EXPECT_EQ(violations_of("#include \"tick.hpp\"\ndouble d = std::sqrt(kTurn);\n"), kNone);
}

TEST(Includes, OfTheStandardLibraryAreMissed) {
    EXPECT_EQ(violations_of("std::vector<int> a;\n"),
              std::vector<std::string>{"haptics/tick.cpp:1: uses vector and includes <vector> nowhere"});
    EXPECT_EQ(violations_of("#include \"haptics/tick.hpp\"\nvoid f() { std::ranges::sort(a); }\n").size(), 1u);
}

TEST(Includes, AreNotAskedForNamesThatTheFileItselfHas) {
    EXPECT_EQ(violations_of("struct Pose { int a; };\nPose b;\n"), kNone);
    EXPECT_EQ(violations_of("constexpr double kStep = 1, kTurn = 2;\ndouble a = kTurn;\n"), kNone);
    EXPECT_EQ(violations_of("double length_of(int a) { return a; }\ndouble b = length_of(1);\n"), kNone);
    EXPECT_EQ(violations_of("template <typename Pose>\nPose f(Pose a);\n"), kNone);
    EXPECT_EQ(violations_of("void f() { Plate a(4), gate(2); gate(1); }\n"), kNone);
}

TEST(Includes, AreNotAskedForMembersOthersNamespacesTextsAndComments) {
    EXPECT_EQ(violations_of("double a = b.length_of(c) + d->length_of(e) + other::length_of(f);\n"), kNone);
    EXPECT_EQ(violations_of("// Pose and kTurn\nconst char* a = \"Pose\"; /* Metres\n Pose */ char b = '\"';\n"),
              kNone);
    EXPECT_EQ(violations_of("const char* a = R\"x(Pose \" kTurn)x\"; int b = 10'000;\n"), kNone);
}

TEST(SourceWords, KeepLinesAndLeaveIncludesOut) {
    const auto words = words_of_source("#include <Pose>\n#define A \\\n B\nint c = 0x1fu; // d\nauto e = f->g::h;\n");
    std::string told;
    for (const SourceWord& word : words)
        told += word.text + ":" + std::to_string(word.line) + (word.directive ? "# " : " ");
    EXPECT_EQ(told, "define:2# A:2# \\:2# B:3# int:4 c:4 =:4 ;:4 auto:5 e:5 =:5 f:5 ->:5 g:5 :::5 h:5 ;:5 ");
}

}  // namespace
}  // namespace burin::house
