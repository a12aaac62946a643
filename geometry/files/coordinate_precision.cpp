// SPDX-License-Identifier: MIT
#include "geometry/files/coordinate_precision.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

namespace burin::geometry {
namespace {

constexpr int kFewDigits = 4;            // numbers of no more are exact, as far as a double is
constexpr int kDigitsOfAnyFloat = 8;     // up to here every number looks like a float
constexpr double kDecimalPlaces = 1.75;  // one last place along each axis, sqrt(3) of them in space, and a little
constexpr double kFloatPlaces = 3.5;     // two, as of what was computed in floats
constexpr double kDoublePlaces = 512.0;  // of doubles, which are computed from others, 13 digits of 16 count

// Returns the last place of a number of so many bits: what the smallest step changes it by.
double last_place_of(double number, int bits) { return std::ldexp(1.0, std::ilogb(number) + 1 - bits); }

struct Digits {
    int significant = 0;
    int decimals = 0;
    int exponent = 0;
};

Digits digits_of(std::string_view word) {
    Digits digits;
    const std::size_t mantissa_end = std::min(word.find_first_of("eE"), word.size());
    bool behind_point = false;
    for (const char c : word.substr(0, mantissa_end)) {
        if (c == '.') behind_point = true;
        if (c < '0' || c > '9') continue;
        if (behind_point) ++digits.decimals;
        if (c != '0' || digits.significant > 0) ++digits.significant;
    }
    if (mantissa_end == word.size()) return digits;
    std::string_view exponent = word.substr(mantissa_end + 1);
    if (exponent.starts_with('+')) exponent.remove_prefix(1);
    std::from_chars(exponent.data(), exponent.data() + exponent.size(), digits.exponent);
    return digits;
}

}  // namespace

void CoordinatePrecision::see(std::string_view word, double value) {
    const Digits digits = digits_of(word);
    digits_ = std::max(digits_, digits.significant);
    if (!all_floats_ || digits.significant <= kDigitsOfAnyFloat) return;
    const double last_place = std::pow(10.0, digits.exponent - digits.decimals);
    all_floats_ = std::abs(value - static_cast<double>(static_cast<float>(value))) <= 0.5 * last_place;
}

double CoordinatePrecision::weld_tolerance(double largest) const {
    const bool is_text = digits_ > 0;
    if (!(largest > 0.0)) return 0.0;
    if (is_text && digits_ <= kFewDigits)
        return kDoublePlaces * last_place_of(largest, std::numeric_limits<double>::digits);
    const double binary = all_floats_ ? kFloatPlaces * last_place_of(largest, std::numeric_limits<float>::digits)
                                      : kDoublePlaces * last_place_of(largest, std::numeric_limits<double>::digits);
    if (!is_text) return binary;
    const double last_decimal = std::pow(10.0, std::floor(std::log10(largest)) + 1.0 - digits_);
    return std::max(binary, kDecimalPlaces * last_decimal);
}

}  // namespace burin::geometry
