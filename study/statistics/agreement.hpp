// SPDX-License-Identifier: MIT
// Agreement of each participant's repeated trials: the intraclass correlation ICC(1), of a single trial, from the
// one-way random-effects analysis of variance (Shrout and Fleiss, "Intraclass correlations: uses in assessing rater
// reliability", 1979, case 1), with its exact interval under normal distributions (McGraw and Wong, "Forming inferences
// about some intraclass correlation coefficients", 1996). 1: the trials agree; 0 or below: they tell no more
// about each other than about anybody's. Any thread.
#pragma once

#include <span>
#include <vector>

#include "study/statistics/outcome.hpp"

namespace burin::study {

// One list for each participant, all of the same length of at least 2; at least two participants. Undefined otherwise,
// and where all values are equal. Without any difference within participants ICC is 1, with an interval of no width.
[[nodiscard]] Estimate intraclass_correlation(std::span<const std::vector<double>> participants,
                                              double confidence = 0.95);

}  // namespace burin::study
