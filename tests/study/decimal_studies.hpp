// SPDX-License-Identifier: MIT
// Random studies of decimal data and what whole numbers say of them: nothing is rounded before the last division.
// Values are few and coarse, so that many means tie.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "base/text.hpp"

namespace burin::study::test_decimals {

// Means of one to four trials are whole twelfths of the last decimal.
inline constexpr std::int64_t kTwelfths = 12;
using Twelfths = std::vector<std::int64_t>;

struct DecimalPerson {
    int group = 0;
    std::vector<std::int64_t> times, deviations;  // in units of the last decimal
};

struct DecimalStudy {
    int decimals = 1;
    std::vector<DecimalPerson> people;

    [[nodiscard]] std::int64_t scale() const {
        std::int64_t power = 1;
        for (int i = 0; i < decimals; ++i) power *= 10;
        return power;
    }

    // The means of a group's people, or their single trials.
    [[nodiscard]] Twelfths values(int group, std::vector<std::int64_t> DecimalPerson::* measure, bool means) const {
        Twelfths found;
        for (const DecimalPerson& person : people) {
            if (person.group != group) continue;
            std::int64_t sum = 0;
            for (const std::int64_t units : person.*measure) {
                sum += units;
                if (!means) found.push_back(kTwelfths * units);
            }
            if (means) found.push_back(kTwelfths / std::ssize(person.*measure) * sum);
        }
        return found;
    }

    // One number in one of the ways in which it may be written.
    [[nodiscard]] std::string text_of(std::int64_t units, int way) const {
        const std::int64_t whole = units / scale(), rest = units % scale();
        if (way == 0) return formatted("%llde-%d", static_cast<long long>(units), decimals);
        return formatted("%lld.%0*lld%s", static_cast<long long>(whole), decimals, static_cast<long long>(rest),
                         way == 1 ? "0" : "");
    }

    [[nodiscard]] std::string csv() const {
        std::string text = "participant,group,trial,deviation_mm,time_s\n";
        for (std::size_t p = 0; p < people.size(); ++p) {
            for (std::size_t i = 0; i < people[p].times.size(); ++i) {
                const int way = static_cast<int>((p + 2 * i) % 5);
                text += formatted("p%zu,%s,%zu,", p, people[p].group == 0 ? "A" : "B", i + 1) +
                        text_of(people[p].deviations[i], way) + "," + text_of(people[p].times[i], 4 - way) + "\n";
            }
        }
        return text;
    }
};

inline DecimalStudy random_decimal_study(std::mt19937_64& random) {
    const auto below = [&](std::uint64_t count) { return static_cast<int>(random() % count); };
    DecimalStudy study{.decimals = 1 + below(5), .people = {}};
    const int first = 2 + below(4), second = 2 + below(4), trials = 1 + below(3);
    const bool unequal = below(3) == 0;
    const auto largest = static_cast<std::uint64_t>(3 + below(40));
    const std::int64_t base = below(2) == 0 ? 0 : below(1000);
    for (int i = 0; i < first + second; ++i) {
        DecimalPerson person{.group = i < first ? 0 : 1, .times = {}, .deviations = {}};
        const int count = unequal ? 1 + below(3) + (i == 0 ? 1 : 0) : trials;
        for (int k = 0; k < count; ++k) {
            person.deviations.push_back(base + static_cast<std::int64_t>(random() % largest));
            person.times.push_back(1 + base + static_cast<std::int64_t>(random() % largest));
        }
        study.people.push_back(person);
    }
    return study;
}

inline std::vector<DecimalStudy> random_decimal_studies(std::size_t count, std::uint64_t seed) {
    std::mt19937_64 random(seed);
    std::vector<DecimalStudy> studies;
    for (std::size_t i = 0; i < count; ++i) studies.push_back(random_decimal_study(random));
    return studies;
}

// Twice U of the first: whole.
inline std::int64_t doubled_u(const Twelfths& first, const Twelfths& second) {
    std::int64_t doubled = 0;
    for (const std::int64_t a : first) {
        for (const std::int64_t b : second) doubled += b < a ? 2 : a == b ? 1 : 0;
    }
    return doubled;
}

inline std::vector<std::int64_t> twice_ranks(const Twelfths& values) {
    std::vector<std::int64_t> ranks;
    for (const std::int64_t value : values) {
        const auto below = std::ranges::count_if(values, [&](std::int64_t other) { return other < value; });
        ranks.push_back(2 * below + std::ranges::count(values, value) + 1);
    }
    return ranks;
}

// NaN where all of one list are equal.
inline double spearman_of(const Twelfths& x, const Twelfths& y) {
    const std::vector<std::int64_t> rx = twice_ranks(x), ry = twice_ranks(y);
    const std::int64_t mean = std::ssize(x) + 1;
    std::int64_t xy = 0, xx = 0, yy = 0;
    for (std::size_t i = 0; i < rx.size(); ++i) {
        xy += (rx[i] - mean) * (ry[i] - mean);
        xx += (rx[i] - mean) * (rx[i] - mean);
        yy += (ry[i] - mean) * (ry[i] - mean);
    }
    return static_cast<double>(static_cast<long double>(xy) / std::sqrt(static_cast<long double>(xx * yy)));
}

// Twice the median: whole.
inline std::int64_t doubled_median(Twelfths values) {
    std::ranges::sort(values);
    const std::size_t half = values.size() / 2;
    return values.size() % 2 == 1 ? 2 * values[half] : values[half - 1] + values[half];
}

inline std::int64_t doubled_shift(const Twelfths& first, const Twelfths& second) {
    Twelfths differences;
    for (const std::int64_t a : first) {
        for (const std::int64_t b : second) differences.push_back(a - b);
    }
    return doubled_median(differences);
}

}  // namespace burin::study::test_decimals
