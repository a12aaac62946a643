// SPDX-License-Identifier: MIT
// A wand as its maker describes it: a handle that is held in its middle, moves and turns in six degrees, and is driven
// in three forces and some torques. The defaults are those of the Quanser 5-DOF Haptic Wand, as
// assets/devices/quanser-wand.toml has them; devices/haptic/wand_file.hpp reads others.
//
// Frames: *maker* is the frame in which a maker's data sheet counts, and need not have its origin in the middle of the
// workspace. The device frame is the one of base/space.hpp, centred. `axes` says which of the maker's axes the device's
// are. The *handle's* own axes are the device's where it is not turned. The scene's frame is placed by
// scene_from_maker. Units: SI. Pure; any thread.
//
// Origin of the numbers: the wand thesis (W2, W3 and W5 of the requirements). Its table of torques says about x and y,
// its text says about x and z, which is also what two pantographs at the ends of an upright handle can drive: so x and
// z are the default, and a setting. What the thesis does not give, which is all of WandArm, is assumed.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "devices/haptic/haptic_device.hpp"
#include "devices/haptic/wand_mechanism.hpp"

namespace burin::devices {

inline constexpr double kDegree_rad = 0.017453292519943295;

// For each axis of the device: the maker's axis (0, 1, 2) that it is, and its sign.
struct AxisMap {
    std::array<int, 3> maker{0, 1, 2};
    std::array<double, 3> sign{1.0, 1.0, 1.0};

    bool operator==(const AxisMap&) const = default;
};

// A place of the handle that touches.
struct WandPoint {
    std::string name;
    Vec3 offset_m{0.0};  // in the handle's axes, from its origin

    bool operator==(const WandPoint&) const = default;
};

// The pose in which a jig holds the handle while the encoders are set, and how far off it may then read.
struct WandCalibration {
    // From the thesis. It lies below the thesis' own workspace: a jig stands where it can.
    Pose maker_from_handle{{0.0, 0.0, 0.123}};
    double tolerance_m = 0.005;
    double tolerance_rad = 2.0 * kDegree_rad;

    bool operator==(const WandCalibration&) const = default;
};

// The arm as a load on the hand, and what it can render. Assumed: of the size of a light arm of half a metre.
struct WandArm {
    double mass_kg = 0.2, damping_Ns_per_m = 1.0, friction_N = 0.35;
    double inertia_kgm2 = 0.0005, angular_damping_Nms_per_rad = 0.01, angular_friction_Nm = 0.015;
    double resolution_m = 0.00005, orientation_step_rad = 0.03 * kDegree_rad;
    double delay_s = 0.001;  // from write() until the motors act
    double max_stiffness_N_per_m = 2000.0, max_torsion_Nm_per_rad = 20.0;

    bool operator==(const WandArm&) const = default;
};

struct WandDescription {
    std::string name = "Quanser 5-DOF Haptic Wand";
    double rate_Hz = 1000.0;
    Box workspace_maker_m{{-0.240, 0.085, -0.215}, {0.240, 0.335, 0.235}};  // of the handle's middle
    // About the maker's axes: pitch about x, roll about z; both 0: no limit is known.
    Vec3 lowest_turn_rad{-65.0 * kDegree_rad, 0.0, -85.0 * kDegree_rad};
    Vec3 highest_turn_rad{65.0 * kDegree_rad, 0.0, 85.0 * kDegree_rad};
    Vec3 max_force_maker_N{2.3, 2.1, 3.0};
    Vec3 max_torque_maker_Nm{0.230, 0.0, 0.250};  // 0: passive
    AxisMap axes;
    Pose scene_from_maker;
    double gain = 1.0;             // g: lengths in the scene are so many times those at the device
    double handle_m = 0.159;       // its length, for who draws it
    Pose device_tool_from_handle;  // a tool that is held at another place than the maker's handle
    std::vector<WandPoint> points{{"top", {0.0, 0.08, 0.0}}, {"bottom", {0.0, -0.08, 0.0}}};
    WandCalibration calibration;
    WandArm arm;
    WandMechanism mechanism;  // of a device that is there; its frame is then the maker's

    bool operator==(const WandDescription&) const = default;
};

// Returns the Quanser wand as its maker's own program counts: the maker's frame is the mechanism's, +x along the waist
// axes, +y outwards from them towards the user, +z up. So the table of the thesis (torque about x and y) and its jig at
// [0, 0, 123] mm, whose last number is the distance outwards, fit together; assets/devices/quanser-wand-hil.toml has
// it. A world stands as with the wand of the thesis: its axes are the device's.
[[nodiscard]] WandDescription quanser_wand_of_maker();

// Most points that can be named; a probe holds no more.
inline constexpr std::size_t kMostWandPoints = 20;

// Turns and flips a maker's vector into the device's axes.
[[nodiscard]] Vec3 device_axes(const AxisMap& axes, const Vec3& maker) noexcept;

// Returns where the maker's frame stands in the device's, whose origin is the middle of the workspace.
[[nodiscard]] Pose device_from_maker(const WandDescription& wand) noexcept;

// Returns the mapping for a tick's workspace settings: device to scene, with the gain as its scale.
[[nodiscard]] Similarity scene_from_device(const WandDescription& wand) noexcept;

// Returns a point's offset in the tool's axes, as a probe needs it.
[[nodiscard]] Vec3 offset_device_m(const WandDescription& wand, const WandPoint& point) noexcept;

// Returns the wand as the tick sees it. `name` is the description's text, which must outlive the result.
[[nodiscard]] DeviceDescription device_of(const WandDescription& wand) noexcept;

// Returns the handle's pose in the jig, in the device's frame and in axes that are the device's where it is not turned.
[[nodiscard]] Pose jig_pose_device(const WandDescription& wand) noexcept;

// How far a pose that the encoders give in the jig is from the jig's.
struct CalibrationError {
    double distance_m = 0.0, angle_rad = 0.0;
    bool within_tolerance = true;
};
[[nodiscard]] CalibrationError calibration_error(const WandDescription& wand, const Pose& device_from_handle) noexcept;

}  // namespace burin::devices
