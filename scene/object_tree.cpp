// SPDX-License-Identifier: MIT
#include "scene/object_tree.hpp"

#include <algorithm>
#include <span>
#include <utility>

namespace burin::scene {
namespace {

int longest_axis(std::span<const ObjectTree::Item> items) {
    Box middles;
    for (const ObjectTree::Item& item : items) middles.include(item.box.center());
    const Vec3 side = middles.extent();
    if (side.x >= side.y && side.x >= side.z) return 0;
    return side.y >= side.z ? 1 : 2;
}

}  // namespace

ObjectTree::ObjectTree(std::vector<Item> items) : items_(std::move(items)) {
    if (items_.empty()) return;
    nodes_.reserve(2 * items_.size());
    nodes_.emplace_back();
    fill(0, 0, static_cast<std::uint32_t>(items_.size()));
}

void ObjectTree::fill(std::uint32_t node, std::uint32_t first, std::uint32_t count) {
    const std::span<Item> items(items_.data() + first, count);
    Box box;
    for (const Item& item : items) box.include(item.box.lo), box.include(item.box.hi);
    if (count <= kLeaf) {
        nodes_[node] = {box, first, count};
        return;
    }
    const std::uint32_t half = count / 2;
    const int axis = longest_axis(items);
    std::ranges::nth_element(items, items.begin() + half, [axis](const Item& a, const Item& b) {
        const double at_a = a.box.center()[axis], at_b = b.box.center()[axis];
        return at_a < at_b || (at_a == at_b && a.index < b.index);
    });
    const auto children = static_cast<std::uint32_t>(nodes_.size());
    nodes_[node] = {box, children, 0};
    nodes_.resize(nodes_.size() + 2);
    fill(children, first, half);
    fill(children + 1, first + half, count - half);
}

}  // namespace burin::scene
