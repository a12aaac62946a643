// SPDX-License-Identifier: MIT
#include "base/csv.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <system_error>

namespace burin {
namespace {

// The strongest first: a comma may also be one of a number.
constexpr std::array kSeparators{'\t', ';', ','};

// Blanks that are no separator.
const char* blanks_beside(char separator) { return separator == '\t' ? " " : " \t"; }

std::string_view without_blanks_around(std::string_view text, const char* blanks) {
    const std::size_t first = text.find_first_not_of(blanks), last = text.find_last_not_of(blanks);
    return first == std::string_view::npos ? std::string_view() : text.substr(first, last + 1 - first);
}

// Counts characters of UTF-8: all bytes but those that continue one.
std::size_t characters_in(std::string_view text) {
    std::size_t count = 0;
    for (const char c : text) count += (static_cast<unsigned char>(c) & 0xC0u) != 0x80u ? 1 : 0;
    return count;
}

}  // namespace

CsvRecord take_record(std::string_view& text, std::optional<char> separator) {
    enum class In : std::uint8_t { blanks, quotes, behind_quotes, plain };
    const std::size_t first_end = std::min(text.find('\n'), text.size());
    std::size_t end = 0, lines = 1;
    In in = text.front() == '#' ? In::plain : In::blanks;
    for (; end < text.size() && lines <= kMostLinesOfField; ++end) {
        const char c = text[end];
        if (c == '\n' && in != In::quotes) break;
        lines += c == '\n' ? 1 : 0;
        const bool separates = separator ? c == *separator : std::ranges::find(kSeparators, c) != kSeparators.end();
        if (in == In::quotes || (c == '"' && in != In::plain))
            in = in != In::quotes || c != '"' ? In::quotes : In::behind_quotes;  // a doubled quote opens again
        else if (separates && text.front() != '#')
            in = In::blanks;
        else if (in != In::blanks || (c != ' ' && c != '\t'))
            in = In::plain;
    }
    if (in == In::quotes || lines > kMostLinesOfField) end = first_end, lines = 1;
    const CsvRecord record{text.substr(0, end), lines};
    text.remove_prefix(std::min(end + 1, text.size()));
    return record;
}

std::string column_name(std::string_view field) {
    std::string name(field);
    for (char& c : name) {
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
        if (c == '\n') c = ' ';
    }
    return name;
}

CsvLine split_csv(std::string_view line, char separator) {
    const char* const blanks = blanks_beside(separator);
    CsvLine split;
    std::size_t at = 0, columns_before = 0, counted_to = 0;
    const auto column_at = [&](std::size_t place) {
        columns_before += characters_in(line.substr(counted_to, place - counted_to));
        counted_to = place;
        return columns_before + 1;
    };
    while (true) {
        at = std::min(line.find_first_not_of(blanks, at), line.size());
        CsvField field{.text = {}, .column = column_at(at)};
        if (at < line.size() && line[at] == '"') {
            bool closed = false;
            for (++at; at < line.size() && !closed; ++at) {
                const bool quote = line[at] == '"', twice = quote && at + 1 < line.size() && line[at + 1] == '"';
                if (twice) ++at;
                closed = quote && !twice;
                if (!closed) field.text += line[at];
            }
            if (!closed && split.unclosed_quote == 0) split.unclosed_quote = field.column;
        }
        // What stands behind a closing quote belongs to the field, so that it is seen and complained about.
        const std::size_t end = std::min(line.find(separator, at), line.size());
        field.text += without_blanks_around(line.substr(at, end - at), blanks);
        split.fields.push_back(std::move(field));
        if (end == line.size()) return split;
        at = end + 1;
    }
}

char separator_in(std::string_view line) {
    char best = ',';
    std::size_t most = 1;
    for (const char separator : kSeparators) {
        const std::size_t fields = split_csv(line, separator).fields.size();
        if (fields <= most) continue;
        most = fields;
        best = separator;
    }
    return best;
}

std::optional<char> declared_separator(std::string_view line) {
    line = without_blanks_around(line, " \r");
    if (line.starts_with('"') && line.ends_with('"') && line.size() >= 2) line = line.substr(1, line.size() - 2);
    constexpr std::string_view kMark = "sep=";
    const bool declares = line.starts_with(kMark) || line.starts_with("Sep=") || line.starts_with("SEP=");
    if (!declares || line.size() > kMark.size() + 1) return std::nullopt;
    const char separator = line.size() > kMark.size() ? line[kMark.size()] : '\0';
    return std::ranges::find(kSeparators, separator) != kSeparators.end() ? separator : '\0';
}

const char* name_of_separator(char separator) {
    if (separator == ';') return "a semicolon";
    return separator == '\t' ? "a tab" : "a comma";
}

std::optional<double> finite_number(std::string_view text) {
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
    return value;
}

std::string csv_number(double value) {
    if (!std::isfinite(value)) return "";
    char text[40];
    return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

std::string csv_field(std::string_view text) {
    if (text.find_first_of(",\"\n") == std::string_view::npos) return std::string(text);
    std::string quoted = "\"";
    for (const char c : text) {
        if (c == '"') quoted += '"';
        quoted += c;
    }
    return quoted + '"';
}

}  // namespace burin
