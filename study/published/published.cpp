// SPDX-License-Identifier: MIT
#include "study/published/published.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <functional>
#include <optional>

#include "study/statistics/mann_whitney.hpp"
#include "study/statistics/outcome.hpp"
#include "study/statistics/ranks.hpp"
#include "study/statistics/spearman.hpp"

namespace burin::study {
namespace {

using Printed = PublishedQuantity;

int decimals_of(double value) {
    char text[400];
    const auto written = std::to_chars(text, text + sizeof text, value, std::chars_format::fixed);
    const std::string_view digits(text, static_cast<std::size_t>(written.ptr - text));
    const std::size_t point = digits.find('.');
    return point == std::string_view::npos ? 0 : static_cast<int>(digits.size() - point - 1);
}

// Whether a computed value is the printed one when both have the decimals of the one that has fewer. Some print a
// number cut off instead of rounded: units = 1 lets that pass.
bool agrees_with(const PublishedValue& value, double computed, double units = 0.5) {
    if (!std::isfinite(computed)) return false;
    const double last = std::pow(10.0, -std::min(value.decimals, decimals_of(computed)));
    return std::abs(value.printed - computed) <= units * last * (1.0 + 1e-9);
}

// ---- What trials give

struct ByGroup {
    std::vector<double> mine, others;
};

class Facts {
public:
    explicit Facts(std::vector<Trial> trials) : trials_(std::move(trials)) {}

    [[nodiscard]] double of(const PublishedValue& v) const {
        switch (v.quantity) {
            case Printed::time: return of_trial(v, [&](std::size_t i) { return trials_[i].time; });
            case Printed::deviation: return of_trial(v, [&](std::size_t i) { return trials_[i].deviation; });
            case Printed::time_rank_of_all: return rank(v, &Trial::time, false);
            case Printed::time_rank_in_group: return rank(v, &Trial::time, true);
            case Printed::deviation_rank_of_all: return rank(v, &Trial::deviation, false);
            case Printed::deviation_rank_in_group: return rank(v, &Trial::deviation, true);
            case Printed::squared_rank_differences: return squared_differences(v.group);
            case Printed::rank_correlation:
                return spearman(groups(v.group, &Trial::time).mine, groups(v.group, &Trial::deviation).mine).statistic;
            case Printed::u_of_time: return u(v.group, &Trial::time);
            case Printed::u_of_deviation: return u(v.group, &Trial::deviation);
            case Printed::z_of_time: return z(v.group, &Trial::time);
            case Printed::z_of_deviation: return z(v.group, &Trial::deviation);
            case Printed::number_of_values: return size(v.group);
        }
        return kUndefined;
    }

    // By formulas that know no ties; NaN for quantities that ties leave alone.
    [[nodiscard]] double without_ties(const PublishedValue& v) const {
        if (v.quantity == Printed::rank_correlation) return correlation_from(v.group, squared_differences(v.group));
        if (v.quantity == Printed::z_of_time) return z_from(v.group, u(v.group, &Trial::time));
        if (v.quantity == Printed::z_of_deviation) return z_from(v.group, u(v.group, &Trial::deviation));
        return kUndefined;
    }

    [[nodiscard]] double correlation_from(const std::string& group, double squares) const {
        const double n = size(group);
        return 1.0 - 6.0 * squares / (n * (n * n - 1.0));
    }
    [[nodiscard]] double z_from(const std::string& group, double u_value) const {
        const double n1 = size(group), n2 = static_cast<double>(trials_.size()) - n1;
        return (u_value - 0.5 * n1 * n2) / std::sqrt(n1 * n2 * (n1 + n2 + 1.0) / 12.0);
    }
    [[nodiscard]] double u_from(const std::string& group, double rank_sum) const {
        const double n1 = size(group), n2 = static_cast<double>(trials_.size()) - n1;
        return n1 * n2 + 0.5 * n1 * (n1 + 1.0) - rank_sum;
    }
    [[nodiscard]] double size(const std::string& group) const {
        return static_cast<double>(std::ranges::count(trials_, group, &Trial::group));
    }

private:
    using Number = double Trial::*;

