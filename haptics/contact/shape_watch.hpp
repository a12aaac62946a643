// SPDX-License-Identifier: MIT
// What the watch over contacts asks of a tool's shape (contact_watch.hpp): does something hold it, and is it clear?
// Frame: relative to the surface's origin, metres. No heap, lock, throw; the work is counted, and bounded by
// kMostShapeTests distances.
#pragma once

#include "geometry/contact/posed_surface.hpp"
#include "haptics/contact/contact_work.hpp"
#include "haptics/contact/tool_shape.hpp"

namespace burin::haptics {

inline constexpr std::uint32_t kMostShapeTests = 150;

struct PosedShape {
    const ToolShape& shape;
    Vec3 place{0.0};  // of its origin
    Quat orientation{1.0, 0.0, 0.0, 0.0};

    [[nodiscard]] Vec3 inside() const { return place + orientation * shape.inside_m; }
};

enum class Held : std::uint8_t { yes, no, unknown };  // unknown: the tests did not suffice

// Whether a triangle within kNear of the width of the tool comes nearer by a quarter of the way or more as the tool
// goes that way, a unit vector. What the hulls overlap does not count.
[[nodiscard]] Held is_held(const PosedShape& tool, const Vec3& way, const geometry::PosedSurface& surface,
                           ContactWork& work) noexcept;

// Whether the tool touches something.
[[nodiscard]] Held touches_something(const PosedShape& tool, const geometry::PosedSurface& surface,
                                     ContactWork& work) noexcept;

}  // namespace burin::haptics
