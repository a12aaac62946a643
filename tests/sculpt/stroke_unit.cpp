// SPDX-License-Identifier: MIT
// A stroke from the ring of samples to the carved solid: what is read, what an update does, and what its figures say.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <span>
#include <vector>

#include "compute/engine/engine.hpp"
#include "haptics/channels.hpp"
#include "sculpt/carved_scene.hpp"
#include "sculpt/load_workpiece.hpp"

namespace burin::sculpt {
namespace {

const toolbox::Tool kBall{compute::BallTool{0.02}, compute::Operation::cut, 0};

std::unique_ptr<compute::CarvingEngine> ball_engine(WorkerPool& pool) {
    return compute::make_cpu_engine(*compute::make_ball(0.1, 32, {"skin"}), pool);
}

// A sample of material without hardness, which gives way where the hand is.
haptics::TickRecord sample_of(std::uint64_t tick, const Vec3& place, bool pressed) {
    haptics::TickRecord sample;
    sample.tick = tick;
    sample.time_ns = static_cast<Nanoseconds>(tick) * 1'000'000;
    sample.contact.points[0].hip_object_m = sample.contact.cut_object_m = sample.contact.points[0].proxy_object_m =
        place;
    sample.sample.buttons = pressed ? 1u : 0u;
    return sample;
}

void push_sample(haptics::HapticChannels& channels, std::uint64_t tick, const Vec3& place, bool pressed) {
    ASSERT_TRUE(channels.ticks.push(sample_of(tick, place, pressed)));
}

}  // namespace

TEST(StrokeReader, StopsAtEachReleaseOfTheButton) {
    StrokeReader reader(kBall, 0.0, 0.005);
    const std::vector samples{sample_of(1, {0.0, 0.0, 0.1}, true), sample_of(2, {0.01, 0.0, 0.1}, true),
                              sample_of(3, {0.01, 0.0, 0.2}, false), sample_of(4, {0.05, 0.0, 0.1}, true)};
    reader.take(samples);
    const SweptSamples first = reader.read();
    EXPECT_TRUE(first.stroke_ended);
    ASSERT_EQ(first.sweeps.size(), 1u);
    EXPECT_EQ(first.sweeps[0].start.position_m, Vec3(0.0, 0.0, 0.1));
    EXPECT_EQ(first.sweeps[0].end.position_m, Vec3(0.01, 0.0, 0.1));
    EXPECT_FALSE(reader.pressed());
    const SweptSamples second = reader.read();
    EXPECT_FALSE(second.stroke_ended);
    ASSERT_EQ(second.sweeps.size(), 1u);
    EXPECT_EQ(second.sweeps[0].start.position_m, Vec3(0.05, 0.0, 0.1));
    EXPECT_TRUE(reader.pressed());
    EXPECT_EQ(reader.last_worked_ns(), 4'000'000);
}

// The bead of a mouse began with a lump: the button goes down while the hand is above the surface.
TEST(StrokeReader, FillingAtTheHandBeginsWhenTheHandHasComeDown) {
    toolbox::Tool tool{compute::BallTool{0.004}, compute::Operation::fill, 0};
    tool.fills_at_hand = true;
    const auto sample = [](std::uint64_t tick, double height_m, double x_m, bool pressed) {
        haptics::TickRecord record = sample_of(tick, {x_m, 0.0, height_m}, pressed);
        record.contact.points[0].proxy_object_m = {x_m, 0.0, std::max(height_m, 0.004)};
        record.contact.points[0].normal_object = {0.0, 0.0, 1.0};
        if (height_m < 0.004) record.flags |= haptics::kTickInContact;
        return record;
    };
    std::vector<haptics::TickRecord> samples;
    std::uint64_t tick = 0;
    for (int i = 0; i <= 40; ++i)
        samples.push_back(
            sample(++tick, 0.0028 + 0.0016 * (0.5 + 0.5 * std::cos(std::numbers::pi * i / 40.0)), 0.0, true));
    for (int i = 1; i <= 20; ++i) samples.push_back(sample(++tick, 0.0028, 0.0005 * i, true));
    samples.push_back(sample(++tick, 0.0028, 0.01, false));
    StrokeReader reader(tool, 0.0, 0.0005);
    reader.take(samples);
    const SweptSamples swept = reader.read();
    ASSERT_FALSE(swept.sweeps.empty());
    for (const compute::ToolSweep& sweep : swept.sweeps) {
        EXPECT_NEAR(sweep.start.position_m.z, 0.0028, 3e-5);
        EXPECT_NEAR(sweep.end.position_m.z, 0.0028, 3e-5);
    }
    EXPECT_LT(swept.sweeps.front().start.position_m.x, 1e-9) << "where the button went down";
    EXPECT_NEAR(swept.sweeps.back().end.position_m.x, 0.01, 1e-9);
    // A click, over before the hand has come down, leaves what it touched all the same.
    const std::vector click{sample(++tick, 0.0041, 0.0, true), sample(++tick, 0.0037, 0.0, true),
                            sample(++tick, 0.0033, 0.0, true), sample(++tick, 0.0033, 0.0, false)};
    reader.take(click);
    const SweptSamples clicked = reader.read();
    ASSERT_EQ(clicked.sweeps.size(), 1u);
    EXPECT_EQ(clicked.sweeps[0].end.position_m.z, 0.0033);
}

TEST(StrokeReader, GoesOnBehindWhatItHasRead) {
    StrokeReader reader(kBall, 0.0, 0.005);
    std::vector<haptics::TickRecord> samples;
    for (std::uint64_t tick = 1; tick <= 4; ++tick)
        samples.push_back(sample_of(tick, {0.01 * static_cast<double>(tick), 0.0, 0.1}, true));
    const std::span all(samples);
    reader.take(all.first(2));
    const SweptSamples first = reader.read();
    ASSERT_FALSE(first.sweeps.empty());
    EXPECT_EQ(first.sweeps.back().end.position_m, Vec3(0.02, 0.0, 0.1));
    reader.take(all.subspan(2, 1));
    reader.take(all.subspan(3));
    const SweptSamples rest = reader.read();
    ASSERT_FALSE(rest.sweeps.empty());
    EXPECT_EQ(rest.sweeps.front().start.position_m, Vec3(0.02, 0.0, 0.1)) << "goes on from where it was";
    EXPECT_EQ(rest.sweeps.back().end.position_m, Vec3(0.04, 0.0, 0.1));
    EXPECT_TRUE(reader.read().sweeps.empty());
}

TEST(CarvedPart, WithoutUndoMemoryLeavesTheHistoryAndItsNoticesToTheirOwner) {
    WorkerPool pool(1);
    Sculpture sculpture(ball_engine(pool), pool);
    haptics::HapticChannels channels;
    std::uint64_t tick = 0;
    const auto two_strokes = [&](double x) {
        for (const double y : {-0.03, 0.03}) {
            push_sample(channels, ++tick, {x, y, 0.09}, true);
            push_sample(channels, ++tick, {x, y, 0.2}, false);
        }
    };
    sculpture.keep_history(1);  // room for one stroke: the first of two is dropped with a notice
    CarvedScene service(sculpture, channels, kBall, 0.0, 0.02, std::nullopt);
    two_strokes(-0.03);
    ASSERT_TRUE(service.update(0));
    const auto update = service.take_surface_update();
    ASSERT_TRUE(update);
    EXPECT_FALSE(update->tiles.empty());
    EXPECT_TRUE(update->messages.empty());
    ASSERT_NE(sculpture.history(), nullptr);
    EXPECT_EQ(sculpture.history()->dropped_strokes(), 1u);
    EXPECT_FALSE(sculpture.history()->take_notices().empty());

    CarvedScene keeper(sculpture, channels, kBall, 0.0, 0.02, 1);
    two_strokes(0.03);
    ASSERT_TRUE(keeper.update(0));
    EXPECT_FALSE(keeper.take_surface_update()->messages.empty());
}

TEST(CarvedPart, CarvesWithoutAnyHistory) {
    WorkerPool pool(1);
    Sculpture sculpture(ball_engine(pool), pool);
    haptics::HapticChannels channels;
    CarvedScene service(sculpture, channels, kBall, 0.0, 0.02, std::nullopt);
    push_sample(channels, 1, {0.0, 0.0, 0.1}, true);
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
