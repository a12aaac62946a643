// SPDX-License-Identifier: MIT
#include "geometry/contact/touch_tree.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/mesh/componentwise.hpp"

namespace burin::geometry {
namespace {

constexpr std::size_t kMost = TouchBoxes::kMost;

// Returns the index of a new entry: a free one, or one appended.
template <typename Entry>
std::uint32_t take_place(std::vector<Entry>& entries, std::vector<std::uint32_t>& free) {
    if (free.empty()) {
        entries.emplace_back();
        return static_cast<std::uint32_t>(entries.size() - 1);
    }
    const std::uint32_t place = free.back();
    free.pop_back();
    entries[place] = {};
    return place;
}

}  // namespace

TouchTree::TouchTree() : root_(new_node(true, {})) {}

void TouchTree::build(std::span<const std::span<const TouchItem>> groups) {
    std::vector<std::uint32_t> tops;
    for (std::span<const TouchItem> items : groups) {
        std::vector<std::uint32_t> patches;
        for (std::size_t at = 0; at < items.size(); at += TouchPatch::kMostTriangles)
            patches.push_back(
                new_patch(items.subspan(at, std::min<std::size_t>(TouchPatch::kMostTriangles, items.size() - at))));
        if (!patches.empty()) tops.push_back(group(true, std::move(patches)));
    }
    if (!tops.empty()) root_ = tops.size() == 1 ? tops.front() : group(false, std::move(tops));
}

// Builds levels of nodes over consecutive children until one node is left, and returns it.
std::uint32_t TouchTree::group(bool of_patches, std::vector<std::uint32_t> children) {
    for (;;) {
        std::vector<std::uint32_t> nodes;
        for (std::size_t at = 0; at < children.size(); at += kMost) {
            const auto first = children.begin() + static_cast<std::ptrdiff_t>(at);
            const auto last = first + static_cast<std::ptrdiff_t>(std::min(kMost, children.size() - at));
            nodes.push_back(new_node(of_patches, {first, last}));
        }
        if (nodes.size() == 1) return nodes.front();
        children = std::move(nodes);
        of_patches = false;
    }
}

std::uint32_t TouchTree::new_patch(std::span<const TouchItem> items) {
    const std::uint32_t number = take_place(patches_, free_patches_);
    fill(patches_[number], number, items);
    return number;
}

void TouchTree::fill(Patch& patch, std::uint32_t number, std::span<const TouchItem> items) {
    patch.slots.clear();
    patch.slots.reserve(items.size());
    Vec3f sum(0.0f);
    for (const TouchItem& item : items) {
        if (item.id >= patch_of_.size()) patch_of_.resize(item.id + 1, kNone);
        patch_of_[item.id] = number;
        patch.slots.push_back(item.id);
        sum += item.middle;
    }
    patch.middle = sum / static_cast<float>(std::max<std::size_t>(items.size(), 1));
}

std::uint32_t TouchTree::new_node(bool of_patches, std::vector<std::uint32_t> children) {
    const std::uint32_t number = take_place(nodes_, free_nodes_);
    nodes_[number].of_patches = of_patches;
    nodes_[number].children = std::move(children);
    adopt(number);
    return number;
}

const Vec3f& TouchTree::middle_of_child(const Node& node, std::uint32_t child) const {
    return node.of_patches ? patches_[child].middle : nodes_[child].middle;
}

void TouchTree::adopt(std::uint32_t number) {
    Node& node = nodes_[number];
    Vec3f sum(0.0f);
    for (const std::uint32_t child : node.children) {
        (node.of_patches ? patches_[child].parent : nodes_[child].parent) = number;
        sum += middle_of_child(node, child);
    }
    node.middle = sum / static_cast<float>(std::max<std::size_t>(node.children.size(), 1));
}

void TouchTree::mark_patches_of(std::span<const std::uint32_t> slots) {
    for (const std::uint32_t slot : slots) mark(patch_of_[slot]);
}

void TouchTree::mark(std::uint32_t patch) {
    if (patches_[patch].marked) return;
    patches_[patch].marked = true;
    mark_node(patches_[patch].parent);
}

void TouchTree::mark_node(std::uint32_t node) {
    for (; node != kNone && !nodes_[node].marked; node = nodes_[node].parent) nodes_[node].marked = true;
}

void TouchTree::refill(std::uint32_t patch, std::span<const TouchItem> items) {
    fill(patches_[patch], patch, items);
    mark(patch);
}

void TouchTree::insert(std::span<const TouchItem> items, std::uint32_t beside) {
    const std::uint32_t patch = new_patch(items), root_before = root_;
    std::uint32_t node = root_;
    if (beside != kNone) node = patches_[beside].parent;
    while (!nodes_[node].of_patches) node = nodes_[node].children.front();
    add_child(node, patch);
    if (root_ != root_before && depth() > TouchSnapshot::kMostLevels) regroup();
}

void TouchTree::add_child(std::uint32_t node, std::uint32_t child) {
    nodes_[node].children.push_back(child);
    (nodes_[node].of_patches ? patches_[child].parent : nodes_[child].parent) = node;
    mark_node(node);
    if (nodes_[node].children.size() > kMost) part(node);
}

// Splits a node: moves half of the children, along the longest extent of their middles, to a new node beside it.
void TouchTree::part(std::uint32_t number) {
    std::vector<TouchItem> items;
    for (const std::uint32_t child : nodes_[number].children)
        items.push_back({middle_of_child(nodes_[number], child), child});
    sort_along_longest_side(items);
    std::vector<std::uint32_t> staying, leaving;
    for (std::size_t i = 0; i < items.size(); ++i) (i <= kMost / 2 ? staying : leaving).push_back(items[i].id);
    nodes_[number].children = std::move(staying);
    adopt(number);
    const std::uint32_t other = new_node(nodes_[number].of_patches, std::move(leaving));
    if (number == root_) {
        root_ = new_node(false, {number, other});
    } else {
        add_child(nodes_[number].parent, other);
    }
}

void TouchTree::remove(std::uint32_t patch) {
    const std::uint32_t parent = patches_[patch].parent;
    patches_[patch] = {};
    free_patches_.push_back(patch);
    remove_child(parent, patch);
    lower_root();
}

void TouchTree::remove_child(std::uint32_t node, std::uint32_t child) {
    std::erase(nodes_[node].children, child);
    mark_node(node);
    if (!nodes_[node].children.empty()) return;
    if (node == root_) {
        nodes_[node].of_patches = true;
        return;
    }
    const std::uint32_t parent = nodes_[node].parent;
    nodes_[node] = {};
    free_nodes_.push_back(node);
    remove_child(parent, node);
}

// Removes roots that have only one node below them.
void TouchTree::lower_root() {
    while (!nodes_[root_].of_patches && nodes_[root_].children.size() == 1) {
        const std::uint32_t child = nodes_[root_].children.front();
        nodes_[root_] = {};
        free_nodes_.push_back(root_);
        root_ = child;
        nodes_[root_].parent = kNone;
    }
}

std::uint32_t TouchTree::depth() const {
    std::uint32_t most = 0;
    const auto go = [&](const auto& self, std::uint32_t node, std::uint32_t at) -> void {
        most = std::max(most, at);
        if (nodes_[node].of_patches) return;
        for (const std::uint32_t child : nodes_[node].children) self(self, child, at + 1);
    };
    go(go, root_, 1);
    return most;
}

// Builds all nodes anew over the existing patches.
void TouchTree::regroup() {
    std::vector<TouchItem> items;
    for (std::uint32_t patch = 0; patch < patches_.size(); ++patch)
        if (patches_[patch].parent != kNone) items.push_back({patches_[patch].middle, patch});
    order_by_nearness(items);
    std::vector<std::uint32_t> order;
    for (const TouchItem& item : items) order.push_back(item.id);
    nodes_.clear(), free_nodes_.clear();
    root_ = group(true, std::move(order));
}

std::shared_ptr<const TouchNode> TouchTree::renew(const MakePatch& make) {
    renew_node(root_, make);
    return nodes_[root_].made;
}

void TouchTree::renew_node(std::uint32_t number, const MakePatch& make) {
    Node& node = nodes_[number];
    if (!node.marked) return;
    for (const std::uint32_t child : node.children) {
        if (!node.of_patches) {
            renew_node(child, make);
        } else if (Patch& patch = patches_[child]; patch.marked) {
            patch.made = make(patch.slots);
            patch.marked = false;
            ++patches_made_;
        }
    }
    node.made = make_node(node);
    node.marked = false;
}

std::shared_ptr<const TouchNode> TouchTree::make_node(const Node& node) const {
    auto made = std::make_shared<TouchNode>();
    made->of_patches = node.of_patches;
    Vec3f lo(HUGE_VALF), hi(-HUGE_VALF);
    for (const std::uint32_t child : node.children) {
        std::shared_ptr<const TouchPart> part;
        if (node.of_patches)
            part = patches_[child].made;
        else
            part = nodes_[child].made;
        made->first_triangle[made->count] = made->triangles;
        made->triangles += part->triangles;
        made->edge_sum_m += part->edge_sum_m;
        if (part->triangles > 0) lo = lower_of(lo, part->frame.lo), hi = upper_of(hi, part->frame.hi);
        made->children[made->count++] = std::move(part);
    }
    if (made->triangles == 0) return made;
    made->frame = TouchFrame::around(lo, hi);
    for (std::uint32_t i = 0; i < made->count; ++i) {
        const TouchPart& part = *made->children[i];
        if (part.triangles > 0) made->boxes.set(i, made->frame.stepped(part.frame.lo, part.frame.hi));
    }
    return made;
}

}  // namespace burin::geometry
