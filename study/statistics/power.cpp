// SPDX-License-Identifier: MIT
#include "study/statistics/power.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "base/error.hpp"
#include "base/worker_pool.hpp"
#include "study/statistics/distributions.hpp"
#include "study/statistics/mann_whitney.hpp"
#include "study/statistics/random.hpp"

namespace burin::study {
namespace {

// For each U, whether it has p <= alpha; values from a continuous distribution have no ties.
struct Rejection {
    std::vector<char> rejected;  // by U
    double level = kUndefined;
};

Rejection exact_rejection(std::size_t first, std::size_t second, double alpha) {
    std::vector<std::int64_t> ranks(first + second);
    std::iota(ranks.begin(), ranks.end(), std::int64_t{1});
    const std::vector<double> counts = rank_sum_counts(ranks, first);
    const double ways = std::accumulate(counts.begin(), counts.end(), 0.0);
    const std::size_t pairs = first * second, least_sum = first * (first + 1) / 2;
    Rejection rejection{.rejected = std::vector<char>(pairs + 1, 0), .level = 0.0};
    // From the ends, where U and pairs - U are equally far from the middle.
    double tails = 0.0;
    for (std::size_t u = 0; 2 * u <= pairs; ++u) {
        tails += (2 * u == pairs ? 1.0 : 2.0) * counts[least_sum + u] / ways;
        if (tails > alpha * kAlikeProbabilities) break;  // a p that equals alpha counts
        rejection.rejected[u] = rejection.rejected[pairs - u] = 1;
        rejection.level = tails;
    }
    return rejection;
}

Rejection normal_rejection(std::size_t first, std::size_t second, double alpha) {
    const auto a = static_cast<double>(first), b = static_cast<double>(second);
    const double deviation = std::sqrt(a * b * (a + b + 1.0) / 12.0);
    Rejection rejection{.rejected = std::vector<char>(first * second + 1, 0), .level = kUndefined};
    for (std::size_t u = 0; u < rejection.rejected.size(); ++u) {
        const double distance = std::max(0.0, std::abs(static_cast<double>(u) - 0.5 * a * b) - 0.5);
        rejection.rejected[u] = normal_two_sided(distance / deviation) <= alpha ? 1 : 0;
    }
    return rejection;
}

// The U of one simulated study.
std::size_t simulated_u(const PowerOptions& options, std::size_t study) {
    Random random(options.seed, study);
    std::vector<double> first(options.first), second(options.second);
    for (double& value : first) value = options.effect + random.normal();
    for (double& value : second) value = random.normal();
    std::ranges::sort(second);
    std::size_t u = 0;
    for (const double value : first)
        u += static_cast<std::size_t>(std::ranges::lower_bound(second, value) - second.begin());
    return u;
}

}  // namespace

Power simulate_power(const PowerOptions& options) {
    BURIN_CHECK(options.first > 0 && options.second > 0 && options.studies > 0);
    const bool exact = options.first + options.second <= kExactValues;
    const Rejection rejection = exact ? exact_rejection(options.first, options.second, options.alpha)
                                      : normal_rejection(options.first, options.second, options.alpha);
    std::vector<char> significant(options.studies);
    WorkerPool pool(options.threads);
    pool.run(options.studies, [&](std::size_t i) { significant[i] = rejection.rejected[simulated_u(options, i)]; });
    Power power{.studies = options.studies, .level = rejection.level};
    power.significant = static_cast<std::size_t>(std::ranges::count(significant, 1));
    const auto n = static_cast<double>(options.studies);
    power.power = static_cast<double>(power.significant) / n;
    power.standard_error = std::sqrt(power.power * (1.0 - power.power) / n);
    return power;
}

std::optional<Sizes> sizes_for_power(PowerOptions options, double target) {
    const auto power_of = [&](std::size_t per_group) {
        options.first = options.second = per_group;
        return simulate_power(options);
    };
    std::size_t enough = 2;
    Power power = power_of(enough);
    while (power.power < target) {
        if (enough == kMostPerGroup) return std::nullopt;
        enough = std::min(2 * enough, kMostPerGroup);
        power = power_of(enough);
    }
    for (std::size_t too_few = enough / 2; enough - too_few > 1;) {
        const std::size_t middle = (too_few + enough) / 2;
        const Power of_middle = power_of(middle);
        if (of_middle.power >= target) {
            enough = middle;
            power = of_middle;
        } else {
            too_few = middle;
        }
    }
    return Sizes{.per_group = enough, .power = power};
}

}  // namespace burin::study
