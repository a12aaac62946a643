// SPDX-License-Identifier: MIT
// A tri-dexel solid as pages of a document: what they hold, and which of them have changed.
//
//   head     one page, JSON: the lattice, the table of materials, how many rays a page has along u and v
//   rays x   the rays along x, 32 by 32 of them a page, in rows of v; rays y and rays z likewise. Page i is the one at
//            column i % columns of row i / columns, where columns = ceil(rays along u / 32)
//   a page   little-endian u32: the number of ends of each ray, u fastest; then of all ends depth and material as
//            shaders/shared/dexel.h has them; then of all ends the normal
//
// The sets of rays along x, y and z each say which nodes are inside. So rays that are lost are made again from another
// set, exact to a cell, and bear a material of their own, red, which shows where.
// Frame: object, metres; depths in lattice units. Pure; any thread.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "compute/rays/ray_batch.hpp"
#include "compute/rays/solid.hpp"
#include "scene/pages.hpp"

namespace burin::workpiece {

inline constexpr std::string_view kSolidPart = "tri-dexel solid";
inline constexpr int kPageSide = 32;  // rays of a page along u and v

// Which pages of a solid have changed since they were saved.
class ChangedPages {
public:
    ChangedPages() = default;
    // All have.
    explicit ChangedPages(const compute::Lattice& lattice);

    void note(const compute::Changes& changes);
    void note_all();
    void clear();
    [[nodiscard]] bool has(int axis, std::size_t page) const { return changed_[static_cast<std::size_t>(axis)][page]; }

private:
    std::array<std::vector<bool>, 3> changed_;
    std::array<int, 3> columns_{};
};

// Puts the solid's head and those of its pages that have changed into the pages.
void save_solid(const compute::Solid& solid, const ChangedPages& changed, scene::Pages& pages);

struct LoadedSolid {
    compute::Solid solid;
    std::string lost = {};  // what was damaged and made again, in words; empty: nothing was
};
// Makes the solid of the pages of a document. Fails without a sound head, and where the rays do not fit into memory.
// `where` names the document in messages.
[[nodiscard]] Result<LoadedSolid> load_solid(const scene::Pages& pages, const std::string& where);

}  // namespace burin::workpiece
