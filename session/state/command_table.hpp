// SPDX-License-Identifier: MIT
// Names every command that a session accepts, and what its arguments name besides tools and operations
// (toolbox/tool_kinds.hpp): workspace techniques and quantities, one descriptor each. The panel, keys, scripts and
// replays all give commands in these words, so that they cannot differ. Each command has the form that acts of
// activities have too (session/input/command_form.hpp), and a parser that returns a typed value. Numbers are in SI
// units; a printed value reads back to the same bits.
// Pure functions; any thread.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "base/error.hpp"
#include "haptics/workspace/workspace_picture.hpp"
#include "session/input/command_form.hpp"
#include "session/input/command_input.hpp"
#include "session/state/session_command.hpp"

namespace burin::session {

// Describes a workspace technique.
struct TechniqueDescriptor {
    haptics::WorkspaceTechnique technique = haptics::WorkspaceTechnique::fixed;
    std::string_view name;   // as commands have it: "moving"
    std::string_view title;  // as the panel shows it: "Moving box"
};
// Lists all techniques in the order of haptics::WorkspaceTechnique.
[[nodiscard]] std::span<const TechniqueDescriptor> techniques();
[[nodiscard]] const TechniqueDescriptor& descriptor_of(haptics::WorkspaceTechnique technique);

struct SessionState;

// What has to be told of a quantity's new value.
enum class QuantityConcern : std::uint8_t { picture, touch, tool_and_touch };
// Describes a quantity: its name, the bounds that the parser enforces, the range that the panel offers, and where the
// session keeps it.
struct QuantityDescriptor {
    Quantity quantity = Quantity::radius;
    std::string_view name;           // the command's name
    std::string_view unit;           // empty: none
    std::string_view argument;       // in help: "R"
    std::string_view help;           // one line
    double least = 0.0, most = 0.0;  // allowed
    double from = 0.0, to = 0.0;     // offered by the panel; the upper end may be exceeded by a command
    bool by_ratio = false;           // the panel's steps are factors, not differences
    QuantityConcern concern = QuantityConcern::picture;
    double (*value)(const SessionState& state) = nullptr;  // null, as set: a viewer keeps it
    void (*set)(SessionState& state, double value) = nullptr;
};
// Lists all quantities in the order of Quantity.
[[nodiscard]] std::span<const QuantityDescriptor> quantities();
[[nodiscard]] const QuantityDescriptor& descriptor_of(Quantity quantity);

using CommandSpec = CommandForm;
// Lists the commands in the order in which help shows them.
[[nodiscard]] std::span<const CommandSpec> commands();

// Parses a command. The Error names the command, what is wrong with it, and what would be right.
[[nodiscard]] Result<SessionCommand> parse_command(const CommandInput& input);
// Parses a script's line such as "tool ball:0.004"; words are separated as in session/input/input_words.hpp.
[[nodiscard]] Result<SessionCommand> parse_command_line(std::string_view line);
// Converts a command to words: parse_command(as_input(c)) equals c.
[[nodiscard]] CommandInput as_input(const SessionCommand& command);

}  // namespace burin::session
