// SPDX-License-Identifier: MIT
// A triangle mesh as plain data: what import returns, scan conversion reads and export writes. Positions are in metres
// in the object frame; triangles wind counter-clockwise seen from outside. The topology may be anything: MeshHealth
// (mesh_health.hpp) measures it.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "base/space.hpp"

namespace burin::geometry {

// The material of a surface. The colour is sRGB, 8 bits a channel, as files and screens use it.
struct Material {
    std::string name;
    std::array<std::uint8_t, 3> colour{200, 200, 200};
};

struct TriangleMesh {
    std::vector<Vec3> positions_m;
    std::vector<std::array<std::uint32_t, 3>> triangles;  // indices into positions_m
    std::vector<std::uint8_t> triangle_materials;         // index into materials; empty: all are 0
    std::vector<Material> materials;                      // at most 254; empty: one default material
    std::vector<std::array<std::uint8_t, 3>> colours;     // one for each vertex, for export; may be empty
};

}  // namespace burin::geometry
