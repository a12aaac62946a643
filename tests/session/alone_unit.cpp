// SPDX-License-Identifier: MIT
// A session by itself: what is linked with it, and which engine carves its workpiece.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstddef>
#include <string>
#include <utility>

#include "base/clock.hpp"
#include "compute/engine/chosen_engine.hpp"
#include "session/live/session.hpp"
#include "tests/session/carving_setup.hpp"
#include "tests/support/run_command.hpp"

namespace burin::session {
namespace {

SessionSetup small_ball(compute::EngineChoice engine) {
    SessionSetup options = carving_setup();
    options.carve.workpiece = {.source = "ball:0.1", .resolution = 16};
    options.carve.engine = engine;
    options.threads = 1;
    return options;
}

// This program has the tests of session/ and all that they need.
TEST(SessionAlone, LinksNothingOfVulkanAndNothingOfADesk) {
    const auto symbols = Workplace().run("nm -C --defined-only /proc/" + std::to_string(::getpid()) + "/exe");
    ASSERT_EQ(symbols.status, 0) << symbols.output;
    ASSERT_TRUE(symbols.output.contains("burin::session::Session::create(")) << "the symbols are there";
    for (const char* const other : {"burin::gpu::", "burin::renderer::", "burin::window::", "burin::session::Desk::",
                                    "burin::compute::VulkanEngine::"})
        EXPECT_FALSE(symbols.output.contains(other)) << other;
}

TEST(SessionAlone, CarvesWithTheProcessorAndRefusesADeviceThatNobodyGaveIt) {
    SimulatedClock clock;
    const auto session = Session::create(small_ball(compute::EngineChoice::automatic), clock);
    ASSERT_TRUE(session) << session.error().line();
    EXPECT_STREQ((*session)->scene_side().engine()->name(), "cpu");
    const auto refused = Session::create(small_ball(compute::EngineChoice::vulkan), clock);
    ASSERT_FALSE(refused);
    EXPECT_TRUE(refused.error().line().contains("--engine vulkan")) << refused.error().line();
}

TEST(SessionAlone, SaysThatNobodyMakesItsWorkpiece) {
    SimulatedClock clock;
    SessionSetup options = small_ball(compute::EngineChoice::cpu);
    options.carve.make_workpiece = nullptr;
    const auto refused = Session::create(options, clock);
    ASSERT_FALSE(refused);
    EXPECT_TRUE(refused.error().line().starts_with("workpiece ball:0.1:")) << refused.error().line();
}

TEST(SessionAlone, CarvesWithTheEngineThatItsOpenerMakes) {
    SimulatedClock clock;
    SessionSetup options = small_ball(compute::EngineChoice::vulkan);
    std::size_t made = 0;
    options.carve.make_engine = [&](compute::Solid solid, WorkerPool& pool) {
        ++made;
        return compute::on_processor(std::move(solid), pool);
    };
    ASSERT_TRUE(Session::create(options, clock));
    EXPECT_EQ(made, 1u);
}

}  // namespace
}  // namespace burin::session
