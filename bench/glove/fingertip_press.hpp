// SPDX-License-Identifier: MIT
// Measures how near the force of a few points comes to that of a fingertip's whole skin. The haptic glove's authors
// said that a mesh of points feels better than one, and had no such measurement.
//
// A fingertip is held with the deepest place of its pad at one depth in a plate or a ball, and rolled about its bone or
// pitched across it. The force is that of requirement G4, F = sum k s_m d_m N_m: d_m the depth of point m along the
// surface's normal there, s_m the point's share of the patch's area. It is compared with that of the whole pad, felt
// with thousands of points. How stiff a patch is as a whole is a matter of k; so each is made as stiff as the pad when
// pressed flat, and what is compared is how the force changes as the finger turns.
// Exact in the surfaces, which have closed forms; the skin is the drawn hand's. Pure.
#pragma once

#include <cstddef>
#include <vector>

#include "geometry/hand/fingertip_patch.hpp"

namespace burin::bench {

enum class PressedOn { plate, ball };
enum class TurnedAbout { bone, across };  // roll, pitch

struct PressTask {
    double depth_m = 0.002;
    double ball_m = 0.03;                  // radius
    double most_rad = 0.6981317007977318;  // 40 degrees to either side
    std::size_t angles = 81;
    std::size_t reference_points = 2000;
    // Greatest extent of the reference's pad, which is the largest that the fingertip has skin for.
    double pad_m = 0.01;
    std::vector<std::size_t> points{1, 5, 9, 20, 50};
    std::vector<double> extents_m{0.002, 0.003, 0.004, 0.005, 0.006, 0.007, 0.008, 0.009, 0.01};
};

// Error of a patch's force against the pad's over all angles, as a share of the pad's force at the same angle.
struct Departure {
    double rms = 0.0, worst = 0.0;
    double worst_rad = 0.0;  // the angle
};

struct PatchFigures {
    std::size_t points = 0;
    double extent_m = 0.0;
    double flat = 0.0;  // force pressed flat on the plate with the same k, over the pad's
    // By what is pressed on (plate, ball) and how it is turned (roll, pitch).
    Departure departures[2][2];
    // The same against a patch of the same extent with the reference's points, as a share of its force when flat: such
    // a patch may lose contact altogether.
    Departure of_own_extent[2][2];
};

struct PressFigures {
    double pad_m = 0.0;  // the reference's extent
    std::vector<PatchFigures> patches;
    // Of the plate, per angle: the pad's force over its force when flat, and those of the patches, in roll and pitch.
    std::vector<double> angles_rad;
    std::vector<double> pad_force[2];
    std::vector<std::vector<double>> patch_forces[2];
};

// The force for k = 1 of a patch (metres) that is turned about the fingertip's origin, then lifted so that the deepest
// place of `pad` is at the task's depth.
[[nodiscard]] double force_of(const std::vector<geometry::PatchPoint>& patch,
                              const std::vector<geometry::PatchPoint>& pad, const Quat& turn, PressedOn on,
                              const PressTask& task);

// Fails where the hand has no such patch.
[[nodiscard]] Result<PressFigures> press_fingertip(const geometry::HandModel& hand, geometry::Finger finger,
                                                   const PressTask& task = {});

}  // namespace burin::bench
