// SPDX-License-Identifier: MIT
// The cube test of the wand thesis (3.5, Figures 22 to 25): a wand is pressed upright against one face of a cube, with
// its top end alone, with its bottom end alone, and with both; and the control case (Figure 15), in which a wand that
// touches with its middle alone sinks its ends into the cube and feels nothing of it.
//
// The thesis' frame: the face looks to -z, the hand pushes to +z. Then forces have only a z component, which is
// negative; the top end alone gives a negative torque about x, the bottom end alone a positive one, and both together
// none, since torque is the sum of r x F.
// Frame: the scene's, which is the wand's own (maker's) unless its description says otherwise. Pure but for the run.
#pragma once

#include <string>
#include <vector>

#include "activities/wand/wand_run.hpp"

namespace burin::activities {

// Cases of the test in their order: an end alone, both ends, and then the wand's middle alone, beside and against the
// cube.
enum class CubeCase : std::uint8_t { top, bottom, both, beside, against };
inline constexpr std::size_t kCubeCases = 5;
[[nodiscard]] const char* text(CubeCase which) noexcept;

// One tick. Forces and torques are those on the hand; torques are about the handle's middle.
struct CubeTick {
    double time_s = 0.0;
    Pose scene_from_handle;
    Vec3 top_scene_m{0.0}, bottom_scene_m{0.0};  // the ends, whether they touch or not
    std::vector<Vec3> point_forces_N;            // of each point of the probe, as desired
    double share = 1.0;                          // of the sums that the energy account affords
    Vec3 force_N{0.0}, torque_Nm{0.0};           // sums as afforded, before the gate; yaw included
    Vec3 given_force_N{0.0}, given_torque_Nm{0.0};
    std::vector<bool> touches;  // of each point
};

// The mean over the middle of the time in which the hand holds the wand against the cube.
struct CubeMeasure {
    CubeCase which = CubeCase::top;
    std::size_t ticks = 0;
    CubeTick mean;            // times of its middle tick
    double sunk_top_m = 0.0;  // how deep the top end is behind the cube's face
    double from_s = 0.0, to_s = 0.0;
};

// One thing that is expected, and whether it is so.
struct CubeFinding {
    CubeCase which = CubeCase::top;
    std::string expected;  // in words
    std::string found;     // with numbers
    bool holds = false;
};

struct PressedCube {
    std::vector<CubeTick> two_points, one_point;
    std::vector<CubeMeasure> measures;  // in the order of CubeCase
    std::vector<CubeFinding> findings;
    WandRun two_points_run, one_point_run;
    double face_m = 0.0;  // z of the cube's face
    [[nodiscard]] bool holds() const;
};

// Runs the test on the box around a felt object that is a cube with its face square to z. Fails where the cube is not
// so high that both ends of the wand fit on its face, or so high that one alone cannot, and where the places are
// outside of the wand's workspace.
[[nodiscard]] Result<PressedCube> press_cube(const ExploredWorld& world, const Box& cube_scene_m,
                                             const devices::WandDescription& wand, double radius_m);

// Compares the measures with what the thesis expects.
[[nodiscard]] std::vector<CubeFinding> findings_of(const std::vector<CubeMeasure>& measures);

// ---- Tables and figures (cube_figures.cpp)

[[nodiscard]] std::string cube_table(const PressedCube& test);      // CSV, a tick a line
[[nodiscard]] std::string figure_forces(const PressedCube& test);   // Figure 23: each end's components, torque about x
[[nodiscard]] std::string figure_torques(const PressedCube& test);  // Figure 24: torque about each axis
[[nodiscard]] std::string figure_sums(const PressedCube& test);  // Figure 25: both ends' forces, torque against force
[[nodiscard]] std::string figure_control(const PressedCube& test);  // Figure 15: the middle alone

}  // namespace burin::activities
