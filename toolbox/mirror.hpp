// SPDX-License-Identifier: MIT
// Symmetric carving: what a tool does to one side of a workpiece it does to the other side as well.
//
// The planes of symmetry are those of constant x, y and z through the workpiece's middle, in the object frame; with
// several of them each sweep has an image for every combination: one, three or seven. Tools of closed form are their
// own mirror images; of a mesh, an image of its own is made. The middle lies on a node or half-way between two, so that
// images are exact in lattice units. Functions are pure; any thread.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "base/space.hpp"

namespace burin::toolbox {

struct Mirror {
    std::array<bool, 3> across{};  // the planes of constant x, y, z

    [[nodiscard]] bool any() const { return across[0] || across[1] || across[2]; }
    bool operator==(const Mirror&) const = default;
};

// Reads "none" or axes in any order, such as "x" or "xz".
[[nodiscard]] Result<Mirror> parse_mirror(std::string_view text, const std::string& where);
// Returns what parse_mirror reads back.
[[nodiscard]] std::string name_of(const Mirror& mirror);

// One mirror image: reflected across each of these planes, one after the other.
struct MirrorImage {
    std::array<bool, 3> across{};

    // Tells whether left becomes right: after an odd number of reflections.
    [[nodiscard]] bool reverses() const { return (across[0] != across[1]) != across[2]; }
};

// Returns all images but the original, which is none of them.
[[nodiscard]] std::vector<MirrorImage> images_of(const Mirror& mirror);
[[nodiscard]] Vec3 image_of(const Vec3& p_object, const MirrorImage& image, const Vec3& middle_object);
// Returns the pose of the tool's image. Where the image reverses, this is the pose of the tool that has been reflected
// in its own frame across its plane of constant x, because a pose turns and cannot reflect.
[[nodiscard]] Pose image_of(const Pose& object_from_tool, const MirrorImage& image, const Vec3& middle_object);

}  // namespace burin::toolbox
