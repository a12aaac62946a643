// SPDX-License-Identifier: MIT
// Where the figures of burin bench go: files, or - for standard output.
#pragma once

#include <functional>
#include <string>

#include "app/command_line.hpp"
#include "base/error.hpp"

namespace burin {

inline constexpr const char* kStandardOutput = "-";

// Whether a file can appear there; to be asked before the first long step. Empty: none is wanted.
[[nodiscard]] Result<void> check_place(const std::string& path);
// Empty: nowhere.
[[nodiscard]] Result<void> write_output(const std::string& path, const std::string& text);

// A subcommand of burin bench with options of its own.
struct BenchSubcommand {
    Command command;
    std::function<Result<void>()> run;
};

}  // namespace burin
