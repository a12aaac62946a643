// SPDX-License-Identifier: MIT
// The wall behind a virtual coupling against a simulated tool without mass between the two.
#include "haptics/stability/rendered_wall.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace burin::haptics {
namespace {

// Stiffness and damping that a hand feels which moves the coupling's end by sin(w t): the parts of the force in phase
// with the motion and with its speed.
CoupledWall felt(const VirtualCoupling& c, const CoupledWall& wall, double w) {
    const double period = 2.0 * std::numbers::pi / w, dt = period / 20000;
    double tool = 0.0, in_phase = 0.0, ahead = 0.0;
    const int kPeriods = 12, kMeasured = 4;
    const int steps = 20000 * kPeriods, from = 20000 * (kPeriods - kMeasured);
    for (int i = 0; i < steps; ++i) {
        const double t = dt * i, x = std::sin(w * t), v = w * std::cos(w * t);
        // k p + b p' = Kc (x - p) + Bc (x' - p')
        const double tool_speed =
            (c.stiffness_N_per_m * (x - tool) + c.damping_Ns_per_m * v - wall.stiffness_N_per_m * tool) /
            (wall.damping_Ns_per_m + c.damping_Ns_per_m);
        const double force = wall.stiffness_N_per_m * tool + wall.damping_Ns_per_m * tool_speed;
        if (i >= from) {
            in_phase += force * x;
            ahead += force * v / w;
        }
        tool += dt * tool_speed;
    }
    const double norm = 2.0 / (20000 * kMeasured);
    return {in_phase * norm, ahead * norm / w};
}

}  // namespace

TEST(VirtualCoupling, FeelsAsASimulatedToolBetweenTwoSpringsAndDampers) {
    const VirtualCoupling couplings[] = {{500.0, 2.0}, {2000.0, 0.5}, {300.0, 0.0}};
    const CoupledWall walls[] = {{600.0, 0.5}, {100.0, 3.0}, {5000.0, 0.2}};
    for (const VirtualCoupling& c : couplings) {
        for (const CoupledWall& wall : walls) {
            const double corner =
                (wall.stiffness_N_per_m + c.stiffness_N_per_m) / (wall.damping_Ns_per_m + c.damping_Ns_per_m);
            const CoupledWall by_formula = through(c, wall), by_simulation = felt(c, wall, 0.02 * corner);
            EXPECT_NEAR(by_formula.stiffness_N_per_m / by_simulation.stiffness_N_per_m, 1.0, 0.01);
            EXPECT_NEAR(by_formula.damping_Ns_per_m / by_simulation.damping_Ns_per_m, 1.0, 0.01);
        }
    }
}

TEST(VirtualCoupling, IsNeverStifferThanEitherAndAsStiffAsItselfOnAHardWall) {
    const VirtualCoupling c{800.0, 1.5};
    for (const double k : {1.0, 100.0, 800.0, 1e4, 1e9}) {
        const CoupledWall wall = through(c, {k, 0.5});
        EXPECT_LE(wall.stiffness_N_per_m, std::min(k, 800.0));
    }
    const CoupledWall hard = through(c, {1e12, 0.5});
    EXPECT_NEAR(hard.stiffness_N_per_m, 800.0, 1e-6);
    EXPECT_NEAR(hard.damping_Ns_per_m, 1.5, 1e-6);
}

TEST(VirtualCoupling, WithoutOneTheWallIsFeltAsItIs) {
    const CoupledWall wall = through({}, {600.0, 0.5});
    EXPECT_EQ(wall.stiffness_N_per_m, 600.0);
    EXPECT_EQ(wall.damping_Ns_per_m, 0.5);
    const CoupledWall nothing = through({500.0, 1.0}, {0.0, 0.0});
    EXPECT_EQ(nothing.stiffness_N_per_m, 0.0);
    EXPECT_EQ(nothing.damping_Ns_per_m, 0.0);
}

}  // namespace burin::haptics
