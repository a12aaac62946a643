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

// Takes the next word of letters off a comment, without what stands before it.
std::string_view take_word(std::string_view& text) {
    std::size_t from = 0;
    while (from < text.size() && !is_letter(text[from])) ++from;
    std::size_t to = from;
    while (to < text.size() && is_letter(text[to])) ++to;
    const std::string_view word = text.substr(from, to - from);
    text.remove_prefix(to);
    return word;
}

std::optional<LengthUnit> unit_named(std::string_view word) {
    const auto found =
        std::ranges::find_if(kUnitWords, [&](const UnitWord& known) { return equals_ignoring_case(word, known.word); });
    return found == kUnitWords.end() ? std::nullopt : std::optional(found->unit);
}

// The number among the characters between two words; 1 where there is none, 0 where it is more than a number.
double factor_in(std::string_view between) {
    constexpr std::string_view kDigits = "0123456789";
    const std::size_t first = between.find_first_of(kDigits);
    if (first == std::string_view::npos) return 1.0;
    const std::size_t from = first > 0 && between[first - 1] == '.' ? first - 1 : first;
    const std::size_t to = between.find_last_of(kDigits) + 1;
    double factor = 0.0;
    const auto read = std::from_chars(between.data() + from, between.data() + to, factor);
    return read.ec == std::errc{} && read.ptr == between.data() + to ? factor : 0.0;
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

// Returns the unit that follows the word "units". "in" is the inch where nothing follows, and else only a word before
// the unit: "units in mm".
std::optional<LengthUnit> unit_after(std::string_view rest) {
    const char* const begin = rest.data();
    std::string_view word = take_word(rest);
    if (equals_ignoring_case(word, "are") || equals_ignoring_case(word, "is")) word = take_word(rest);
    std::string_view behind = rest;
    const std::string_view next = take_word(behind);
    if (equals_ignoring_case(word, "in") && !next.empty()) word = next;
    return times(factor_in({begin, word.data()}), unit_named(word));
}

const char* plural_of(LengthUnit unit) { return descriptor_of(unit).plural; }

}  // namespace

FileUnit choose_unit(std::optional<LengthUnit> given, std::optional<LengthUnit> stated, double longest_side) {
    if (given) return {*given, UnitSource::given, stated};
    if (stated) return {*stated, UnitSource::stated, stated};
    return {longest_side > kLongestInMetres ? LengthUnit::mm : LengthUnit::m, UnitSource::guessed, {}};
}

std::optional<LengthUnit> unit_in_comment(std::string_view comment) {
    // Recognises how older exports of Burin named their unit; other programs did not read that.
    if (comment.contains("by Burin, in metres")) return LengthUnit::m;
    while (!comment.empty()) {
        const std::string_view word = take_word(comment);
        if (!equals_ignoring_case(word, "units") && !equals_ignoring_case(word, "unit")) continue;
        if (const auto unit = unit_after(comment)) return unit;
    }
    return std::nullopt;
}

std::optional<LengthUnit> unit_in_comments(std::string_view text) {
    text = text.substr(0, kHeadBytes);
    for (TextScanner scan(text); !scan.at_end(); scan.next_line()) {
        const std::string_view line = scan.rest_of_line();
        const std::size_t comment = line.find('#');
        if (comment == std::string_view::npos) continue;
        if (const auto unit = unit_in_comment(line.substr(comment + 1))) return unit;
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
                        ? std::string("; the file itself says ") + plural_of(*unit.stated)
                        : "") +
                   ")";
        case UnitSource::stated: return size + " (its numbers are " + in + ", as the file says)";
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
