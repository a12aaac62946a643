// SPDX-License-Identifier: MIT
// A bounding-volume tree over the boxes of objects that rest: finds those near a point among thousands.
//
// Built anew when an object that rests is edited: about 0.2 us an object times the logarithm of their number. A query
// tests the boxes of the nodes on its way: about 2 log2(n), and those of what it finds.
// Frame: any one. Any thread may query. The order in which objects are found depends on the boxes alone.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/space.hpp"

namespace burin::scene {

// Squared distance from a point to a box that is not empty; 0 inside.
[[nodiscard]] inline double distance2_m2(const Box& box, const Vec3& p) noexcept {
    const Vec3 outside = glm::max(glm::max(box.lo - p, p - box.hi), Vec3(0.0));
    return glm::dot(outside, outside);
}

class ObjectTree {
public:
    struct Item {
        Box box;                  // not empty
        std::uint32_t index = 0;  // what the query gives
    };

    ObjectTree() = default;
    explicit ObjectTree(std::vector<Item> items);

    // Calls visit(index) for each item whose box meets the ball. Returns the number of boxes tested.
    template <typename Visit>
    std::uint64_t for_each_near(const Vec3& center, double radius_m, Visit&& visit) const {
        std::uint64_t tested = 0;
        if (nodes_.empty()) return tested;
        const double reach2 = radius_m * radius_m;
        std::array<std::uint32_t, kMaxDepth> way{};
        std::uint32_t depth = 0;
        way[depth++] = 0;
        while (depth > 0) {
            const Node& node = nodes_[way[--depth]];
            ++tested;
            if (!(distance2_m2(node.box, center) <= reach2)) continue;
            if (node.count == 0) {
                way[depth++] = node.first + 1;
                way[depth++] = node.first;
                continue;
            }
            for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
                ++tested;
                if (distance2_m2(items_[i].box, center) <= reach2) visit(items_[i].index);
            }
        }
        return tested;
    }

private:
    static constexpr std::uint32_t kLeaf = 4;
    // Halving a number of 32 bits; one more node waits on each level.
    static constexpr std::uint32_t kMaxDepth = 64;

    struct Node {
        Box box;
        std::uint32_t first = 0;  // of its items; of an inner node, the first of its two children
        std::uint32_t count = 0;  // of items; 0: an inner node
    };
    void fill(std::uint32_t node, std::uint32_t first, std::uint32_t count);

    std::vector<Item> items_;
    std::vector<Node> nodes_;  // the root first
};

}  // namespace burin::scene
