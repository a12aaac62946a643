// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "session/input/input_words.hpp"
#include "session/state/command_table.hpp"
#include "toolbox/tool_options.hpp"

namespace burin::session {
namespace {

double between(double least, double most) {
    return least + (most - least) * (*rc::gen::inRange(0, 1'000'001)) / 1'000'000.0;
}

template <typename Descriptor>
const Descriptor& any_of(std::span<const Descriptor> table) {
    return table[*rc::gen::inRange<std::size_t>(0, table.size())];
}

toolbox::ToolSpec any_tool() {
    const toolbox::ToolDescriptor& kind = any_of(toolbox::tool_kinds());
    toolbox::ToolSpec tool{kind.kind, {}, {}};
    if (kind.used_sizes().empty()) {
        tool.file = "folder with blanks/" + std::to_string(*rc::gen::inRange(0, 1000)) + ":\"#.stl";
        return tool;
    }
    for (std::size_t i = 0; i < kind.used_sizes().size(); ++i) tool.sizes_m[i] = between(1e-5, 1.0);
    if (kind.rule.adapted != nullptr) tool.sizes_m = kind.rule.adapted(tool.sizes_m, 0, 1e-5);
    return tool;
}

SessionCommand any_command() {
    switch (*rc::gen::inRange(0, 27)) {
        case 0: return RunAction{static_cast<Action>(*rc::gen::inRange<std::size_t>(0, action_names().size()))};
        case 1: return SetTool{any_tool()};
        case 2: return SetOperation{any_of(toolbox::operations()).operation};
        case 3: return SetColour{{between(0.0, 1.0), between(0.0, 1.0), between(0.0, 1.0)}};
        case 4: {
            const QuantityDescriptor& range = any_of(quantities());
            return SetQuantity{range.quantity, between(range.least, range.most)};
        }
        case 5: return SetTechnique{any_of(techniques()).technique};
        case 6: return SetStereoMode{static_cast<wall::StereoMode>(*rc::gen::inRange<int>(0, wall::kStereoModes))};
        case 7: return SetTestPattern{static_cast<wall::TestPattern>(*rc::gen::inRange(0, 4))};
        case 8: return SetEyeSwap{*rc::gen::arbitrary<bool>()};
        case 9: return SetForce{*rc::gen::arbitrary<bool>()};
        case 16: {
            const auto any = [] { return *rc::gen::arbitrary<bool>(); };
            return SetMirror{{{any(), any(), any()}}};
        }
        case 15: return SetAmplifiers{*rc::gen::arbitrary<bool>()};
        case 14: return CalibrateHandle{*rc::gen::arbitrary<bool>()};
        case 13: return SetMaterial{any_of(toolbox::feel_presets()).preset};
        case 12: return SetCatchDrill{*rc::gen::arbitrary<bool>()};
        case 25: return SetEdgeComfort{static_cast<EdgeComfort>(*rc::gen::inRange(0, 3))};
        case 11: return SetForceShown{*rc::gen::arbitrary<bool>()};
        case 10: return ExportTo{"a \"part\" # " + std::to_string(*rc::gen::inRange(0, 1000)) + ".stl"};
        case 17: return SaveTo{};
        case 18: return SaveTo{"two words.burin"};
        case 19: return QuitDiscard{};
        case 20: return QuitSave{};
        case 21: return QuitStay{};
        case 22: return SaveAs{"two words.burin", static_cast<NameIs>(*rc::gen::inRange(0, 4))};
        case 23:
            return TellDocument{{.is = static_cast<DocumentIs>(*rc::gen::inRange(0, 4)),
                                 .name = "two words.burin",
                                 .has_file = *rc::gen::arbitrary<bool>(),
                                 .strokes = *rc::gen::inRange<std::size_t>(0, 100),
                                 .kept = *rc::gen::inRange<std::size_t>(0, 100),
                                 .saves = *rc::gen::inRange<std::size_t>(0, 100)}};
        case 24: return TellDocument{{.keeps = false}};
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
    const toolbox::ToolSpec tool = any_tool();
    const auto settings = toolbox::parse_tool_settings({.shape = toolbox::text_of(tool)});
    RC_ASSERT(settings.has_value());
    RC_ASSERT(settings->shape == tool);
}

TEST(Commands, AreListedOnceEachWithHelp) {
    std::set<std::string_view> names;
    for (const CommandSpec& spec : commands()) {
        EXPECT_TRUE(names.insert(spec.name).second) << spec.name << " is there twice";
        EXPECT_FALSE(spec.help.empty()) << spec.name;
    }
    for (const std::string_view action : action_names()) EXPECT_TRUE(names.contains(action)) << action;
    for (const QuantityDescriptor& quantity : quantities()) EXPECT_TRUE(names.contains(quantity.name)) << quantity.name;
}

// The help of a command that takes one of a table's names, read from that table, names each.
TEST(Commands, NameEveryKindOfToolOperationAndTechniqueInTheirHelp) {
    const auto help_of = [](std::string_view name) {
        return std::ranges::find(commands(), name, &CommandSpec::name)->help;
    };
    EXPECT_TRUE(help_of("tool").starts_with("Take a tool: ball:R, cylinder:R,L, cone:R0,R1,L, bullnose:R,C,L, box"));
    EXPECT_TRUE(help_of("operation").starts_with("What the tool does: cut, fill, paint"));
    EXPECT_TRUE(help_of("technique").starts_with("How the workspace moves: fixed, moving, scaling, clutching, bubble"));
    for (const std::string& synopsis : toolbox::tool_synopses()) EXPECT_TRUE(help_of("tool").contains(synopsis));
    for (const auto& operation : toolbox::operations()) EXPECT_TRUE(help_of("operation").contains(operation.name));
    for (const auto& technique : techniques()) EXPECT_TRUE(help_of("technique").contains(technique.name));
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
        Wrong{"edge-comfort onn", "edge-comfort onn", "on"},
        Wrong{"force", "force", "on|off"},
        Wrong{"export \"\"", "export", "part.stl"},
        Wrong{"undo twice", "undo", "leave out"},
        Wrong{"object Tube", "object", "NAME WHAT VALUE"},
        Wrong{"object Tube stifness 700", "object Tube stifness", "did you mean stiffness"},
        Wrong{"object Tube coulomb-velocity slow", "object Tube coulomb-velocity slow", "in m/s"},
        Wrong{"object Tube stiffness soft", "object Tube stiffness soft", "in N/m"},
        // These were found when half of the script was done.
        Wrong{"object Tube stiffness -1", "object Tube stiffness -1", "give N/m above 0 and up to 1e+05"},
        Wrong{"object Tube stiffness 0", "object Tube stiffness 0", "give N/m above 0 and up to 1e+05"},
        Wrong{"object Tube stiffness 2e5", "object Tube stiffness 2e5", "give N/m above 0 and up to 1e+05"},
        Wrong{"object Tube damping -1", "object Tube damping -1", "give a number from 0 to 1000"},
        Wrong{"object Tube friction 11", "object Tube friction 11", "give a number from 0 to 10"},
        Wrong{"object Tube static-friction -1", "object Tube static-friction -1", "give a number from 0 to 10"},
        Wrong{"object Tube dynamic-friction 11", "object Tube dynamic-friction 11", "give a number from 0 to 10"},
        Wrong{"object Tube coulomb-velocity 2", "object Tube coulomb-velocity 2", "give a number from 0 to 1"},
        Wrong{"object Tube scale 0", "object Tube scale 0", "give a factor from 1e-6 to 1e6"},
        Wrong{"object Tube position 0,0,2000", "object Tube position 0,0,2000", "give metres"},
        Wrong{"object Tube position 1,2", "object Tube position 1,2", "X,Y,Z"},
        Wrong{"object Tube seen maybe", "object Tube seen maybe", "on"},
        Wrong{"quit now", "quit now", "quit discard"},
        Wrong{"save-as part.stl", "save-as part.stl", ".burin"},
        Wrong{"save-as part.burin fre", "fre", "did you mean free"},
        Wrong{"document changd a.burin new 0/0 0", "changd", "did you mean changed"},
        Wrong{"document changed a.burin new all 0", "document all", "3/4"},
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
}  // namespace burin::session
