// SPDX-License-Identifier: MIT
// The form of a command: its name, its arguments with what each of them may be, and its help. The session's commands
// (session/state/command_table.hpp) and the acts of an activity (session/activity/activity.hpp) are tables of these,
// and their words are checked here alone, so that every Error names what would be right in the same way.
// Numbers are in SI units and finite. Pure functions; any thread.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "base/error.hpp"

namespace burin::session {

// What an argument may be.
struct ArgumentKind {
    enum class What : std::uint8_t { text, number, name, colour };
    What what = What::text;
    double least = 0.0, most = 0.0;                // of a number
    std::string_view unit = {};                    // of a number: "m"; empty: none
    std::span<const std::string_view> names = {};  // it is one of these
};
[[nodiscard]] constexpr ArgumentKind number_within(double least, double most, std::string_view unit = {}) {
    return {ArgumentKind::What::number, least, most, unit, {}};
}
// The names must outlive the table.
[[nodiscard]] constexpr ArgumentKind name_of_these(std::span<const std::string_view> names) {
    return {ArgumentKind::What::name, 0.0, 0.0, {}, names};
}
// "R,G,B", sRGB from 0 to 1.
[[nodiscard]] constexpr ArgumentKind colour_word() { return {.what = ArgumentKind::What::colour}; }

struct CommandForm {
    static constexpr std::size_t kMostKinds = 3;
    std::string_view name;
    std::string_view arguments;  // "R", "on|off" or "NAME WHAT VALUE"; empty: none; [ ]: optional; ... at the end: more
    std::string_view help;       // one line
    std::array<ArgumentKind, kMostKinds> kinds = {};  // of the first arguments; all others are text
};

// Checks the words behind a command's name. before: what stands before the name, "do " for an act.
[[nodiscard]] Result<void> check_words(const CommandForm& form, std::span<const std::string> words,
                                       std::string_view before = {});
// Returns name and arguments with what each may be: "apart METRES (a number from 0.0001 to 1, in m)".
[[nodiscard]] std::string text_of(const CommandForm& form);

// Read one word; where: "command radius 5".
[[nodiscard]] Result<double> read_number(const std::string& word, const ArgumentKind& kind, const std::string& where);
[[nodiscard]] Result<std::size_t> read_name(std::string_view word, std::span<const std::string_view> names,
                                            const std::string& command);
[[nodiscard]] Result<std::array<double, 3>> read_colour(const std::string& word, const std::string& where);
// Reads a word that check_words() has found to be a number.
[[nodiscard]] double number_of(const std::string& word);
// Returns the shortest word that reads back to the same bits.
[[nodiscard]] std::string exact_word(double value);
[[nodiscard]] std::string exact_word(const std::array<double, 3>& srgb);

}  // namespace burin::session
