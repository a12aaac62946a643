// SPDX-License-Identifier: MIT
// The native engine's short ways for a resting ball give what the shared text gives, on whatever vector unit.
#include "compute/cpu/ball_spans.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>

#include "shaders/shared/capsule.h"
#include "tests/compute/effort.hpp"

namespace burin::compute::test {

TEST(BallSpans, AreTheCapsulesOwn) {
    Random random(11);
    for (int i = 0; i < repeated(2000); ++i) {
        const std::int64_t radius = random.small(1, random.chance(0.5) ? 300 : 1 << 24);
        shared::Capsule ball{};
        ball.radius2 = radius * radius + random.small(0, 1000) % (2 * radius + 1);
        const int first = -static_cast<int>(std::min<std::int64_t>(radius, 32 * 4096 + random.small(0, 4095)));
        std::array<std::int32_t, 64> half{};
        std::int32_t count = 0;
        const auto rest = [&](std::int32_t k) {
            const std::int64_t u = first + k * 4096;
            return ball.radius2 - u * u;
        };
        while (count < 64 && rest(count) >= 0) ++count;
        ASSERT_GT(count, 0);
        ball_half_spans(ball.radius2, first, count, half.data());
        for (std::int32_t k = 0; k < count; ++k) {
            const shared::RaySpan span = shared::capsule_span(shared::capsule_from_ray(ball, 0, first + k * 4096, 0));
            ASSERT_EQ(span.lo, -half[static_cast<std::size_t>(k)]) << radius << " " << k;
            ASSERT_EQ(span.hi, half[static_cast<std::size_t>(k)]);
        }
    }
}

TEST(BallSpans, DirectionCodesAreTheEncodedNormals) {
    Random random(12);
    constexpr int kCount = 100;
    std::array<std::int32_t, kCount> x{}, y{}, z{};
    std::array<std::uint32_t, kCount> codes{};
    for (int i = 0; i < repeated(5000); ++i) {
        const int most = random.chance(0.5) ? 4 : 1 << random.small(1, 26);
        for (std::size_t k = 0; k < kCount; ++k) {
            do {
                x[k] = random.small(-most, most);
                y[k] = random.small(-most, most);
                z[k] = random.chance(0.1) ? 0 : random.small(-most, most);
            } while (x[k] == 0 && y[k] == 0 && z[k] == 0);
        }
        direction_codes(kCount, x.data(), y.data(), z.data(), codes.data());
        for (std::size_t k = 0; k < kCount; ++k) {
            ASSERT_EQ(codes[k], shared::encode_normal({x[k], y[k], z[k]})) << x[k] << " " << y[k] << " " << z[k];
        }
    }
    EXPECT_NE(std::string(vector_unit()), "");
}

}  // namespace burin::compute::test
