// SPDX-License-Identifier: MIT
#include "base/numbers.hpp"

#include <charconv>
#include <cmath>

namespace burin {

Result<std::vector<double>> parse_numbers(std::string_view text, std::size_t count, const std::string& what) {
    std::vector<double> numbers;
    const char* at = text.data();
    const char* const end = text.data() + text.size();
    while (at <= end && numbers.size() <= count) {
        double value = 0.0;
        const auto [stop, error] = std::from_chars(at, end, value);
        if (error != std::errc{} || !std::isfinite(value)) break;
        numbers.push_back(value);
        if (stop == end) {
            at = end;
            break;
        }
        if (*stop != ',') break;
        at = stop + 1;
    }
    if (at != end || numbers.size() != count) {
        return fail(what, "does not give " + std::to_string(count) + (count == 1 ? " number" : " numbers with commas"),
                    "see the command's --help");
    }
    return numbers;
}

}  // namespace burin
