// SPDX-License-Identifier: MIT
// Figures of a study as they were published, and how far they follow from its data. A text of published figures is CSV
// (docs/formats.md); nothing here knows any study. Pure; any thread.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "study/table/trial_table.hpp"

namespace burin::study {

// What a figure is of. Ranks are midranks, from 1 for the least; `all` are the trials of every group together.
enum class PublishedQuantity {
    time,
    deviation,
    time_rank_of_all,
    time_rank_in_group,
    deviation_rank_of_all,
    deviation_rank_in_group,
    squared_rank_differences,  // their sum over a group, ranks within the group
    rank_correlation,          // Spearman's, of a group's trials
    u_of_time,                 // n1 n2 + n1 (n1 + 1) / 2 - R, with the size n1 and the rank sum R of the group named
    u_of_deviation,
    z_of_time,  // (U - n1 n2 / 2) / sigma of that U, without continuity correction
    z_of_deviation,
    number_of_values  // trials of a group
};
[[nodiscard]] const char* name_of(PublishedQuantity quantity);  // as the CSV has it: "time rank of all"

struct PublishedValue {
    std::string table;  // where it is printed
    PublishedQuantity quantity = PublishedQuantity::time;
    std::string group;
    std::string participant;  // empty, and trial 0, for figures of a whole group
    int trial = 0;
    double printed = 0.0;
    int decimals = 0;  // that are printed
    std::string text;  // as it is printed
};

struct PublishedStudy {
    std::string title;
    std::vector<PublishedValue> values;
};

struct ParsedPublished {
    PublishedStudy study;
    std::vector<TableFault> faults;
};
// More figures or tables are a fault, behind which nothing is read.
inline constexpr std::size_t kMostPublishedValues = 5000, kMostPublishedTables = 50;
[[nodiscard]] ParsedPublished parse_published(std::string_view text);

// Whether the table holds the trials of the study's first table: the same ones, with the values printed there.
[[nodiscard]] bool is_data_of(const TrialTable& table, const PublishedStudy& study);

// A published figure beside what the data give.
struct PublishedCheck {
    PublishedValue value;
    double from_data = 0.0;  // NaN where the data have no such group or trial
    bool agrees = false;     // to the decimals of whichever has fewer
    std::string remark;      // where it differs, what would give the printed figure, if anything here does
};

struct PublishedComparison {
    std::string title;
    std::vector<PublishedCheck> checks;  // in the order of the study's values

    [[nodiscard]] std::size_t disagreeing() const;
};
[[nodiscard]] PublishedComparison compare_published(const PublishedStudy& study, const TrialTable& table);

// The published studies that Burin knows: the texts of assets/studies, compiled in.
[[nodiscard]] std::span<const std::string_view> known_published_texts();

}  // namespace burin::study
