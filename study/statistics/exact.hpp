// SPDX-License-Identifier: MIT
// Decimal numbers and their means without rounding, so that equal means tie in whatever order they are summed: 0.1 +
// 0.2 + 0.3 and 0.3 + 0.2 + 0.1 are different doubles. All values that are compared become whole multiples of one
// common step. Pure; any thread; allocates.
//
// Exact as long as the values of a list, their common denominator and the square of their count fit 126 bits: that is
// 28 digits of the largest value for a hundred values and up to nine trials of each. Digits that do not fit are rounded
// off: values that differ by less than 1e-19 of the largest may then tie, and equal ones always do.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace burin::study {

__extension__ using Int128 = __int128;

// digits * 10^exponent; digits do not end in 0, and 0 has the exponent 0, so that equal numbers have equal members.
struct Decimal {
    Int128 digits = 0;
    int exponent = 0;

    friend bool operator==(const Decimal&, const Decimal&) = default;
};

// Reads a number as finite_number (base/csv.hpp) takes it, such as -12.50 or 4.5e-3. Digits behind the 36th that
// counts are dropped.
[[nodiscard]] Decimal decimal_of(std::string_view number);
// The shortest decimal that is read back as the value, which must be finite: 0.1 is one tenth.
[[nodiscard]] Decimal decimal_of(double value);

// The size of a step: 10^exponent / divisor.
struct Step {
    std::int64_t divisor = 1;
    int exponent = 0;
};

// The double nearest to steps / parts steps. parts is above 0.
[[nodiscard]] double value_of(Int128 steps, const Step& step, std::int64_t parts = 1);

struct ExactValues {
    std::vector<Int128> steps;
    Step step;

    // The double nearest to value i.
    [[nodiscard]] double value(std::size_t i) const { return value_of(steps[i], step); }
};

// The mean of each sample, none of which is empty.
[[nodiscard]] ExactValues exact_means(std::span<const std::vector<Decimal>> samples);
[[nodiscard]] ExactValues exact_values(std::span<const Decimal> values);
// Each value as its shortest decimal; all must be finite.
[[nodiscard]] ExactValues exact_values(std::span<const double> values);

// Two lists of values on one step.
struct ExactGroups {
    std::vector<Int128> first, second;
    Step step;
};
[[nodiscard]] ExactGroups exact_groups(std::span<const double> first, std::span<const double> second);

// The median as statistics books have it: the mean of the two in the middle of an even number; NaN for no values.
[[nodiscard]] double median_of(std::vector<Int128> steps, const Step& step);

}  // namespace burin::study