    [[nodiscard]] double of_trial(const PublishedValue& v, const std::function<double(std::size_t)>& value) const {
        for (std::size_t i = 0; i < trials_.size(); ++i) {
            const Trial& t = trials_[i];
            if (t.participant == v.participant && t.number == v.trial && t.group == v.group) return value(i);
        }
        return kUndefined;
    }

    [[nodiscard]] double rank(const PublishedValue& v, Number number, bool in_group) const {
        return of_trial(v, [&](std::size_t i) {
            double below = 0.0, equal = 0.0;
            for (const Trial& t : trials_) {
                if (in_group && t.group != v.group) continue;
                below += t.*number < trials_[i].*number ? 1.0 : 0.0;
                equal += t.*number == trials_[i].*number ? 1.0 : 0.0;
            }
            return below + 0.5 * (equal + 1.0);
        });
    }

    [[nodiscard]] ByGroup groups(const std::string& group, Number number) const {
        ByGroup split;
        for (const Trial& t : trials_) (t.group == group ? split.mine : split.others).push_back(t.*number);
        return split;
    }

    [[nodiscard]] double squared_differences(const std::string& group) const {
        const std::vector<double> times = midranks(groups(group, &Trial::time).mine);
        const std::vector<double> deviations = midranks(groups(group, &Trial::deviation).mine);
        double sum = 0.0;
        for (std::size_t i = 0; i < times.size(); ++i) sum += (times[i] - deviations[i]) * (times[i] - deviations[i]);
        return sum;
    }

    // The formula with the group's rank sum counts the pairs in which the others are greater.
    [[nodiscard]] double u(const std::string& group, Number number) const {
        const ByGroup split = groups(group, number);
        return mann_whitney_normal(split.others, split.mine).statistic;
    }
    [[nodiscard]] double z(const std::string& group, Number number) const {
        const ByGroup split = groups(group, number);
        return normal_u(split.others, split.mine).z;
    }

    std::vector<Trial> trials_;
};

// ---- What a printed figure that differs may come from

PublishedQuantity other_rank(PublishedQuantity quantity) {
    switch (quantity) {
        case Printed::time_rank_of_all: return Printed::time_rank_in_group;
        case Printed::time_rank_in_group: return Printed::time_rank_of_all;
        case Printed::deviation_rank_of_all: return Printed::deviation_rank_in_group;
        case Printed::deviation_rank_in_group: return Printed::deviation_rank_of_all;
        default: return quantity;
    }
}

class Detective {
public:
    Detective(const PublishedStudy& study, const TrialTable& table) : study_(study), data_(table.trials) {
        for (const PublishedValue& v : study.values) {
            if (std::ranges::find(tables_, v.table, &OwnTable::name) == tables_.end())
                tables_.push_back({v.table, Facts(as_printed_in(v.table, table.trials))});
        }
    }

    [[nodiscard]] PublishedCheck check(const PublishedValue& v) const {
        PublishedCheck check{.value = v, .from_data = data_.of(v), .agrees = false, .remark = {}};
        check.agrees = agrees_with(v, check.from_data);
        if (std::isnan(check.from_data)) {
            check.remark = "the data have no such trial or group";
        } else if (!check.agrees) {
            check.remark = remark_on(v, check.from_data);
        }
        return check;
    }

private:
    struct OwnTable {
        std::string name;
        Facts facts;  // of the trials with the times and deviations that this table prints
    };

    [[nodiscard]] std::vector<Trial> as_printed_in(const std::string& table, std::vector<Trial> trials) const {
        for (const PublishedValue& v : study_.values) {
            const bool time = v.quantity == Printed::time, deviation = v.quantity == Printed::deviation;
            if (v.table != table || (!time && !deviation)) continue;
            for (Trial& t : trials) {
                if (t.participant == v.participant && t.number == v.trial && t.group == v.group)
                    (time ? t.time : t.deviation) = v.printed;
            }
        }
        return trials;
    }

