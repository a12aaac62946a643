// SPDX-License-Identifier: MIT
#include "study/table/csv.hpp"

#include <charconv>
#include <cmath>
#include <system_error>

namespace burin::study {
namespace {

std::string_view without_blanks_around(std::string_view text) {
    const std::size_t first = text.find_first_not_of(" \t"), last = text.find_last_not_of(" \t");
    return first == std::string_view::npos ? std::string_view() : text.substr(first, last + 1 - first);
}

// Counts characters of UTF-8: all bytes but those that continue one.
std::size_t characters_in(std::string_view text) {
    std::size_t count = 0;
    for (const char c : text) count += (static_cast<unsigned char>(c) & 0xC0u) != 0x80u ? 1 : 0;
    return count;
}

}  // namespace

CsvLine split_csv(std::string_view line) {
    CsvLine split;
    std::size_t at = 0, columns_before = 0, counted_to = 0;
    const auto column_at = [&](std::size_t place) {
        columns_before += characters_in(line.substr(counted_to, place - counted_to));
        counted_to = place;
        return columns_before + 1;
    };
    while (true) {
        while (at < line.size() && (line[at] == ' ' || line[at] == '\t')) ++at;
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
        const std::size_t end = std::min(line.find(',', at), line.size());
        field.text += without_blanks_around(line.substr(at, end - at));
        split.fields.push_back(std::move(field));
        if (end == line.size()) return split;
        at = end + 1;
    }
}

std::optional<double> finite_number(std::string_view text) {
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
    return value;
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

}  // namespace burin::study
