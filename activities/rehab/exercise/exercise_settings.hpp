// SPDX-License-Identifier: MIT
// Settings of an exercise that a therapist chooses. Each exercise has one table of its settings (SettingKind); from it
// follow the options of the command, the keys of the settings' file, the line that a recording keeps, and every
// message.
//
//   [ball] of a TOML file -> values <- options of the command, which go before
//   values -> the exercise; -> the file's text (--print-config); -> the recording's line, and back from it
// Failure: all mistakes of a file are reported together, each with its line and the remedy; an unknown key with the
// nearest that there is. Units: as the keys say. Pure; any thread. docs/rehab.md lists the keys.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "base/toml_table.hpp"

namespace burin::activities {

// One setting; all texts are literals. The value of one in words is the word's number, from 0.
struct SettingKind {
    const char* key = "";     // of the file: "hold_s"
    const char* option = "";  // of the command: "--hold"
    const char* help = "";
    const char* remedy = "";  // "ask for 0 to 60 seconds"
    double usual = 0.0, least = 0.0, most = 0.0;
    bool whole = false;                       // of numbers
    std::span<const char* const> words = {};  // empty: it is a number
    // The value in recordings of before there was this setting; none: each recording has it.
    std::optional<double> before = std::nullopt;
};

// Those that every exercise has: the level of difficulty, from 1 to `levels`, and when it ends, in seconds.
[[nodiscard]] SettingKind level_setting(unsigned levels, const char* help, const char* remedy);
[[nodiscard]] SettingKind time_limit_setting(double usual_s);
// And when the clock begins. By the device: pressed with a glove on a line, where fingers press; asked, by `do start`
// or its button, where a person does it otherwise; at once where a script leads a simulated hand.
inline constexpr std::array kStarts{"by_device", "pressed", "at_once", "asked"};
inline constexpr double kStartsByDevice = 0.0, kStartsPressed = 1.0, kStartsAtOnce = 2.0, kStartsAsked = 3.0;
[[nodiscard]] SettingKind start_setting();

// The values of an exercise's settings. Equal where all of them are.
class SettingValues {
public:
    // All as usual. The kinds must outlive it.
    explicit SettingValues(std::span<const SettingKind> kinds);

    [[nodiscard]] std::span<const SettingKind> kinds() const { return kinds_; }
    [[nodiscard]] bool has(std::string_view key) const;
    // Requires a key that there is.
    [[nodiscard]] double number(std::string_view key) const { return values_[index_of(key)]; }
    [[nodiscard]] unsigned count(std::string_view key) const { return static_cast<unsigned>(number(key)); }
    [[nodiscard]] const char* word(std::string_view key) const;
    // Returns the value as it is written.
    [[nodiscard]] std::string text(std::size_t kind) const;

    // Sets a value of any size. problems() says what cannot be.
    void set(std::string_view key, double value) {
        values_[index_of(key)] = value == 0.0 ? 0.0 : value;  // no -0
        was_set_[index_of(key)] = true;
    }
    // Fails on a word that there is not.
    [[nodiscard]] Result<void> set(std::string_view key, std::string_view word);

    // Returns whether somebody has set it, be it to what is usual.
    [[nodiscard]] bool was_set(std::string_view key) const { return was_set_[index_of(key)]; }

    // Leaves a setting out of line_of(), as in the recording that it comes from.
    void leave_out(std::string_view key) { left_out_.push_back(index_of(key)); }
    [[nodiscard]] bool is_left_out(std::size_t kind) const;

    // Compares the values alone.
    bool operator==(const SettingValues& other) const { return values_ == other.values_; }

private:
    [[nodiscard]] std::size_t index_of(std::string_view key) const;

    std::span<const SettingKind> kinds_;
    std::vector<double> values_;
    std::vector<bool> was_set_;
    std::vector<std::size_t> left_out_;  // by their numbers
};

// Returns what nobody can do: each names its setting by its key. Empty: the values are sound.
[[nodiscard]] std::vector<Error> problems(const SettingValues& values);

// Returns the mistake of a time limit that ends before the shortest time that the other settings take; nothing where it
// does not. sum: the arithmetic, as "5 squeezes of 2 s and 4 rests of 0.25 s".
[[nodiscard]] std::optional<Error> too_short_a_limit(const SettingValues& values, double least_s,
                                                     const std::string& sum);

// Reads an exercise's table of a file, of which there may be none; mistakes go to the reading.
[[nodiscard]] SettingValues values_in(TableReading& reading, const toml::table* table, std::string_view exercise,
                                      std::span<const SettingKind> kinds);
// Writes such a table.
[[nodiscard]] std::string table_text(std::string_view exercise, const SettingValues& values);

// Writes the values as options on a line, "--level 2 --hold 1"; numbers to the last bit. Of values that values_of() has
// read it is that line again: a replay compares the two.
[[nodiscard]] std::string line_of(const SettingValues& values);
// Reads what line_of() has written. Fails on anything else, and on values that cannot be.
[[nodiscard]] Result<SettingValues> values_of(std::string_view line, std::span<const SettingKind> kinds);

}  // namespace burin::activities
