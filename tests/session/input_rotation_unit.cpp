// SPDX-License-Identifier: MIT
// Rotations in lines of a tracker or a script.
#include <gtest/gtest.h>

#include <cmath>

#include "base/text.hpp"
#include "session/input/input_line.hpp"

namespace burin::session {

// A sender that writes five decimals is heard in every direction, not only where these happen to have length 1.
TEST(InputLog, ARotationOfFewDecimalsIsBroughtToLengthOneInEveryDirection) {
    for (int i = 0; i < 500; ++i) {
        const Quat q = glm::normalize(Quat(std::sin(1.0 + i), std::cos(2.0 * i), std::sin(3.0 * i), std::cos(5.0 + i)));
        for (const int decimals : {3, 4, 5}) {
            const std::string line = formatted("1 %s 0 1.6 2 %.*f %.*f %.*f %.*f", i % 2 == 0 ? "head" : "wand 0",
                                               decimals, q.x, decimals, q.y, decimals, q.z, decimals, q.w);
            const auto event = parse_line(line, "n");
            ASSERT_TRUE(event.has_value() && event->has_value()) << event.error().line();
            const Input& input = (*event)->input;
            const Quat heard = i % 2 == 0 ? std::get<HeadInput>(input).pose_world.orientation
                                          : std::get<WandInput>(input).pose_world.orientation;
            EXPECT_NEAR(glm::length(heard), 1.0, 1e-6) << line;
            EXPECT_NEAR(glm::dot(heard, q), 1.0, 1e-5) << line;
            // Written and read again it stays as it is.
            const auto again = parse_line(line_of(**event), "n");
            ASSERT_TRUE(again.has_value() && again->has_value());
            EXPECT_EQ((*again)->input, input) << line;
        }
    }
}

}  // namespace burin::session
