// SPDX-License-Identifier: MIT
// The one shape of a command: a row with its name, its help, and a function that adds its options and returns what it
// does. Rows make the table of burin (app/burin_commands.hpp), and that of a command which has commands of its own.
// Help, manual, completion and dispatch follow the tables. One thread.
//   CommandAction add_film(Command command) {
//       const auto options = std::make_shared<FilmOptions>();
//       command.option("FOLDER", options->folder, "...").required();
//       return action([options] { return film(*options); });
//   }
//   CommandRow film_row() { return {"film", "Join a folder's pictures into one that moves", add_film}; }
#pragma once

#include <functional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "app/cli/command_line.hpp"
#include "base/error.hpp"

namespace burin::app {

// What a command does once the line is parsed. Owns the options that the parse writes to. Returns the exit status.
using CommandAction = std::function<Result<int>()>;

struct CommandRow {
    std::string name, help;
    std::function<CommandAction(Command)> add;  // adds options to the command, which is on the line already
};

// Makes an action of a function without arguments. Where that returns Result<void>, the exit status is 0.
template <typename Function>
[[nodiscard]] CommandAction action(Function function) {
    if constexpr (std::is_same_v<std::invoke_result_t<Function>, Result<void>>) {
        return [function = std::move(function)]() -> Result<int> {
            if (const Result<void> done = function(); !done) return std::unexpected(done.error());
            return 0;
        };
    } else {
        return function;
    }
}

// Adds the commands of a table, in its order. Returns what the one that the line names does, and `otherwise` where it
// names none; without `otherwise` the parent must require one (Command::require_subcommand()).
[[nodiscard]] CommandAction add_commands(Command parent, const std::vector<CommandRow>& rows,
                                         const CommandAction& otherwise = {});

// Says in one line on standard error what is wrong with the usage of a command, such as "world". Returns the exit
// status of wrong usage.
[[nodiscard]] int wrong_usage(const std::string& command, const std::string& what);

}  // namespace burin::app
