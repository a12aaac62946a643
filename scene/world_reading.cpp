// SPDX-License-Identifier: MIT
#include "scene/world_reading.hpp"

#include <charconv>
#include <cmath>

#include "base/length_unit.hpp"

namespace burin::scene {

Result<double> parse_world_unit(const std::string& text, const std::string& where) {
    double count = 1.0;
    const char *from = text.data(), *to = from + text.size();
    const auto [end, failed] = std::from_chars(from, to, count);
    const char* name = failed == std::errc() ? end : from;
    while (name != to && *name == ' ') ++name;
    const auto unit = length_unit(std::string_view(name, static_cast<std::size_t>(to - name)));
    const double metres = unit ? count * metres_in(*unit) : 0.0;
    if (unit && std::isfinite(metres) && metres >= 1e-9 && metres <= 1e9) return metres;
    return fail(where, "is " + text, "write m, cm, mm, in or ft, or how many of one: 2.54mm");
}

}  // namespace burin::scene
