// SPDX-License-Identifier: MIT
// How one screen's picture draws the patches of a surface: the level and shading rate of each, which are in view, and
// what of them has changed since the picture was drawn. Several screens draw the same PatchStore, each with a
// DrawnPatches of its own.
//
// Ownership: registers with its store, which must outlive it. Thread: that of the store.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "renderer/surface/patch_store.hpp"

namespace burin::renderer {

// How a patch is shaded: lit at its vertices, at every pixel, or smooth triangles at vertices and the others at pixels.
enum class ShadingRate : std::uint8_t { vertex, by_triangle, pixel };

class DrawnPatches {
public:
    explicit DrawnPatches(PatchStore& store);
    ~DrawnPatches();
    DrawnPatches(const DrawnPatches&) = delete;
    DrawnPatches& operator=(const DrawnPatches&) = delete;

    struct State {
        std::uint8_t level = 0;  // with which the picture shows it
        ShadingRate rate = ShadingRate::pixel;
        bool wanted = false;  // in view at the last full redraw
    };
    // Returns the store's patches in the order of the index buffer, and the state of one of them.
    [[nodiscard]] std::span<PatchStore::Patch* const> patches() const { return store_.in_order(); }
    [[nodiscard]] const std::map<GroupPlace, PatchGroup>& groups() const { return store_.groups(); }
    [[nodiscard]] State& of(const PatchStore::Patch& patch) { return states_[patch.slot]; }
    [[nodiscard]] const State& of(const PatchStore::Patch& patch) const { return states_[patch.slot]; }

    struct Changes {
        bool whole = false;      // the whole picture has to be drawn again
        std::vector<Box> boxes;  // around what changed, in the patches' frame
    };
    // Returns what has changed since the last call.
    [[nodiscard]] Changes take_changes();
    // Records that a full redraw has chosen levels anew.
    void levels_chosen() { new_levels_ = 0; }

    // ---- Reported by the store.
    void slot_taken(std::uint32_t slot);
    void all_removed(const Box& bounds);
    void appeared_or_vanished(const Box& bounds);
    // `changed` is around the triangles of the finest level that differ; nearly all of a coarser level's do.
    struct Change {
        const PatchStore::Patch &was, &now;
        const Box& changed;
        bool replaced = false;  // has another mesh
    };
    void changed(const Change& change);
    // Reports new levels of a patch, then the end of such reports for now. A full redraw that shows new levels is
    // delayed until it pays: a level differs by half a pixel at most, so its appearance goes unnoticed, but it costs a
    // whole picture. all_done: no others will follow soon.
    void levels_came(const PatchStore::Patch& patch) { new_levels_ += of(patch).wanted ? 1 : 0; }
    void levels_are_there(bool all_done);

private:
    void add(const Box& box);

    PatchStore& store_;
    std::vector<State> states_;  // indexed by slot
    Changes changes_;
    std::size_t new_levels_ = 0;  // patches with levels that no full redraw has shown yet
};

}  // namespace burin::renderer
