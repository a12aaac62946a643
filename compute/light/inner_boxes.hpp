// SPDX-License-Identifier: MIT
// A few large boxes that lie wholly inside the solid: what is behind one is behind material, whatever the surface looks like.
// Unions of tiles all of whose nodes are inside, one cell smaller on every side, so that no vertex of the surface (at most half a
// cell beside its own cell) reaches into one.
#pragma once

#include <cstdint>
#include <vector>

#include "compute/occupancy.hpp"

namespace burin {

class InnerBoxes {
public:
    static constexpr std::size_t kMost = 16;

    explicit InnerBoxes(const Lattice& lattice) : lattice_(lattice), grid_(lattice) {}

    // Drops every box with a tile that is not full any more.
    void keep_true(const Occupancy& occupancy);
    // Looks for all of them anew: the largest cube of full tiles, grown to a box while it can be; then among what is left.
    void find(const Occupancy& occupancy);
    // In the object frame, metres; largest cube first.
    [[nodiscard]] const std::vector<Box>& boxes_object() const { return boxes_object_; }

private:
    struct TileBox {
        std::array<int, 3> lo{}, hi{};  // tiles, both included
    };
    [[nodiscard]] bool full(const Occupancy& occupancy, const TileBox& box) const;
    [[nodiscard]] TileBox grown(const Occupancy& occupancy, TileBox box) const;
    [[nodiscard]] Box object_box(const TileBox& box) const;
    void state_boxes();

    Lattice lattice_;
    TileGrid grid_;
    std::vector<TileBox> tiles_;
    std::vector<Box> boxes_object_;
};

}  // namespace burin
