// SPDX-License-Identifier: MIT
// Permutation test of two groups' means (Fisher, "The Design of Experiments", 1935; Pitman, "Significance tests which
// may be applied to samples from any populations", 1937): the only assumption is that who is in which group was decided
// at random. For one value a participant, as five against five, it is exact.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "study/statistics/exact.hpp"
#include "study/statistics/outcome.hpp"

namespace burin::study {

inline constexpr double kMostDeals = 1e6;
inline constexpr std::size_t kRandomDeals = 99'999, kMostDealt = 200;

// statistic: the first group's mean less the second's. p, two-sided: the share of all ways to deal the values out to
// the groups whose difference is at least as far from 0. Sums are those of the decimals (exact.hpp), so that equal
// differences count as equal. Up to kMostDeals ways all are counted; then kRandomDeals random ones give
// (1 + hits) / (1 + deals), up to kMostDealt values; beyond, p comes from the normal approximation of the
// distribution of all ways. Undefined where a group is empty. Any thread.
[[nodiscard]] Outcome permutation_of_means(std::span<const double> first, std::span<const double> second,
                                           std::uint64_t seed = 1);
[[nodiscard]] Outcome permutation_of_means(std::span<const Int128> first, std::span<const Int128> second,
                                           const Step& step, std::uint64_t seed = 1);

}  // namespace burin::study
