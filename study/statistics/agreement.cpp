// SPDX-License-Identifier: MIT
#include "study/statistics/agreement.hpp"

#include "base/statistics.hpp"
#include "study/statistics/distributions.hpp"

namespace burin::study {
namespace {

std::string why_no_agreement(std::span<const std::vector<double>> participants) {
    if (participants.size() < 2) return "fewer than two participants";
    for (const std::vector<double>& trials : participants) {
        if (trials.size() < 2) return "a participant has fewer than two trials";
        if (trials.size() != participants.front().size()) return "participants differ in their number of trials";
        if (!all_finite(trials)) return kNotFinite;
    }
    return "";
}

bool one_value_only(std::span<const std::vector<double>> participants) {
    for (const std::vector<double>& trials : participants) {
        for (const double value : trials) {
            if (value != participants.front().front()) return false;
        }
    }
    return true;
}

// Mean squares between participants and within them.
struct MeanSquares {
    double between = 0.0, within = 0.0;
};

MeanSquares mean_squares(std::span<const std::vector<double>> participants) {
    const auto n = static_cast<double>(participants.size()), k = static_cast<double>(participants.front().size());
    std::vector<double> means;
    MeanSquares squares;
    for (const std::vector<double>& trials : participants) {
        means.push_back(mean(trials));
        for (const double value : trials)
            squares.within += (value - means.back()) * (value - means.back()) / (n * (k - 1.0));
    }
    const double middle = mean(means);
    for (const double one : means) squares.between += k * (one - middle) * (one - middle) / (n - 1.0);
    return squares;
}

}  // namespace

Estimate intraclass_correlation(std::span<const std::vector<double>> participants, double confidence) {
    Estimate estimate;
    estimate.method = "intraclass correlation ICC(1), one-way random effects, interval from F under normality";
    estimate.undefined = why_no_agreement(participants);
    if (estimate.undefined.empty() && one_value_only(participants)) estimate.undefined = "all values are equal";
    if (!estimate.undefined.empty()) return estimate;
    const auto n = static_cast<double>(participants.size()), k = static_cast<double>(participants.front().size());
    const auto [between, within] = mean_squares(participants);
    estimate.value = (between - within) / (between + (k - 1.0) * within);
    estimate.confidence = confidence;
    // F = between / within; each end is the value for an F divided by a quantile.
    const double above = 0.5 + 0.5 * confidence, freedom1 = n - 1.0, freedom2 = n * (k - 1.0);
    const auto end = [&](double quantile) {  // of F_observed / quantile, multiplied through by within
        return (between - quantile * within) / (between + (k - 1.0) * quantile * within);
    };
    estimate.low = end(f_quantile(above, freedom1, freedom2));
    estimate.high = end(1.0 / f_quantile(above, freedom2, freedom1));
    return estimate;
}

}  // namespace burin::study
