// SPDX-License-Identifier: MIT
// A stroke from the ring of samples to the carved solid: what is read, what an update does, and what its figures say.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "sculpt/sculpt_service.hpp"
#include "sculpt/workpiece.hpp"

namespace burin::sculpt {
namespace {

const Tool kBall{compute::BallTool{0.02}, compute::Operation::cut, 0};

std::unique_ptr<compute::CarvingEngine> ball_engine(WorkerPool& pool) {
    return std::move(choose_engine(EngineChoice::cpu, *compute::make_ball(0.1, 32, {"skin"}), pool)->engine);
}

// Pushes a sample of material without hardness, which gives way where the hand is.
void push(haptics::HapticChannels& channels, std::uint64_t tick, const Vec3& place, bool pressed) {
    haptics::StrokeSample sample;
    sample.tick = tick;
    sample.time_ns = static_cast<Nanoseconds>(tick) * 1'000'000;
    sample.position_object_m = sample.cut_object_m = sample.proxy_object_m = place;
    sample.buttons = pressed ? 1u : 0u;
    ASSERT_TRUE(channels.stroke.push(sample));
}

}  // namespace

TEST(StrokeReader, StopsAtEachReleaseOfTheButton) {
    haptics::HapticChannels channels;
    StrokeReader reader(channels, kBall, 0.0, 0.005);
    push(channels, 1, {0.0, 0.0, 0.1}, true);
    push(channels, 2, {0.01, 0.0, 0.1}, true);
    push(channels, 3, {0.01, 0.0, 0.2}, false);
    push(channels, 4, {0.05, 0.0, 0.1}, true);
    reader.take(UINT64_MAX);
    EXPECT_EQ(reader.last_tick(), 4u);
    EXPECT_EQ(reader.release_ns(INT64_MAX), 3'000'000);
    const SweptSamples first = reader.read(INT64_MAX);
    EXPECT_TRUE(first.stroke_ended);
    ASSERT_EQ(first.sweeps.size(), 1u);
    EXPECT_EQ(first.sweeps[0].start.position_m, Vec3(0.0, 0.0, 0.1));
    EXPECT_EQ(first.sweeps[0].end.position_m, Vec3(0.01, 0.0, 0.1));
    EXPECT_EQ(reader.oldest_ns(), 4'000'000);
    EXPECT_FALSE(reader.pressed());
    const SweptSamples second = reader.read(INT64_MAX);
    EXPECT_FALSE(second.stroke_ended);
    ASSERT_EQ(second.sweeps.size(), 1u);
    EXPECT_EQ(second.sweeps[0].start.position_m, Vec3(0.05, 0.0, 0.1));
    EXPECT_TRUE(reader.pressed());
    EXPECT_EQ(reader.last_worked_ns(), 4'000'000);
}

TEST(StrokeReader, LeavesSamplesOfLaterTicksInTheRing) {
    haptics::HapticChannels channels;
    StrokeReader reader(channels, kBall, 0.0, 0.005);
    for (std::uint64_t tick = 1; tick <= 4; ++tick) push(channels, tick, {0.01 * double(tick), 0.0, 0.1}, true);
    reader.take(2);
    const SweptSamples first = reader.read(INT64_MAX);
    ASSERT_FALSE(first.sweeps.empty());
    EXPECT_EQ(first.sweeps.back().end.position_m, Vec3(0.02, 0.0, 0.1));
    EXPECT_EQ(reader.last_tick(), 2u);
    reader.take(UINT64_MAX);
    const SweptSamples rest = reader.read(INT64_MAX);
    ASSERT_FALSE(rest.sweeps.empty());
    EXPECT_EQ(rest.sweeps.front().start.position_m, Vec3(0.02, 0.0, 0.1)) << "goes on from where it was";
    EXPECT_EQ(rest.sweeps.back().end.position_m, Vec3(0.04, 0.0, 0.1));
    EXPECT_TRUE(reader.read(INT64_MAX).sweeps.empty());
}

TEST(StrokeReader, ReadsUpToATimeAndMakesASweepOfEachSampleWhereTheirOrderMatters) {
    haptics::HapticChannels channels;
    for (const bool alone : {false, true}) {
        StrokeReader reader(channels, kBall, 0.0, 0.005);
        for (std::uint64_t tick = 1; tick <= 6; ++tick)  // it stands still from the fourth on
            push(channels, tick, {0.01 * double(std::min<std::uint64_t>(tick, 4)), 0.0, 0.1}, true);
        reader.take(UINT64_MAX);
        // Two samples, the tool's radius, and three cells.
        EXPECT_NEAR(reader.reach_object(3'000'000).hi.x, 0.02 + 0.02 + 0.015, 1e-12);
        EXPECT_NEAR(reader.reach_object(3'000'000).lo.y, -0.02 - 0.015, 1e-12);
        const SweptSamples first = reader.read(4'000'000, alone), rest = reader.read(INT64_MAX, alone);
        EXPECT_EQ(first.samples + rest.samples, 6u);
        EXPECT_EQ(first.sweeps.size(), alone ? 2u : 1u);
        EXPECT_EQ(rest.sweeps.size(), alone ? 3u : 1u);
        EXPECT_EQ(first.ends_ns, alone ? (std::vector<Nanoseconds>{2'000'000, 3'000'000}) : std::vector<Nanoseconds>{});
        EXPECT_EQ(alone ? rest.ends_ns.back() : 6'000'000, 6'000'000);
        EXPECT_EQ(rest.sweeps.front().start.position_m, first.sweeps.back().end.position_m);
        EXPECT_EQ(rest.sweeps.back().end.position_m, Vec3(0.04, 0.0, 0.1));
        EXPECT_TRUE(reader.reach_object(INT64_MAX).empty());
    }
}

TEST(SculptService, WithoutUndoMemoryLeavesTheHistoryAndItsNoticesToTheirOwner) {
    WorkerPool pool(1);
    Sculpture sculpture(ball_engine(pool), pool);
    haptics::HapticChannels channels;
    std::uint64_t tick = 0;
    const auto two_strokes = [&](double x) {
        for (const double y : {-0.03, 0.03}) {
            push(channels, ++tick, {x, y, 0.09}, true);
            push(channels, ++tick, {x, y, 0.2}, false);
        }
    };
    sculpture.keep_history(1);  // room for one stroke: the first of two is dropped with a notice
    SculptService service(sculpture, channels, kBall, 0.0, 0.02, std::nullopt);
    two_strokes(-0.03);
    ASSERT_TRUE(service.update(0));
    const auto update = service.take_surface_update();
    ASSERT_TRUE(update);
    EXPECT_FALSE(update->tiles.empty());
    EXPECT_TRUE(update->messages.empty());
    ASSERT_NE(sculpture.history(), nullptr);
    EXPECT_EQ(sculpture.history()->dropped_strokes(), 1u);
    EXPECT_FALSE(sculpture.history()->take_notices().empty());

    SculptService keeper(sculpture, channels, kBall, 0.0, 0.02, 1);
    two_strokes(0.03);
    ASSERT_TRUE(keeper.update(0));
    EXPECT_FALSE(keeper.take_surface_update()->messages.empty());
}

TEST(SculptService, CarvesWithoutAnyHistory) {
    WorkerPool pool(1);
    Sculpture sculpture(ball_engine(pool), pool);
    haptics::HapticChannels channels;
    SculptService service(sculpture, channels, kBall, 0.0, 0.02, std::nullopt);
    push(channels, 1, {0.0, 0.0, 0.1}, true);
    ASSERT_TRUE(service.update(0));
    EXPECT_EQ(sculpture.history(), nullptr);
    EXPECT_GT(sculpture.figures().rays_changed, 0u);
    EXPECT_EQ(service.take_surface_update()->undoable, 0u);
    EXPECT_EQ(service.published(), 1u);
}

TEST(Sculpture, LightFollowsUndoAndRedo) {
    WorkerPool pool(1);
    Sculpture sculpture(ball_engine(pool), pool);
    sculpture.keep_history(1 << 24);
    ASSERT_TRUE(sculpture.keep_light({{0.3, 1.0, 0.2}, 0.05}));
    // Bakes all that waits, after checking that each vertex has a light meanwhile too.
    const auto light_of_all_tiles = [&] {
        std::vector<std::vector<geometry::VertexLight>> lights;
        for (std::uint32_t tile = 0; tile < sculpture.surface().tile_count(); ++tile) {
            const auto& light = sculpture.light()->shared_light(tile);
            EXPECT_EQ(light ? light->vertices.size() : 0, sculpture.surface().tile(tile).vertices.size()) << tile;
        }
        while (sculpture.bake_light(Vec3(0.0), 64) > 0) {
        }
        for (std::uint32_t tile = 0; tile < sculpture.surface().tile_count(); ++tile) {
            const auto& light = sculpture.light()->shared_light(tile);
            lights.push_back(light ? light->vertices : std::vector<geometry::VertexLight>{});
        }
        return lights;
    };
    const auto whole = light_of_all_tiles();
    const Pose place{{0.0, 0.1, 0.0}};
    const compute::ToolSweep stamp = kBall.sweep(place, place);
    ASSERT_TRUE(sculpture.update({&stamp, 1}));
    sculpture.end_stroke();
    const auto carved = light_of_all_tiles();
    EXPECT_FALSE(carved == whole);
    EXPECT_EQ(sculpture.undo(1), 1u);
    EXPECT_TRUE(light_of_all_tiles() == whole);
    EXPECT_EQ(sculpture.redo(1), 1u);
    EXPECT_TRUE(light_of_all_tiles() == carved);
}

TEST(Sculpture, TimesThePartsOfEachUpdate) {
    WorkerPool pool(1);
    Sculpture sculpture(ball_engine(pool), pool);
    for (const double x : {-0.02, 0.0, 0.02}) {
        const Pose place{{x, 0.0, 0.1}};
        const compute::ToolSweep stamp = kBall.sweep(place, place);
        ASSERT_TRUE(sculpture.update({&stamp, 1}));
    }
    const SculptFigures& figures = sculpture.figures();
    ASSERT_EQ(figures.update_ms.size(), 3u);
    ASSERT_EQ(figures.carve_ms.size(), 3u);
    ASSERT_EQ(figures.mesh_ms.size(), 3u);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_GT(figures.carve_ms[i], 0.0);
        EXPECT_GT(figures.mesh_ms[i], 0.0);
        EXPECT_LE(figures.carve_ms[i] + figures.mesh_ms[i], figures.update_ms[i] + 1e-9);
    }
    EXPECT_GT(figures.cells_remeshed, 0u);
    EXPECT_GT(figures.triangles_remeshed, 0u);
}

}  // namespace burin::sculpt
