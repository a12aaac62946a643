// SPDX-License-Identifier: MIT
#include "app/cli/command_table.hpp"

#include <cstdio>

namespace burin::app {

CommandAction add_commands(Command parent, const std::vector<CommandRow>& rows, const CommandAction& otherwise) {
    struct Added {
        Command command;
        CommandAction action;
    };
    std::vector<Added> all;
    for (const CommandRow& row : rows) {
        const Command command = parent.subcommand(row.name, row.help);
        all.push_back({command, row.add(command)});
    }
    return [all = std::move(all), otherwise]() -> Result<int> {
        for (const Added& one : all)
            if (one.command.parsed()) return one.action();
        return otherwise ? otherwise() : Result<int>(0);
    };
}

int wrong_usage(const std::string& command, const std::string& what) {
    std::fprintf(stderr, "burin: %s; see burin %s --help\n", what.c_str(), command.c_str());
    return 2;
}

}  // namespace burin::app
