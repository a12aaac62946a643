// SPDX-License-Identifier: MIT
// What a statistical procedure gives: a statistic, a probability, and how they were obtained. Values for which a
// procedure is not defined (no values, one value, all equal, NaN) are no error: the outcome then says why it is empty.
// Plain data; any thread.
#pragma once

#include <cmath>
#include <limits>
#include <span>
#include <string>

namespace burin::study {

inline constexpr double kUndefined = std::numeric_limits<double>::quiet_NaN();

struct Outcome {
    double statistic = kUndefined;  // of the kind that the procedure's header names
    double p = kUndefined;          // two-sided; NaN where it is not defined
    std::string method;             // the procedure and how p was obtained, ready to be printed
    bool exact = false;             // p comes from the whole permutation distribution, not from a limit or a sample
    std::string undefined;          // why statistic or p is NaN; empty where both are defined
};

// An estimate with its confidence interval.
struct Estimate {
    double value = kUndefined;
    double low = kUndefined, high = kUndefined;  // NaN where the interval is not defined
    double confidence = kUndefined;              // what the interval reaches, e.g. 0.95
    std::string method;
    bool exact = false;     // the interval's confidence is computed from an exact distribution
    std::string undefined;  // why a number above is NaN
};

[[nodiscard]] inline bool all_finite(std::span<const double> values) {
    for (const double value : values) {
        if (!std::isfinite(value)) return false;
    }
    return true;
}

// The reason that every procedure gives for values that are not finite.
inline constexpr const char* kNotFinite = "a value is not finite";

}  // namespace burin::study
