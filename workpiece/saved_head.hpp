// SPDX-License-Identifier: MIT
// The head of a solid's pages in a document, JSON: what holds for all rays. And whether rays can be a solid's.
// Frame: object, metres; depths in lattice units. Pure; any thread.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "compute/rays/solid.hpp"

namespace burin::workpiece {

inline constexpr const char* kHead = "head";
inline constexpr std::size_t kMostMaterials = 255;

struct SavedHead {
    compute::Lattice lattice;
    std::vector<geometry::Material> materials;
    int page_side = 0;
};
[[nodiscard]] std::vector<std::byte> head_bytes(const compute::Solid& solid, int page_side);
// Returns nothing where the bytes are no head, or have numbers that no work can have.
[[nodiscard]] std::optional<SavedHead> head_in(std::span<const std::byte> bytes);

// Returns whether these can be the ends of one ray.
[[nodiscard]] bool is_sound(std::span<const shared::DexelEnd> ends, int most_depth, std::size_t materials);

// The material of what was damaged and made again.
[[nodiscard]] const geometry::Material& lost_material();

}  // namespace burin::workpiece
