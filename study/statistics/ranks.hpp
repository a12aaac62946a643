// SPDX-License-Identifier: MIT
// Ranks with ties (midranks), as Kruskal and Wallis, "Use of ranks in one-criterion variance analysis" (1952) define
// them: tied values share the mean of the ranks that they take up together. Ranks begin at 1, the least value has the
// least rank. Values must be finite; as whole steps (exact.hpp) they tie as the decimals do that were written. Any
// thread; cost n log n.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "study/statistics/exact.hpp"

namespace burin::study {

// Twice the midranks: whole numbers, so that sums of ranks compare exactly.
[[nodiscard]] std::vector<std::int64_t> doubled_midranks(std::span<const double> values);
[[nodiscard]] std::vector<std::int64_t> doubled_midranks(std::span<const Int128> values);

[[nodiscard]] std::vector<double> midranks(std::span<const double> values);
[[nodiscard]] std::vector<double> midranks(std::span<const Int128> values);

// Returns the sum of t^3 - t over the groups of t values that share a doubled rank, by which ties reduce a variance of
// ranks.
[[nodiscard]] Int128 tie_term(std::span<const std::int64_t> doubled_ranks);

}  // namespace burin::study
