// SPDX-License-Identifier: MIT
#include "toolbox/tool_kinds.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <set>
#include <sstream>

#include "toolbox/tool_options.hpp"

namespace burin::toolbox {
namespace {

// A tool as wide as a ball of radius 0.01, or one without a file.
ToolSpec example_of(const ToolDescriptor& kind) {
    ToolSpec tool{kind.kind, {}, {}};
    for (std::size_t i = 0; i < kind.used_sizes().size(); ++i) tool.sizes_m[i] = 0.01 * kind.proportions[i];
    return tool;
}

ToolSpec parsed(const std::string& text) {
    const auto tool = parse_tool_spec(text, "--tool " + text);
    EXPECT_TRUE(tool) << (tool ? "" : tool.error().line());
    return tool.value_or(ToolSpec{});
}

template <typename Shape>
Shape made(const std::string& text) {
    return std::get<Shape>(*make_shape(parsed(text)));
}

void expect_refused(const std::string& text, const std::string& problem, const std::string& remedy) {
    const auto refused = parse_tool_spec(text, "--tool " + text);
    ASSERT_FALSE(refused) << text;
    EXPECT_EQ(refused.error().where, "--tool " + text);
    EXPECT_EQ(refused.error().what, problem);
    EXPECT_TRUE(refused.error().remedy.starts_with(remedy)) << refused.error().remedy;
}

}  // namespace

TEST(ToolKinds, EachMakesItsOwnAlternativeOfTheShape) {
    for (const ToolDescriptor& kind : tool_kinds()) {
        if (kind.used_sizes().empty()) continue;  // from a file, below
        const auto shape = make_shape(example_of(kind));
        ASSERT_TRUE(shape) << kind.name;
        EXPECT_EQ(shape->index(), static_cast<std::size_t>(kind.kind)) << kind.name;
    }
}

TEST(ToolKinds, EachIsReadAsItIsWrittenAndAsHelpWritesIt) {
    std::set<std::string_view> names;
    for (const ToolDescriptor& kind : tool_kinds()) {
        EXPECT_TRUE(names.insert(kind.name).second) << kind.name << " is there twice";
        ToolSpec tool = example_of(kind);
        if (kind.used_sizes().empty()) tool.file = "a:b c.stl";
        EXPECT_EQ(parsed(text_of(tool)), tool) << text_of(tool);
        const std::string synopsis = synopsis_of(kind);
        EXPECT_EQ(std::ranges::count(synopsis, ','), std::ranges::count(text_of(tool), ',')) << synopsis;
        EXPECT_EQ(synopsis.substr(0, synopsis.find(':')), kind.name);
    }
}

// The page on tools names each kind as help does; nothing else would remind of it.
TEST(ToolKinds, AreAllOnTheirPage) {
    std::ostringstream page;
    page << std::ifstream("docs/tools.md").rdbuf();
    for (const std::string& synopsis : tool_synopses())
        EXPECT_TRUE(page.str().contains(synopsis)) << synopsis << " is missing";
}

TEST(ToolKinds, PutEachSizeWhereItBelongs) {
    EXPECT_EQ(made<compute::BallTool>("ball:0.1").radius_m, 0.1);
    const auto cylinder = made<compute::CylinderTool>("cylinder:0.1,0.2");
    EXPECT_EQ(cylinder.radius_m, 0.1);
    EXPECT_EQ(cylinder.length_m, 0.2);
    const auto cone = made<compute::ConeTool>("cone:0,0.2,0.3");
    EXPECT_EQ(cone.tip_radius_m, 0.0);
    EXPECT_EQ(cone.top_radius_m, 0.2);
    EXPECT_EQ(cone.length_m, 0.3);
    const auto nose = made<compute::BullNoseTool>("bullnose:0.2,0.1,0.3");
    EXPECT_EQ(nose.radius_m, 0.2);
    EXPECT_EQ(nose.corner_radius_m, 0.1);
    EXPECT_EQ(nose.length_m, 0.3);
    EXPECT_EQ(made<compute::BoxTool>("box:0.2,0.4,0.6").half_size_m, Vec3(0.1, 0.2, 0.3));
}

TEST(ToolKinds, AreRefusedWithTheRemedyWhenTheyAreNone) {
    const std::string kinds = "write ball:R, cylinder:R,L, cone:R0,R1,L, bullnose:R,C,L, box:X,Y,Z";
    for (const char* text : {"", "cube:1", "Ball:0.1", "ball", "ball:"}) {
        const bool known = std::string(text).starts_with("ball");
        expect_refused(text, known ? "does not give 1 number" : "is not a tool", known ? "see" : kinds);
    }
    expect_refused("cylinder:0.1", "does not give 2 numbers with commas", "see the command's --help");
    expect_refused("box:0.1,0.1,0.1,0.1", "does not give 3 numbers with commas", "see");
    for (const char* text : {"ball:0", "ball:-1", "cylinder:0.1,0", "bullnose:0.1,0,0.1", "box:0.1,0.1,0"})
        expect_refused(text, "has no size", "give sizes above zero, in metres");
    for (const char* text : {"cone:0,0,1", "cone:1,1,0", "cone:-1,2,1"})
        expect_refused(text, "has no size", "give a length above zero, and one radius above zero");
    expect_refused("bullnose:0.01,0.02,1", "has a corner larger than its radius or its length",
                   "write bullnose:R,C,L with C up to both");
    for (const std::string& text : {std::string("mesh"), std::string("mesh:"), std::string("mesh:a\0b", 8)})
        expect_refused(text, "names no file", "write mesh:FILE");
}

TEST(ToolKinds, OfAFileAreReadWhenTheyAreMadeAndNotBefore) {
    const ToolSpec tool = parsed("mesh:no/such/file.stl");
    EXPECT_EQ(tool.file, "no/such/file.stl");
    const auto shape = make_shape(tool);
    ASSERT_FALSE(shape);
    EXPECT_TRUE(shape.error().line().contains("no/such/file.stl"));
}

TEST(ToolOptions, AreParsedOnceIntoNumbers) {
    const auto settings = parse_tool_settings({.shape = "cone:0,0.2,0.3",
                                               .operation = compute::Operation::paint,
                                               .material = "200,40,30",
                                               .sweep_tolerance_cells = 0.25,
                                               .smooth_strength = 0.75});
    ASSERT_TRUE(settings);
    EXPECT_EQ(settings->shape, (ToolSpec{ToolKind::cone, {0.0, 0.2, 0.3}, {}}));
    EXPECT_EQ(material_of(*settings).name, "painted");
    EXPECT_EQ(material_of(*settings).colour, (std::array<std::uint8_t, 3>{200, 40, 30}));
    const auto tool = make_tool(*settings);
    ASSERT_TRUE(tool);
    EXPECT_EQ(tool->operation, compute::Operation::paint);
    EXPECT_EQ(tool->tolerance_cells, 0.25);
    EXPECT_EQ(tool->smooth_strength, 0.75);
}

TEST(ToolOptions, ThatMakeNoToolAreRefusedWithTheRemedy) {
    const auto flat = parse_tool_settings({.shape = "box:1,0,1"});
    ASSERT_FALSE(flat);
    EXPECT_EQ(flat.error().line(), "--tool box:1,0,1: has no size; give sizes above zero, in metres");
    EXPECT_TRUE(parse_tool_settings({.shape = "box:1,1,1", .operation = compute::Operation::smooth}));
    for (const char* colour : {"red", "1,2", "1,2,256", "-1,2,3", "1.5,2,3"}) {
        const auto refused = parse_tool_settings({.material = colour});
        ASSERT_FALSE(refused) << colour;
        EXPECT_EQ(refused.error().where, "--material " + std::string(colour));
    }
}

TEST(Operations, EachLeaveAMaterialOfTheirOwn) {
    std::set<std::string> materials;
    std::set<std::array<std::uint8_t, 3>> colours;
    for (const OperationDescriptor& operation : operations()) {
        const geometry::Material material = material_of({.operation = operation.operation});
        EXPECT_EQ(&descriptor_of(operation.operation), &operation);
        EXPECT_TRUE(materials.insert(material.name).second) << material.name;
        EXPECT_TRUE(colours.insert(material.colour).second) << material.name;
    }
}

TEST(Words, AreListedAsASentenceDoes) {
    using Words = std::vector<std::string>;
    EXPECT_EQ(alternatives({}), "");
    EXPECT_EQ(alternatives(Words{"cut"}), "cut");
    EXPECT_EQ(alternatives(Words{"cut", "fill"}), "cut or fill");
    EXPECT_EQ(alternatives(Words{"cut", "fill", "paint"}), "cut, fill or paint");
}

}  // namespace burin::toolbox
