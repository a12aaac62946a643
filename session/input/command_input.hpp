// SPDX-License-Identifier: MIT
// A command in words, as the panel, a script or a log gives it (session/state/command_table.hpp). Plain data.
#pragma once

#include <string>
#include <vector>

namespace burin::session {

// Named action with arguments, from the panel or from a script.
struct CommandInput {
    std::string name;
    std::vector<std::string> arguments;
    friend bool operator==(const CommandInput&, const CommandInput&) = default;
};

}  // namespace burin::session
