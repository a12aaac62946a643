// SPDX-License-Identifier: MIT
// The machine's pace, and that only a session in real time has one of its own.
#include <gtest/gtest.h>

#include "compute/engine/chosen_engine.hpp"
#include "haptics/channels.hpp"
#include "haptics/tick.hpp"
#include "sculpt/made_workpiece.hpp"
#include "session/hands/machine_pace.hpp"
#include "session/live/session.hpp"
#include "tests/session/carving_setup.hpp"

namespace burin::session {

TEST(MachinePace, IsTheTimeTakenOverTheReferencesWithinBounds) {
    EXPECT_DOUBLE_EQ(pace_of(1'700'000, 1e6), 1.7);
    EXPECT_EQ(pace_of(1, 1e6), kLeastPace);
    EXPECT_EQ(pace_of(1'000'000'000, 1e6), kMostPace);
}

// How fast this machine is nobody knows; but it does the work, and the parameters of a tick accept what comes out.
TEST(MachinePace, AsMeasuredIsSensible) {
    haptics::TickParameters parameters;
    parameters.work.pace = measured_pace();
    EXPECT_GE(parameters.work.pace, kLeastPace);
    EXPECT_LE(parameters.work.pace, kMostPace);
    EXPECT_TRUE(haptics::parameters_are_sensible(parameters));
}

TEST(MachinePace, IsOneForAScriptAndThatOfTheSessionInAllItsParameters) {
    SessionSetup options = carving_setup();
    options.carve.workpiece.resolution = 16;
    options.carve.engine = compute::EngineChoice::cpu;
    for (const double pace : {1.0, 1.7}) {
        SimulatedClock clock;
        auto session =
            pace == 1.0 ? Session::create(options, clock) : Session::create(options, clock, pace, nullptr, {});
        ASSERT_TRUE(session);
        Session& s = **session;
        EXPECT_EQ(s.channels().parameters.newest().work.pace, pace);
        // Another feel: the next set has it as well.
        const std::vector<InputEvent> events{{1'000'000, CommandInput{"friction", {"0.4"}}}};
        Leader nobody;
        s.begin_step(2'000'000, std::span(&s.newest_tool(), 1));
        s.step({events}, nobody, [](const scene::SceneThread::Order&) {});
        EXPECT_EQ(s.channels().parameters.newest().sequence, 2u);
        EXPECT_EQ(s.channels().parameters.newest().work.pace, pace);
    }
}

}  // namespace burin::session
