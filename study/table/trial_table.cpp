// SPDX-License-Identifier: MIT
#include "study/table/trial_table.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <utility>

#include "base/csv.hpp"
#include "base/file_io.hpp"
#include "base/text.hpp"
#include "base/try.hpp"

namespace burin::study {
namespace {

enum class Quantity { participant, group, trial, deviation, time, stage, world, day, reason };
constexpr std::size_t kNeeded = 5, kQuantities = 9;  // the needed ones come first

struct ColumnName {
    const char* name;
    Quantity quantity;
    const char* unit;
};
constexpr std::array kColumnNames{ColumnName{"participant", Quantity::participant, ""},
                                  ColumnName{"user", Quantity::participant, ""},
                                  ColumnName{"group", Quantity::group, ""},
                                  ColumnName{"trial", Quantity::trial, ""},
                                  ColumnName{"deviation", Quantity::deviation, ""},
                                  ColumnName{"deviation_m", Quantity::deviation, "m"},
                                  ColumnName{"deviation_mm", Quantity::deviation, "mm"},
                                  ColumnName{"time_s", Quantity::time, "s"},
                                  ColumnName{"time_min", Quantity::time, "min"},
                                  ColumnName{"stage", Quantity::stage, ""},
                                  ColumnName{"world", Quantity::world, ""},
                                  ColumnName{"day", Quantity::day, ""},
                                  ColumnName{"reason", Quantity::reason, ""}};

constexpr std::array<const char*, kNeeded> kWays{"participant (or user)", "group", "trial",
                                                 "deviation, deviation_m or deviation_mm", "time_s or time_min"};
constexpr double kLargestNumber = 1e9;  // far from overflow in squares and sums, far above any time or distance
constexpr int kMostTrials = 1'000'000;
constexpr std::size_t kMostGroups = 20;  // every two are compared

// Reads line by line and keeps what it has seen.
class TrialParser {
public:
    void read(std::string_view text) {
        std::string_view rest = text;
        for (std::size_t next = line_ = 1; !rest.empty(); line_ = next) {
            const auto [line, lines] = take_record(rest, separator_);
            next = line_ + lines;
            if (line.find_first_not_of(" \t") == std::string_view::npos || line.front() == '#') continue;
            if (header_seen_ && rows_seen_ == kMostRows) {
                complain(line_, 1, formatted("is the first of more than %zu rows", kMostRows),
                         "write one row for each trial, not for each sample");
                break;
            }
            if (header_seen_) {
                read_row(line);
            } else if (!takes_separator(line)) {
                read_header(line);
            }
        }
        if (!header_seen_) {
            complain(1, 1, "holds no table", "write a line with the columns' names, then a line for each trial");
        } else if (columns_known_ && rows_seen_ == 0) {
            complain(std::max<std::size_t>(1, line_ - 1), 1, "holds no trial", "write a line for each trial");
        }
        std::ranges::stable_sort(parsed_.faults, {}, [](const TableFault& f) { return std::pair(f.line, f.column); });
    }

    [[nodiscard]] ParsedTable take() { return std::move(parsed_); }

private:
    void complain(std::size_t line, std::size_t column, std::string what, std::string remedy) {
        parsed_.faults.push_back({line, column, std::move(what), std::move(remedy)});
    }

    [[nodiscard]] bool quotes_closed(const CsvLine& split) {
        if (split.unclosed_quote == 0) return true;
        complain(line_, split.unclosed_quote, "a double quote is never closed", "close it in the same line");
        return false;
    }

    // Whether the line says what separates columns; nothing but the first may.
    [[nodiscard]] bool takes_separator(std::string_view line) {
        const std::optional<char> declared = declared_separator(line);
        if (!declared || separator_) return false;
        if (*declared == '\0')
            complain(line_, 1, "declares a separator that is none: " + std::string(line.substr(0, 40)),
                     "separate columns by commas, semicolons or tabs");
        separator_ = *declared == '\0' ? ',' : *declared;
        return true;
    }

    void read_header(std::string_view line) {
        header_seen_ = true;
        if (!separator_) separator_ = separator_in(line);
        const CsvLine split = split_csv(line, *separator_);
        if (!quotes_closed(split)) return;
        columns_ = split.fields.size();
        for (std::size_t i = 0; i < columns_; ++i) name_column(split.fields[i], i);
        columns_known_ = true;
        for (std::size_t q = 0; q < kNeeded; ++q) {
            if (place_[q]) continue;
            columns_known_ = false;
            complain(line_, 1, std::string("has no column ") + kWays[q], remedy_for_columns(line));
        }
    }

