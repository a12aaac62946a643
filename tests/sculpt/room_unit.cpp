// SPDX-License-Identifier: MIT
// Adding material around a workpiece: all of it stays within the room, and what does not fit is told.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "compute/engine/engine.hpp"
#include "haptics/channels.hpp"
#include "sculpt/carved_scene.hpp"
#include "sculpt/load_workpiece.hpp"

namespace burin::sculpt {
namespace {

constexpr double kAddedRadius_m = 0.006;

// Adds half a ball on the middle of a block's top; returns how much of it is there, and what was told.
struct Added {
    double of_half_ball = 0.0;
    std::vector<std::string> told;
};
Added half_ball_on_top(double room) {
    WorkerPool pool(1);
    auto block = load_workpiece({.source = "block:0.06,0.05,0.04", .resolution = 60, .room = room}, pool);
    EXPECT_TRUE(block);
    EXPECT_NEAR(block->bounds_object.hi.z, 0.04, 1e-3) << "the room is not the workpiece's";
    Sculpture carving(compute::make_cpu_engine(std::move(block->solid), pool), pool);
    haptics::HapticChannels channels;
    const toolbox::Tool ball{compute::BallTool{kAddedRadius_m}, compute::Operation::fill};
    CarvedScene desk(carving, channels, ball, 0.0, 0.02, 1 << 24);
    EXPECT_TRUE(desk.update(0));
    static_cast<void>(desk.take_surface_update());
    for (std::uint64_t tick = 1; tick <= 3; ++tick) {
        haptics::TickRecord s;
        s.tick = tick;
        s.time_ns = static_cast<Nanoseconds>(tick) * 1'000'000;
        s.contact.points[0].proxy_object_m = {0.03, 0.025, 0.04};
        s.sample.buttons = 1;
        EXPECT_TRUE(channels.ticks.push(s));
    }
    EXPECT_TRUE(desk.update(10'000'000));
    const double half_ball_m3 = 2.0 / 3.0 * std::numbers::pi * std::pow(kAddedRadius_m, 3);
    const double added_m3 = carving.surface().volume_m3() - carving.initial_volume_m3();
    const auto update = desk.take_surface_update();
    return {added_m3 / half_ball_m3, update ? update->messages : std::vector<std::string>{}};
}

}  // namespace

TEST(RoomAround, HoldsWhatIsAddedOnTop) {
    const Added with = half_ball_on_top(workpiece::kUsualRoom);
    EXPECT_NEAR(with.of_half_ball, 1.0, 0.02);
    EXPECT_TRUE(with.told.empty());
}

TEST(RoomAround, TellsOnceThatWhatIsAddedEndsAtItsBorder) {
    const Added without = half_ball_on_top(0.0);
    EXPECT_LT(without.of_half_ball, 0.5);
    ASSERT_EQ(without.told.size(), 1u);
    EXPECT_NE(without.told[0].find("--room"), std::string::npos) << without.told[0];
}

}  // namespace burin::sculpt
