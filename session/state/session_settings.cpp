// SPDX-License-Identifier: MIT
#include "session/state/session_settings.hpp"

#include <array>
#include <charconv>
#include <iterator>
#include <map>
#include <optional>
#include <string_view>

#include "base/try.hpp"
#include "session/activity/activity.hpp"
#include "session/input/input_words.hpp"
#include "session/options/option_bounds.hpp"

namespace burin::session {
namespace {

// Before the command, which stands before the options. In older recordings the command is "sculpt" in all of them.
constexpr std::string_view kProgram = "burin ";
constexpr const char* kActivity = "--activity";  // behind it Activity::settings(); no option of the command line

// All options by name; behind a number its bounds.
template <typename Options, typename Visit>
void visit_settings(Options& o, Visit&& visit) {
    visit("--world", o.scene.world);
    visit("--world-units", o.scene.reading.unit);
    visit("--world-root", o.scene.reading.root);
    visit("--no-workpiece", o.scene.no_workpiece);
    visit("--points", o.hands.points);
    visit("--workpiece", o.carve.workpiece.source);
    visit("--units", o.carve.workpiece.units);
    visit("--export-units", o.carve.exports.units);
    visit("--close-holes", o.carve.workpiece.close_holes);
    visit("--weld", o.carve.workpiece.weld_m, kWeldBounds);
    visit("--resolution", o.carve.workpiece.resolution, kResolutionBounds);
    visit("--room", o.carve.workpiece.room, kRoomBounds);
    visit("--crumbs", o.carve.exports.crumbs_m);
    visit("--tool", o.hands.tool.shape);
    visit("--operation", o.hands.tool.operation);
    visit("--material", o.hands.tool.material);
    visit("--sweep-tolerance", o.hands.tool.sweep_tolerance_cells, kSweepToleranceBounds);
    visit("--smooth-strength", o.hands.tool.smooth_strength, kSmoothStrengthBounds);
    visit("--mirror", o.carve.mirror);
    visit("--hardness", o.carve.feel.hardness);
    visit("--yield", o.carve.feel.yield_kPa);
    visit("--grain", o.carve.feel.grain_mm);
    visit("--stiffness", o.carve.feel.stiffness_N_per_m);
    visit("--friction", o.carve.feel.friction);
    visit("--undo-memory", o.carve.undo_memory_MiB, kUndoMemoryBounds);
    visit("--device", o.hands.device);
    visit("--hands", o.hands.named);
    visit("--mouse", o.hands.mouse);
    visit("--wall", o.desk.wall);
    visit("--stereo", o.desk.stereo);
    visit("--swap-eyes", o.desk.swap_eyes);
    visit("--edge-comfort", o.desk.edge_comfort);
    visit("--width", o.desk.width, kPictureBounds);
    visit("--height", o.desk.height, kPictureBounds);
    visit("--panel-window", o.desk.panel_window);
    visit("--panel-scale", o.desk.panel_scale, kPanelScaleBounds);
    visit("--first-steps", o.desk.first_steps);
    visit("--frames-world", o.desk.frames_world);
    visit("--samples", o.desk.samples, kSampleCounts);
}

// ---- Text of an option's value; none: the option is absent. A flag that is present has an empty text.

std::optional<std::string> text(const std::string& value) {
    return value.empty() ? std::nullopt : std::optional(value);
}
std::optional<std::string> text(bool on) { return on ? std::optional<std::string>("") : std::nullopt; }
std::optional<std::string> text(compute::Operation operation) {
    return std::string(toolbox::descriptor_of(operation).name);
}
std::optional<std::string> text(LengthUnit unit) { return name_of(unit); }
std::optional<std::string> text(const toolbox::Mirror& mirror) {
    return mirror.any() ? std::optional(toolbox::name_of(mirror)) : std::nullopt;
}
std::optional<std::string> text(EdgeComfort comfort) {
    return comfort == EdgeComfort::automatic ? std::nullopt : std::optional(std::string(name_of(comfort)));
}
std::optional<std::string> text(MouseMode mode) { return std::string(name_of(mode)); }
std::optional<std::string> text(const std::vector<NamedDevice>& hands) {
    if (hands.empty()) return std::nullopt;
    std::string all;
    for (const NamedDevice& one : hands) all += (all.empty() ? "" : " ") + as_word(one.hand + "=" + one.device);
    return all;
}
template <typename T>
std::optional<std::string> text(T number) {
    std::array<char, 32> digits;
    return std::string(digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), number).ptr);
}
template <typename T>
std::optional<std::string> text(const std::optional<T>& value) {
    return value ? text(*value) : std::nullopt;
}

