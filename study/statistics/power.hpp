// SPDX-License-Identifier: MIT
// Power by simulation: how often the exact Mann-Whitney test of two groups gives p <= alpha, when each participant's
// value comes from a normal distribution and the first group's lies `effect` standard deviations higher. The values are
// those that are tested: of a participant, the mean of the trials. Study i has a generator of its own, so that the
// result is the same bits with any number of threads. Allocates.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "study/statistics/outcome.hpp"

namespace burin::study {

struct PowerOptions {
    double effect = 0.0;                // difference of the means in standard deviations (Cohen's d)
    std::size_t first = 5, second = 5;  // participants of each group, at least 1
    double alpha = 0.05;
    std::size_t studies = 10'000;
    std::uint64_t seed = 1;
    unsigned threads = 0;  // 0: one per core
};

struct Power {
    std::size_t significant = 0, studies = 0;
    double power = 0.0;           // their quotient
    double standard_error = 0.0;  // of the power, binomial
    double level = kUndefined;    // P(p <= alpha) where there is no effect, exact; NaN beyond kExactValues participants
};

[[nodiscard]] Power simulate_power(const PowerOptions& options);

// The largest groups that are tried.
inline constexpr std::size_t kMostPerGroup = 2000;

// Finds the smallest groups of equal size whose simulated power reaches the target, and their power; nothing where
// kMostPerGroup do not. Sizes are searched by halves, so that noise of the simulation may put the result off by a few.
struct Sizes {
    std::size_t per_group = 0;
    Power power;
};
[[nodiscard]] std::optional<Sizes> sizes_for_power(PowerOptions options, double target);

}  // namespace burin::study
