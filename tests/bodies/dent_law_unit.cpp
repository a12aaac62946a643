// SPDX-License-Identifier: MIT
// What a contact and the mesh below it give together, against Hertz.
#include <gtest/gtest.h>

#include <cmath>

#include "bodies/solver/dent_law.hpp"

namespace burin::bodies {

TEST(DentLaw, GivesWithTheMeshWhatHertzSaysUntilItIsTooStiff) {
    const DentLaw law{.stiffest_N_per_m = 2000.0, .hertz_N_per_m32 = 5.4e3, .mesh_m_per_N = 1.0 / 1800.0};
    for (double depth_m = 1e-9; depth_m < 2e-3; depth_m *= 1.3) {
        const DentForce dent = law.at(depth_m);
        ASSERT_LT(dent.slope_N_per_m, 2000.0) << depth_m;
        const double together_m = depth_m + dent.force_N * law.mesh_m_per_N;
        EXPECT_NEAR(dent.force_N / (law.hertz_N_per_m32 * std::pow(together_m, 1.5)), 1.0, 1e-12) << depth_m;
        const double step_m = 1e-5 * depth_m;
        const double slope = (law.at(depth_m + step_m).force_N - law.at(depth_m - step_m).force_N) / (2.0 * step_m);
        EXPECT_NEAR(slope / dent.slope_N_per_m, 1.0, 1e-6) << depth_m;
    }
}

// Beyond its bound it is a straight line that begins without a step, in force and slope.
TEST(DentLaw, IsASpringBeyondItsBound) {
    const DentLaw law{.stiffest_N_per_m = 500.0, .hertz_N_per_m32 = 5.4e3, .mesh_m_per_N = 1.0 / 1800.0};
    EXPECT_EQ(law.at(0.02).slope_N_per_m, 500.0);
    EXPECT_NEAR(law.at(0.021).force_N - law.at(0.02).force_N, 0.5, 1e-12);
    DentForce last = law.at(1e-6);
    for (double depth_m = 2e-6; depth_m < 0.02; depth_m += 1e-6) {
        const DentForce dent = law.at(depth_m);
        ASSERT_GE(dent.slope_N_per_m, last.slope_N_per_m);
        ASSERT_NEAR(dent.force_N - last.force_N, 0.5e-6 * (dent.slope_N_per_m + last.slope_N_per_m),
                    2e-6 * 500.0 * 1e-3)
            << depth_m;
        last = dent;
    }
}

TEST(DentLaw, OfNoBallIsASpringAndNothingOutside) {
    const DentLaw law{.stiffest_N_per_m = 500.0};
    EXPECT_EQ(law.at(0.002).force_N, 1.0);
    EXPECT_EQ(law.at(0.0).force_N, 0.0);
    EXPECT_EQ(law.at(-0.001).force_N, 0.0);
    EXPECT_EQ(law.at(std::nan("")).force_N, 0.0);
}

}  // namespace burin::bodies
