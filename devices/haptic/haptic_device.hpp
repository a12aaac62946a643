// SPDX-License-Identifier: MIT
// The interface of a force-feedback device: a description, samples in, forces out, all plain data.
// A device whose parts move by themselves, such as a glove's fingers, offers a HapticDevice for each part. All parts
// have the same rate, and one loop reads them all before it writes the first (haptics/haptic_loop.hpp); so a driver may
// exchange one packet for all when the first is read and when the last is written.
// Frames: everything here is in the device frame (base/space.hpp), which all parts of a device share. Threads: read()
// and write() are called by the haptic thread only, once a tick each, and must be wait-free: no heap, lock, throw or
// file.
#pragma once

#include <cstdint>

#include "base/clock.hpp"
#include "base/space.hpp"
#include "devices/haptic/device_sample.hpp"
#include "devices/haptic/joints.hpp"

namespace burin::devices {

// Capabilities of the device; the safety gate, the stiffness limiter and the workspace mapping are set up from it.
// Unknown figures stay 0.
struct DeviceDescription {
    const char* name = "";
    Vec3 workspace_m{0.0};             // width (x), height (y), depth (z) of the box centred on the device origin
    double resolution_m = 0.0;         // position quantum
    bool drives_one_way = false;       // its samples have a OneWayDrive
    double max_force_N = 0.0;          // peak the device takes, any direction
    Vec3 axis_max_force_N{0.0};        // per axis; 0: no limit of its own
    Vec3 max_torque_Nm{0.0};           // per axis; 0: the axis is passive and gets no torque
    double max_stiffness_N_per_m = 0;  // stiffest wall it should be asked to render
    double rate_Hz = 1000.0;           // servo rate
    double apparent_mass_kg = 0.0;     // of the arm, at the hand
    double damping_Ns_per_m = 0.0;     // viscous, of the arm
    double friction_N = 0.0;           // Coulomb, of the arm
    double delay_s = 0.0;              // from write() until the motors act, on top of the hold over a period
    // Time without a write() after which the device takes all force and torque off its motors by itself; 0: it has no
    // such watchdog, and holds what it was given last. A driver sets it when it opens the device, to a few periods.
    double watchdog_s = 0.0;
    // Rotation of the handle about any axis.
    double max_torsion_Nm_per_rad = 0.0;       // stiffest wall it should be asked to render
    double apparent_inertia_kgm2 = 0.0;        // of the arm, at the hand
    double angular_damping_Nms_per_rad = 0.0;  // viscous, of the arm
    double angular_friction_Nm = 0.0;          // Coulomb, of the arm
    double orientation_step_rad = 0.0;         // orientation quantum
    // How far the handle turns about each axis from where its orientation is the identity; both 0: not known.
    Vec3 lowest_turn_rad{0.0}, highest_turn_rad{0.0};
    // Whether a person's hand holds it. Simulated devices say no: their hand is simulated too, and feels nothing.
    bool felt_by_person = true;
    // Names, for people, what leads a simulated device's hand if neither script nor mouse does: "a SpaceMouse".
    const char* led_by = "";
    bool has_buttons = true;  // false: its samples never have one
    // True if a small force moves the hand that holds the device; a simulated hand may hold against it.
    bool gives_way = true;
    // The driver that knows them and their Jacobian fills resolution_m and orientation_step_rad by step_at_handle().
    Joints joints{};
};

// The law of a contact along a drive of one way, which a device's controller may render by itself while hand and object
// do not move against each other: a spring that begins where the drive is shorter than start_m, with damping and
// friction against the drive's motion there.
struct DriveLaw {
    bool holds = false;  // now; false: the force that is written counts
    double spring_N_per_m = 0.0, damping_Ns_per_m = 0.0, friction_N = 0.0;
    double start_m = 0.0;
    double most_N = 0.0;  // never more
    bool operator==(const DriveLaw&) const = default;
};

// A virtual interface, because the device is chosen at run time.
class HapticDevice {
public:
    virtual ~HapticDevice() = default;
    [[nodiscard]] virtual const DeviceDescription& description() const noexcept = 0;
    [[nodiscard]] virtual DeviceSample read() noexcept = 0;
    virtual void write(const DeviceWrench& wrench) noexcept = 0;
    // Offers the law of the contact of a part that drives one way, before write(). A device whose controller cannot
    // render by itself takes no notice.
    virtual void offer(const DriveLaw& /*law*/) noexcept {}
};

}  // namespace burin::devices
