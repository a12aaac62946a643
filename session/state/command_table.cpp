// SPDX-License-Identifier: MIT
#include "app/session/command_table.hpp"

#include <algorithm>

#include "app/session/input_keys.hpp"
#include "app/session/input_words.hpp"
#include "app/tool_option.hpp"
#include "app/workpiece.hpp"

namespace burin {

namespace {

using Parsed = Result<SessionCommand>;
using Arguments = std::span<const std::string>;

constexpr double kMostLength_m = 10.0;

// Bounds: lengths to 10 m as anywhere in the input log's scenes; a filter's a below 1, or it would never answer; an eye distance that no
// human head exceeds (Dodgson 2004: 52 to 78 mm), and 0 for two pictures that are one.
constexpr std::array<QuantityRange, 8> kRanges{{
    {Quantity::radius, "radius", "m", 1e-6, kMostLength_m, 0.0005, 0.05, true},
    {Quantity::hardness, "hardness", "N s/m3", 0.0, 1e12, 1e4, 1e8, true},
    {Quantity::friction, "friction", "", 0.0, 10.0, 0.0, 1.0, false},
    {Quantity::stiffness, "stiffness", "N/m", 0.0, 1e6, 50.0, 2000.0, true},
    {Quantity::velocity_filter, "velocity-filter", "", 0.0, 0.999, 0.0, 0.99, false},
    {Quantity::force_filter, "force-filter", "", 0.0, 0.999, 0.0, 0.99, false},
    {Quantity::scale, "scale", "", 1e-3, 1e3, 0.1, 20.0, true},
    {Quantity::eye_distance, "eye-distance", "m", 0.0, 0.1, 0.0, 0.08, false},
}};

std::unexpected<Error> no_argument(std::string_view command, std::string_view given, const std::string& remedy) {
    return fail("command " + std::string(command) + (given.empty() ? "" : " " + std::string(given)),
                given.empty() ? "says not what" : "is not known", remedy);
}

template <typename Names>
std::string listed(const Names& names) {
    std::string text;
    for (const std::string_view name : names) text += (text.empty() ? "" : ", ") + std::string(name);
    return text;
}

// The place of a word in a list of names.
Result<std::size_t> choice(std::string_view command, std::string_view word, std::span<const std::string_view> names) {
    const auto at = std::ranges::find(names, word);
    if (at == names.end()) {
        return no_argument(command, word,
                           "did you mean " + std::string(nearest_name(word, names)) + "? There are " + listed(names));
    }
    return static_cast<std::size_t>(at - names.begin());
}

template <typename Enum, std::size_t N>
Result<Enum> choice_of(std::string_view command, std::string_view word) {
    std::array<std::string_view, N> names;
    for (std::size_t i = 0; i < N; ++i) names[i] = file_name_of(static_cast<Enum>(i));
    const auto at = choice(command, word, names);
    if (!at) return std::unexpected(at.error());
    return static_cast<Enum>(*at);
}

Result<bool> parse_switch(std::string_view command, std::string_view word) {
    constexpr std::array<std::string_view, 2> kWords{"off", "on"};
    const auto at = choice(command, word, kWords);
    if (!at) return std::unexpected(at.error());
    return *at == 1;
}

Parsed parse_quantity(const QuantityRange& range, const std::string& word) {
    const std::string where = "command " + std::string(range.name) + " " + word;
    const auto number = parse_numbers(word, 1, where);
    std::string remedy = "write a number from " + as_input(SetQuantity{range.quantity, range.least}).arguments[0] +
                         " to " + as_input(SetQuantity{range.quantity, range.most}).arguments[0];
    if (!range.unit.empty()) remedy += ", in " + std::string(range.unit);
    if (!number) return fail(where, "is not a number", remedy);
    if ((*number)[0] < range.least || (*number)[0] > range.most) return fail(where, "is out of bounds", remedy);
    return SetQuantity{range.quantity, (*number)[0]};
}

Parsed parse_tool_command(Arguments words) {
    auto tool = parse_tool_spec(words[0]);
    if (!tool) return std::unexpected(tool.error());
    return SetTool{std::move(*tool)};
}

Parsed parse_operation(Arguments words) {
    const auto operation = choice_of<Operation, kOperations>("operation", words[0]);
    if (!operation) return std::unexpected(operation.error());
    return SetOperation{*operation};
}

Parsed parse_colour(Arguments words) {
    const std::string where = "command colour " + words[0];
    const char* const remedy = "write red,green,blue from 0 to 1, such as 0.8,0.2,0.1";
    const auto numbers = parse_numbers(words[0], 3, where);
    if (!numbers) return fail(where, "is no colour", remedy);
    if (std::ranges::any_of(*numbers, [](double part) { return part < 0.0 || part > 1.0; })) {
        return fail(where, "is out of bounds", remedy);
    }
    return SetColour{{(*numbers)[0], (*numbers)[1], (*numbers)[2]}};
}

Parsed parse_technique(Arguments words) {
    const auto technique = choice_of<WorkspaceTechnique, kTechniques>("technique", words[0]);
    if (!technique) return std::unexpected(technique.error());
    return SetTechnique{*technique};
}

// The parsers of others name no command in their errors.
template <typename T>
Result<T> of_command(Result<T> result, const std::string& command) {
    if (!result) result.error().where = "command " + command;
    return result;
}

Parsed parse_mode(Arguments words) {
    const auto mode = of_command(parse_stereo_mode(words[0]), "stereo-mode " + words[0]);
    if (!mode) return std::unexpected(mode.error());
    return SetStereoMode{*mode};
}

Parsed parse_pattern(Arguments words) {
    const auto pattern = of_command(parse_test_pattern(words[0]), "test-pattern " + words[0]);
    if (!pattern) return std::unexpected(pattern.error());
    return SetTestPattern{*pattern};
}

Parsed parse_eye_swap(Arguments words) {
    if (words.empty()) return RunAction{Action::swap_eyes};
    const auto on = parse_switch("swap-eyes", words[0]);
    if (!on) return std::unexpected(on.error());
    return SetEyeSwap{*on};
}

Parsed parse_force(Arguments words) {
    const auto on = parse_switch("force", words[0]);
    if (!on) return std::unexpected(on.error());
    return SetForce{*on};
}

Parsed parse_force_shown(Arguments words) {
    const auto on = parse_switch("show-force", words[0]);
    if (!on) return std::unexpected(on.error());
    return SetForceShown{*on};
}

Result<std::string> parse_path(std::string_view command, const std::string& path, const char* example) {
    if (path.empty() || path.contains('\0')) {
        return no_argument(command, "", "name a file, such as " + std::string(example));
    }
    return path;
}

Parsed parse_export(Arguments words) {
    auto path = parse_path("export", words[0], "part.stl");
    if (!path) return std::unexpected(path.error());
    return ExportTo{std::move(*path)};
}

Parsed parse_screenshot(Arguments words) {
    auto path = parse_path("screenshot", words[0], "wall.png");
    if (!path) return std::unexpected(path.error());
    return ScreenshotTo{std::move(*path)};
}

template <Quantity quantity>
Parsed parse_number_of(Arguments words) {
    return parse_quantity(range_of(quantity), words[0]);
}

struct Entry {
    CommandSpec spec;
    Parsed (*parse)(Arguments);  // null: an action
};

constexpr std::array kArguments{
    Entry{{"tool", "SHAPE", "Take a tool: ball:R, cylinder:R,L, cone:R0,R1,L, bullnose:R,C,L, box:X,Y,Z, mesh:FILE"},
          parse_tool_command},
    Entry{{"radius", "R", "The tool's radius in metres"}, parse_number_of<Quantity::radius>},
    Entry{{"operation", "WHAT", "What the tool does: cut, fill, paint or smooth"}, parse_operation},
    Entry{{"colour", "R,G,B", "Colour of what the tool leaves, each part from 0 to 1"}, parse_colour},
    Entry{{"hardness", "H", "How hard the material is to cut, in N s/m3"}, parse_number_of<Quantity::hardness>},
    Entry{{"friction", "MU", "Friction of the surface, Coulomb's coefficient"}, parse_number_of<Quantity::friction>},
    Entry{{"stiffness", "K", "Stiffness of the surface in N/m"}, parse_number_of<Quantity::stiffness>},
    Entry{{"force", "on|off", "Whether the device gives force"}, parse_force},
    Entry{{"velocity-filter", "A", "Moving average of the velocity, weight of the past; 0: none"},
          parse_number_of<Quantity::velocity_filter>},
    Entry{{"force-filter", "A", "Moving average of the force, weight of the past; 0: none"},
          parse_number_of<Quantity::force_filter>},
    Entry{{"technique", "NAME", "How the workspace moves: fixed, moving, scaling, clutching, bubble or drift"},
          parse_technique},
    Entry{{"scale", "G", "How much larger motions in the scene are than the hand's"}, parse_number_of<Quantity::scale>},
    Entry{{"stereo-mode", "NAME", "How the two eyes' pictures are shown, such as anaglyph_red_cyan"}, parse_mode},
    Entry{{"swap-eyes", "[on|off]", "Exchange the eyes; the other way round without argument"}, parse_eye_swap},
    Entry{{"test-pattern", "NAME", "Show none, eye_order, ghosting or geometry"}, parse_pattern},
    Entry{{"eye-distance", "D", "Distance between the eyes in metres"}, parse_number_of<Quantity::eye_distance>},
    Entry{{"show-force", "on|off", "Whether an arrow shows the force"}, parse_force_shown},
    Entry{{"export", "FILE", "Write the mesh to a file"}, parse_export},
    Entry{{"screenshot", "FILE", "Write a picture of the screen to a file"}, parse_screenshot},
};

constexpr std::size_t kActions = static_cast<std::size_t>(Action::quit) + 1;

std::string_view help_of(Action action) {
    const auto cut = std::ranges::find(short_cuts(), action, &ShortCut::action);
    return cut == short_cuts().end() ? std::string_view{} : cut->description;
}

// Both kinds; swap-eyes is an action that takes an argument too, and is listed once.
const std::vector<CommandSpec>& all_commands() {
    static const std::vector<CommandSpec> all = [] {
        std::vector<CommandSpec> list;
        for (const Entry& entry : kArguments) list.push_back(entry.spec);
        for (std::size_t i = 0; i < kActions; ++i) {
            const auto action = static_cast<Action>(i);
            if (action != Action::swap_eyes) list.push_back({name_of(action), "", help_of(action)});
        }
        return list;
    }();
    return all;
}

Parsed parse_action(const CommandInput& input) {
    const auto names = action_names();
    const auto at = std::ranges::find(names, std::string_view(input.name));
    if (at == names.end()) {
        std::vector<std::string_view> known;
        for (const CommandSpec& spec : all_commands()) known.push_back(spec.name);
        return fail("command " + input.name, "is not known",
                    "did you mean " + std::string(nearest_name(input.name, known)) + "? F1 lists all commands");
    }
    if (!input.arguments.empty()) {
        return fail("command " + input.name, "takes no argument", "leave out " + burin::quoted(input.arguments[0]));
    }
    return RunAction{static_cast<Action>(at - names.begin())};
}

}  // namespace

const QuantityRange& range_of(Quantity quantity) { return kRanges.at(static_cast<std::size_t>(quantity)); }

std::span<const CommandSpec> commands() { return all_commands(); }

Result<ToolSpec> parse_tool_spec(std::string_view text) {
    const std::size_t colon = text.find(':');
    const std::string where = "command tool " + std::string(text);
    const auto kind = choice_of<ToolKind, kToolKinds>("tool", text.substr(0, colon));
    if (!kind) return std::unexpected(kind.error());
    ToolSpec tool{*kind, {}, {}};
    const std::string rest(colon == std::string_view::npos ? std::string_view{} : text.substr(colon + 1));
    if (*kind == ToolKind::mesh) {
        if (rest.empty() || rest.contains('\0')) return fail(where, "names no file", "write mesh:FILE");
        tool.file = rest;
        return tool;
    }
    // What sizes make a tool is that parser's to say; here only that they are of this world.
    ToolOptions options;
    options.shape = text;
    if (const auto whole = of_command(parse_tool(options), "tool " + options.shape); !whole) {
        return std::unexpected(whole.error());
    }
    const auto sizes = parse_numbers(rest, size_names(*kind).size(), where);
    if (!sizes) return std::unexpected(sizes.error());
    if (std::ranges::any_of(*sizes, [](double size) { return size > kMostLength_m; })) {
        return fail(where, "is larger than 10 m", "give sizes in metres");
    }
    std::ranges::copy(*sizes, tool.sizes_m.begin());
    return tool;
}

Result<SessionCommand> parse_command(const CommandInput& input) {
    const auto entry = std::ranges::find_if(kArguments, [&](const Entry& e) { return e.spec.name == input.name; });
    if (entry == kArguments.end()) return parse_action(input);
    const bool optional = entry->spec.arguments.starts_with('[');
    if (input.arguments.size() > 1 || (input.arguments.empty() && !optional)) {
        return fail("command " + input.name, input.arguments.empty() ? "lacks its argument" : "takes one argument",
                    "write " + input.name + " " + std::string(entry->spec.arguments));
    }
    return entry->parse(input.arguments);
}

Result<SessionCommand> parse_command_line(std::string_view line) {
    auto words = words_of(line, "command");
    if (!words) return std::unexpected(words.error());
    if (words->empty()) return fail("command", "the line is empty", "write a command; F1 lists them");
    CommandInput input{words->front(), {words->begin() + 1, words->end()}};
    return parse_command(input);
}

}  // namespace burin
