// SPDX-License-Identifier: MIT
#include "app/cli/command_line.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <string>
#include <string_view>
#include <system_error>
#include <type_traits>
#include <utility>

#include "base/text.hpp"

namespace burin::app {
namespace {

// ---- Numbers
// One rule for all options that take a number, since the library's own takes 010 for eight, 0x10 for sixteen, 1'000 for
// a thousand, and clips what is too large: decimal digits without zeros before them, the whole word, within bounds.

// The name of the check that an option's bounds stand in; CommandOption::within() narrows it.
constexpr const char* kNumberCheck = "number";

bool has_leading_zeros(std::string_view digits) {
    if (digits.starts_with('-')) digits.remove_prefix(1);
    return digits.size() > 1 && digits[0] == '0' && digits[1] >= '0' && digits[1] <= '9';
}

template <typename Number>
std::optional<Number> decimal_number(const std::string& text) {
    Number number{};
    const char* const end = text.data() + text.size();
    const auto [stopped, failed] = std::from_chars(text.data(), end, number);
    if (failed != std::errc() || stopped != end || has_leading_zeros(text)) return std::nullopt;
    if constexpr (std::is_floating_point_v<Number>)
        if (!std::isfinite(number)) return std::nullopt;
    return number;
}

// Returns the shortest text that is read as the same number.
template <typename Number>
std::string shortest(Number number) {
    std::array<char, 32> digits{};
    return {digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), number).ptr};
}

// Returns why a text is no number from least to most; empty where it is one.
template <typename Number>
std::string refusal(const std::string& text, Number least, Number most) {
    const auto number = decimal_number<Number>(text);
    if (number && *number >= least && *number <= most) return "";
    const char* const kind = std::is_floating_point_v<Number> ? "number" : "whole number";
    const bool bounded = least > std::numeric_limits<Number>::lowest() || most < std::numeric_limits<Number>::max();
    const std::string bounds =
        !bounded && std::is_floating_point_v<Number> ? "" : " from " + shortest(least) + " to " + shortest(most);
    return "'" + text + "' is no " + kind + bounds + (has_leading_zeros(text) ? ", without zeros before it" : "");
}

template <typename Number>
CommandOption with_number(CLI::Option* option) {
    using Limits = std::numeric_limits<Number>;
    option->check([](const std::string& text) { return refusal(text, Limits::lowest(), Limits::max()); }, "",
                  kNumberCheck);
    return CommandOption(option);
}

// Returns why a text is no value of a flag, as in --live=no; empty where it is one. The library takes any text that
// begins with a number.
std::string refusal_of_flag(const std::string& text) {
    static constexpr std::array<std::string_view, 8> kValues{"true", "false", "on", "off", "yes", "no", "1", "0"};
    if (std::ranges::find(kValues, text) != kValues.end()) return {};
    return "'" + text + "' is no value of a flag, which is on or off";
}

template <typename Number>
void narrow(CLI::Option* option, Number least, Number most) {
    CLI::Validator* const check = option->get_validator(kNumberCheck);
    check->operation([=](std::string& text) { return refusal<Number>(text, least, most); });
    check->description(std::string(std::is_floating_point_v<Number> ? "FLOAT" : "INT") + " in [" + shortest(least) +
                       " - " + shortest(most) + "]");
}

// ---- Names of assets

// Returns whether an option of that room takes other words too, such as a tool's shape or a device.
bool takes_other_words(AssetRoom room) {
    return room == AssetRoom::tools || room == AssetRoom::devices || room == AssetRoom::trackers;
}

std::string unknown_asset(AssetRoom room, const std::string& name) {
    std::string known;
    for (const std::string& one : asset_names(room)) known += (known.empty() ? ": " : ", ") + one;
    return "'" + name + "' is no file, and not among the " + room_folder(room) + known + " (assets: " + assets_line() +
           ")";
}

// Puts the path of an asset in the place of its name. Returns why the name can be none; empty where it may.
std::string resolve_asset(AssetRoom room, std::string& text) {
    const std::size_t colon = text.rfind(':');
    const bool has_kind = room == AssetRoom::tools || room == AssetRoom::devices;
    const std::size_t begin = has_kind && colon != std::string::npos ? colon + 1 : 0;
    const std::string name = text.substr(begin);
    if (const std::string path = asset_named(room, name); !path.empty()) {
        text.replace(begin, std::string::npos, path);
        return {};
    }
    const bool is_word = !name.empty() && name[0] != '-' && name.find_first_of("/.:") == std::string::npos;
    std::error_code ignored;
    if (!is_word || takes_other_words(room) || std::filesystem::exists(name, ignored)) return {};
    return unknown_asset(room, name);
}

// ---- Misspelt words

