// SPDX-License-Identifier: MIT
// Agreement of each participant's repeated trials: the intraclass correlation ICC(1), of a single trial, from the
// one-way random-effects analysis of variance (Shrout and Fleiss, "Intraclass correlations: uses in assessing rater
// reliability", 1979, case 1), with its exact interval under normal distributions (McGraw and Wong, "Forming inferences
// about some intraclass correlation coefficients", 1996). 1: the trials agree; 0 or below: they tell no more
// about each other than about anybody's. Any thread.
//
// Participants with different numbers of trials: k is the mean number less the variance of the numbers over their sum,
// k0 = (N - sum(n_i^2) / N) / (n - 1) (Lessells and Boag, "Unrepeatable repeatabilities", 1987), and the interval is
// approximate. Somebody's only trial counts between participants alone.
#pragma once

#include <span>
#include <vector>

#include "study/statistics/exact.hpp"
#include "study/statistics/outcome.hpp"

namespace burin::study {

// One list for each participant, none empty, of at least two participants, one of them with at least two trials.
// Undefined otherwise, and where all values are equal. Without any difference within participants ICC is 1, with an
// interval of no width. All whole steps are of one size.
[[nodiscard]] Estimate intraclass_correlation(std::span<const std::vector<double>> participants,
                                              double confidence = 0.95);
[[nodiscard]] Estimate exact_intraclass_correlation(std::span<const std::vector<Int128>> participants,
                                                    double confidence = 0.95);

}  // namespace burin::study
