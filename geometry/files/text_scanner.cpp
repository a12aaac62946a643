// SPDX-License-Identifier: MIT
#include "geometry/files/text_scanner.hpp"

#include <limits>

namespace burin::geometry {

std::optional<double> number_from(std::string_view token) {
    if (token.starts_with('+') && !token.starts_with("+-")) token.remove_prefix(1);
    double value = 0.0;
    const char* const end = token.data() + token.size();
    const auto [stop, code] = std::from_chars(token.data(), end, value);
    if (stop != end || code == std::errc::invalid_argument) return std::nullopt;
    if (code == std::errc::result_out_of_range) {
        // from_chars does not tell on which side the value left the range. Only a negative exponent makes a number too
        // small, apart from a value written with hundreds of leading zeros, which is too small as well.
        const std::size_t exponent = token.find_first_of("eE");
        const bool tiny = exponent == std::string_view::npos ? token.find_first_of("123456789") > token.find('.')
                                                             : token.substr(exponent + 1).starts_with('-');
        if (tiny) return 0.0;
        return token.starts_with('-') ? -std::numeric_limits<double>::infinity()
                                      : std::numeric_limits<double>::infinity();
    }
    return value;
}

std::string in_quotes(std::string_view token) {
    constexpr std::size_t kShown = 24;
    std::string text = "'";
    for (const char c : token.substr(0, kShown)) text += c >= ' ' && c <= '~' ? c : '?';
    if (token.size() > kShown) text += "...";
    return text + "'";
}

}  // namespace burin::geometry