bool read(const std::string& text, std::string& value) {
    value = text;
    return true;
}
// As words, each of a hand: "right=simulated left=simulated-wand:w.toml".
bool read(const std::string& text, std::vector<NamedDevice>& hands) {
    const Result<std::vector<std::string>> words = words_of(text, "--hands");
    if (!words || words->size() > kMostHands) return false;
    for (const std::string& word : *words) {
        Result<NamedDevice> named = parse_named_device(word);
        if (!named) return false;
        hands.push_back(std::move(*named));
    }
    return true;
}
bool read(const std::string& text, bool& on) { return on = text.empty(); }
bool read(const std::string& text, compute::Operation& value) {
    for (const toolbox::OperationDescriptor& known : toolbox::operations()) {
        value = known.operation;
        if (known.name == text) return true;
    }
    return false;
}
bool read(const std::string& text, toolbox::Mirror& value) {
    const Result<toolbox::Mirror> mirror = toolbox::parse_mirror(text, "--mirror " + text);
    value = mirror.value_or(toolbox::Mirror{});
    return mirror.has_value();
}
bool read(const std::string& text, MouseMode& value) {
    const Result<MouseMode> mode = parse_mouse_mode(text, "--mouse " + text);
    value = mode.value_or(MouseMode::free);
    return mode.has_value();
}
bool read(const std::string& text, EdgeComfort& value) {
    const Result<EdgeComfort> comfort = parse_edge_comfort(text, "--edge-comfort " + text);
    value = comfort.value_or(EdgeComfort::automatic);
    return comfort.has_value();
}
bool read(const std::string& text, LengthUnit& value) {
    const auto unit = length_unit(text);
    value = unit.value_or(LengthUnit::m);
    return unit.has_value();
}
template <typename T>
bool read(const std::string& text, T& number) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    return error == std::errc{} && end == text.data() + text.size();
}
template <typename T>
bool read(const std::string& text, std::optional<T>& value) {
    return read(text, value.emplace());
}

// ---- What is beyond a number's bounds: in words what it should be; empty: it is within them.

template <typename T>
std::string beyond(const T&) {
    return {};
}
template <typename T, typename B>
std::string beyond(const T& value, const Bounds<B>& bounds) {
    const double number = static_cast<double>(value);
    if (number >= static_cast<double>(bounds.least) && number <= static_cast<double>(bounds.most)) return {};
    return "from " + *text(bounds.least) + " to " + *text(bounds.most);
}
template <typename T, typename B>
std::string beyond(const std::optional<T>& value, const Bounds<B>& bounds) {
    return value ? beyond(*value, bounds) : std::string();
}
template <typename T>
std::string beyond(const T& value, const std::initializer_list<int>& known) {
    std::string all;
    for (const int number : known) {
        if (value == static_cast<T>(number)) return {};
        all += (all.empty() ? "" : ", ") + std::to_string(number);
    }
    return "one of " + all;
}

// The usual device is written by no recording: those from before there were others do not name it either.
bool is_usual(const std::string& option, const std::string& value) {
    return option == "--device" && value == devices::kDefaultHapticDevice;
}

using OptionWords = std::map<std::string, std::string>;

// Returns the values of all options that are present, by option.
OptionWords words_behind(const SessionSetup& options) {
    OptionWords words;
    visit_settings(options, [&](const char* name, const auto& value, const auto&...) {
        if (const auto behind = text(value); behind && !is_usual(name, *behind)) words.emplace(name, *behind);
    });
    return words;
}

Result<OptionWords> words_on(const std::string& line) {
    BURIN_TRY(all, words_of(line, "the recording's first line"));
    OptionWords words;
    std::string option;
    for (const std::string& word : all) {
        if (word.starts_with("--")) {
            option = word;
            words[option] = "";
        } else if (!option.empty()) {
            words[std::exchange(option, {})] = word;
        }
    }
    return words;
}

std::string shown(const std::string& name, const OptionWords& words) {
    const auto found = words.find(name);
    if (found == words.end()) return "no " + name;
    return found->second.empty() ? name : name + " " + as_word(found->second);
}

// Takes the activity out of the words, and checks that it is the given one: the log does not hold what it does.
Result<void> check_activity(OptionWords& words, const Activity* given) {
    const auto recorded = words.extract(kActivity);
    const std::string then = recorded ? recorded.mapped() : "", now = given != nullptr ? given->settings() : "";
    if (then == now) return {};
    const auto named = [](const std::string& settings) {
        return settings.empty() ? "no activity" : "the activity " + as_word(settings);
    };
    const std::string command = then.substr(0, then.find(" --"));  // "rehab ball" of its settings
    std::string remedy = "replay it with burin sculpt or burin world";
    if (!then.empty() && now.starts_with(command))
        remedy = "leave out what was given otherwise: the recording has its own";
    else if (!then.empty())
        remedy = "do it again with the command that recorded it, burin " + command +
                 " --input FILE, or a session file with burin replay FILE";
    return fail("the recording", "is of " + named(then) + ", and this session has " + named(now), remedy);
}

// Completes the options of a recording that names no unit. Every recording has named one since there are units; before,
// files were read in metres, and a session without a --tool had a ball of 10 mm.
void as_before_units(SessionSetup& options) {
    options.record.from_before_units = !options.carve.workpiece.units.has_value();
    if (!options.record.from_before_units) return;
    options.carve.workpiece.units = LengthUnit::m;
    if (options.hands.tool.shape.empty()) options.hands.tool.shape = "ball:0.01";
}

