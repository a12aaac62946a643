// SPDX-License-Identifier: MIT
// What a body that gives pushes a point of the probe with, by its local model (geometry/contact/local_model.hpp).
// Frames: object in, device out. Units: SI; the body's forces are felt as they are, and lengths at the device are
// shorter by the position gain. Pure; no heap, lock or throw.
#pragma once

#include "geometry/contact/local_model.hpp"

namespace burin::haptics {

struct PushedPoint {
    Vec3 hip_object_m{0.0};
    Vec3 velocity_object_m_per_s{0.0};
    double most_stiffness_N_per_m = 0.0;  // that the device renders passively, in the object's lengths
    Nanoseconds now_ns = 0;
};
struct BodyPush {
    double force_N = 0.0;    // along the model's normal; 0: the body is not touched
    double energy_J = 0.0;   // that the body would give back along the model
    double surface_m = 0.0;  // how far its surface is above the point
};
// The damper adds to the force as much as the spring gives at most, so that a contact begins and ends at 0.
[[nodiscard]] BodyPush push_of(const geometry::LocalModel& model, const PushedPoint& point) noexcept;

}  // namespace burin::haptics
