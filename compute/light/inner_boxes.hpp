// SPDX-License-Identifier: MIT
// A few large boxes that lie wholly inside the solid: what is behind one is occluded, whatever the surface looks like.
// Each is a union of tiles whose nodes are all inside, shrunk by one cell on every side, so that no vertex of the
// surface (at most half a cell beside its own cell) reaches into one.
#pragma once

#include <cstdint>
#include <vector>

#include "compute/light/occupancy.hpp"

namespace burin::compute {

class InnerBoxes {
public:
    static constexpr std::size_t kMost = 16;

    explicit InnerBoxes(const Lattice& lattice) : lattice_(lattice), grid_(lattice) {}

    // Drops every box with a tile that is no longer full.
    void keep_true(const Occupancy& occupancy);
    // Searches for all boxes again: takes the largest cube of full tiles and grows it to a box, then repeats with the
    // tiles that are left.
    void find(const Occupancy& occupancy);
    // Returns the boxes in the object frame, metres; largest cube first.
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

}  // namespace burin::compute
