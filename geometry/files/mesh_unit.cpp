// SPDX-License-Identifier: MIT
#include "geometry/files/mesh_unit.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "base/text.hpp"
#include "geometry/files/text_scanner.hpp"

namespace burin::geometry {
namespace {

constexpr std::size_t kHeadBytes = 8192;  // of a text, in which comments may state a unit

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

constexpr bool is_letter(char c) { return lower(c) >= 'a' && lower(c) <= 'z'; }
constexpr bool is_gap(char c) { return is_blank(c) || is_line_end(c) || c == '\0'; }

std::string_view without_leading_gap(std::string_view text) {
    while (!text.empty() && is_gap(text.front())) text.remove_prefix(1);
    return text;
}

// Returns the letters at the beginning of a text.
std::string_view leading_word(std::string_view text) {
    std::size_t to = 0;
    while (to < text.size() && is_letter(text[to])) ++to;
    return text.substr(0, to);
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

// Tells whether a unit's word has ended before this text: "M-12", "cm4" and "ft-lbs" are no units.
bool ends_a_word(std::string_view behind) {
    constexpr std::string_view kMarks = ",;)]}>\"'";
    if (behind.empty() || is_gap(behind.front()) || kMarks.contains(behind.front())) return true;
    return behind.front() == '.' && (behind.size() == 1 || is_gap(behind[1]));
}

// Tells whether a statement has ended before this text, so that no further word belongs to it.
bool ends_a_statement(std::string_view behind) {
    constexpr std::string_view kClosing = ".)]}>\"'";
    while (!behind.empty() && (is_gap(behind.front()) || kClosing.contains(behind.front()))) behind.remove_prefix(1);
    return behind.empty() || behind.front() == ',' || behind.front() == ';';
}

// Takes a number off the beginning of a text, if there is one.
std::optional<double> take_number(std::string_view& text) {
    double number = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc{}) return std::nullopt;
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    return number;
}

// Returns the power of ten at the end of a text: 1000 of "scale: 1000 "; 1 where there is none.
double number_before(std::string_view text) {
    while (!text.empty() && is_gap(text.back())) text.remove_suffix(1);
    const std::size_t from = text.find_last_not_of("0123456789.") + 1;  // npos + 1 is 0
    std::string_view digits = text.substr(from);
    const double number = take_number(digits).value_or(1.0);
    return number == 10.0 || number == 100.0 || number == 1000.0 ? number : 1.0;
}

// "1 unit = 0.001 m" states millimetres. A length that no unit has, such as 25 mm, states none.
std::optional<LengthUnit> times(double factor, std::optional<LengthUnit> unit) {
    if (!unit || factor == 1.0) return unit;
    for (const UnitWord& known : kUnitWords) {
        const double ratio = factor * metres_in(*unit) / metres_in(known.unit);
        if (std::abs(ratio - 1.0) < 1e-9) return known.unit;
    }
    return std::nullopt;
}

// Takes "are", "is" and "in" off a text where a unit follows.
std::string_view without_small_words(std::string_view text) {
    for (;;) {
        const std::string_view word = leading_word(text), behind = without_leading_gap(text.substr(word.size()));
        const bool is_verb = equals_ignoring_case(word, "are") || equals_ignoring_case(word, "is");
        const bool leads_to_unit = equals_ignoring_case(word, "in") && unit_named(leading_word(behind));
        if (!is_verb && !leads_to_unit) return text;
        text = behind;
    }
}

// Tells whether a unit ends behind = or :. Another "KEY=value" may follow; behind "in", which is a word as well,
// nothing else.
bool ends_a_value(std::string_view unit, std::string_view behind) {
    if (!equals_ignoring_case(unit, "in") || ends_a_statement(behind)) return ends_a_word(behind);
    behind = without_leading_gap(behind);
    const std::string_view rest = behind.substr(leading_word(behind).size());
    return !rest.empty() && (rest.front() == '=' || rest.front() == ':');
}

// Returns the unit that follows the word "unit" or "units": behind = or :, or alone with nothing behind it. "in" is the
// inch where nothing follows, and else only a word before the unit: "units in mm". `before`: what stands before the
// word, of which a number counts in "1 unit = 0.001 m".
std::optional<LengthUnit> unit_after(std::string_view rest, std::string_view before) {
    constexpr std::string_view kOpening = "([{<\"'";
    rest = without_leading_gap(rest);
    const bool is_assigned = rest.starts_with('=') || rest.starts_with(':');
    if (is_assigned) rest = without_leading_gap(rest.substr(1));
    rest = without_small_words(rest);
    if (!rest.empty() && kOpening.contains(rest.front())) rest = without_leading_gap(rest.substr(1));
    const std::optional<double> length = take_number(rest);
    if (length) rest = without_leading_gap(rest);
    const std::string_view word = leading_word(rest), behind = rest.substr(word.size());
    if (!(is_assigned ? ends_a_value(word, behind) : ends_a_statement(behind) && ends_a_word(behind)))
        return std::nullopt;
    return times(length ? *length / number_before(before) : 1.0, unit_named(word));
}

const char* plural_of(LengthUnit unit) { return descriptor_of(unit).plural; }

}  // namespace

FileUnit choose_unit(std::optional<LengthUnit> given, const std::optional<StatedUnit>& stated, double longest_side) {
    if (!given && !stated)
        return {longest_side > kLongestInMetres ? LengthUnit::mm : LengthUnit::m, UnitSource::guessed, {}, {}};
    FileUnit chosen{given ? *given : stated->unit, given ? UnitSource::given : UnitSource::stated, {}, {}};
    if (stated) chosen.stated = stated->unit, chosen.place = stated->place;
    return chosen;
}

std::optional<LengthUnit> unit_in_comment(std::string_view comment) {
    // Recognises how older exports of Burin named their unit; other programs did not read that.
    if (comment.contains("by Burin, in metres")) return LengthUnit::m;
    std::string_view rest = comment;
    while (!rest.empty()) {
        const std::string_view word = take_word(rest);
        if (!equals_ignoring_case(word, "units") && !equals_ignoring_case(word, "unit")) continue;
        const std::string_view before = comment.substr(0, static_cast<std::size_t>(word.data() - comment.data()));
        if (const auto unit = unit_after(rest, before)) return unit;
    }
    return std::nullopt;
}

std::optional<StatedUnit> unit_in_line(std::string_view comment, std::uint64_t line) {
    const auto unit = unit_in_comment(comment);
    return unit ? std::optional<StatedUnit>({*unit, "in line " + std::to_string(line)}) : std::nullopt;
}

std::optional<StatedUnit> unit_in_comments(std::string_view text) {
    text = text.substr(0, kHeadBytes);
    for (TextScanner scan(text); !scan.at_end(); scan.next_line()) {
        const std::string_view line = scan.rest_of_line();
        const std::size_t comment = line.find('#');
        if (comment == std::string_view::npos) continue;
        if (auto unit = unit_in_line(line.substr(comment + 1), scan.line())) return unit;
    }
    return std::nullopt;
}

std::string comment_of(LengthUnit unit) { return std::string("units ") + name_of(unit); }

std::string describe_size(const std::string& file, const Vec3& size_m, const FileUnit& unit) {
    const std::string size = file + ": " + in_millimetres(size_m), in = plural_of(unit.unit);
    switch (unit.source) {
        case UnitSource::given:
            return size + " (read as " + in + ", as --units or the recording says" +
                   (unit.stated && *unit.stated != unit.unit
                        ? std::string("; the file itself says ") + plural_of(*unit.stated) + " " + unit.place
                        : "") +
                   ")";
        case UnitSource::stated: return size + " (its numbers are " + in + ", as the file says " + unit.place + ")";
        case UnitSource::guessed: break;
    }
    const LengthUnit other = unit.unit == LengthUnit::m ? LengthUnit::mm : LengthUnit::m;
    return size + formatted(
                      " (no unit that Burin knows is given in the file; read as %s, since its longest side is %s %g; "
                      "--units %s "
                      "reads it as %s)",
                      in.c_str(), unit.unit == LengthUnit::m ? "at most" : "above", kLongestInMetres, name_of(other),
                      plural_of(other));
}

}  // namespace burin::geometry
