// SPDX-License-Identifier: MIT
#include "geometry/files/unit_statement.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <span>
#include <string>

#include "geometry/files/text_scanner.hpp"

namespace burin::geometry {
namespace {

constexpr std::size_t kHeadBytes = 8192;        // of a text, in which comments may state a unit
constexpr double kUnitTolerance = 2e-5;         // of a stated length, against a unit: 39.37 inches are a metre
constexpr std::size_t kWordsBehindANumber = 2;  // "1000 drawing units"
constexpr std::size_t kThousand = 3;            // digits between separators

struct UnitWord {
    std::string_view word;
    LengthUnit unit;
};
constexpr std::array<UnitWord, 21> kUnitWords{{{"m", LengthUnit::m},
                                               {"meter", LengthUnit::m},
                                               {"meters", LengthUnit::m},
                                               {"metre", LengthUnit::m},
                                               {"metres", LengthUnit::m},
                                               {"cm", LengthUnit::cm},
                                               {"centimeter", LengthUnit::cm},
                                               {"centimeters", LengthUnit::cm},
                                               {"centimetre", LengthUnit::cm},
                                               {"centimetres", LengthUnit::cm},
                                               {"mm", LengthUnit::mm},
                                               {"millimeter", LengthUnit::mm},
                                               {"millimeters", LengthUnit::mm},
                                               {"millimetre", LengthUnit::mm},
                                               {"millimetres", LengthUnit::mm},
                                               {"in", LengthUnit::inch},
                                               {"inch", LengthUnit::inch},
                                               {"inches", LengthUnit::inch},
                                               {"ft", LengthUnit::ft},
                                               {"foot", LengthUnit::ft},
                                               {"feet", LengthUnit::ft}}};

using Words = std::span<const std::string_view>;
// Units that are other words as well, or beginnings of names.
constexpr std::string_view kShortUnits[] = {"m", "ft", "in"};
// Quantities and things whose unit is not that of the coordinates.
constexpr std::string_view kForeign[] = {
    "acceleration", "angle", "angular",   "area",    "colour",   "color",     "control",  "cooling",    "current",
    "density",      "drive", "energy",    "flow",    "force",    "frequency", "handling", "heat",       "heating",
    "intensity",    "load",  "mass",      "moment",  "momentum", "power",     "pressure", "processing", "rate",
    "roughness",    "speed", "stiffness", "storage", "strain",   "strength",  "stress",   "temp",       "temperature",
    "tension",      "time",  "timing",    "torque",  "velocity", "viscosity", "voltage",  "volume",     "weight"};
constexpr std::string_view kNumberWords[] = {"two",      "three",    "four",    "five",   "six",   "seven",
                                             "eight",    "nine",     "ten",     "twelve", "dozen", "hundred",
                                             "hundreds", "thousand", "million", "half",   "k"};
constexpr std::string_view kVerbs[] = {"are", "is", "equal", "equals"};
constexpr std::string_view kLengths[] = {"length", "lengths", "measure", "measurement"};
// Words behind a unit that make another one of it.
constexpr std::string_view kGoesOn[] = {"per", "or", "hg", "wc", "aq", "squared", "cubed", "x"};

bool is_one_of(std::string_view word, Words known) {
    return std::ranges::any_of(known, [&](std::string_view w) { return equals_ignoring_case(word, w); });
}

constexpr bool is_letter(char c) { return lower(c) >= 'a' && lower(c) <= 'z'; }
constexpr bool is_figure(char c) { return c >= '0' && c <= '9'; }
constexpr bool is_gap(char c) { return is_blank(c) || is_line_end(c) || c == '\0'; }

std::string_view without_leading_gap(std::string_view text) {
    while (!text.empty() && is_gap(text.front())) text.remove_prefix(1);
    return text;
}
std::string_view without_trailing_gap(std::string_view text) {
    while (!text.empty() && is_gap(text.back())) text.remove_suffix(1);
    return text;
}

// Return the letters at the beginning and at the end of a text.
std::string_view leading_word(std::string_view text) {
    return text.substr(0, static_cast<std::size_t>(std::ranges::find_if_not(text, is_letter) - text.begin()));
}
std::string_view trailing_word(std::string_view text) {
    std::size_t from = text.size();
    while (from > 0 && is_letter(text[from - 1])) --from;
    return text.substr(from);
}

// Takes the next word of letters off a comment, with what stands before it.
std::string_view take_word(std::string_view& text) {
    while (!text.empty() && !is_letter(text.front())) text.remove_prefix(1);
    const std::string_view word = leading_word(text);
    text.remove_prefix(word.size());
    return word;
}

std::optional<LengthUnit> unit_named(std::string_view word) {
    const auto found =
        std::ranges::find_if(kUnitWords, [&](const UnitWord& known) { return equals_ignoring_case(word, known.word); });
    return found == kUnitWords.end() ? std::nullopt : std::optional(found->unit);
}

// A length of so many units is one of ours, or none.
std::optional<LengthUnit> times(double factor, std::optional<LengthUnit> unit) {
    if (!unit || factor == 1.0) return unit;
    for (const UnitWord& known : kUnitWords) {
        const double ratio = factor * metres_in(*unit) / metres_in(known.unit);
        if (std::abs(ratio - 1.0) < kUnitTolerance) return known.unit;
    }
    return std::nullopt;
}

// ---- Numbers

// Takes a separator with its three digits off a text: ",000".
bool take_thousand(std::string_view& text) {
    if (text.size() <= kThousand || !std::string_view(",'_").contains(text.front())) return false;
    const std::string_view behind = text.substr(1 + kThousand);
    if (!std::ranges::all_of(text.substr(1, kThousand), is_figure)) return false;
    if (!behind.empty() && is_figure(behind.front())) return false;
    text = behind;
    return true;
}

// Takes a number off the beginning of a text, if there is one: 25.4, 1e-3, 1,000, 1'000.
std::optional<double> take_number(std::string_view& text) {
    if (text.empty() || !(is_figure(text.front()) || text.front() == '.' || text.front() == '-')) return std::nullopt;
    double number = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc{}) return std::nullopt;
    const std::string_view written = text.substr(0, static_cast<std::size_t>(end - text.data()));
    text.remove_prefix(written.size());
    const bool may_have_thousands =
        written.size() <= kThousand && written.front() != '0' && std::ranges::all_of(written, is_figure);
    while (may_have_thousands && take_thousand(text)) number *= 1000.0;
    return number;
}

// Holds how many units a statement is about, as it stands before the word: the 1000 of "1000 drawing units".
struct Count {
    double number = 1.0;
    bool is_told = false;       // a number stands there
    bool is_understood = true;  // or something that is none
    bool is_a_value = false;    // of another key: "SCALE=2 UNITS=in"
    std::string_view before;    // what stands before the number
};

// Reads "1000", "(1000", "scale:1000"; a word with a figure in it, such as "v2", is not understood as a number.
Count count_from(std::string_view token, std::string_view before) {
    constexpr std::string_view kOpening = "([{<\"'";
    Count count{1.0, true, true, false, before};
    if (is_letter(token.front())) {
        const std::size_t sign = token.find_last_of("=:");
        if (sign == std::string_view::npos) return {1.0, false, false, false, before};
        count.is_a_value = token[sign] == '=';
        token.remove_prefix(sign + 1);
    } else if (token.front() == '=') {
        count.before = {before.data(), before.size() + 1};
        token.remove_prefix(1);
    }
    while (!token.empty() && kOpening.contains(token.front())) token.remove_prefix(1);
    const bool is_group = token.size() == kThousand && std::ranges::all_of(token, is_figure);
    const std::string_view left = without_trailing_gap(before);
    const auto number = take_number(token);
    if (number) count.number = *number;
    count.is_understood = number && token.empty() && *number > 0.0;
    if (is_group && !left.empty() && is_figure(left.back())) count.is_understood = false;  // "1 000"
    return count;
}

Count count_before(std::string_view text) {
    text = without_trailing_gap(text);
    for (std::size_t i = 0; i <= kWordsBehindANumber; ++i) {
        const std::string_view word = trailing_word(text);
        const std::string_view left = text.substr(0, text.size() - word.size());
        if (word.empty() || (!left.empty() && !is_gap(left.back()))) break;
        if (is_one_of(word, kNumberWords)) return {1.0, true, false, false, left};
        if (i == kWordsBehindANumber) return {1.0, false, true, false, text};
        text = without_trailing_gap(left);
    }
    std::size_t from = text.size();
    while (from > 0 && !is_gap(text[from - 1])) --from;
    const std::string_view token = text.substr(from);
    const bool ends_before = token.ends_with(',') || token.ends_with(';') || token.ends_with('.');
    if (ends_before || std::ranges::none_of(token, is_figure)) return {1.0, false, true, false, text};
    return count_from(token, text.substr(0, from));
}

// ---- What may stand behind a unit

// Tells whether a unit's word has ended before this text: "M-12", "cm4" and "ft-lbs" are no units.
bool ends_a_word(std::string_view behind) {
    constexpr std::string_view kMarks = ",;()[]}>\"'=";
    if (behind.empty() || is_gap(behind.front()) || kMarks.contains(behind.front())) return true;
    return behind.front() == '.' && (behind.size() == 1 || is_gap(behind[1]));
}

// Tells whether a statement has ended before this text, so that no further word belongs to it.
bool ends_a_statement(std::string_view behind) {
    constexpr std::string_view kClosing = ".)]}>\"'";
    while (!behind.empty() && (is_blank(behind.front()) || kClosing.contains(behind.front()))) behind.remove_prefix(1);
    return behind.empty() || is_gap(behind.front()) || behind.front() == ',' || behind.front() == ';';
}

// Tells whether a remark in brackets follows; behind a short word one that names the same unit: "m (metres)".
bool is_explained(std::string_view behind, LengthUnit unit, bool is_short) {
    behind = without_leading_gap(behind);
    if (!behind.starts_with('(') && !behind.starts_with('[')) return false;
    return !is_short || unit_named(leading_word(without_leading_gap(behind.substr(1)))) == unit;
}

// Tells whether "KEY=value" or a further "= length" follows.
bool leads_to_a_key(std::string_view behind) {
    behind = without_leading_gap(behind);
    const std::string_view rest = behind.substr(leading_word(behind).size());
    return !rest.empty() && (rest.front() == '=' || rest.front() == ':');
}

// Tells whether what follows makes another unit of it, or names a second one: "mm per s", "mm or in", "mm, inches".
bool goes_on(std::string_view behind, LengthUnit unit) {
    behind = without_leading_gap(behind);
    if (is_one_of(leading_word(behind), kGoesOn)) return true;
    if (behind.starts_with(',') || behind.starts_with(';')) behind = without_leading_gap(behind.substr(1));
    std::string_view word = leading_word(behind);
    if (equals_ignoring_case(word, "and") || equals_ignoring_case(word, "or")) {
        behind = without_leading_gap(behind.substr(word.size()));
        word = leading_word(behind);
    }
    const auto second = unit_named(word);
    const std::string_view rest = behind.substr(word.size());
    return second && *second != unit && ends_a_word(rest) && (ends_a_statement(rest) || !is_one_of(word, kShortUnits));
}

// ---- Statements

// Holds the words that stand behind the word "unit".
struct Value {
    bool is_assigned = false;  // behind = or :
    bool has_equals = false;   // or behind "is", "are", "equals"
    std::optional<double> length;
    std::string_view word, behind;
};

// Takes signs and small words off a text before which a unit stands: "of length:", "are in", "==", "in:".
std::string_view without_small_words(std::string_view text, Value& value) {
    for (;;) {
        text = without_leading_gap(text);
        const std::string_view word = leading_word(text), behind = without_leading_gap(text.substr(word.size()));
        if (text.starts_with('=') || text.starts_with(':')) {
            value.is_assigned = true;
            value.has_equals = value.has_equals || text.front() == '=';
            text.remove_prefix(1);
        } else if (is_one_of(word, kVerbs)) {
            value.has_equals = true;
            text = behind;
        } else if (equals_ignoring_case(word, "of") && is_one_of(leading_word(behind), kLengths)) {
            text = behind.substr(leading_word(behind).size());
        } else if (equals_ignoring_case(word, "in") &&
                   (unit_named(leading_word(behind)) || behind.starts_with(':') || behind.starts_with('='))) {
            text = behind;
        } else {
            return text;
        }
    }
}

Value value_behind(std::string_view rest) {
    constexpr std::string_view kOpening = "([{<\"'";
    Value value;
    rest = without_small_words(rest, value);
    if (!rest.empty() && kOpening.contains(rest.front())) rest = without_leading_gap(rest.substr(1));
    value.length = take_number(rest);
    if (value.length) rest = without_leading_gap(rest);
    value.word = leading_word(rest);
    value.behind = rest.substr(value.word.size());
    return value;
}

// Returns the number of units that a value is the length of; nothing where that is unclear. A number before "units:
// mm" is none of a length, as in "version 7 units: mm".
std::optional<double> units_told(const Count& count, const Value& value) {
    if (value.length) return count.is_understood ? std::optional(count.number) : std::nullopt;
    if (!count.is_told || count.is_a_value || (value.is_assigned && !value.has_equals)) return 1.0;
    return count.is_understood && count.number == 1.0 ? std::optional(1.0)
           : count.is_understood && value.has_equals  ? std::optional(count.number)
                                                      : std::nullopt;
}

// Returns the unit of "N units = M UNIT", of "units mm" and of "UNITS=mm".
std::optional<LengthUnit> unit_behind(std::string_view rest, std::string_view before) {
    const Value value = value_behind(rest);
    const auto unit = unit_named(value.word);
    if (!unit || !ends_a_word(value.behind) || goes_on(value.behind, *unit)) return std::nullopt;
    const bool is_short = is_one_of(value.word, kShortUnits);
    const bool ends = ends_a_statement(value.behind) || is_explained(value.behind, *unit, is_short);
    if (!ends && !(value.is_assigned && (!is_short || leads_to_a_key(value.behind)))) return std::nullopt;
    const auto units = units_told(count_before(before), value);
    return units ? times(value.length.value_or(1.0) / *units, unit) : std::nullopt;
}

// Returns the unit of "M UNIT = N units", whose word "units" ends the statement.
std::optional<LengthUnit> unit_before(std::string_view rest, std::string_view before) {
    if (!ends_a_word(rest) || !ends_a_statement(rest)) return std::nullopt;
    const Count units = count_before(before);
    std::string_view left = without_trailing_gap(units.before);
    if (!units.is_understood || !left.ends_with('=')) return std::nullopt;
    while (left.ends_with('=')) left.remove_suffix(1);
    left = without_trailing_gap(left);
    const std::string_view word = trailing_word(left);
    const auto unit = unit_named(word);
    left = without_trailing_gap(left.substr(0, left.size() - word.size()));
    std::size_t from = left.size();
    while (from > 0 && !is_gap(left[from - 1])) --from;
    if (!unit || from == left.size()) return std::nullopt;
    const Count length = count_from(left.substr(from), left.substr(0, from));
    return length.is_told && length.is_understood ? times(length.number / units.number, unit) : std::nullopt;
}

bool is_of_another_quantity(std::string_view before) {
    while (!before.empty() && (is_gap(before.back()) || before.back() == '-' || before.back() == '_'))
        before.remove_suffix(1);
    return is_one_of(trailing_word(before), kForeign);
}

}  // namespace

