// SPDX-License-Identifier: MIT
#include "study/statistics/agreement.hpp"

#include <algorithm>
#include <numeric>
#include <string>

#include "study/statistics/distributions.hpp"

namespace burin::study {
namespace {

using Participants = std::span<const std::vector<Int128>>;

std::string why_no_agreement(Participants participants) {
    if (participants.size() < 2) return "fewer than two participants";
    const auto repeats = [](const std::vector<Int128>& trials) { return trials.size() >= 2; };
    const auto has_none = [](const std::vector<Int128>& trials) { return trials.empty(); };
    if (std::ranges::any_of(participants, has_none)) return "a participant has no trial";
    if (std::ranges::none_of(participants, repeats)) return "every participant has fewer than two trials";
    const Int128 one = participants.front().front();
    const auto is_one = [&](const std::vector<Int128>& trials) {
        return std::ranges::all_of(trials, [&](Int128 value) { return value == one; });
    };
    return std::ranges::all_of(participants, is_one) ? "all values are equal" : "";
}

Int128 total_of(const std::vector<Int128>& trials) { return std::accumulate(trials.begin(), trials.end(), Int128{0}); }

double squared(double value) { return value * value; }

// Mean squares between participants and within them, with their degrees of freedom and the trials of each, k0.
struct Variances {
    double between = 0.0, within = 0.0;
    double freedom_between = 0.0, freedom_within = 0.0;
    double trials = 0.0;
};

// Every deviation is a whole number before it is squared, so that those that are 0 are exactly 0.
Variances variances_of(Participants participants) {
    Int128 all = 0, total = 0;
    double squared_sizes = 0.0;
    for (const std::vector<Int128>& trials : participants) {
        all += static_cast<Int128>(trials.size());
        total += total_of(trials);
        squared_sizes += squared(static_cast<double>(trials.size()));
    }
    Variances v;
    for (const std::vector<Int128>& trials : participants) {
        const auto size = static_cast<Int128>(trials.size());
        const Int128 mine = total_of(trials);
        const auto n = static_cast<double>(size);
        for (const Int128 value : trials) v.within += squared(static_cast<double>(value * size - mine) / n);
        v.between += n * squared(static_cast<double>(mine * all - total * size) / n / static_cast<double>(all));
    }
    const auto people = static_cast<double>(participants.size()), values = static_cast<double>(all);
    v.freedom_between = people - 1.0;
    v.freedom_within = values - people;
    v.between /= v.freedom_between;
    v.within /= v.freedom_within;
    v.trials = (values - squared_sizes / values) / (people - 1.0);
    return v;
}

Estimate undefined_agreement(const std::string& why) {
    Estimate estimate;
    estimate.method = "intraclass correlation ICC(1), one-way random effects, interval from F under normality";
    estimate.undefined = why;
    return estimate;
}

}  // namespace

Estimate intraclass_correlation(std::span<const std::vector<double>> participants, double confidence) {
    std::vector<double> pooled;
    for (const std::vector<double>& trials : participants) pooled.insert(pooled.end(), trials.begin(), trials.end());
    if (!all_finite(pooled)) return undefined_agreement(kNotFinite);
    const std::vector<Int128> steps = exact_values(pooled).steps;
    std::vector<std::vector<Int128>> exact;
    auto next = steps.begin();
    for (const std::vector<double>& trials : participants) {
        const auto end = next + std::ssize(trials);
        exact.emplace_back(next, end);
        next = end;
    }
    return exact_intraclass_correlation(exact, confidence);
}

Estimate exact_intraclass_correlation(std::span<const std::vector<Int128>> participants, double confidence) {
    Estimate estimate = undefined_agreement(why_no_agreement(participants));
    if (!estimate.undefined.empty()) return estimate;
    const Variances v = variances_of(participants);
    const auto same_size = [&](const std::vector<Int128>& one) { return one.size() == participants.front().size(); };
    if (!std::ranges::all_of(participants, same_size)) estimate.method += ", approximate for unequal numbers of trials";
    // F = between / within; each end is the value for an F divided by a quantile, multiplied through by within.
    const auto correlation = [&](double quantile) {
        return (v.between - quantile * v.within) / (v.between + (v.trials - 1.0) * quantile * v.within);
    };
    estimate.value = correlation(1.0);
    estimate.confidence = confidence;
    const double above = 0.5 + 0.5 * confidence;
    estimate.low = correlation(f_quantile(above, v.freedom_between, v.freedom_within));
    estimate.high = correlation(1.0 / f_quantile(above, v.freedom_within, v.freedom_between));
    return estimate;
}

}  // namespace burin::study
