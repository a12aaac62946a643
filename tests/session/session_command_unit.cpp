// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "app/session/command_table.hpp"
#include "app/session/input_words.hpp"
#include "app/tool_option.hpp"

namespace burin {
namespace {

double between(double least, double most) {
    return least + (most - least) * (*rc::gen::inRange(0, 1'000'001)) / 1'000'000.0;
}

ToolSpec any_tool() {
    ToolSpec tool;
    tool.kind = static_cast<ToolKind>(*rc::gen::inRange<int>(0, kToolKinds));
    tool.sizes_m = {};
    if (tool.kind == ToolKind::mesh) {
        tool.file = "folder with blanks/" + std::to_string(*rc::gen::inRange(0, 1000)) + ":\"#.stl";
        return tool;
    }
    for (std::size_t i = 0; i < size_names(tool.kind).size(); ++i) tool.sizes_m[i] = between(1e-5, 1.0);
    if (tool.kind == ToolKind::bullnose)
        tool.sizes_m[1] = std::min({tool.sizes_m[0], tool.sizes_m[1], tool.sizes_m[2]});
    return tool;
}

SessionCommand any_command() {
    switch (*rc::gen::inRange(0, 13)) {
        case 0: return RunAction{static_cast<Action>(*rc::gen::inRange<std::size_t>(0, action_names().size()))};
        case 1: return SetTool{any_tool()};
        case 2: return SetOperation{static_cast<Operation>(*rc::gen::inRange<int>(0, kOperations))};
        case 3: return SetColour{{between(0.0, 1.0), between(0.0, 1.0), between(0.0, 1.0)}};
        case 4: {
            const QuantityRange& range = range_of(static_cast<Quantity>(*rc::gen::inRange(0, 8)));
            return SetQuantity{range.quantity, between(range.least, range.most)};
        }
        case 5: return SetTechnique{static_cast<WorkspaceTechnique>(*rc::gen::inRange<int>(0, kTechniques))};
        case 6: return SetStereoMode{static_cast<StereoMode>(*rc::gen::inRange<int>(0, kStereoModes))};
        case 7: return SetTestPattern{static_cast<TestPattern>(*rc::gen::inRange(0, 4))};
        case 8: return SetEyeSwap{*rc::gen::arbitrary<bool>()};
        case 9: return SetForce{*rc::gen::arbitrary<bool>()};
        case 11: return SetForceShown{*rc::gen::arbitrary<bool>()};
        case 10: return ExportTo{"a \"part\" # " + std::to_string(*rc::gen::inRange(0, 1000)) + ".stl"};
        default: return ScreenshotTo{"wall.png"};
    }
}

std::string line_of(const CommandInput& input) {
    std::string line = as_word(input.name);
    for (const std::string& argument : input.arguments) line += " " + as_word(argument);
    return line;
}

RC_GTEST_PROP(Commands, ReadBackAsTheyWerePrinted, ()) {
    const SessionCommand command = any_command();
    const auto again = parse_command(as_input(command));
    RC_ASSERT(again.has_value());
    RC_ASSERT(*again == command);
    const auto from_line = parse_command_line(line_of(as_input(command)));
    RC_ASSERT(from_line.has_value());
    RC_ASSERT(*from_line == command);
}

// What is said of a tool is what the rest of the program understands.
RC_GTEST_PROP(Commands, NameToolsAsTheOptionDoes, ()) {
    const ToolSpec tool = any_tool();
    RC_PRE(tool.kind != ToolKind::mesh);
    ToolOptions options;
    options.shape = text_of(tool);
    RC_ASSERT(parse_tool(options).has_value());
}

// The other way of writing a colour, read by the option's own parser.
RC_GTEST_PROP(Commands, GiveTheOptionTheNearestColour, ()) {
    const SetColour colour{{between(0.0, 1.0), between(0.0, 1.0), between(0.0, 1.0)}};
    ToolOptions options;
    options.material = material_text(colour);
    const auto material = parse_tool_material(options);
    RC_ASSERT(material.has_value());
    for (std::size_t k = 0; k < 3; ++k) RC_ASSERT(std::abs(material->colour[k] - 255.0 * colour.srgb[k]) <= 0.5 + 1e-9);
}

TEST(Commands, AreListedOnceEachWithHelp) {
    std::set<std::string_view> names;
    for (const CommandSpec& spec : commands()) {
        EXPECT_TRUE(names.insert(spec.name).second) << spec.name << " is there twice";
        EXPECT_FALSE(spec.help.empty()) << spec.name;
    }
    for (const std::string_view action : action_names()) EXPECT_TRUE(names.contains(action)) << action;
}

TEST(Commands, WithoutArgumentsAreTheActionsOfTheKeys) {
    for (const std::string_view name : action_names()) {
        const auto command = parse_command({std::string(name), {}});
        ASSERT_TRUE(command) << command.error().line();
        const auto* action = std::get_if<RunAction>(&*command);
        ASSERT_NE(action, nullptr) << name;
        EXPECT_EQ(name_of(action->action), name);
    }
}

TEST(Commands, TellWhatIsWrongAndWhatWouldBeRight) {
    struct Wrong {
        const char* line;
        const char* named;   // what the error must name
        const char* remedy;  // and what it must offer
    };
    const std::array wrongs{
        Wrong{"raduis 0.004", "raduis", "radius"},
        Wrong{"radius", "radius", "write radius R"},
        Wrong{"radius 0.004 0.005", "radius", "write radius R"},
        Wrong{"radius large", "radius large", "number from"},
        Wrong{"radius nan", "radius nan", "number from"},
        Wrong{"radius -0.004", "radius -0.004", "in m"},
        Wrong{"radius 1e300", "radius 1e300", "to 10"},
        Wrong{"velocity-filter 1", "velocity-filter 1", "0.999"},
        Wrong{"tool bal:0.004", "tool bal", "did you mean ball"},
        Wrong{"tool ball", "tool ball", ""},
        Wrong{"tool ball:0", "tool ball:0", "above zero"},
        Wrong{"tool ball:20", "tool ball:20", "metres"},
        Wrong{"tool bullnose:0.001,0.002,0.01", "bullnose", "C up to both"},
        Wrong{"tool mesh:", "tool mesh:", "mesh:FILE"},
        Wrong{"operation pant", "operation pant", "did you mean paint"},
        Wrong{"colour 0.8,0.2", "colour 0.8,0.2", "0.8,0.2,0.1"},
        Wrong{"colour 0.8,0.2,1.1", "colour", "from 0 to 1"},
        Wrong{"technique moveing", "technique moveing", "moving"},
        Wrong{"stereo-mode anaglif", "stereo-mode anaglif", "anaglyph"},
        Wrong{"test-pattern ghost", "test-pattern ghost", "ghosting"},
        Wrong{"swap-eyes maybe", "swap-eyes maybe", "on"},
        Wrong{"force", "force", "on|off"},
        Wrong{"export \"\"", "export", "part.stl"},
        Wrong{"undo twice", "undo", "leave out"},
        Wrong{"", "command", "F1"},
    };
    for (const Wrong& wrong : wrongs) {
        const auto command = parse_command_line(wrong.line);
        ASSERT_FALSE(command) << wrong.line;
        EXPECT_TRUE(command.error().line().contains(wrong.named)) << wrong.line << " -> " << command.error().line();
        EXPECT_TRUE(command.error().remedy.contains(wrong.remedy)) << wrong.line << " -> " << command.error().line();
        EXPECT_FALSE(command.error().remedy.empty()) << wrong.line;
    }
}

}  // namespace
}  // namespace burin
