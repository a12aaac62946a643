// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <optional>
#include <set>
#include <utility>

#include "base/csv.hpp"
#include "base/text.hpp"
#include "study/published/published.hpp"

namespace burin::study {
namespace {

constexpr std::array kQuantityNames{
    std::pair(PublishedQuantity::time, "time"),
    std::pair(PublishedQuantity::deviation, "deviation"),
    std::pair(PublishedQuantity::time_rank_of_all, "time rank of all"),
    std::pair(PublishedQuantity::time_rank_in_group, "time rank in group"),
    std::pair(PublishedQuantity::deviation_rank_of_all, "deviation rank of all"),
    std::pair(PublishedQuantity::deviation_rank_in_group, "deviation rank in group"),
    std::pair(PublishedQuantity::squared_rank_differences, "sum of squared rank differences"),
    std::pair(PublishedQuantity::rank_correlation, "rank correlation"),
    std::pair(PublishedQuantity::u_of_time, "U of time"),
    std::pair(PublishedQuantity::u_of_deviation, "U of deviation"),
    std::pair(PublishedQuantity::z_of_time, "z of time"),
    std::pair(PublishedQuantity::z_of_deviation, "z of deviation"),
    std::pair(PublishedQuantity::number_of_values, "number of values")};

constexpr std::string_view kPublishedHeader = "table,quantity,group,participant,trial,printed";
constexpr std::string_view kTitleMark = "# study: ";
constexpr std::size_t kPublishedColumns = 6;

// Whether the line has the header's names, in quotes or not.
bool is_header(std::string_view line, char separator) {
    std::string names;
    for (const CsvField& field : split_csv(line, separator).fields)
        names += (names.empty() ? "" : ",") + column_name(field.text);
    return names == kPublishedHeader;
}

bool is_of_a_trial(PublishedQuantity quantity) { return quantity <= PublishedQuantity::deviation_rank_in_group; }

std::optional<PublishedQuantity> quantity_named(std::string_view name) {
    for (const auto& [quantity, known] : kQuantityNames) {
        if (name == known) return quantity;
    }
    return std::nullopt;
}

std::string all_quantities() {
    std::string all;
    for (const auto& [quantity, name] : kQuantityNames) all += (all.empty() ? "" : ", ") + std::string(name);
    return all;
}

void read_value(ParsedPublished& parsed, const CsvLine& split, std::size_t line) {
    const auto complain = [&](std::size_t field, std::string what, std::string remedy) {
        parsed.faults.push_back({line, split.fields[field].column, std::move(what), std::move(remedy)});
    };
    if (split.fields.size() != kPublishedColumns || split.unclosed_quote != 0) {
        complain(0, "does not hold six fields", "write " + std::string(kPublishedHeader));
        return;
    }
    const std::size_t faults_before = parsed.faults.size();
    const auto text = [&](std::size_t field) -> const std::string& { return split.fields[field].text; };
    const auto quantity = quantity_named(text(1));
    if (!quantity) complain(1, "knows no quantity '" + text(1) + "'", "write one of: " + all_quantities());
    const auto printed = finite_number(text(5));
    if (!printed) complain(5, "'" + text(5) + "' is not a finite number", "write the figure as it is printed");
    const bool of_trial = quantity && is_of_a_trial(*quantity);
    const auto trial = finite_number(text(4));
    if (of_trial && (!trial || !(*trial >= 1.0 && *trial <= 1e6)))
        complain(4, "names no trial", "write the number of the participant's trial");
    if (parsed.faults.size() > faults_before) return;
    const std::size_t point = text(5).find('.');
    parsed.study.values.push_back(
        {.table = text(0),
         .quantity = *quantity,
         .group = text(2),
         .participant = of_trial ? text(3) : "",
         .trial = of_trial ? static_cast<int>(*trial) : 0,
         .printed = *printed,
         .decimals = point == std::string::npos ? 0 : static_cast<int>(text(5).size() - point - 1),
         .text = text(5)});
}

}  // namespace

const char* name_of(PublishedQuantity quantity) {
    return std::ranges::find(kQuantityNames, quantity, &decltype(kQuantityNames)::value_type::first)->second;
}

ParsedPublished parse_published(std::string_view text) {
    ParsedPublished parsed;
    bool header_seen = false;
    std::optional<char> separator;
    std::set<std::string> tables;
    for (std::size_t line_number = 1, next = 1; !text.empty(); line_number = next) {
        const auto [line, lines] = take_record(text, separator);
        next = line_number + lines;
        if (line.starts_with(kTitleMark)) parsed.study.title = line.substr(kTitleMark.size());
        if (line.empty() || line.front() == '#') continue;
        if (!header_seen && !separator && (separator = declared_separator(line))) continue;
        if (parsed.study.values.size() == kMostPublishedValues || tables.size() > kMostPublishedTables) {
            parsed.faults.push_back(
                {line_number, 1,
                 formatted("follows more than %zu figures or %zu tables", kMostPublishedValues, kMostPublishedTables),
                 "compare with a part of them at a time"});
            return parsed;
        }
        if (header_seen) {
            read_value(parsed, split_csv(line, *separator), line_number);
            if (!parsed.study.values.empty()) tables.insert(parsed.study.values.back().table);
        } else if (!separator) {
            separator = separator_in(line);
        }
        if (!header_seen && !is_header(line, *separator)) {
            parsed.faults.push_back({line_number, 1, "is no table of published figures",
                                     "its first line must read " + std::string(kPublishedHeader)});
            return parsed;
        }
        header_seen = true;
    }
    if (parsed.study.values.empty() && parsed.faults.empty())
        parsed.faults.push_back({1, 1, "holds no figure", "write " + std::string(kPublishedHeader) + " and rows"});
    return parsed;
}

}  // namespace burin::study
