// SPDX-License-Identifier: MIT
// ctest house.structure: rooms include each other in one direction, no type has two definitions, and each rule can be
// seen to fail.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/house/asserting_tests.hpp"
#include "tests/house/house_figures.hpp"
#include "tests/house/session_figures.hpp"
#include "tests/house/source_tree.hpp"
#include "tests/house/structure_rules.hpp"

namespace burin::house {
namespace {

using Names = std::vector<std::string>;

TEST(Rooms, IncludeEachOtherInOneDirection) {
    for (const std::string& cycle : room_cycles(BURIN_SOURCE_FOLDER)) ADD_FAILURE() << cycle;
}

TEST(Types, AreDefinedOnce) {
    for (const std::string& twice : types_defined_twice(BURIN_SOURCE_FOLDER)) ADD_FAILURE() << twice;
}

TEST(Types, AreFoundInThisRepository) {
    const Names types = types_defined_in(read_text(std::string(BURIN_SOURCE_FOLDER) + "/base/error.hpp"));
    EXPECT_NE(std::ranges::find(types, "burin::Error"), types.end());
}

TEST(Tests, ExpectSomething) {
    const Findings found = tests_without_expectation(BURIN_SOURCE_FOLDER);
    for (const std::string& place : found.places) ADD_FAILURE() << place << " expects nothing, and cannot fail";
    EXPECT_GE(found.looked_at, 1000u) << "hardly any test was read";
}

TEST(TestRules, SeeATestThatExpectsNothing) {
    const ScratchFolder tree;
    write_text(tree.path() / "tests/a/helper.hpp",
               "inline void looks(int a) { EXPECT_EQ(a, 1); }\ntemplate <typename T> bool by(T a) noexcept { looks(a); "
               "return true; }\ninline int idle(int a) { return a; }\n");
    write_text(tree.path() / "tests/a/a_unit.cpp",
               "TEST(A, Expects) { if (true) { ASSERT_TRUE(true); } }\nTEST_F(A, Asks) { by<int>(1); }\n"
               "TEST(A, ExpectsInALambda) { const auto f = [] { ADD_FAILURE() << 1; }; f(); }\n"
               "RC_GTEST_PROP(A, Holds, (int a)) { RC_ASSERT(a == a); }\n"
               "TEST(A, Idles) { idle(1); }\nTEST_F(A, Says) { const char* s = \"EXPECT_EQ({1)\"; }\n"
               "TEST(A, Comments) { // EXPECT_TRUE(true)\n}\nTEST(A, Ends) { const int large = 1'000'000; }\n");
    const Findings found = tests_without_expectation(tree.path());
    EXPECT_EQ(found.looked_at, 8u);
    EXPECT_EQ(found.places, (Names{"tests/a/a_unit.cpp: A.Comments", "tests/a/a_unit.cpp: A.Ends",
                                   "tests/a/a_unit.cpp: A.Idles", "tests/a/a_unit.cpp: A.Says"}));
}

TEST(FragmentRules, CountShortFilesByFolder) {
    const ScratchFolder tree;
    const auto lines = [](int count) { return std::string(static_cast<std::size_t>(count), '\n'); };
    write_text(tree.path() / "a/x/one.hpp", lines(39));
    write_text(tree.path() / "a/two.cpp", lines(40));
    write_text(tree.path() / "b/three.cpp", lines(500));
    write_text(tree.path() / "tests/four.cpp", lines(1));
    write_text(tree.path() / "a/CMakeLists.txt", lines(1));
    const auto folders = fragments_by_folder(tree.path());
    ASSERT_EQ(folders.size(), 2u);
    EXPECT_EQ(folders[0].folder, "a");
    EXPECT_EQ(folders[0].files, 2u);
    EXPECT_EQ(folders[0].fragments, Names{"a/x/one.hpp"});
    EXPECT_EQ(folders[0].percent(), 50.0);
    EXPECT_TRUE(folders[1].fragments.empty());
}

TEST(Figures, MissTheirBarsOnATreeThatBreaksTheRulesAndSayWhere) {
    const ScratchFolder tree;
    write_text(tree.path() / "a/one.hpp", "#include \"b/two.hpp\"\nnamespace burin {\nstruct Room {};\n}\n");
    write_text(tree.path() / "b/two.hpp",
               "#include \"a/one.hpp\"\nnamespace burin {\nstruct Room {};\n}\n// " + std::string(120, 'x') + "\n");
    write_text(tree.path() / "docs/a.md", "see `a/gone.hpp`\n");
    const auto figures = house_figures(tree.path());
    const auto missed = std::ranges::count_if(figures, [](const Figure& figure) { return !figure.reached(); });
    EXPECT_EQ(missed, 4) << "twice, cycle, line and path\n" << table_of(figures);
    for (const char* place : {"burin::Room", "a -> b", "b/two.hpp:5", "docs/a.md:1", "MISSED"})
        EXPECT_TRUE(table_of(figures).contains(place)) << place << "\n" << table_of(figures);
}

TEST(Figures, OfThisRepositoryReachTheirBars) {
    const auto figures = house_figures(BURIN_SOURCE_FOLDER);
    EXPECT_TRUE(std::ranges::all_of(figures, &Figure::reached)) << table_of(figures);
}

TEST(SessionFigures, CountWhatAClassHolds) {
    EXPECT_EQ(private_members("class A {\npublic:\n    int f_;\nprivate:\n    int f(int x_);\n    int a_ = 1, b_;\n"
                              "    Map<int> c_{d()};  // e_\n};\nclass B {\nprivate:\n    int g_;\n};\n",
                              "A"),
              (Names{"a_", "b_", "c_"}));
}

TEST(SessionFigures, CountIncludesUpAndLinesThatAreRead) {
    const ScratchFolder tree;
    write_text(tree.path() / "session/a.hpp", "#include \"desk/b.hpp\"\n\n");
    write_text(tree.path() / "session/a.cpp", "#include \"session/a.hpp\"\n");
    write_text(tree.path() / "desk/b.hpp", "\n\n\n");
    const auto figures = session_figures(tree.path());
    EXPECT_EQ(figures.front().value, 1.0);
    EXPECT_EQ(figures.front().places, Names{"session/a.hpp includes desk/b.hpp"});
    const auto read = std::ranges::find(figures, "lines of our headers that a source reads in session/", &Figure::name);
    ASSERT_NE(read, figures.end());
    EXPECT_EQ(read->value, 5.0);
}

TEST(RoomRules, SeeACircleOfThreeRoomsAndNameTheIncludes) {
    const ScratchFolder tree;
    write_text(tree.path() / "a/x/one.hpp", "#include \"a/y/two.hpp\"\n");
    write_text(tree.path() / "a/y/two.hpp", "#include \"a/three.hpp\"\n");
    write_text(tree.path() / "a/three.hpp", "");
    EXPECT_EQ(room_cycles(tree.path()), Names{});
    write_text(tree.path() / "a/four.cpp", "#include \"a/x/one.hpp\"\n");
    const Names cycles = room_cycles(tree.path());
    ASSERT_EQ(cycles.size(), 1u);
    EXPECT_TRUE(cycles[0].contains("a -> a/x (a/four.cpp includes a/x/one.hpp)")) << cycles[0];
    EXPECT_TRUE(cycles[0].contains("a/y -> a (a/y/two.hpp includes a/three.hpp)")) << cycles[0];
}

TEST(RoomRules, LeaveTestsAndTheSameRoomAside) {
    const ScratchFolder tree;
    write_text(tree.path() / "a/one.hpp", "#include \"a/two.hpp\"\n#include \"tests/t.hpp\"\n");
    write_text(tree.path() / "a/two.hpp", "#include \"a/one.hpp\"\n");
    write_text(tree.path() / "tests/t.hpp", "#include \"a/one.hpp\"\n");
    EXPECT_EQ(room_cycles(tree.path()), Names{});
}

TEST(TypeRules, SeeClassesStructsEnumsAndTheirScopes) {
    EXPECT_EQ(types_defined_in(
                  "namespace burin::gpu {\nstruct A { enum class E : int { x }; };\nclass B final : public A {};\n"
                  "enum class C : std::uint8_t { red };\ntemplate <typename T>\nclass D {};\n}\n"),
              (Names{"burin::gpu::A", "burin::gpu::A::E", "burin::gpu::B", "burin::gpu::C", "burin::gpu::D"}));
}

TEST(TypeRules, LeaveAsideWhatOtherSourcesCannotSee) {
    EXPECT_EQ(types_defined_in("namespace burin {\nnamespace {\nstruct A {};\n}\nclass B;\nvoid f() { struct C {}; }\n"
                               "inline int g() { return 1'000; }\n// struct D {};\nconst char* h = \"struct E {\";\n"
                               "template <class F> void i(struct G* g);\nstruct H::I {};\n#define X struct J {\n}\n"),
              Names{});
}

TEST(TypeRules, SeeATypeThatTwoFilesDefine) {
    const ScratchFolder tree;
    write_text(tree.path() / "a/one.hpp", "namespace burin {\nstruct Room {};\n}\n");
    write_text(tree.path() / "b/two.cpp", "namespace burin {\nnamespace {\nstruct Room {};\n}\n}\n");
    EXPECT_EQ(types_defined_twice(tree.path()), Names{});
    write_text(tree.path() / "c/three.hpp", "namespace burin {\ntemplate <int n>\nclass Room { int i; };\n}\n");
    EXPECT_EQ(types_defined_twice(tree.path()), Names{"burin::Room is defined in a/one.hpp and in c/three.hpp"});
}

}  // namespace
}  // namespace burin::house
