// SPDX-License-Identifier: MIT
// Reads a skinned mesh from binary glTF 2.0 (.glb): vertices, triangles, the joints at rest, and how much of each joint
// a vertex follows.
//
// What is read: the skin of the file, and the one primitive of the mesh that wears it, as triangles. Everything else
// (nodes, materials, animations, textures) is left alone: the pose at rest follows from the inverse bind matrices.
// Units and frame: metres, as glTF has them, in the mesh's own frame. Weights are normalised; those that add up to
// anything but 1, to a part in a thousand, are an error, since then nobody knows what the vertex follows.
// Failure: an Error with the file, what is wrong and the remedy. Every size in the file is compared with the bytes that
// there are before anything is allocated. Cost: linear in the file. Any thread.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "base/space.hpp"

namespace burin::geometry {

inline constexpr std::size_t kInfluences = 4;  // joints that move a vertex, at most

// What moves a vertex: numbers of joints, with weights of at least 0 that add up to 1.
struct SkinBinding {
    std::array<std::uint16_t, kInfluences> joints{};
    std::array<double, kInfluences> weights{};
    bool operator==(const SkinBinding&) const = default;
};

struct SkinJoint {
    std::string name;
    Pose mesh_from_joint;  // at rest
};

struct SkinnedMesh {
    std::vector<Vec3> positions_m;
    std::vector<SkinBinding> bindings;  // one for each position
    std::vector<std::array<std::uint32_t, 3>> triangles;
    std::vector<SkinJoint> joints;
};

[[nodiscard]] Result<SkinnedMesh> read_skinned_glb(const std::filesystem::path& path);
// `name` stands for the file in messages.
[[nodiscard]] Result<SkinnedMesh> read_skinned_glb(std::span<const std::byte> bytes, const std::string& name);

}  // namespace burin::geometry
