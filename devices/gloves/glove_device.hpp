// SPDX-License-Identifier: MIT
// A glove on a serial line as a device of four parts, one for each fingertip that has a piston.
//
// Where a fingertip is follows from the hand's pose, which mouse, script or tracker lead, and from the finger's joints,
// which the glove reads (glove_hand.hpp). Sets are taken each 8.3 ms: a fingertip goes from one to the next on a
// straight line of its joints, so that a tick each millisecond sees a motion and no steps. It is as late as sets lately
// came: one period where they come one by one, and up to 40 ms where they come in bunches or are lost
// (glove_timeline.hpp). A line that has been silent for kGloveLost_ns is a fault of all parts. A sample's joints are
// the finger's four angles, so that the hand can be drawn, now and of a recording. A simulated glove has the same parts
// without a line: the hand's first button closes its fingers (grip_shape.hpp), and what a piston gives pushes its
// finger open. A piston pushes one way alone: each sample says which way and how far (OneWayDrive), so that the tick
// judges what the piston does; and what the controller measures of it.
// Threads: as haptic_device.hpp; the first part's read() leads the hand and takes the newest set for all, the last
// part's write() hands the forces over.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/clock.hpp"
#include "devices/gloves/finger_course.hpp"
#include "devices/gloves/glove_hand.hpp"
#include "devices/gloves/grip_shape.hpp"
#include "devices/haptic/opened_device.hpp"
#include "devices/haptic/simulated_omni.hpp"
#include "devices/presence/device_presence.hpp"

namespace burin::devices {

inline constexpr const char* kGlove = "glove";
inline constexpr const char* kSimulatedGlove = "simulated-glove";
inline constexpr Nanoseconds kGloveLost_ns = 60'000'000;
// A bit of the parts' OneWayDrive::state, behind those of DriveState: since the last tick a set has been left out, in
// which a joint has turned faster than any does.
inline constexpr std::uint32_t kDriveSetRejected = 1u << 5;
static_assert(kDriveSetRejected > kDriveLocal);

// port: of the serial line. Empty: a glove that is nowhere, with its fingers straight, for a recording that is done
// again. `hand`: where the palm is, in the device frame. The clock must outlive the parts.
[[nodiscard]] Result<OpenedDevice> open_glove(const std::string& port, AnyHand hand, Clock& clock);
// Looks for serial lines on which a glove may be. Opens none: that alone resets some controllers.
[[nodiscard]] std::vector<DevicePresence> look_for_gloves();
[[nodiscard]] OpenedDevice simulated_glove(GripShape shape, AnyHand hand, Clock& clock);
// Its fingers follow a course from when it is opened, and no button.
[[nodiscard]] OpenedDevice simulated_glove(FingerCourse course, AnyHand hand, Clock& clock);

}  // namespace burin::devices
