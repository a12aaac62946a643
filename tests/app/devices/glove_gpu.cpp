// SPDX-License-Identifier: MIT
// A glove at the far end of a line, in a session by the command line.
#include <gtest/gtest.h>

#include <string>

#include "gpu/device.hpp"
#include "tests/support/places.hpp"
#include "tests/support/run_command.hpp"

namespace burin::app {

TEST(GloveSession, IsRecordedWithFourFingersAndDoneAgainToTheBitWithoutTheGlove) {
    if (!gpu::list_devices()) GTEST_SKIP() << "no Vulkan driver";
    const Workplace at;
    const std::string burin = kBurinCommand;
    at.write("s.txt", "burin-input 1 a glove\n0.1 mouse 160 90\n0.5 mouse 150 100\n2.5 close\n");
    // The emulated glove ends by itself, whatever becomes of the session.
    const auto recorded =
        at.run("(" + burin +
               " glove emulate --seconds 30 > port.txt &) ; "
               "while ! test -s port.txt; do sleep 0.05; done; " +
               burin + " world " + kSessionsFolder + "/../worlds/garden.toml --device glove:$(cat port.txt) " +
               "--input s.txt --offscreen --width 320 --height 180 --record g.session");
    ASSERT_EQ(recorded.status, 0) << recorded.output;
    EXPECT_TRUE(recorded.output.contains("0 lost")) << recorded.output;
    const auto replayed = at.run(burin + " replay g.session");
    EXPECT_EQ(replayed.status, 0) << replayed.output;
    EXPECT_TRUE(replayed.output.contains("equal to the bit")) << replayed.output;
    const auto info = at.run(burin + " session info g.session");
    for (const char* finger : {"\nthumb: ", "\nindex: ", "\nmiddle: ", "\nring: "})
        EXPECT_TRUE(info.output.contains(finger)) << info.output;
    const auto without = at.run(burin + " world " + kSessionsFolder +
                                "/../worlds/garden.toml --device glove:/dev/no-such-port --input s.txt --offscreen "
                                "--record h.session");
    EXPECT_EQ(without.status, 1);
    EXPECT_TRUE(without.output.contains("there is no such port")) << without.output;
}

}  // namespace burin::app
