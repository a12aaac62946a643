// SPDX-License-Identifier: MIT
#include "session/state/command_table.hpp"

#include <algorithm>
#include <charconv>

#include "base/near_name.hpp"
#include "base/numbers.hpp"
#include "base/try.hpp"
#include "document/document_file.hpp"
#include "scene/object_property.hpp"
#include "session/input/input_words.hpp"

namespace burin::session {

namespace {

using Parsed = Result<SessionCommand>;
using CommandWords = std::span<const std::string>;

std::unexpected<Error> no_argument(std::string_view command, std::string_view given, const std::string& remedy) {
    return fail("command " + std::string(command) + (given.empty() ? "" : " " + std::string(given)),
                given.empty() ? "says not what" : "is not known", remedy);
}

std::string listed(const auto& names) {
    std::string text;
    for (const std::string_view name : names) text += (text.empty() ? "" : ", ") + std::string(name);
    return text;
}

// Returns the index of a word in a list of names.
Result<std::size_t> choice(std::string_view command, std::string_view word, std::span<const std::string_view> names) {
    return read_name(word, names, "command " + std::string(command));
}

// Returns the descriptor in a table with this name.
template <typename Descriptor>
Result<Descriptor> choice_of(std::string_view command, std::string_view word, std::span<const Descriptor> table) {
    std::vector<std::string_view> names;
    for (const Descriptor& descriptor : table) names.push_back(descriptor.name);
    BURIN_TRY(at, choice(command, word, names));
    return table[at];
}

constexpr std::array<std::string_view, 4> kSwitchWords{"off", "on", "no", "yes"};

Result<bool> parse_switch(std::string_view command, std::string_view word) {
    BURIN_TRY(at, choice(command, word, kSwitchWords));
    return at % 2 == 1;
}

ArgumentKind kind_of(const QuantityDescriptor& range) { return number_within(range.least, range.most, range.unit); }

Parsed parse_tool(CommandWords words) {
    const std::string& text = words[0];
    // Looks the kind up first, because this error offers the nearest name.
    BURIN_TRY(kind, choice_of("tool", text.substr(0, text.find(':')), toolbox::tool_kinds()));
    const std::string where = "command tool " + text;
    BURIN_TRY(tool, toolbox::parse_tool_spec(text, where));
    return SetTool{std::move(tool)};
}

Parsed parse_operation(CommandWords words) {
    BURIN_TRY(operation, choice_of("operation", words[0], toolbox::operations()));
    return SetOperation{operation.operation};
}

Parsed parse_colour(CommandWords words) {
    BURIN_TRY(srgb, read_colour(words[0], "command colour " + words[0]));
    return SetColour{srgb};
}

Parsed parse_material(CommandWords words) {
    BURIN_TRY(preset, choice_of("material", words[0], toolbox::feel_presets()));
    return SetMaterial{preset.preset};
}

Parsed parse_technique(CommandWords words) {
    BURIN_TRY(technique, choice_of("technique", words[0], techniques()));
    return SetTechnique{technique.technique};
}

// Makes the error of another parser name the command; these parsers do not know it.
template <typename T>
Result<T> of_command(Result<T> result, const std::string& command) {
    if (!result) result.error().where = "command " + command;
    return result;
}

Parsed parse_mode(CommandWords words) {
    BURIN_TRY(mode, of_command(wall::parse_stereo_mode(words[0]), "stereo-mode " + words[0]));
    return SetStereoMode{mode};
}

Parsed parse_pattern(CommandWords words) {
    BURIN_TRY(pattern, of_command(wall::parse_test_pattern(words[0]), "test-pattern " + words[0]));
    return SetTestPattern{pattern};
}

Parsed parse_eye_swap(CommandWords words) {
    if (words.empty()) return RunAction{Action::swap_eyes};
    BURIN_TRY(on, parse_switch("swap-eyes", words[0]));
    return SetEyeSwap{on};
}

Parsed parse_edges(CommandWords words) {
    BURIN_TRY(comfort,
              of_command(parse_edge_comfort(words[0], "edge-comfort " + words[0]), "edge-comfort " + words[0]));
    return SetEdgeComfort{comfort};
}

Parsed parse_force(CommandWords words) {
    BURIN_TRY(on, parse_switch("force", words[0]));
    return SetForce{on};
}

Parsed parse_amplifiers(CommandWords words) {
    BURIN_TRY(on, parse_switch("amplifiers", words[0]));
    return SetAmplifiers{on};
}

Parsed parse_force_shown(CommandWords words) {
    BURIN_TRY(on, parse_switch("show-force", words[0]));
    return SetForceShown{on};
}

Parsed parse_catch_drill(CommandWords words) {
    BURIN_TRY(on, parse_switch("catch-drill", words[0]));
    return SetCatchDrill{on};
}

Result<std::string> parse_path(std::string_view command, const std::string& path, const char* example) {
    if (path.empty() || path.contains('\0')) {
        return no_argument(command, "", "name a file, such as " + std::string(example));
    }
    return path;
}

Parsed parse_export(CommandWords words) {
    BURIN_TRY(path, parse_path("export", words[0], "part.stl"));
    return ExportTo{std::move(path)};
}

Result<void> check_document_name(const std::string& command, const std::string& path) {
    if (document::is_document_name(path)) return {};
    return fail("command " + command + " " + path, "is no name of a document",
                "name it .burin; export FILE writes a mesh");
}

Parsed parse_save(CommandWords words) {
    if (words.empty()) return SaveTo{};
    BURIN_TRY(path, parse_path("save", words[0], "bust.burin"));
    BURIN_TRY_DO(check_document_name("save", path));
    return SaveTo{std::move(path)};
}

Parsed parse_save_as(CommandWords words) {
    if (words.empty()) return RunAction{Action::save_as};
    BURIN_TRY(path, parse_path("save-as", words[0], "bust.burin"));
    BURIN_TRY_DO(check_document_name("save-as", path));
    if (words.size() == 1) return SaveAs{std::move(path)};
    BURIN_TRY(is, choice("save-as " + words[0], words[1], name_states()));
    return SaveAs{std::move(path), static_cast<NameIs>(is)};
}

Result<std::size_t> parse_count(std::string_view word, const std::string& where) {
    std::size_t count = 0;
    const auto [end, failed] = std::from_chars(word.data(), word.data() + word.size(), count);
    if (failed == std::errc{} && end == word.data() + word.size()) return count;
    return fail(where, "is not a count", "write a whole number, such as 3");
}

Parsed parse_document(CommandWords words) {
    BURIN_TRY(is, choice("document", words[0], document_states()));
    DocumentTold told{.is = static_cast<DocumentIs>(is), .name = words[1]};
    BURIN_TRY(place, choice("document", words[2], std::array<std::string_view, 2>{"new", "file"}));
    told.has_file = place == 1;
    const std::string& kept = words[3];
    const std::size_t slash = kept.find('/');
    told.keeps = kept != "none";
    if (told.keeps && slash == std::string::npos)
        return no_argument("document", kept, "write how many of how many strokes are kept, such as 3/4, or none");
    const auto first = parse_count(told.keeps ? kept.substr(0, slash) : "0", "command document " + kept);
    const auto of = parse_count(told.keeps ? kept.substr(slash + 1) : "0", "command document " + kept);
    const auto saves = parse_count(words[4], "command document " + words[4]);
    for (const auto* const count : {&first, &of, &saves})
        if (!*count) return std::unexpected(count->error());
    told.kept = *first;
    told.strokes = *of;
    told.saves = *saves;
    return TellDocument{std::move(told)};
}

Parsed parse_quit(CommandWords words) {
    if (words.empty()) return RunAction{Action::quit};
    if (words[0] == "discard") return QuitDiscard{};
    if (words[0] == "save") return QuitSave{};
    if (words[0] == "stay") return QuitStay{};
    return no_argument("quit", words[0], "write quit, quit save, or quit discard, which forgets what was not saved");
}

Parsed parse_screenshot(CommandWords words) {
    BURIN_TRY(path, parse_path("screenshot", words[0], "wall.png"));
    return ScreenshotTo{std::move(path)};
}

Result<scene::PropertyValue> parse_value(const scene::PropertyDescriptor& property, const std::string& word,
                                         const std::string& where) {
    scene::PropertyValue value{};
    if (property.numbers == 0) {
        BURIN_TRY(on, of_command(parse_switch("object", word), where.substr(8)));
        value[0] = on ? 1.0 : 0.0;
        return value;
    }
    constexpr const char* kOpacityRemedy = "write a number from 0, clear as glass, to 1, which hides what is behind";
    const bool is_opacity = property.property == scene::ObjectProperty::opacity;
    const auto numbers = parse_numbers(word, property.numbers, where);
    if (!numbers) {
        const std::string unit = property.unit.empty() ? "" : ", in " + std::string(property.unit);
        return fail(where, property.numbers == 1 ? "is not a number" : "is not " + std::string(property.argument),
                    is_opacity ? kOpacityRemedy : "write " + std::string(property.argument) + unit);
    }
    std::ranges::copy(*numbers, value.begin());
    const auto is_part = [](double part) { return part >= 0.0 && part <= 1.0; };
    if (property.property == scene::ObjectProperty::colour && !std::ranges::all_of(*numbers, is_part))
        return fail(where, "is out of bounds", "write R,G,B from 0 to 1, such as 0.8,0.2,0.1");
    if (is_opacity && !is_part(value[0])) return fail(where, "is out of bounds", kOpacityRemedy);
    if (property.property == scene::ObjectProperty::orientation && !(Vec3(value[0], value[1], value[2]) != Vec3(0.0)))
        return fail(where, "has an axis without length", "write an axis and an angle in radians, such as 0,1,0,1.57");
    if (const auto possible = scene::check_value(property.property, value); !possible)
        return fail(where, possible.error().what, possible.error().remedy);
    return value;
}

Parsed parse_object(CommandWords words) {
    BURIN_TRY(property, choice_of("object " + words[0], words[1], scene::object_properties()));
    const std::string where = "command object " + words[0] + " " + words[1] + " " + words[2];
    BURIN_TRY(value, parse_value(property, words[2], where));
    return EditObject{words[0], property.property, value};
}

Parsed parse_act(CommandWords words) { return DoAct{{words.begin(), words.end()}}; }

Parsed parse_select(CommandWords words) { return SelectObject{words[0]}; }

Parsed parse_hand(CommandWords words) { return LeadHand{words[0]}; }

Parsed parse_calibrate(CommandWords words) {
    if (words.empty()) return CalibrateHandle{};
    if (words[0] == "reset") return CalibrateHandle{.reset = true};
    return no_argument("calibrate", words[0], "write calibrate, or calibrate reset");
}

Parsed parse_mouse(CommandWords words) {
    BURIN_TRY(at, choice("mouse", words[0], mouse_mode_names()));
    return SetMouse{static_cast<MouseMode>(at)};
}

Parsed parse_mirror(CommandWords words) {
    BURIN_TRY(mirror, toolbox::parse_mirror(words[0], "command mirror " + words[0]));
    return SetMirror{mirror};
}

template <Quantity quantity>
Parsed parse_number_of(CommandWords words) {
    return SetQuantity{quantity, number_of(words[0])};
}

struct Entry {
    CommandSpec spec;
    Parsed (*parse)(CommandWords);
};

template <Quantity quantity>
Entry entry_of() {
    const QuantityDescriptor& q = descriptor_of(quantity);
    return {{q.name, q.argument, q.help, {kind_of(q)}}, parse_number_of<quantity>};
}

std::vector<std::string_view> names_of(const auto& descriptors) {
    std::vector<std::string_view> names;
    for (const auto& descriptor : descriptors) names.push_back(descriptor.name);
    return names;
}

// What help and kinds of arguments read from other tables, kept for as long as the program runs.
struct NamesInTables {
    std::vector<std::string_view> operations = names_of(toolbox::operations());
    std::vector<std::string_view> materials = names_of(toolbox::feel_presets());
    std::vector<std::string_view> techniques = names_of(session::techniques());
    std::string tool_help = "Take a tool: " + listed(toolbox::tool_synopses());
    std::string operation_help = "What the tool does: " + all_of(toolbox::operations());
    std::string material_help = "What the workpiece feels like: " + all_of(toolbox::feel_presets());
    std::string technique_help = "How the workspace moves: " + all_of(session::techniques());
    std::string object_help = "Change an object of the world: " + all_of(scene::object_properties());

private:
    static std::string all_of(const auto& descriptors) { return alternatives(names_in(descriptors)); }
};

// Lists the commands that take an argument.
const std::vector<Entry>& entries() {
    static const NamesInTables in;
    constexpr ArgumentKind kSwitch = name_of_these(kSwitchWords);
    static const std::vector<Entry> all{
        {{"tool", "SHAPE", in.tool_help}, parse_tool},
        entry_of<Quantity::radius>(),
        {{"operation", "WHAT", in.operation_help, {name_of_these(in.operations)}}, parse_operation},
        {{"colour", "R,G,B", "Colour of what the tool leaves, each part from 0 to 1", {colour_word()}}, parse_colour},
        {{"material", "NAME", in.material_help, {name_of_these(in.materials)}}, parse_material},
        entry_of<Quantity::hardness>(),
        entry_of<Quantity::friction>(),
        entry_of<Quantity::stiffness>(),
        {{"force", "on|off", "Whether the device gives force", {kSwitch}}, parse_force},
        {{"amplifiers", "on|off", "Enable the device's amplifiers again after a trip, or switch them off", {kSwitch}},
         parse_amplifiers},
        entry_of<Quantity::velocity_filter>(),
        entry_of<Quantity::force_filter>(),
        {{"technique", "NAME", in.technique_help, {name_of_these(in.techniques)}}, parse_technique},
        entry_of<Quantity::scale>(),
        {{"stereo-mode", "NAME", "How the two eyes' pictures are shown, such as anaglyph_red_cyan"}, parse_mode},
        {{"swap-eyes", "[on|off]", "Exchange the eyes; the other way round without argument", {kSwitch}},
         parse_eye_swap},
        {{"edge-comfort", "auto|on|off", "Whether depth fades towards the edge of a lone screen, for the eyes' ease"},
         parse_edges},
        {{"test-pattern", "NAME", "Show none, eye_order, ghosting or geometry"}, parse_pattern},
        entry_of<Quantity::eye_distance>(),
        {{"mirror", "AXES",
          "Carve the other side as well, across planes through the workpiece's middle: x, y, z, several such as xz, or "
          "none"},
         parse_mirror},
        {{"object", "NAME WHAT VALUE", in.object_help}, parse_object},
        {{"select", "NAME", "Show an object of the world on the panel"}, parse_select},
        {{"mouse",
          "surface|free",
          "Whether the tool is where the cursor points, or the mouse moves it along the screen",
          {name_of_these(mouse_mode_names())}},
         parse_mouse},
        entry_of<Quantity::strength>(),
        {{"hand", "NAME", "Lead the hand of this name with mouse and keys, of several"}, parse_hand},
        {{"do", "ACT...", "Tell the activity something, as the buttons of its section do"}, parse_act},
        {{"show-force", "on|off", "Whether an arrow shows the force", {kSwitch}}, parse_force_shown},
        {{"calibrate", "[reset]", "Take the wand, now in its jig, for being where that is; or take that back"},
         parse_calibrate},
        {{"catch-drill", "on|off", "Hold the tool where it is, to see the watch let the hand go", {kSwitch}},
         parse_catch_drill},
        {{"save", "[FILE]", "Save the work as a document, FILE.burin; without a name into the one that it has"},
         parse_save},
        {{"save-as", "[FILE] [given|free|taken|replaced]",
          "Ask for the name of a file, or save the work under one: what is known of it stands behind"},
         parse_save_as},
        {{"document", "STATE NAME PLACE KEPT SAVES", "What the program tells of the document, for a replay"},
         parse_document},
        {{"quit", "[save|discard|stay]",
          "Quit; what was not saved is asked about, or else kept for the next session, saved or discarded"},
         parse_quit},
        {{"export", "FILE", "Write the mesh to a file"}, parse_export},
        {{"screenshot", "FILE", "Write a picture of the screen to a file"}, parse_screenshot},
    };
    return all;
}

constexpr std::size_t kActions = static_cast<std::size_t>(Action::quit) + 1;

// Lists commands with arguments and actions. swap-eyes, save-as and quit are actions that also take an argument, and
// are listed once.
const std::vector<CommandSpec>& all_commands() {
    static const std::vector<CommandSpec> all = [] {
        std::vector<CommandSpec> list;
        for (const Entry& entry : entries()) list.push_back(entry.spec);
        for (std::size_t i = 0; i < kActions; ++i) {
            const auto action = static_cast<Action>(i);
            if (action != Action::swap_eyes && action != Action::save_as && action != Action::quit)
                list.push_back({name_of(action), "", help_of(action)});
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
                    meant_by(input.name, known) + "docs/formats.md lists all commands, and F1 in a window");
    }
    if (!input.arguments.empty()) {
        return fail("command " + input.name, "takes no argument",
                    "leave out " + burin::session::quoted(input.arguments[0]));
    }
    return RunAction{static_cast<Action>(at - names.begin())};
}

}  // namespace

std::span<const CommandSpec> commands() { return all_commands(); }

Result<SessionCommand> parse_command(const CommandInput& input) {
    const auto entry = std::ranges::find_if(entries(), [&](const Entry& e) { return e.spec.name == input.name; });
    if (entry == entries().end()) return parse_action(input);
    BURIN_TRY_DO(check_words(entry->spec, input.arguments));
    return entry->parse(input.arguments);
}

Result<SessionCommand> parse_command_line(std::string_view line) {
    BURIN_TRY(words, words_of(line, "command"));
    if (words.empty()) return fail("command", "the line is empty", "write a command; F1 lists them");
    CommandInput input{words.front(), {words.begin() + 1, words.end()}};
    return parse_command(input);
}

}  // namespace burin::session
