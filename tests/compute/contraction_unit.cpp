// SPDX-License-Identifier: MIT
// Each float operation of a shader of the engine rounds by itself: a device must not fuse two of them, since the host
// does not. Read from the SPIR-V that the program carries; numbers are those of the SPIR-V specification 1.5.
#include <gtest/gtest.h>

#include <cstdint>
#include <set>
#include <span>
#include <string>

#include "shaders/cut_rays.comp.spv.hpp"
#include "shaders/export_rays.comp.spv.hpp"
#include "shaders/gather_ball.comp.spv.hpp"
#include "shaders/gather_corners.comp.spv.hpp"
#include "shaders/mesh_edges.comp.spv.hpp"
#include "shaders/mesh_mark.comp.spv.hpp"
#include "shaders/mesh_pieces.comp.spv.hpp"
#include "shaders/mesh_places.comp.spv.hpp"
#include "shaders/mesh_quads.comp.spv.hpp"
#include "shaders/mesh_sizes.comp.spv.hpp"
#include "shaders/mesh_tiles.comp.spv.hpp"
#include "shaders/mesh_vertices.comp.spv.hpp"
#include "shaders/patch_rays.comp.spv.hpp"

namespace burin::compute {
namespace {

struct FloatOperations {
    std::size_t all = 0, free = 0;  // free: a device may fuse it with another
};

FloatOperations float_operations(std::span<const std::uint32_t> spirv) {
    constexpr std::uint32_t kDecorate = 71, kNoContraction = 42;
    // FNegate, FAdd, FSub, FMul, FDiv, FRem, FMod, VectorTimesScalar to OuterProduct, Dot
    const std::set<std::uint32_t> floats{127, 129, 131, 133, 136, 140, 141, 142, 143, 144, 145, 146, 147, 148};
    std::set<std::uint32_t> results, kept;
    constexpr std::size_t kHeaderWords = 5;
    for (std::size_t at = kHeaderWords; at < spirv.size();) {
        const std::uint32_t operation = spirv[at] & 0xffffu, words = spirv[at] >> 16;
        if (words == 0) break;
        if (floats.contains(operation)) results.insert(spirv[at + 2]);
        if (operation == kDecorate && spirv[at + 2] == kNoContraction) kept.insert(spirv[at + 1]);
        at += words;
    }
    FloatOperations found{results.size(), 0};
    for (const std::uint32_t result : results) found.free += !kept.contains(result);
    return found;
}

}  // namespace

TEST(Contraction, NoFloatOperationOfAShaderMayBeFused) {
    const std::pair<const char*, std::span<const std::uint32_t>> shaders[] = {
        {"cut_rays", k_cut_rays_comp},       {"export_rays", k_export_rays_comp},
        {"gather_ball", k_gather_ball_comp}, {"gather_corners", k_gather_corners_comp},
        {"mesh_edges", k_mesh_edges_comp},   {"mesh_mark", k_mesh_mark_comp},
        {"mesh_pieces", k_mesh_pieces_comp}, {"mesh_places", k_mesh_places_comp},
        {"mesh_quads", k_mesh_quads_comp},   {"mesh_sizes", k_mesh_sizes_comp},
        {"mesh_tiles", k_mesh_tiles_comp},   {"mesh_vertices", k_mesh_vertices_comp},
        {"patch_rays", k_patch_rays_comp}};
    std::size_t all = 0;
    for (const auto& [name, spirv] : shaders) {
        const FloatOperations found = float_operations(spirv);
        EXPECT_EQ(found.free, 0u) << name;
        all += found.all;
    }
    EXPECT_GT(all, 100u) << "there are such operations";
}

}  // namespace burin::compute