// Refuses an empty text, as of a shell's variable that is not set: without a word the option would be as if left out.
CLI::Option* not_empty(CLI::Option* option) {
    return option->check(
        [](const std::string& text) { return text.empty() ? std::string("is empty; leave it out for none") : ""; });
}

// Returns the name that a word was meant to be; empty where none is near.
std::string meant(std::string_view word, const std::vector<std::string>& names) {
    if (names.empty() || word.size() < 3) return "";
    const std::vector<std::string_view> all(names.begin(), names.end());
    const std::string_view nearest = nearest_name(word, all);
    const std::size_t most = word.size() < 6 ? 1 : 2;
    return edit_distance(word, nearest) <= most + (word.size() == nearest.size() ? 1 : 0) ? std::string(nearest) : "";
}

std::vector<std::string> subcommands_of(const CLI::App& app) {
    std::vector<std::string> names;
    for (const CLI::App* one : app.get_subcommands({})) names.push_back(one->get_name());
    return names;
}

std::vector<std::string> long_options_of(const CLI::App& app) {
    std::vector<std::string> names;
    for (const CLI::Option* option : app.get_options())
        for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    return names;
}

// Says what the first misspelt subcommand or option was meant to be; empty where nothing is misspelt so that one can
// tell. The library takes the value behind an unknown option for the value of a place, and blames that.
std::string misspelt(const CLI::App& program, int argc, const char* const* argv) {
    const CLI::App* at = &program;
    std::string path;
    for (int i = 1; i < argc; ++i) {
        const std::string word = argv[i];
        if (word == "--") break;
        if (word.starts_with("--")) {
            const std::string name = word.substr(0, word.find('='));
            const std::vector<std::string> known = long_options_of(*at);
            if (std::ranges::find(known, name) != known.end()) continue;
            if (const std::string option = meant(name, known); !option.empty())
                return name + " is no option; did you mean " + option + "? See burin " + path + "--help";
            continue;
        }
        const std::vector<std::string> known = subcommands_of(*at);
        if (known.empty() || word.starts_with('-')) continue;
        if (std::ranges::find(known, word) != known.end()) {
            at = at->get_subcommand(word);
            path += word + " ";
            continue;
        }
        const bool is_a_name = word.find_first_of("/.:") == std::string::npos;
        const std::string command = is_a_name ? meant(word, known) : "";
        if (!command.empty())
            return word + " is no command; did you mean " + command + "? See burin " + path + "--help";
    }
    return "";
}

}  // namespace

CommandOption CommandOption::required() {
    option_->required();
    return *this;
}

CommandOption CommandOption::show_default() {
    option_->capture_default_str();
    return *this;
}

CommandOption CommandOption::within(int least, int most) {
    narrow(option_, least, most);
    return *this;
}

CommandOption CommandOption::within(std::uint64_t least, std::uint64_t most) {
    narrow(option_, least, most);
    return *this;
}

CommandOption CommandOption::within(double least, double most) {
    narrow(option_, least, most);
    return *this;
}

CommandOption CommandOption::one_of(std::initializer_list<const char*> words) {
    return one_of(std::span(words.begin(), words.size()));
}

CommandOption CommandOption::one_of(std::span<const char* const> words) {
    option_->check(CLI::IsMember(std::vector<std::string>(words.begin(), words.end())));
    return *this;
}

CommandOption CommandOption::one_of(std::initializer_list<int> numbers) {
    option_->check(CLI::IsMember(std::vector<int>(numbers)));
    return *this;
}

CommandOption CommandOption::asset(AssetRoom room) {
    option_->transform(
        CLI::Validator([room](std::string& text) { return resolve_asset(room, text); }, "", room_folder(room)));
    return *this;
}

Command Command::subcommand(const std::string& name, const std::string& help) {
    return Command(app_->add_subcommand(name, help));
}

void Command::require_subcommand() { app_->require_subcommand(1); }

CommandOption Command::option(const std::string& name, std::string& to, const std::string& help) {
    return CommandOption(not_empty(app_->add_option(name, to, help)));
}

CommandOption Command::option(const std::string& name, std::vector<std::string>& to, const std::string& help) {
    return CommandOption(not_empty(app_->add_option(name, to, help)));
}

CommandOption Command::option(const std::string& name,
                              const std::function<Result<void>(const std::vector<std::string>&)>& take,
                              const std::string& help) {
    const std::function<void(const std::vector<std::string>&)> taken = [take](const std::vector<std::string>& given) {
        if (const auto ok = take(given); !ok) throw CLI::ValidationError(ok.error().line());
    };
    // One value each time that it is given, and no more: what follows may be a file's name.
    return CommandOption(
        app_->add_option_function(name, taken, help)->expected(1)->take_all()->allow_extra_args(false));
}

