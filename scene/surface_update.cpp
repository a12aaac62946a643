// SPDX-License-Identifier: MIT
#include "scene/surface_update.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace burin::scene {

void add(std::optional<SurfaceUpdate>& to, std::optional<SurfaceUpdate> later) {
    if (to && later) {
        merge(*to, std::move(*later));
    } else if (later) {
        to = std::move(later);
    }
}

void merge(SurfaceUpdate& into, SurfaceUpdate later) {
    for (TileUpdate& tile : later.tiles) {
        const auto known = std::ranges::find(into.tiles, tile.tile, &TileUpdate::tile);
        if (known == into.tiles.end()) {
            into.tiles.push_back(std::move(tile));
        } else {
            *known = std::move(tile);
        }
    }
    into.inner_boxes_object = std::move(later.inner_boxes_object);
    into.cut_ns = std::max(into.cut_ns, later.cut_ns);
    into.undoable = later.undoable;
    into.redoable = later.redoable;
    into.state = later.state;
    into.exporting = later.exporting;
    std::ranges::move(later.messages, std::back_inserter(into.messages));
    std::ranges::move(later.exports, std::back_inserter(into.exports));
}

}  // namespace burin::scene
