// SPDX-License-Identifier: MIT
#include "geometry/mesh/distinct_positions.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <tuple>

namespace burin::geometry {

std::size_t make_distinct(std::vector<Vec3f>& positions) {
    std::vector<std::uint32_t> order(positions.size());
    std::iota(order.begin(), order.end(), 0u);
    const auto key = [&](std::uint32_t i) { return std::tuple(positions[i].x, positions[i].y, positions[i].z); };
    std::size_t steps = 0;
    for (bool all_differ = false; !all_differ;) {
        all_differ = true;
        std::ranges::sort(order, [&](std::uint32_t a, std::uint32_t b) {
            return std::tuple_cat(key(a), std::tuple(a)) < std::tuple_cat(key(b), std::tuple(b));
        });
        for (std::size_t i = 1; i < order.size(); ++i) {
            if (key(order[i]) != key(order[i - 1])) continue;
            positions[order[i]].x = std::nextafter(positions[order[i]].x, std::numeric_limits<float>::max());
            ++steps;
            all_differ = false;
        }
    }
    return steps;
}

}  // namespace burin::geometry