CommandOption Command::option(const std::string& name, int& to, const std::string& help) {
    return with_number<int>(app_->add_option(name, to, help));
}

CommandOption Command::option(const std::string& name, unsigned& to, const std::string& help) {
    return with_number<unsigned>(app_->add_option(name, to, help));
}

CommandOption Command::option(const std::string& name, std::uint64_t& to, const std::string& help) {
    return with_number<std::uint64_t>(app_->add_option(name, to, help));
}

CommandOption Command::option(const std::string& name, double& to, const std::string& help) {
    return with_number<double>(app_->add_option(name, to, help));
}

CommandOption Command::option(const std::string& name, std::optional<unsigned>& to, const std::string& help) {
    return with_number<unsigned>(app_->add_option(name, to, help));
}

CommandOption Command::option(const std::string& name, std::optional<std::uint64_t>& to, const std::string& help) {
    return with_number<std::uint64_t>(app_->add_option(name, to, help));
}

CommandOption Command::option(const std::string& name, std::optional<double>& to, const std::string& help) {
    return with_number<double>(app_->add_option(name, to, help));
}

CommandOption Command::flag(const std::string& name, bool& to, const std::string& help) {
    return CommandOption(app_->add_flag(name, to, help)->check(refusal_of_flag));
}

CommandOption Command::add_choice(const std::string& name, const std::string& help,
                                  const std::vector<std::pair<std::string, int>>& words,
                                  const std::function<void(int)>& choose) {
    enum class Chosen : int {};
    std::string known;
    for (const auto& [word, value] : words) known += (known.empty() ? "" : ", ") + word;
    // CLI11's own transformer lists the numbers behind the words too, in its help and its errors.
    const auto to_number = [words, known](std::string& text) -> std::string {
        const auto found = std::ranges::find(words, text, &std::pair<std::string, int>::first);
        if (found == words.end()) return "'" + text + "' is none of: " + known;
        text = std::to_string(found->second);
        return {};
    };
    auto* option = app_->add_option_function<Chosen>(
        name, [choose](const Chosen& chosen) { choose(static_cast<int>(chosen)); }, help);
    option->transform(CLI::Validator(to_number, "{" + known + "}"));
    return CommandOption(option);
}

CommandOption Command::unit(const std::string& name, std::optional<LengthUnit>& to, const std::string& help) {
    std::vector<std::pair<std::string, int>> words;
    for (const LengthUnitDescriptor& known : length_units())
        words.emplace_back(known.name, static_cast<int>(known.unit));
    return add_choice(name, help, words, [&to](int value) { to = static_cast<LengthUnit>(value); });
}

bool Command::parsed() const { return app_->parsed(); }

std::vector<std::string> Command::options() const {
    std::vector<std::string> names;
    for (const CLI::Option* option : app_->get_options()) names.push_back(option->get_name());
    return names;
}

std::vector<std::string> Command::given() const {
    std::vector<std::string> names;
    for (const CLI::Option* option : app_->get_options())
        if (option->count() > 0) names.push_back(option->get_name());
    return names;
}

CommandLine::CommandLine(const std::string& description) : app_(std::make_unique<CLI::App>(description)) {
    app_->require_subcommand(0, 1);
}

CommandLine::~CommandLine() = default;

Command CommandLine::program() { return Command(app_.get()); }

std::optional<int> CommandLine::parse(int argc, const char* const* argv) {
    try {
        app_->parse(argc, argv);
        return {};
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() == 0) return app_->exit(error);  // --help
        if (const std::string hint = misspelt(*app_, argc, argv); !hint.empty()) {
            std::fprintf(stderr, "burin: %s\n", hint.c_str());
            return 2;
        }
        std::string command;  // with its subcommands: "devices emulate "
        for (auto parsed = app_->get_subcommands(); !parsed.empty(); parsed = parsed.front()->get_subcommands())
            command += parsed.front()->get_name() + " ";
        std::fprintf(stderr, "burin: %s; see burin %s--help\n", error.what(), command.c_str());
        return 2;
    }
}

Result<void> CommandLine::take(const std::string& word) {
    const std::array<const char*, 2> words{"burin", word.c_str()};
    try {
        app_->parse(static_cast<int>(words.size()), words.data());
        return {};
    } catch (const CLI::ParseError& error) {
        // The library names the option before what its check has found.
        const std::string what = error.what(), name = word.substr(0, word.find('=')) + ": ";
        return fail(word, what.starts_with(name) ? what.substr(name.size()) : what);
    }
}

std::string CommandLine::help() const { return app_->help(); }

std::vector<ManualFile> CommandLine::manual(const std::string& version) const { return manual_files(*app_, version); }

}  // namespace burin::app