std::optional<LengthUnit> unit_in_comment(std::string_view comment) {
    // Recognises how older exports of Burin named their unit; other programs did not read that.
    if (comment.contains("by Burin, in metres")) return LengthUnit::m;
    std::string_view rest = comment;
    while (!rest.empty()) {
        const std::string_view word = take_word(rest);
        if (!equals_ignoring_case(word, "units") && !equals_ignoring_case(word, "unit")) continue;
        const std::string_view before = comment.substr(0, static_cast<std::size_t>(word.data() - comment.data()));
        if (is_of_another_quantity(before)) continue;
        if (const auto unit = unit_behind(rest, before)) return unit;
        if (const auto unit = unit_before(rest, before)) return unit;
    }
    return std::nullopt;
}

std::optional<LengthUnit> unit_in_header(std::string_view header) {
    constexpr char kUnended = '-';  // no word ends before it
    if (header.empty() || is_gap(header.back())) return unit_in_comment(without_trailing_gap(header));
    return unit_in_comment(std::string(header) + kUnended);
}

std::optional<StatedUnit> unit_in_line(std::string_view comment, std::uint64_t line) {
    const auto unit = unit_in_comment(comment);
    return unit ? std::optional<StatedUnit>({*unit, "in line " + std::to_string(line)}) : std::nullopt;
}

std::optional<StatedUnit> unit_in_comments(std::string_view text) {
    if (text.size() > kHeadBytes) {
        std::size_t whole = kHeadBytes + 1;  // up to the last line's end
        while (whole > 0 && !is_line_end(text[whole - 1])) --whole;
        text = text.substr(0, whole);
    }
    for (TextScanner scan(text); !scan.at_end(); scan.next_line()) {
        const std::string_view line = scan.rest_of_line();
        const std::size_t comment = line.find('#');
        if (comment == std::string_view::npos) continue;
        if (auto unit = unit_in_line(line.substr(comment + 1), scan.line())) return unit;
    }
    return std::nullopt;
}

}  // namespace burin::geometry