    [[nodiscard]] std::string remedy_for_columns(std::string_view line) const {
        if (columns_ == 1)
            return std::string("separate columns by commas, semicolons or tabs") +
                   (line.contains('|') ? ", not by |" : "");
        return std::string("name the column in this line; what separates its fields is ") +
               name_of_separator(*separator_);
    }

    static std::string one_line(std::string text) {
        std::ranges::replace(text, '\n', ' ');
        return text;
    }

    void name_column(const CsvField& field, std::size_t i) {
        const std::string name = column_name(field.text);
        const auto known = std::ranges::find(kColumnNames, name, &ColumnName::name);
        if (known == kColumnNames.end()) {
            parsed_.table.other_columns.push_back(name == field.text ? name : one_line(field.text));
            return;
        }
        std::optional<std::size_t>& place = place_[static_cast<std::size_t>(known->quantity)];
        if (place && static_cast<std::size_t>(known->quantity) >= kNeeded) {
            parsed_.table.other_columns.push_back(field.text);
            return;
        }
        if (place) {
            complain(line_, field.column, "column " + field.text + " says again what a column before it says",
                     "keep one of them, or give this one another name");
            return;
        }
        place = i;
        if (known->quantity == Quantity::time) parsed_.table.time_unit = known->unit;
        if (known->quantity == Quantity::deviation) parsed_.table.deviation_unit = known->unit;
    }

    void read_row(std::string_view line) {
        ++rows_seen_;
        const CsvLine split = split_csv(line, *separator_);
        if (!quotes_closed(split) || !columns_known_ || !has_all_fields(split)) return;
        if (is_lost(split)) return read_lost(split);
        if (const std::string reason = text(split, Quantity::reason); !reason.empty())
            complain(line_, field(split, Quantity::reason).column,
                     "has measures, and a reason why it has none: '" + reason + "'",
                     "leave deviation and time empty, or the reason");
        const std::size_t faults_before = parsed_.faults.size();
        const Trial trial{.participant = code(split, Quantity::participant),
                          .group = code(split, Quantity::group),
                          .number = trial_number(split),
                          .deviation = number(split, Quantity::deviation, false),
                          .time = number(split, Quantity::time, true),
                          .exact_deviation = decimal_of(field(split, Quantity::deviation).text),
                          .exact_time = decimal_of(field(split, Quantity::time).text),
                          .stage = text(split, Quantity::stage),
                          .world = text(split, Quantity::world),
                          .day = text(split, Quantity::day)};
        check_against_rows_before(split, {trial.participant, trial.group, trial.number});
        if (parsed_.faults.size() > faults_before) return;
        add_group(split, trial.group);
        parsed_.table.trials.push_back(trial);
    }

    // Of a column that a table need not have; empty where it has none.
    [[nodiscard]] std::string text(const CsvLine& split, Quantity quantity) const {
        return place_[static_cast<std::size_t>(quantity)] ? field(split, quantity).text : std::string();
    }

    // Whether a row has neither measure and says why.
    [[nodiscard]] bool is_lost(const CsvLine& split) const {
        return field(split, Quantity::deviation).text.empty() && field(split, Quantity::time).text.empty() &&
               !text(split, Quantity::reason).empty();
    }

    void read_lost(const CsvLine& split) {
        const std::size_t faults_before = parsed_.faults.size();
        LostTrial lost{.participant = code(split, Quantity::participant),
                       .group = code(split, Quantity::group),
                       .number = trial_number(split),
                       .stage = text(split, Quantity::stage),
                       .world = text(split, Quantity::world),
                       .day = text(split, Quantity::day),
                       .reason = text(split, Quantity::reason)};
        check_against_rows_before(split, {lost.participant, lost.group, lost.number});
        if (parsed_.faults.size() == faults_before) parsed_.table.lost.push_back(std::move(lost));
    }

    [[nodiscard]] bool has_all_fields(const CsvLine& split) {
        if (split.fields.size() == columns_) return true;
        const bool more = split.fields.size() > columns_;
        const CsvField& where = more ? split.fields[columns_] : split.fields.back();
        complain(line_, where.column,
                 formatted("has %zu fields where the first line names %zu columns", split.fields.size(), columns_),
                 more ? std::string("remove what is too much, or put text that holds ") +
                            name_of_separator(*separator_) + " in double quotes"
                      : std::string("write every field, with ") + name_of_separator(*separator_) + " between them");
        return false;
    }

