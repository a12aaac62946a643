// SPDX-License-Identifier: MIT
// The command line: commands, subcommands, and options that write to variables. Those variables, and the CommandLine
// itself, must outlive the parse; Command and CommandOption only refer to it. One thread.
//
// Hides CLI11, whose templates cost a compiler 20 seconds in every source that includes it: only command_line.cpp
// and command_manual.cpp do.
#pragma once

#include <cstdint>
#include <functional>
#include <initializer_list>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "app/cli/command_manual.hpp"
#include "base/assets.hpp"
#include "base/error.hpp"
#include "base/length_unit.hpp"
#include "session/options/bounds.hpp"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace burin::app {

// An option that has been added; its functions restrict and document it, and return it to be chained.
class CommandOption {
public:
    explicit CommandOption(CLI::Option* option) : option_(option) {}

    CommandOption required();
    CommandOption show_default();  // shows the present value of the variable in the help
    // Restrict the value; anything else is wrong usage. Both ends of a range belong to it. Of options that take a
    // number only.
    CommandOption within(int least, int most);
    CommandOption within(std::uint64_t least, std::uint64_t most);
    CommandOption within(double least, double most);
    template <typename T>
    CommandOption within(const session::Bounds<T>& bounds) {
        return within(bounds.least, bounds.most);
    }
    CommandOption one_of(std::span<const char* const> words);
    CommandOption one_of(std::initializer_list<const char*> words);
    CommandOption one_of(std::initializer_list<int> numbers);
    // The value names a file, or one of the room's that come with the program (base/assets.hpp), whose path the
    // variable then holds: "garden", and "mesh:hex-bar" of a tool or "simulated-wand:short-wand" of a device. A single
    // word that is neither is wrong usage where the option takes nothing but files; any other name goes on as it is.
    CommandOption asset(AssetRoom room);

private:
    CLI::Option* option_;
};

class Command {
public:
    explicit Command(CLI::App* app = nullptr) : app_(app) {}

    Command subcommand(const std::string& name, const std::string& help);
    // Makes it wrong usage to name none of the subcommands.
    void require_subcommand();

    // Add an option: "--name" takes a value, "NAME" is the value at that place. Where the option is not given, an
    // optional stays empty and any other variable as it is; a vector takes all values, also of a repeated option.
    // Numbers are decimal, without zeros before them and within what the variable holds; anything else is wrong usage.
    CommandOption option(const std::string& name, std::string& to, const std::string& help);
    CommandOption option(const std::string& name, std::vector<std::string>& to, const std::string& help);
    // Adds an option whose values all go to `take`; a failure of that function is reported as wrong usage.
    CommandOption option(const std::string& name,
                         const std::function<Result<void>(const std::vector<std::string>&)>& take,
                         const std::string& help);
    CommandOption option(const std::string& name, int& to, const std::string& help);
    CommandOption option(const std::string& name, unsigned& to, const std::string& help);
    CommandOption option(const std::string& name, std::uint64_t& to, const std::string& help);
    CommandOption option(const std::string& name, double& to, const std::string& help);
    CommandOption option(const std::string& name, std::optional<unsigned>& to, const std::string& help);
    CommandOption option(const std::string& name, std::optional<std::uint64_t>& to, const std::string& help);
    CommandOption option(const std::string& name, std::optional<double>& to, const std::string& help);
    // Adds a flag, which sets its variable to true; "!--no-name" sets it to false.
    CommandOption flag(const std::string& name, bool& to, const std::string& help);

    // Adds an option that takes one of an enumeration's values, by its word or its number.
    template <typename Choice>
    CommandOption choice(const std::string& name, Choice& to, const std::string& help,
                         const std::vector<std::pair<std::string, Choice>>& words) {
        std::vector<std::pair<std::string, int>> numbered;
        for (const auto& [word, value] : words) numbered.emplace_back(word, static_cast<int>(value));
        return add_choice(name, help, numbered, [&to](int value) { to = static_cast<Choice>(value); });
    }
    // Adds an option that takes a unit of length by its name: m, cm, mm, in or ft.
    CommandOption unit(const std::string& name, std::optional<LengthUnit>& to, const std::string& help);

    [[nodiscard]] bool parsed() const;  // whether it was named on the command line
    // Names of its options in the order in which they were added: all, and those that the command line gave.
    [[nodiscard]] std::vector<std::string> options() const;
    [[nodiscard]] std::vector<std::string> given() const;

private:
    CommandOption add_choice(const std::string& name, const std::string& help,
                             const std::vector<std::pair<std::string, int>>& words,
                             const std::function<void(int)>& choose);

    CLI::App* app_;
};

class CommandLine {
public:
    explicit CommandLine(const std::string& description);
    ~CommandLine();
    CommandLine(const CommandLine&) = delete;
    CommandLine& operator=(const CommandLine&) = delete;

    [[nodiscard]] Command program();
    // Parses the arguments. Returns the exit status where nothing is left to do: 0 after --help, 2 after wrong usage,
    // which it reports in one line on standard error.
    [[nodiscard]] std::optional<int> parse(int argc, const char* const* argv);
    // Parses one word, such as "--width=640", as an option of the program itself. The Error says what is wrong with it.
    [[nodiscard]] Result<void> take(const std::string& word);
    [[nodiscard]] std::string help() const;
    // Returns the manual's pages and the shell's completion of all commands that have been added (command_manual.hpp).
    [[nodiscard]] std::vector<ManualFile> manual(const std::string& version) const;

private:
    std::unique_ptr<CLI::App> app_;
};

}  // namespace burin::app
