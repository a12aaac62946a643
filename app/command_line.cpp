// SPDX-License-Identifier: MIT
#include "app/command_line.hpp"

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>

namespace burin::app {
namespace {

bool is_nan(const std::string& text) {
    char* end = nullptr;
    return std::isnan(std::strtod(text.c_str(), &end)) && end != text.c_str();
}

// Refuses a sign where no negative number can be meant: the library would wrap it to a huge one.
CommandOption unsigned_only(CLI::Option* option) {
    option->check(
        [](const std::string& text) { return text.starts_with('-') ? text + " is below zero" : std::string(); });
    return CommandOption(option);
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
    option_->check(CLI::Range(least, most));
    return *this;
}

CommandOption CommandOption::within(std::uint64_t least, std::uint64_t most) {
    option_->check(CLI::Range(least, most));
    return *this;
}

CommandOption CommandOption::within(double least, double most) {
    // CLI::Range lets a number pass that is none.
    option_->check([](const std::string& text) { return is_nan(text) ? text + " is no number" : std::string(); });
    option_->check(CLI::Range(least, most));
    return *this;
}

CommandOption CommandOption::one_of(std::initializer_list<const char*> words) {
    option_->check(CLI::IsMember(std::vector<std::string>(words.begin(), words.end())));
    return *this;
}

CommandOption CommandOption::one_of(std::initializer_list<int> numbers) {
    option_->check(CLI::IsMember(std::vector<int>(numbers)));
    return *this;
}

Command Command::subcommand(const std::string& name, const std::string& help) {
    return Command(app_->add_subcommand(name, help));
}

void Command::require_subcommand() { app_->require_subcommand(1); }

CommandOption Command::option(const std::string& name, std::string& to, const std::string& help) {
    return CommandOption(app_->add_option(name, to, help));
}

CommandOption Command::option(const std::string& name, std::vector<std::string>& to, const std::string& help) {
    return CommandOption(app_->add_option(name, to, help));
}

CommandOption Command::option(const std::string& name, int& to, const std::string& help) {
    return CommandOption(app_->add_option(name, to, help));
}

CommandOption Command::option(const std::string& name, unsigned& to, const std::string& help) {
    return unsigned_only(app_->add_option(name, to, help));
}

CommandOption Command::option(const std::string& name, std::uint64_t& to, const std::string& help) {
    return unsigned_only(app_->add_option(name, to, help));
}

CommandOption Command::option(const std::string& name, double& to, const std::string& help) {
    return CommandOption(app_->add_option(name, to, help));
}

CommandOption Command::option(const std::string& name, std::optional<unsigned>& to, const std::string& help) {
    return unsigned_only(app_->add_option(name, to, help));
}

CommandOption Command::option(const std::string& name, std::optional<std::uint64_t>& to, const std::string& help) {
    return unsigned_only(app_->add_option(name, to, help));
}

CommandOption Command::option(const std::string& name, std::optional<double>& to, const std::string& help) {
    return CommandOption(app_->add_option(name, to, help));
}

CommandOption Command::flag(const std::string& name, bool& to, const std::string& help) {
    return CommandOption(app_->add_flag(name, to, help));
}

CommandOption Command::add_choice(const std::string& name, const std::string& help,
                                  const std::vector<std::pair<std::string, int>>& words,
                                  const std::function<void(int)>& choose) {
    enum class Chosen : int {};
    std::map<std::string, Chosen> values;
    for (const auto& [word, value] : words) values[word] = Chosen{value};
    auto* option = app_->add_option_function<Chosen>(
        name, [choose](const Chosen& chosen) { choose(static_cast<int>(chosen)); }, help);
    option->transform(CLI::CheckedTransformer(values));
    return CommandOption(option);
}

CommandOption Command::unit(const std::string& name, std::optional<LengthUnit>& to, const std::string& help) {
    std::vector<std::pair<std::string, int>> words;
    for (const LengthUnitDescriptor& known : length_units())
        words.emplace_back(known.name, static_cast<int>(known.unit));
    return add_choice(name, help, words, [&to](int value) { to = static_cast<LengthUnit>(value); });
}

bool Command::parsed() const { return app_->parsed(); }

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
        const auto parsed = app_->get_subcommands();
        const std::string command = parsed.empty() ? "" : parsed.front()->get_name() + " ";
        std::fprintf(stderr, "burin: %s; see burin %s--help\n", error.what(), command.c_str());
        return 2;
    }
}

std::string CommandLine::help() const { return app_->help(); }

}  // namespace burin::app
