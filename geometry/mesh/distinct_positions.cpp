// SPDX-License-Identifier: MIT
#include "geometry/mesh/distinct_positions.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <numeric>
#include <queue>
#include <span>
#include <tuple>

namespace burin::geometry {
namespace {

// Sweeps along positions of one line, which are sorted by x. At each x the first vertex stays, and the others wait for
// the next.
std::size_t sweep(std::span<const std::uint32_t> line, std::vector<Vec3f>& positions) {
    std::priority_queue<std::uint32_t, std::vector<std::uint32_t>, std::greater<>> waiting;
    std::size_t steps = 0, next = 0;
    float x = 0.0f;
    while (next < line.size() || !waiting.empty()) {
        if (waiting.empty()) x = positions[line[next]].x;
        while (next < line.size() && positions[line[next]].x == x) waiting.push(line[next++]);
        const std::uint32_t stays = waiting.top();
        waiting.pop();
        if (positions[stays].x != x) positions[stays].x = x;
        steps += waiting.size();
        x = std::nextafter(x, std::numeric_limits<float>::max());
    }
    return steps;
}

}  // namespace

std::size_t make_distinct(std::vector<Vec3f>& positions) {
    std::vector<std::uint32_t> order(positions.size());
    std::iota(order.begin(), order.end(), 0u);
    std::ranges::sort(order, {},
                      [&](std::uint32_t i) { return std::tuple(positions[i].y, positions[i].z, positions[i].x, i); });
    std::size_t steps = 0;
    for (auto first = order.begin(); first != order.end();) {
        const Vec3f& at = positions[*first];
        const auto last = std::find_if(
            first, order.end(), [&](std::uint32_t i) { return positions[i].y != at.y || positions[i].z != at.z; });
        steps += sweep({first, last}, positions);
        first = last;
    }
    return steps;
}

}  // namespace burin::geometry