    [[nodiscard]] std::string remark_on(const PublishedValue& v, double from_data) const {
        const OwnTable& own = *std::ranges::find(tables_, v.table, &OwnTable::name);
        PublishedValue as_other = v;
        as_other.quantity = other_rank(v.quantity);
        const bool of_all =
            as_other.quantity == Printed::time_rank_of_all || as_other.quantity == Printed::deviation_rank_of_all;
        const std::string other =
            of_all ? "the printed one is the rank among all trials" : "the printed one is the rank within the group";
        const double without_ties = data_.without_ties(v);
        if (as_other.quantity != v.quantity && agrees_with(v, data_.of(as_other))) return other;
        if (v.quantity == Printed::time || v.quantity == Printed::deviation) return elsewhere(v, from_data);
        if (agrees_with(v, own.facts.of(v))) return "the printed one is right for the values that this table prints";
        if (as_other.quantity != v.quantity && agrees_with(v, own.facts.of(as_other)))
            return other + ", for the values that this table prints";
        if (agrees_with(v, without_ties)) return "the printed one is right if ties are ignored";
        if (const std::string follows = follows_from(v); !follows.empty()) return follows;
        if (agrees_with(v, -from_data, 1.0)) return "the printed sign is reversed";
        if (agrees_with(v, -without_ties, 1.0)) return "the printed sign is reversed, and ties are ignored";
        return "";
    }

    // Where the same number is printed as the data have it.
    [[nodiscard]] std::string elsewhere(const PublishedValue& v, double from_data) const {
        for (const PublishedValue& other : study_.values) {
            if (other.quantity == v.quantity && other.group == v.group && other.participant == v.participant &&
                other.trial == v.trial && agrees_with(other, from_data))
                return "table " + other.table + " prints " + other.text;
        }
        return "";
    }

    // Whether the figure follows from other figures of the same table, right or wrong.
    [[nodiscard]] std::string follows_from(const PublishedValue& v) const {
        const auto printed = [&](PublishedQuantity quantity) {
            double sum = kUndefined;
            for (const PublishedValue& other : study_.values) {
                if (other.table == v.table && other.group == v.group && other.quantity == quantity)
                    sum = std::isnan(sum) ? other.printed : sum + other.printed;
            }
            return sum;
        };
        double follows = kUndefined;
        const char* from = "";
        switch (v.quantity) {
            case Printed::rank_correlation:
                follows = data_.correlation_from(v.group, printed(Printed::squared_rank_differences));
                from = "the printed one follows from the sum of squares that this table prints";
                break;
            case Printed::u_of_time:
            case Printed::u_of_deviation: {
                const bool time = v.quantity == Printed::u_of_time;
                follows =
                    data_.u_from(v.group, printed(time ? Printed::time_rank_of_all : Printed::deviation_rank_of_all));
                from = "the printed one follows from the ranks that this table prints";
                break;
            }
            case Printed::z_of_time:
            case Printed::z_of_deviation: {
                const bool time = v.quantity == Printed::z_of_time;
                follows = data_.z_from(v.group, printed(time ? Printed::u_of_time : Printed::u_of_deviation));
                from = "the printed one follows from the U that this table prints, ties ignored";
                break;
            }
            default: break;
        }
        return agrees_with(v, follows, 1.0) ? from : "";
    }

    const PublishedStudy& study_;
    Facts data_;
    std::vector<OwnTable> tables_;
};

}  // namespace

std::size_t PublishedComparison::disagreeing() const {
    return static_cast<std::size_t>(std::ranges::count(checks, false, &PublishedCheck::agrees));
}

bool is_data_of(const TrialTable& table, const PublishedStudy& study) {
    if (study.values.empty()) return false;
    const Facts data(table.trials);
    std::size_t times = 0, deviations = 0;
    for (const PublishedValue& v : study.values) {
        if (v.table != study.values.front().table) continue;
        times += v.quantity == Printed::time ? 1 : 0;
        deviations += v.quantity == Printed::deviation ? 1 : 0;
        if (!agrees_with(v, data.of(v))) return false;
    }
    return times == table.trials.size() && deviations == table.trials.size();
}

PublishedComparison compare_published(const PublishedStudy& study, const TrialTable& table) {
    PublishedComparison comparison{.title = study.title, .checks = {}};
    const Detective detective(study, table);
    for (const PublishedValue& value : study.values) comparison.checks.push_back(detective.check(value));
    return comparison;
}

}  // namespace burin::study
