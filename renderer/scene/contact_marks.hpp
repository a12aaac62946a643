// SPDX-License-Identifier: MIT
// Where the signs of a contact stand in the world (SceneContact): the ring around the point and the arrow along the force.
// Pure functions; any thread.
#pragma once

#include <array>
#include <optional>

#include "renderer/scene.hpp"

namespace burin {

struct ContactRing {
    Vec3 center_world{0.0};
    Vec3 axis_world{0.0};  // unit
    double radius_m = 0.0;

    bool operator==(const ContactRing&) const = default;
};

struct ForceArrow {
    Vec3 from_world{0.0};
    Vec3 direction_world{0.0};  // unit
    double length_m = 0.0;      // from end to tip
    double head_m = 0.0;        // of this the head
    double shaft_radius_m = 0.0, head_radius_m = 0.0;

    bool operator==(const ForceArrow&) const = default;
};

struct ContactMarks {
    std::optional<ContactRing> ring;
    std::optional<ForceArrow> arrow;
    Vec3 colour{0.0};

    bool operator==(const ContactMarks&) const = default;
};

// Of the scene's contact, and of its tool, which they stand clear of. Nothing where a number is not finite.
[[nodiscard]] ContactMarks contact_marks(const Scene& scene);

// Around the ring and around the arrow; empty for what is not there.
[[nodiscard]] std::array<Box, 2> boxes_of(const ContactMarks& marks);

}  // namespace burin
