// SPDX-License-Identifier: MIT
#include "activities/rehab/exercise/exercise_settings.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "base/text.hpp"

namespace burin::activities {
namespace {

// A shorter one would end an exercise before its first turns.
constexpr double kLeastTime_s = 0.1, kMostTime_s = 3600.0;

// Returns what is wrong with a value; empty: nothing.
std::string fault_of(const SettingKind& kind, double value) {
    if (value >= kind.least && value <= kind.most && (!kind.whole || value == std::floor(value))) return "";
    return formatted("is %g", value);
}

// Returns the fewest digits that are read as the same number.
std::string shortest(double value) {
    std::array<char, 32> text;
    const auto written = std::to_chars(text.data(), text.data() + text.size(), value);
    return {text.data(), written.ptr};
}

std::string known_words(const SettingKind& kind) {
    std::string text;
    for (const char* word : kind.words) text += (text.empty() ? "" : ", ") + std::string(word);
    return text;
}

}  // namespace

SettingKind level_setting(unsigned levels, const char* help, const char* remedy) {
    return {.key = "level",
            .option = "--level",
            .help = help,
            .remedy = remedy,
            .usual = 1,
            .least = 1,
            .most = static_cast<double>(levels),
            .whole = true};
}

SettingKind time_limit_setting(double usual_s) {
    return {.key = "time_limit_s",
            .option = "--time-limit",
            .help = "When the exercise ends, in seconds",
            .remedy = "give 0.1 to 3600 seconds",
            .usual = usual_s,
            .least = kLeastTime_s,
            .most = kMostTime_s};
}

SettingKind start_setting() {
    return {.key = "start",
            .option = "--start",
            .help = "When the time begins: when each finger has pressed once, at once, or when Start is pressed",
            .words = kStarts,
            .before = kStartsAtOnce};
}

SettingValues::SettingValues(std::span<const SettingKind> kinds) : kinds_(kinds) {
    for (const SettingKind& kind : kinds) values_.push_back(kind.usual);
    was_set_.resize(values_.size());
}

bool SettingValues::has(std::string_view key) const {
    return std::ranges::find(kinds_, key, &SettingKind::key) != kinds_.end();
}

bool SettingValues::is_left_out(std::size_t kind) const {
    return std::ranges::find(left_out_, kind) != left_out_.end();
}

std::size_t SettingValues::index_of(std::string_view key) const {
    const auto kind = std::ranges::find(kinds_, key, &SettingKind::key);
    BURIN_CHECK(kind != kinds_.end());
    return static_cast<std::size_t>(kind - kinds_.begin());
}

const char* SettingValues::word(std::string_view key) const {
    const std::size_t index = index_of(key);
    return kinds_[index].words[static_cast<std::size_t>(values_[index])];
}

std::string SettingValues::text(std::size_t kind) const {
    return kinds_[kind].words.empty() ? formatted("%.17g", values_[kind]) : word(kinds_[kind].key);
}

Result<void> SettingValues::set(std::string_view key, std::string_view word) {
    const std::size_t index = index_of(key);
    const SettingKind& kind = kinds_[index];
    const auto known = std::ranges::find(kind.words, word);
    if (known == kind.words.end()) return fail(kind.key, "is " + std::string(word), "there are " + known_words(kind));
    values_[index] = static_cast<double>(known - kind.words.begin());
    was_set_[index] = true;
    return {};
}

std::vector<Error> problems(const SettingValues& values) {
    std::vector<Error> found;
    for (const SettingKind& kind : values.kinds()) {
        if (!kind.words.empty()) continue;
        if (const std::string fault = fault_of(kind, values.number(kind.key)); !fault.empty())
            found.push_back({fault, kind.key, kind.remedy});
    }
    return found;
}

std::optional<Error> too_short_a_limit(const SettingValues& values, double least_s, const std::string& sum) {
    const double limit_s = values.number("time_limit_s");
    if (least_s <= limit_s) return std::nullopt;
    return Error{sum + formatted(" take %g s at least, and it ends after %g s", least_s, limit_s), "time_limit_s",
                 "ask for less, or for more time"};
}

SettingValues values_in(TableReading& reading, const toml::table* table, std::string_view exercise,
                        std::span<const SettingKind> kinds) {
    SettingValues values(kinds);
    TableReader reader(reading, table, "[" + std::string(exercise) + "]");
    for (const SettingKind& kind : kinds) {
        if (!kind.words.empty()) {
            const auto word = reader.text(kind.key);
            const Result<void> known = word ? values.set(kind.key, *word) : Result<void>{};
            if (!known) reader.refuse(kind.key, known.error().what, known.error().remedy);
            continue;
        }
        if (const auto number = reader.number(kind.key, kind.remedy)) {
            values.set(kind.key, *number);
            if (const std::string fault = fault_of(kind, *number); !fault.empty())
                reader.refuse(kind.key, fault, kind.remedy);
        }
    }
    reader.refuse_unknown();
    return values;
}

std::string table_text(std::string_view exercise, const SettingValues& values) {
    std::string text = "[" + std::string(exercise) + "]\n";
    for (std::size_t i = 0; i < values.kinds().size(); ++i) {
        const std::string quote = "\"";
        const std::string value = values.kinds()[i].words.empty() ? shortest(values.number(values.kinds()[i].key))
                                                                  : quote + values.text(i) + quote;
        text += values.kinds()[i].key + std::string(" = ") + value + "\n";
    }
    return text;
}

std::string line_of(const SettingValues& values) {
    std::string line;
    for (std::size_t i = 0; i < values.kinds().size(); ++i)
        if (!values.is_left_out(i))
            line += (line.empty() ? "" : " ") + std::string(values.kinds()[i].option) + " " + values.text(i);
    return line;
}

Result<SettingValues> values_of(std::string_view line, std::span<const SettingKind> kinds) {
    SettingValues values(kinds);
    for (const SettingKind& kind : kinds)
        if (kind.before && !(" " + std::string(line)).contains(" " + std::string(kind.option) + " ")) {
            values.set(kind.key, *kind.before);
            values.leave_out(kind.key);
        }
    std::string_view rest = line;
    const auto next_word = [&rest] {
        const std::string_view word = rest.substr(0, rest.find(' '));
        rest.remove_prefix(std::min(word.size() + 1, rest.size()));
        return word;
    };
    while (!rest.empty()) {
        const std::string_view option = next_word(), text = next_word();
        const auto kind = std::ranges::find(kinds, option, &SettingKind::option);
        if (kind == kinds.end()) break;
        double number = 0.0;
        if (!kind->words.empty())
            (void)values.set(kind->key, text);
        else if (std::from_chars(text.data(), text.data() + text.size(), number).ec == std::errc{})
            values.set(kind->key, number);
    }
    if (problems(values).empty() && line_of(values) == line) return values;
    return fail(std::string(line), "are no settings of this exercise", "replay it with the program that recorded it");
}

}  // namespace burin::activities
