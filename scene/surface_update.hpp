// SPDX-License-Identifier: MIT
// What has changed of a surface of tiles, such as a carved one, for whoever shows it: tiles that never change again.
// Frame: object, metres. Plain data.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/clock.hpp"
#include "base/space.hpp"
#include "scene/drawn_change.hpp"

namespace burin::geometry {
struct SurfaceTile;  // geometry/contact/surface_tile.hpp
}

namespace burin::compute {
struct TileLight;  // compute/light/tile_light.hpp
}  // namespace burin::compute

namespace burin::scene {

struct TileUpdate {
    std::uint32_t tile = 0;
    std::shared_ptr<const geometry::SurfaceTile> surface;  // null where no surface is left
    std::shared_ptr<const compute::TileLight> light;       // of the tile's vertices; null means full light
};

// Tells how an export has ended.
struct ExportOutcome {
    std::string message;  // for the user
    std::string path;
    std::size_t asked_by = 0;
    bool written = false, replaced = false;  // replaced: there was a file
};

// Changes since the previous surface update.
struct SurfaceUpdate {
    std::vector<TileUpdate> tiles;
    std::vector<Box> inner_boxes_object;  // boxes that now lie wholly inside the material
    Nanoseconds cut_ns = 0;               // time at which the tool worked last
    std::size_t undoable = 0, redoable = 0;
    std::uint64_t state = 0;             // of the work (compute::History::state)
    bool exporting = false;              // an export is under way
    std::vector<std::string> messages;   // for the user
    std::vector<ExportOutcome> exports;  // that have ended, for the user as well
};

// Merges a later surface update into one that nobody has taken yet.
void merge(SurfaceUpdate& into, SurfaceUpdate later);
// Merges a later surface update, if there is one, into one that may not exist yet.
void add(std::optional<SurfaceUpdate>& to, std::optional<SurfaceUpdate> later);

// One on its way to the frames.
class SurfaceChange final : public DrawnChange {
public:
    explicit SurfaceChange(SurfaceUpdate changed) : update(std::move(changed)) {}
    SurfaceUpdate update;
};

}  // namespace burin::scene
