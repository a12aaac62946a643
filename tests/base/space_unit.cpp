// SPDX-License-Identifier: MIT
#include "base/space.hpp"

#include <gtest/gtest.h>

namespace burin {
namespace {

// Kept apart from its caller, so that the compiler cannot work it out beforehand.
__attribute__((noinline)) Vec3 through_float(const Vec3& p) { return Vec3(Vec3f(p)); }

}  // namespace

TEST(Space, GoingThroughFloatRounds) {
    volatile double x = 0.1, y = 0.2, z = 0.3;
    const Vec3 p(x, y, z);
    const Vec3 rounded = through_float(p);
    EXPECT_EQ(rounded.x, static_cast<double>(0.1f));
    EXPECT_EQ(rounded.y, static_cast<double>(0.2f));
    EXPECT_EQ(rounded.z, static_cast<double>(0.3f));
}

TEST(Space, ASimilarityAndItsInverseCancel) {
    const Similarity s{{1.0, -2.0, 0.5}, glm::angleAxis(0.7, glm::normalize(Vec3(1, 2, 3))), 2.5};
    const Vec3 p(0.3, -0.4, 5.0);
    EXPECT_LT(glm::length(inverse(s) * (s * p) - p), 1e-14);
    EXPECT_LT(glm::length((inverse(s) * s) * p - p), 1e-14);
    const Vec3 by_matrix = Vec3(matrix(s) * glm::dvec4(p, 1.0));
    EXPECT_LT(glm::length(by_matrix - s * p), 1e-14);
}

}  // namespace burin
