// SPDX-License-Identifier: MIT
// The tree of patches behind a TouchMesh, on the publisher's side: which triangles are in which patch, which patches
// under which node, and the published objects made of them. Patches and nodes that change are marked, up to the root,
// and only those are made anew.
//
// It grows and shrinks as a B-tree does: a node that gets a seventeenth child is split in two, an empty node is
// removed.
// Publisher's thread only; allocates.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "geometry/contact/touch_layout.hpp"
#include "geometry/contact/touch_patch.hpp"

namespace burin::geometry {

class TouchTree {
public:
    static constexpr std::uint32_t kNone = 0xffffffffu;

    TouchTree();

    // Fills an empty tree: patches of consecutive triangles, nodes of consecutive patches. Items are triangles by slot.
    // Groups share no node below the root.
    void build(std::span<const std::span<const TouchItem>> groups);

    [[nodiscard]] std::uint32_t patch_of(std::uint32_t slot) const { return patch_of_[slot]; }
    // Includes the triangles taken out since the patch was filled.
    [[nodiscard]] std::span<const std::uint32_t> slots(std::uint32_t patch) const { return patches_[patch].slots; }

    void mark_patches_of(std::span<const std::uint32_t> slots);
    // Takes the triangle out of its patch, which must then be filled again.
    void take_out(std::uint32_t slot) { patch_of_[slot] = kNone; }
    // Replaces the triangles of a patch.
    void refill(std::uint32_t patch, std::span<const TouchItem> items);
    // Adds a patch beside another one; anywhere if `beside` is kNone.
    void insert(std::span<const TouchItem> items, std::uint32_t beside);
    void remove(std::uint32_t patch);

    using MakePatch = std::function<std::shared_ptr<const TouchPatch>(std::span<const std::uint32_t> slots)>;
    // Makes the marked patches and nodes anew and returns the root.
    [[nodiscard]] std::shared_ptr<const TouchNode> renew(const MakePatch& make);
    [[nodiscard]] std::uint64_t patches_made() const { return patches_made_; }

private:
    struct Patch {
        std::vector<std::uint32_t> slots;
        Vec3f middle{0.0f};
        std::uint32_t parent = kNone;
        bool marked = true;
        std::shared_ptr<const TouchPatch> made;
    };
    struct Node {
        std::vector<std::uint32_t> children;  // patches or nodes
        bool of_patches = true;
        Vec3f middle{0.0f};
        std::uint32_t parent = kNone;
        bool marked = true;
        std::shared_ptr<const TouchNode> made;
    };

    std::uint32_t new_patch(std::span<const TouchItem> items);
    std::uint32_t new_node(bool of_patches, std::vector<std::uint32_t> children);
    void fill(Patch& patch, std::uint32_t number, std::span<const TouchItem> items);
    [[nodiscard]] const Vec3f& middle_of_child(const Node& node, std::uint32_t child) const;
    void mark(std::uint32_t patch);
    void adopt(std::uint32_t node);
    std::uint32_t group(bool of_patches, std::vector<std::uint32_t> children);
    void mark_node(std::uint32_t node);
    void add_child(std::uint32_t node, std::uint32_t child);
    void part(std::uint32_t node);
    void remove_child(std::uint32_t node, std::uint32_t child);
    void lower_root();
    void regroup();
    [[nodiscard]] std::uint32_t depth() const;
    void renew_node(std::uint32_t node, const MakePatch& make);
    [[nodiscard]] std::shared_ptr<const TouchNode> make_node(const Node& node) const;

    std::vector<Patch> patches_;
    std::vector<Node> nodes_;
    std::vector<std::uint32_t> free_patches_, free_nodes_;
    std::vector<std::uint32_t> patch_of_;  // one for each slot
    std::uint32_t root_ = kNone;
    std::uint64_t patches_made_ = 0;
};

}  // namespace burin::geometry
