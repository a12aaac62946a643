// SPDX-License-Identifier: MIT
#include "study/statistics/exact.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numeric>
#include <string>

#include "base/error.hpp"
#include "study/statistics/outcome.hpp"

namespace burin::study {
namespace {

constexpr int kKeptDigits = 36;
constexpr int kLargestShift = 1'000'000;  // far beyond every double
// Beyond it means are rounded to a fraction of a step that still tells any two of them apart.
constexpr std::int64_t kLargestDivisor = 1'000'000'000;
constexpr double kLog10Of2 = 0.30102999566398120;
constexpr double kBits = 126.0;

bool is_digit(char c) { return c >= '0' && c <= '9'; }

Int128 power_of_10(int exponent) {
    Int128 power = 1;
    for (int i = 0; i < exponent; ++i) power *= 10;
    return power;
}

Decimal without_trailing_zeros(Decimal decimal) {
    if (decimal.digits == 0) return {};
    for (; decimal.digits % 10 == 0; ++decimal.exponent) decimal.digits /= 10;
    return decimal;
}

// The quotient rounded to the nearest whole number, halves away from 0; the divisor is above 0.
Int128 rounded_quotient(Int128 dividend, Int128 divisor) {
    const Int128 half = divisor / 2;
    return (dividend < 0 ? dividend - half : dividend + half) / divisor;
}

// The decimal in units of 10^exponent, rounded where it has digits below them.
Int128 in_units(const Decimal& decimal, int exponent) {
    const int places = decimal.exponent - exponent;
    if (places >= 0) return decimal.digits == 0 ? 0 : decimal.digits * power_of_10(places);
    return places < -kKeptDigits - 1 ? 0 : rounded_quotient(decimal.digits, power_of_10(-places));
}

double size_of(const Decimal& decimal) {
    return std::log10(std::abs(static_cast<double>(decimal.digits))) + decimal.exponent;
}

// The least common multiple of the samples' sizes; 0 beyond kLargestDivisor.
std::int64_t common_divisor(std::span<const std::vector<Decimal>> samples) {
    std::int64_t multiple = 1;
    for (const std::vector<Decimal>& sample : samples) {
        const auto size = static_cast<std::int64_t>(sample.size());
        if (size > kLargestDivisor) return 0;
        multiple = std::lcm(multiple, size);
        if (multiple > kLargestDivisor) return 0;
    }
    return multiple;
}

// Two different means of up to n whole numbers differ by at least 1 / n^2.
std::int64_t telling_divisor(std::span<const std::vector<Decimal>> samples) {
    std::size_t most = 1;
    for (const std::vector<Decimal>& sample : samples) most = std::max(most, sample.size());
    return static_cast<std::int64_t>(most * most);
}

// The finest exponent that any value has, or a coarser one that keeps all sums and products within kBits.
int common_exponent(std::span<const std::vector<Decimal>> samples, std::int64_t divisor) {
    int finest = 0;
    double largest = 0.0, count = 1.0;
    bool is_first = true;
    for (const std::vector<Decimal>& sample : samples) {
        for (const Decimal& decimal : sample) {
            ++count;
            if (decimal.digits == 0) continue;
            finest = is_first ? decimal.exponent : std::min(finest, decimal.exponent);
            largest = is_first ? size_of(decimal) : std::max(largest, size_of(decimal));
            is_first = false;
        }
    }
    const double room = kBits * kLog10Of2 - std::log10(4.0 * count * count) - std::log10(static_cast<double>(divisor));
    return is_first ? 0 : std::max(finest, static_cast<int>(std::ceil(largest - room)));
}

// Digits of dividend / divisor with a point after the whole part; a last 1 in place of a 0 stands for a rest.
std::string quotient_text(Int128 dividend, Int128 divisor) {
    constexpr int kPlaces = 60;
    std::string whole;
    for (Int128 quotient = dividend / divisor; quotient > 0; quotient /= 10)
        whole.insert(whole.begin(), static_cast<char>('0' + static_cast<int>(quotient % 10)));
    std::string text = (whole.empty() ? "0" : whole) + ".";
    Int128 rest = dividend % divisor;
    for (int i = 0; i < kPlaces && rest > 0; ++i) {
        rest *= 10;
        text += static_cast<char>('0' + static_cast<int>(rest / divisor));
        rest %= divisor;
    }
    return text + (rest > 0 ? '1' : '0');
}

}  // namespace

Decimal decimal_of(std::string_view number) {
    Decimal decimal;
    const bool is_negative = number.starts_with('-');
    std::size_t at = is_negative ? 1 : 0;
    int kept = 0;
    bool behind_point = false;
    for (; at < number.size() && (is_digit(number[at]) || number[at] == '.'); ++at) {
        if (number[at] == '.') {
            behind_point = true;
            continue;
        }
        const bool keeps = kept < kKeptDigits;
        if (keeps) decimal.digits = 10 * decimal.digits + (number[at] - '0');
        if (keeps && decimal.digits != 0) ++kept;
        decimal.exponent += (keeps ? 0 : 1) - (behind_point ? 1 : 0);
    }
    if (decimal.digits == 0) return {};
    if (at + 1 < number.size()) {  // e, an optional sign, digits
        const std::string_view exponent = number.substr(number[at + 1] == '+' ? at + 2 : at + 1);
        int shift = 0;
        std::from_chars(exponent.data(), exponent.data() + exponent.size(), shift);
        decimal.exponent += std::clamp(shift, -kLargestShift, kLargestShift);
    }
    if (is_negative) decimal.digits = -decimal.digits;
    return without_trailing_zeros(decimal);
}

Decimal decimal_of(double value) {
    BURIN_CHECK(std::isfinite(value));
    char text[40];
    return decimal_of(std::string_view(text, std::to_chars(text, text + sizeof text, value).ptr));
}

double value_of(Int128 steps, const Step& step, std::int64_t parts) {
    const bool is_negative = steps < 0;
    const std::string text =
        quotient_text(is_negative ? -steps : steps, Int128{step.divisor} * parts) + "e" + std::to_string(step.exponent);
    double value = 0.0;  // stays where the number is below all doubles
    std::from_chars(text.data(), text.data() + text.size(), value);
    return is_negative ? -value : value;
}

ExactValues exact_means(std::span<const std::vector<Decimal>> samples) {
    const std::int64_t common = common_divisor(samples);
    ExactValues means;
    means.step.divisor = common > 0 ? common : telling_divisor(samples);
    means.step.exponent = common_exponent(samples, means.step.divisor);
    means.steps.reserve(samples.size());
    for (const std::vector<Decimal>& sample : samples) {
        BURIN_CHECK(!sample.empty());
        Int128 sum = 0;
        for (const Decimal& decimal : sample) sum += in_units(decimal, means.step.exponent);
        const auto size = static_cast<Int128>(sample.size());
        means.steps.push_back(common > 0 ? sum * (common / size) : rounded_quotient(sum * means.step.divisor, size));
    }
    return means;
}

ExactValues exact_values(std::span<const Decimal> values) {
    std::vector<std::vector<Decimal>> samples;
    samples.reserve(values.size());
    for (const Decimal& value : values) samples.push_back({value});
    return exact_means(samples);
}

ExactValues exact_values(std::span<const double> values) {
    std::vector<Decimal> decimals;
    decimals.reserve(values.size());
    for (const double value : values) decimals.push_back(decimal_of(value));
    return exact_values(decimals);
}

ExactGroups exact_groups(std::span<const double> first, std::span<const double> second) {
    std::vector<double> pooled(first.begin(), first.end());
    pooled.insert(pooled.end(), second.begin(), second.end());
    ExactValues all = exact_values(pooled);
    const auto middle = all.steps.begin() + static_cast<std::ptrdiff_t>(first.size());
    return {.first = {all.steps.begin(), middle}, .second = {middle, all.steps.end()}, .step = all.step};
}

double median_of(std::vector<Int128> steps, const Step& step) {
    if (steps.empty()) return kUndefined;
    std::ranges::sort(steps);
    const std::size_t half = steps.size() / 2;
    return steps.size() % 2 == 1 ? value_of(steps[half], step) : value_of(steps[half - 1] + steps[half], step, 2);
}

}  // namespace burin::study