    void add_group(const CsvLine& split, const std::string& group) {
        std::vector<std::string>& groups = parsed_.table.groups;
        if (std::ranges::find(groups, group) != groups.end() || groups.size() > kMostGroups) return;
        groups.push_back(group);
        if (groups.size() <= kMostGroups) return;
        complain(line_, field(split, Quantity::group).column,
                 formatted("is the first of more than %zu groups", kMostGroups),
                 "name the training in this column, not the participant");
    }

    [[nodiscard]] const CsvField& field(const CsvLine& split, Quantity quantity) const {
        return split.fields[*place_[static_cast<std::size_t>(quantity)]];
    }

    [[nodiscard]] std::string code(const CsvLine& split, Quantity quantity) {
        const CsvField& f = field(split, quantity);
        const std::string what = quantity == Quantity::group ? "group" : "participant";
        if (f.text.empty()) complain(line_, f.column, "names no " + what, "write a code");
        if (f.text.contains('\n')) complain(line_, f.column, what + " goes over lines", "write its code in one line");
        if (f.text.contains('@'))
            complain(line_, f.column, what + " '" + f.text + "' looks like a mail address",
                     "write a code that names nobody");
        return f.text;
    }

    [[nodiscard]] int trial_number(const CsvLine& split) {
        const CsvField& f = field(split, Quantity::trial);
        const std::optional<double> value = finite_number(f.text);
        if (value && *value >= 1.0 && *value <= kMostTrials && *value == static_cast<int>(*value))
            return static_cast<int>(*value);
        complain(line_, f.column, "trial '" + f.text + "' is not a whole number from 1 on",
                 "number each person's trials");
        return 0;
    }

    [[nodiscard]] double number(const CsvLine& split, Quantity quantity, bool above_0) {
        const CsvField& f = field(split, quantity);
        const std::string what = quantity == Quantity::time ? "time" : "deviation";
        const std::optional<double> value = finite_number(f.text);
        if (!value) {
            complain(line_, f.column, what + " '" + f.text + "' is not a finite number",
                     f.text.contains(',') ? "write a decimal point, not a comma"
                                          : "write a number such as 2.5; where there is none leave the row out, or "
                                            "leave deviation and time empty and say why in a column reason");
        } else if (*value < 0.0 || (above_0 && *value == 0.0)) {
            complain(line_, f.column, what + " " + f.text + (above_0 ? " is not above 0" : " is below 0"),
                     "correct the number");
        } else if (*value > kLargestNumber) {
            complain(line_, f.column, what + " " + f.text + " is absurdly large", "correct the number");
        }
        return value.value_or(0.0);
    }

    struct WhoseTrial {
        const std::string &participant, &group;
        int number = 0;
    };

    void check_against_rows_before(const CsvLine& split, const WhoseTrial& trial) {
        const auto [group, fresh] = group_of_.emplace(trial.participant, std::pair(trial.group, line_));
        if (!fresh && group->second.first != trial.group) {
            complain(line_, field(split, Quantity::group).column,
                     "participant " + trial.participant + " is in group " + trial.group + " here and in group " +
                         group->second.first + formatted(" in line %zu", group->second.second),
                     "correct the group, or give the second person a code of their own");
        }
        if (trial.number == 0) return;
        const auto [row, first] = line_of_trial_.emplace(std::pair(trial.participant, trial.number), line_);
        if (!first) {
            complain(line_, field(split, Quantity::trial).column,
                     "participant " + trial.participant +
                         formatted(" has trial %d already in line %zu", trial.number, row->second),
                     "number the trials of a participant, each once");
        }
    }

    ParsedTable parsed_;
    std::size_t line_ = 1, columns_ = 0, rows_seen_ = 0;
    bool header_seen_ = false, columns_known_ = false;
    std::optional<char> separator_;  // of the columns; none before the first line
    std::array<std::optional<std::size_t>, kQuantities> place_;
    std::map<std::string, std::pair<std::string, std::size_t>> group_of_;  // of a participant, and the first line
    std::map<std::pair<std::string, int>, std::size_t> line_of_trial_;
};

}  // namespace

std::string line_of(const TableFault& fault, const std::string& file) {
    return Error{fault.what, formatted("%s:%zu:%zu", file.c_str(), fault.line, fault.column), fault.remedy}.line();
}

ParsedTable parse_trials(std::string_view text) {
    TrialParser parser;
    parser.read(text);
    return parser.take();
}

Result<ParsedTable> read_trials(const std::filesystem::path& path) {
    BURIN_TRY(text, read_text_file(path, kMostTableBytes));
    return parse_trials(text);
}

}  // namespace burin::study
