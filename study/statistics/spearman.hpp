// SPDX-License-Identifier: MIT
// Spearman's rank correlation: the Pearson correlation of the midranks, which is right with ties too. The short form
// 1 - 6 sum(d^2) / (n (n^2 - 1)) is not (Kendall, "The treatment of ties in ranking problems", 1945).
//
// p is two-sided: the share of all pairings of the two lists whose correlation is at least as far from 0. Up to
// kExactPairs pairs all n! pairings are counted, by sums over subsets, ties included; up to kSampledPairs pairs a
// seeded sample of kPairings pairings gives (1 + hits) / (1 + pairings) (Davison and Hinkley, "Bootstrap Methods and
// their Application", 1997); beyond, t = r sqrt((n - 2) / (1 - r^2)) with n - 2 degrees of freedom.
// Any thread. Cost: 12 pairs about 0.1 s and 40 MB.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "study/statistics/exact.hpp"
#include "study/statistics/outcome.hpp"

namespace burin::study {

inline constexpr std::size_t kExactPairs = 12, kSampledPairs = 200, kPairings = 99'999;

// statistic: r_s, -1 to 1. x and y have the same length, x[i] belongs to y[i]. Undefined below two pairs and where all
// of x or all of y are equal.
[[nodiscard]] Outcome spearman(std::span<const double> x, std::span<const double> y, std::uint64_t seed = 1);
// Of values as whole steps (exact.hpp), which tie as the decimals do that were written.
[[nodiscard]] Outcome spearman(std::span<const Int128> x, std::span<const Int128> y, std::uint64_t seed = 1);

}  // namespace burin::study
