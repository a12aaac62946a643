// SPDX-License-Identifier: MIT
// The marks of a contact in the world, from PictureContact: the
// ring around the contact point and the arrow along the force.
// Pure functions; any thread.
#pragma once

#include <array>
#include <optional>

#include "picture/picture.hpp"

namespace burin::picture {

struct ContactRing {
    Vec3 center_world{0.0};
    Vec3 axis_world{0.0};  // unit
    double radius_m = 0.0;

    bool operator==(const ContactRing&) const = default;
};

struct ForceArrow {
    Vec3 from_world{0.0};
    Vec3 direction_world{0.0};  // unit
    double length_m = 0.0;      // from tail to tip
    double head_m = 0.0;        // the head's share of length_m
    double shaft_radius_m = 0.0, head_radius_m = 0.0;

    bool operator==(const ForceArrow&) const = default;
};

struct ContactMarks {
    std::optional<ContactRing> ring;
    std::optional<ForceArrow> arrow;
    Vec3 colour{0.0};

    bool operator==(const ContactMarks&) const = default;
};

// Computes the marks of the scene's contact, clear of the scene's
// tool. Leaves out a mark whose numbers are not all finite.
[[nodiscard]] ContactMarks contact_marks(const Picture& picture);

// Returns the bounding boxes of the ring and of the arrow; empty for a mark that is absent.
[[nodiscard]] std::array<Box, 2> boxes_of(const ContactMarks& marks);

}  // namespace burin::picture
