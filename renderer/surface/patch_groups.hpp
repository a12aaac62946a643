// SPDX-License-Identifier: MIT
// Neighbouring patches as one mesh of few triangles, for the picture of a moving view (Renderer::record).
//
// A patch keeps all vertices on its border, which is most of what is left of it when it is drawn coarsely. A group is
// some sixteen of them: only the border between groups stays as it is, so groups and single patches meet without a
// crack. A group's triangles refer to its patches' own vertices, so it costs indices alone, and the light of the
// vertices is always the newest. Unlike the levels of a patch (patch_detail.hpp) a group is only held to a distance:
// its light may look different, for as long as the view moves.
// A group loses its triangles with any change of its patches, which are then drawn one by one until it has others.
// Pure, except that PatchGroups is PatchStore's; its thread.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <vector>

#include "renderer/surface/patch_detail.hpp"
#include "renderer/surface/visibility.hpp"

namespace burin::renderer {

// A patch of a group: its surface, and where its vertices begin in the store's buffer.
struct GroupMember {
    std::shared_ptr<const geometry::SurfaceTile> surface;
    std::uint32_t first_vertex = 0;
};

// Returns levels from fine to coarse, whose indices are the store's; none where nothing is gained. Triangles between
// vertices of different colours stay. error_m is an estimate. Cost: about 2 us a triangle.
[[nodiscard]] std::vector<PatchLevel> group_levels(std::span<const GroupMember> members, double edge_m);

struct PatchGroup {
    struct Level {
        std::uint32_t first_index = 0, index_count = 0;
        double error_m = 0.0;
    };
    std::vector<Level> levels;      // from fine to coarse; none: not known, or not worked out yet
    std::vector<PatchLevel> ready;  // worked out, not uploaded yet
    std::uint32_t patches = 0;      // how many it has
    std::uint64_t version = 1;      // changes with its patches
    std::uint64_t asked = 0;        // the version whose levels were asked for last
    std::uint64_t changed_at = 0;   // number of the flush that changed it last
    PatchShape shape;               // around its patches, as of when its levels were placed
};

// Where a group lies: patches belong to the one that their middle lies in.
using GroupPlace = std::array<std::int32_t, 3>;

class PatchGroups {
public:
    // Returns the group of a patch with this shape, which is to enter it. The first patch decides the groups' size.
    [[nodiscard]] PatchGroup& of(const PatchShape& shape);
    void clear() { *this = {}; }

    [[nodiscard]] std::map<GroupPlace, PatchGroup>& all() { return groups_; }
    [[nodiscard]] const std::map<GroupPlace, PatchGroup>& all() const { return groups_; }

private:
    std::map<GroupPlace, PatchGroup> groups_;  // their addresses hold until clear()
    double side_m_ = 0.0;
};

}  // namespace burin::renderer
