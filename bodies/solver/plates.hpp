// SPDX-License-Identifier: MIT
// A body between two rigid plates, the measure of a solver: they close on it along y and its force on them is read. The
// reference for a ball is Tatara (1991), doi 10.1115/1.2903407: Hertz' contact, and the way by which the far side of
// the ball comes nearer. Units: SI; frame: the body's own. Pure; any thread. Allocates.
#pragma once

#include <vector>

#include "bodies/solver/soft_step.hpp"

namespace burin::bodies {

struct PlatePress {
    double closed_m = 0.0;  // by which each plate has come nearer than the body at rest
    double dt_s = 0.004;
    unsigned sweeps = 4;
    double closes_m_per_s = 0.05, settles_s = 1.0;
    // Penalty of the plates: a pressure of one Young's modulus sinks in by this share of the body's half height.
    double softness = 0.001;
};
struct PlateFigures {
    double force_N = 0.0;    // the mean of both plates'
    double elastic_N = 0.0;  // that of the elements on the half of the body above y = 0, along y: in balance the same
    double volume_share = 1.0;  // of that at rest
    double least_share = 1.0;   // of an element's volume
    double drift = 0.0;         // by which the force changed in the last tenth of settling, as a share
    std::size_t steps = 0;
};
[[nodiscard]] PlateFigures press_between_plates(const SoftBody& body, const EmbeddedSurface& surface,
                                                const PlatePress& press);

// Returns the force on a ball that each plate has pressed by closed_m.
[[nodiscard]] double tatara_N(double radius_m, double young_Pa, double poisson, double closed_m);
[[nodiscard]] double hertz_N(double radius_m, double young_Pa, double poisson, double closed_m);

}  // namespace burin::bodies
