// SPDX-License-Identifier: MIT
// ctest house.layers: the layer rule holds in this tree, and the checker that says so can see each kind of violation.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/house/layer_rules.hpp"
#include "tests/house/source_tree.hpp"

namespace burin::house {
namespace {

constexpr const char* kRules = R"(# a small house
folder base:
folder shaders/shared:
folder geometry: base shaders/shared
folder gpu: base
folder haptics: base geometry
folder renderer: base gpu shaders/shared
folder app: base geometry gpu haptics renderer
forbid haptics: vulkan fstream cstdio base/log
)";

std::vector<std::string> violations_of(const std::string& file, const std::string& text) {
    const ScratchFolder tree;
    write_text(tree.path() / "base/clock.hpp", "#pragma once\n");
    write_text(tree.path() / "base/file.hpp", "#pragma once\n#include <fstream>\n");
    write_text(tree.path() / "geometry/mesh.hpp", "#include \"base/file.hpp\"\n");
    write_text(tree.path() / "gpu/device.hpp", "#include <vulkan/vulkan.h>\n#include \"base/clock.hpp\"\n");
    write_text(tree.path() / "shaders/shared/dexel.h", "");
    write_text(tree.path() / "app/session.hpp", "#include \"gpu/device.hpp\"\n");
    write_text(tree.path() / file, text);
    const auto rules = parse_layer_rules(kRules);
    EXPECT_TRUE(rules.has_value());
    return layer_violations(tree.path(), *rules);
}

TEST(Layers, AreKeptInThisRepository) {
    const auto rules = parse_layer_rules(read_text(BURIN_LAYER_RULES_FILE));
    ASSERT_TRUE(rules.has_value()) << rules.error().line();
    ASSERT_GE(rules->may_include.size(), 9u) << "CMake declared too few folders in " << BURIN_LAYER_RULES_FILE;
    ASSERT_GE(ruled_files(BURIN_SOURCE_FOLDER, *rules), 10u) << "hardly any source was read";
    for (const std::string& violation : layer_violations(BURIN_SOURCE_FOLDER, *rules)) ADD_FAILURE() << violation;
}

TEST(Layers, LetNobodyIncludeApp) {
    const auto rules = parse_layer_rules(read_text(BURIN_LAYER_RULES_FILE));
    ASSERT_TRUE(rules.has_value()) << rules.error().line();
    for (const auto& [folder, allowed] : rules->may_include) {
        EXPECT_EQ(std::ranges::count(allowed, std::string("app")), 0) << folder << " may include app";
    }
}

TEST(Layers, AllowWhatIsDeclared) {
    EXPECT_EQ(violations_of("renderer/view.cpp",
                            "#include \"gpu/device.hpp\"\n#include \"shaders/shared/dexel.h\"\n#include <vector>\n"),
              std::vector<std::string>{});
    EXPECT_EQ(violations_of("app/main.cpp", "#include \"haptics/tick.hpp\"\n"), std::vector<std::string>{});
}

TEST(Layers, AllowTheSameFolderAndAHeaderBesideIt) {
    EXPECT_EQ(violations_of("gpu/image.cpp", "#include \"gpu/device.hpp\"\n#include \"device.hpp\"\n"),
              std::vector<std::string>{});
}

TEST(Layers, AllowCompiledShadersOnlyWhereGpuIsAllowed) {
    EXPECT_EQ(violations_of("renderer/a.cpp", "#include \"shaders/wall.frag.spv.hpp\"\n").size(), 0u);
    EXPECT_EQ(violations_of("geometry/a.cpp", "#include \"shaders/wall.frag.spv.hpp\"\n").size(), 1u);
}

TEST(Layers, ReportAForbiddenFolderWithFileAndLine) {
    EXPECT_EQ(violations_of("base/bad.cpp", "\n#include \"geometry/mesh.hpp\"\n"),
              std::vector<std::string>{"base/bad.cpp:2: base may not include geometry (geometry/mesh.hpp)"});
}

TEST(Layers, ReportAForbiddenFolderWhoseHeaderDoesNotExistYet) {
    EXPECT_EQ(violations_of("base/bad.cpp", "#include \"gpu/nothing.hpp\"\n").size(), 1u);
}

TEST(Layers, AreNotFooledByAngleBracketsRelativePathsOrSpaces) {
    EXPECT_EQ(violations_of("base/a.cpp", "#include <gpu/device.hpp>\n").size(), 1u);
    EXPECT_EQ(violations_of("base/a.cpp", "#include \"../gpu/device.hpp\"\n").size(), 1u);
    EXPECT_EQ(violations_of("base/a.cpp", "  #  include   \"base/../gpu/device.hpp\"\n").size(), 1u);
}

TEST(Layers, ReportAnyoneWhoIncludesApp) {
    EXPECT_EQ(violations_of("renderer/a.cpp", "#include \"app/session.hpp\"\n").size(), 1u);
}

TEST(Layers, ReportAQuotedHeaderOfNoFolder) {
    EXPECT_EQ(violations_of("base/a.cpp", "#include \"helpers.hpp\"\n").size(), 1u);
    EXPECT_EQ(violations_of("base/a.cpp", "#include \"tests/support/x.hpp\"\n").size(), 1u);
}

TEST(Layers, LeaveCommentsAside) {
    EXPECT_EQ(violations_of("base/a.cpp", "// #include \"gpu/device.hpp\"\n/* \n#include \"gpu/device.hpp\"\n*/\n"),
              std::vector<std::string>{});
}

TEST(Layers, ReportAForbiddenLibraryHeader) {
    EXPECT_EQ(violations_of("haptics/tick.cpp", "#include <cstdio>\n"),
              std::vector<std::string>{"haptics/tick.cpp:1: haptics must not see <cstdio>"});
    EXPECT_EQ(violations_of("haptics/tick.cpp", "#include <vulkan/vulkan.h>\n").size(), 1u);
    EXPECT_EQ(violations_of("haptics/tick.cpp", "#include \"base/log.hpp\"\n").size(), 1u);
    EXPECT_EQ(violations_of("haptics/tick.cpp", "#include <fstreams_are_fine>\n").size(), 0u);
}

TEST(Layers, ReportAForbiddenLibraryHeaderThatComesThroughAnotherFolder) {
    EXPECT_EQ(violations_of("haptics/tick.cpp", "#include \"geometry/mesh.hpp\"\n"),
              std::vector<std::string>{"haptics/tick.cpp: haptics must not see <fstream>, through base/file.hpp"});
}

TEST(Layers, RefuseRulesThatCannotBeRead) {
    const auto rules = parse_layer_rules("folder base:\nfolder gpu base\n");
    ASSERT_FALSE(rules.has_value());
    EXPECT_EQ(rules.error().where, "layer rules:2");
}

}  // namespace
}  // namespace burin::house
