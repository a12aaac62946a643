// SPDX-License-Identifier: MIT
// Where a workpiece has to stand to fill the part of a screen that the panel leaves free. Its bounding box is projected
// from the viewer's eye; its front stands in the screen's own plane, where eyes rest best.
// Frames: world, object; metres. Pure; any thread.
#pragma once

#include <optional>

#include "base/space.hpp"
#include "wall/screen.hpp"

namespace burin::session {

// From where a workpiece is seen.
struct SeenFrom {
    wall::Screen screen;
    Vec3 eye_world{0.0, 1.6, 2.0};  // the middle of both
    double free_width = 1.0;        // of the screen's picture, at its left
    Box bounds_object;
};

// Share of the free part that the box fills, in the direction in which it is fuller: room for the plinth, for the tool
// above, and to drag beside the workpiece.
inline constexpr double kFilled = 0.74;

// Turned so.
[[nodiscard]] Similarity fitted(const SeenFrom& from, const Quat& world_from_object);
// Seen straight on: turned so before a viewer whose line of sight is square to the screen, and then with the line of
// sight to the middle of the box.
[[nodiscard]] Similarity fitted_straight(const SeenFrom& from, const Quat& world_from_object);

// A round plinth under a box, however it stands: its top touches the lowest corner, or the lowest point of what is in
// the box where that is known.
struct PlinthPlace {
    Vec3 top_center_world{0.0};
    double radius_m = 0.0;
    // It is a pedestal on the floor that the eye sees from above: one that is seen from below, or that reaches up to
    // the viewer, would hide the workpiece.
    bool visible = false;
};
[[nodiscard]] PlinthPlace plinth_under(const Box& bounds_object, const Similarity& world_from_object,
                                       const Vec3& eye_world, std::optional<double> lowest_world_m = std::nullopt);

}  // namespace burin::session
