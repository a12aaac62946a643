// SPDX-License-Identifier: MIT
// How far two groups are apart, without a normal distribution. Undefined where a group is empty or a value is not
// finite. Values are compared and subtracted as the decimals that they are (exact.hpp), never as rounded doubles. Any
// thread; cost n log n.
#pragma once

#include <span>

#include "study/statistics/exact.hpp"
#include "study/statistics/outcome.hpp"

namespace burin::study {

// Rank-biserial correlation (Cureton, "Rank-biserial correlation", 1956; the same number as Cliff's delta):
//   P(first > second) - P(first < second) over all pairs = 2 U_first / (n1 n2) - 1.
// Its sign: positive where values of the first group tend to be greater; -1 to 1; 0 where neither does.
//
// The interval is Cliff's, from the unbiased estimate of the estimate's variance, asymmetric so that it stays within
// -1 and 1 (Cliff, "Answering ordinal questions with ordinal data using ordinal statistics", 1996; Feng and Cliff,
// "Monte Carlo evaluation of ordinal d with improved confidence interval", 2004), with the normal quantile. It is an
// approximation. Where all pairs point one way, its inner end is (n - z^2) / (n + z^2), n the smaller group's size.
// With one value in a group there is no interval.
[[nodiscard]] Estimate rank_biserial(std::span<const double> first, std::span<const double> second,
                                     double confidence = 0.95);
[[nodiscard]] Estimate rank_biserial(std::span<const Int128> first, std::span<const Int128> second,
                                     double confidence = 0.95);

// Hodges and Lehmann's shift ("Estimates of location based on rank tests", 1963): the median of all differences of a
// value of the first group and one of the second, rounded once. Positive where the first is greater; in the values'
// unit.
//
// The interval lies between the k-th least and the k-th greatest difference, k as large as the distribution of U allows
// (Lehmann, "Nonparametrics", 1975); `confidence` is what it reaches, 1 - 2 P(U <= k - 1), which is below
// the wish only where k = 1 does not reach it. Exact for values from continuous distributions up to kExactValues values
// in all; with ties it covers at least as often. Beyond kExactValues k comes from the normal approximation.
[[nodiscard]] Estimate hodges_lehmann(std::span<const double> first, std::span<const double> second,
                                      double confidence = 0.95);
[[nodiscard]] Estimate hodges_lehmann(std::span<const Int128> first, std::span<const Int128> second, const Step& step,
                                      double confidence = 0.95);

}  // namespace burin::study