// Returns whether options stand behind the program and its command.
bool has_options(std::string_view line) {
    if (!line.starts_with(kProgram)) return false;
    const std::size_t behind = line.find(' ', kProgram.size());
    return behind != std::string_view::npos && line.substr(behind).starts_with(" --");
}

// Returns the command that begins such a session.
std::string command_of(const SessionSetup& options) {
    if (options.activity) {
        const std::string settings = options.activity->settings();
        return settings.substr(0, settings.find(' '));
    }
    return options.scene.no_workpiece && !options.scene.world.empty() ? "world" : "sculpt";
}

}  // namespace

std::string settings_on(const std::string& header) {
    const std::size_t at = header.find(" " + std::string(kProgram));
    return at == std::string::npos ? std::string() : header.substr(at + 1);
}

std::string settings_line(const SessionSetup& options) {
    std::string line = std::string(kProgram) + command_of(options);
    visit_settings(options, [&](const char* name, const auto& value, const auto&...) {
        const auto behind = text(value);
        if (!behind || is_usual(name, *behind)) return;
        line += std::string(" ") + name;
        if (!behind->empty()) line += " " + as_word(*behind);
    });
    if (options.activity) line += std::string(" ") + kActivity + " " + as_word(options.activity->settings());
    return line;
}

Result<std::string> option_on(const std::string& line, const std::string& option) {
    if (!has_options(line)) return "";
    BURIN_TRY(words, words_on(line));
    const auto found = words.find(option);
    return found == words.end() ? "" : found->second;
}

Result<std::vector<NamedDevice>> hands_on(const std::string& line) {
    const Result<std::string> several = option_on(line, "--hands"), one = option_on(line, "--device");
    if (!several) return std::unexpected(several.error());
    if (!one) return std::unexpected(one.error());
    std::vector<NamedDevice> hands;
    if (!read(*several, hands))
        return fail("the recording's first line", "--hands " + *several + " is no value of that option");
    if (hands.empty()) hands.push_back({"", one->empty() ? devices::kDefaultHapticDevice : *one});
    return hands;
}

std::vector<std::string> setting_names() {
    std::vector<std::string> names;
    const SessionSetup defaults;
    visit_settings(defaults, [&](const char* name, const auto&...) { names.emplace_back(name); });
    return names;
}

Result<std::string> with_setting_of(const SessionSetup& from, const std::string& option, const std::string& line) {
    BURIN_TRY(words, words_of(line, "the recording's first line"));
    std::string changed;
    for (auto word = words.begin(); word != words.end(); ++word) {
        if (*word == option) {
            if (const auto next = std::next(word); next != words.end() && !next->starts_with("--")) ++word;
            continue;
        }
        changed += (changed.empty() ? "" : " ") + (word->starts_with("--") ? *word : as_word(*word));
    }
    const OptionWords behind = words_behind(from);
    const auto found = behind.find(option);
    if (found == behind.end()) return changed;
    return changed + " " + option + (found->second.empty() ? "" : " " + as_word(found->second));
}

Result<void> check_activity_on(const std::string& line, const Activity* given) {
    if (!has_options(line)) return {};
    BURIN_TRY(words, words_on(line));
    return check_activity(words, given);
}

Result<std::string> activity_on(const std::string& line) { return option_on(line, kActivity); }

Result<RecordedOptions> options_as_recorded(const std::string& line, const SessionSetup& given) {
    RecordedOptions recorded{given, {}};
    if (!has_options(line)) {  // recorded without options
        as_before_units(recorded.options);
        return recorded;
    }
    BURIN_TRY(words, words_on(line));
    BURIN_TRY_DO(check_activity(words, given.activity.get()));
    const SessionSetup defaults;
    const OptionWords given_words = words_behind(given), left_out = words_behind(defaults);
    std::string wrong;
    visit_settings(recorded.options, [&]<typename T>(const std::string& name, T& value, const auto&... bounds) {
        const std::string now = shown(name, given_words), then = shown(name, words);
        if (now != then && now != shown(name, left_out))
            recorded.overruled.push_back("it was recorded with " + then + ", which is done again; " + now +
                                         " does not count");
        value = T{};
        const auto found = words.extract(name);
        if (!found || !wrong.empty()) return;
        if (!read(found.mapped(), value))
            wrong = found.mapped().empty() ? name + " has no value" : then + " is no value of that option";
        else if (const std::string wanted = beyond(value, bounds...); !wanted.empty())
            wrong = then + " is not " + wanted;
    });
    if (!words.empty()) wrong = words.begin()->first + " is no option that a session knows";
    if (!wrong.empty()) return fail("the recording's first line", wrong, "replay it with the program that recorded it");
    if (recorded.options.hands.device.empty()) recorded.options.hands.device = devices::kDefaultHapticDevice;
    if (!recorded.options.hands.named.empty())
        recorded.options.hands.device = recorded.options.hands.named.front().device;
    as_before_units(recorded.options);
    return recorded;
}

}  // namespace burin::session
