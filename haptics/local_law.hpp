// SPDX-License-Identifier: MIT
// When the controller of a device that drives one way may render a contact by itself, and by which law.
//
// A controller knows its drive's length and nothing of the scene. So what it may render is a contact that rests: the
// drive's foot, with the palm, does not move against the touched object, and the plane of the contact stays as it is.
// After kBegins_s of that the law is made of what is touched, and it is kept as it was made until the contact ends or
// moves, so that a controller may render for as long as it likes without hearing more. Rests and moves lie apart, so
// that a hand that trembles does not go back and forth.
//   spring   sum of k_m (n_m . w)^2 over the points in contact, w how the handle moves with the drive's length
//   start    the length at which those springs are slack
// Which force is given meanwhile is the controller's matter; ticks compute and record theirs as ever.
// Frame: object, and along the drive. Pure; no clock, heap, lock or throw.
#pragma once

#include "haptics/tick.hpp"

namespace burin::haptics {

struct LocalLawState {
    static constexpr double kBegins_s = 0.1;
    // Rests within the first, moves beyond the second: of the foot's way against the object, and of the plane's turn.
    static constexpr double kRests_m = 0.002, kMoves_m = 0.004;
    static constexpr double kRestsCosine = 0.985, kMovesCosine = 0.94;  // 10 and 20 degrees

    std::uint32_t object = 0;
    Vec3 normal_object{0.0};  // when the rest began
    Vec3 way_device_m{0.0};   // of the foot against the object since then
    double rests_s = 0.0;
    devices::DriveLaw law;
};

// Goes on by a tick and the state that it has left. next.law is the law now.
[[nodiscard]] LocalLawState step_local_law(const LocalLawState& state, const TickRecord& record, const TickState& tick,
                                           const TickParameters& parameters, const devices::DeviceDescription& device,
                                           double dt_s) noexcept;

}  // namespace burin::haptics
