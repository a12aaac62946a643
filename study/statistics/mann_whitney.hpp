// SPDX-License-Identifier: MIT
// The Mann-Whitney U test (Mann and Whitney, "On a test of whether one of two random variables is stochastically larger
// than the other", 1947). It asks whether values of one group tend to be greater than those of the other; it is not a
// test of means or medians.
//
// statistic: U of the first group, the number of pairs (first, second) in which the first is greater, a tie counting
// one half. U of the second group is n1 n2 - U.
//
// p is two-sided: P(|U - n1 n2 / 2| >= |u - n1 n2 / 2|) over all ways to deal the pooled midranks out to the groups. Up
// to kExactValues values in both groups together the ways are counted, ties included; beyond that the normal
// approximation with tie correction and continuity correction of 0.5 gives p. Values as whole steps (exact.hpp) tie as
// the decimals do that were written. Any thread; 100 values take about 0.1 s.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "study/statistics/exact.hpp"
#include "study/statistics/outcome.hpp"

namespace burin::study {

inline constexpr std::size_t kExactValues = 100;

// Exact up to kExactValues values, else approximate. Undefined where a group is empty; p is 1 where all are equal.
[[nodiscard]] Outcome mann_whitney(std::span<const double> first, std::span<const double> second);
[[nodiscard]] Outcome mann_whitney(std::span<const Int128> first, std::span<const Int128> second);

// The approximation at any size, which tables in print use.
[[nodiscard]] Outcome mann_whitney_normal(std::span<const double> first, std::span<const double> second);
[[nodiscard]] Outcome mann_whitney_normal(std::span<const Int128> first, std::span<const Int128> second);

// Returns by s the number of ways to choose `chosen` of the doubled ranks so that their sum is s. Exact below 2^53,
// then to a relative error of 1e-14 or better.
[[nodiscard]] std::vector<double> rank_sum_counts(std::span<const std::int64_t> doubled_ranks, std::size_t chosen);

// The standard deviation of U when both groups have one distribution, reduced for ties; z has no continuity correction.
struct NormalU {
    double mean = kUndefined, deviation = kUndefined;
    double z = kUndefined;
};
[[nodiscard]] NormalU normal_u(std::span<const double> first, std::span<const double> second);

}  // namespace burin::study
