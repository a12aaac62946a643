// SPDX-License-Identifier: MIT
// The manual and the shell's completion, made from the same commands and options as the help: none of them says what
// the program has not. Pure; any thread.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}  // namespace CLI

namespace burin::app {

struct ManualFile {
    std::string name;  // below a folder: "man/burin-sculpt.1", "bash/burin"
    std::string text;
};

// Returns a page of section 1 for the program and for each of its commands, with that command's own commands in it, and
// a completion for bash. `version` stands at the pages' foot.
[[nodiscard]] std::vector<ManualFile> manual_files(const CLI::App& program, const std::string& version);

}  // namespace burin::app
