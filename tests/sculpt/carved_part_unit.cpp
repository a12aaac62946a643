// SPDX-License-Identifier: MIT
// Strokes, orders and exports of the carving side, and what it reports of them to the frame.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <mutex>
#include <thread>

#include "compute/engine/engine.hpp"
#include "haptics/channels.hpp"
#include "haptics/tick.hpp"
#include "scene/scene_thread.hpp"
#include "sculpt/carved_scene.hpp"
#include "sculpt/load_workpiece.hpp"
#include "tests/support/run_command.hpp"

namespace burin::sculpt {
namespace {

// A ball under a tool that a script moves by hand-made samples.
struct Bench {
    WorkerPool pool{1};
    Sculpture carving;
    haptics::HapticChannels channels;
    CarvedScene desk;

    explicit Bench(const Vec3& place = Vec3(0.0))
        : carving(engine(pool, place), pool), desk(carving, channels, tool(), 0.0, 0.02, 1 << 24) {
        desk.start_at({0.0, 0.0, 0.15});
    }
    static std::unique_ptr<compute::CarvingEngine> engine(WorkerPool& pool, const Vec3& place) {
        compute::Solid ball = *compute::make_ball(0.1, 32, {"skin"});
        ball.lattice.origin_object += place;
        return compute::make_cpu_engine(std::move(ball), pool);
    }
    static toolbox::Tool tool() { return {compute::BallTool{0.02}}; }
    // The tool at a place, with its button up or down; material without hardness goes away where the hand is.
    void sample(const Vec3& place, bool pressed) {
        haptics::TickRecord s;
        s.tick = ++ticks;
        s.time_ns = static_cast<Nanoseconds>(ticks) * 1'000'000;
        s.contact.points[0].hip_object_m = s.contact.cut_object_m = s.contact.points[0].proxy_object_m = place;
        s.sample.buttons = pressed ? 1u : 0u;
        ASSERT_TRUE(channels.ticks.push(s));
    }
    void stroke() {
        for (int i = 0; i < 10; ++i) sample({0.01 * i - 0.05, 0.0, 0.1}, true);
        sample({0.05, 0.0, 0.2}, false);
    }
    std::uint64_t ticks = 0;
};

}  // namespace

TEST(CarvedPart, OnePressIsOneUndoAlsoWhereTheToolLosesTouch) {
    Bench bench;
    ASSERT_TRUE(bench.desk.update(0));
    static_cast<void>(bench.desk.take_surface_update());
    // Pressed twice into the ball's front without letting go, paused between in an update of its own.
    for (const double z : {0.1, 0.2, 0.1}) {
        for (int i = 0; i < 5; ++i) bench.sample({0.01 * i, 0.0, z}, true);
        ASSERT_TRUE(bench.desk.update(0));
    }
    bench.sample({0.05, 0.0, 0.2}, false);
    ASSERT_TRUE(bench.desk.update(0));
    const auto news = bench.desk.take_surface_update();
    ASSERT_TRUE(news);
    EXPECT_EQ(news->undoable, 1u);
}

TEST(CarvedPart, OneStrokeIsOneUndoAndNewsTellOnlyWhatChanged) {
    Bench bench;
    ASSERT_TRUE(bench.desk.update(0));
    const auto first = bench.desk.take_surface_update();
    ASSERT_TRUE(first);
    EXPECT_EQ(first->undoable, 0u);
    EXPECT_FALSE(bench.desk.take_surface_update()) << "nothing has happened since";
    bench.stroke();
    ASSERT_TRUE(bench.desk.update(20'000'000));
    ASSERT_TRUE(bench.desk.update(30'000'000));
    const auto carved = bench.desk.take_surface_update();
    ASSERT_TRUE(carved);
    EXPECT_EQ(carved->undoable, 1u);
    EXPECT_GT(carved->cut_ns, 0);
    EXPECT_FALSE(carved->tiles.empty());
    EXPECT_LT(carved->tiles.size(), first->tiles.size());
    bench.desk.order(workpiece::UndoStroke{});
    const auto undone = bench.desk.take_surface_update();
    ASSERT_TRUE(undone);
    EXPECT_EQ(undone->undoable, 0u);
    EXPECT_EQ(undone->redoable, 1u);
    EXPECT_EQ(undone->tiles.size(), carved->tiles.size());
}

// Orders come while strokes are carved on another thread; what is left is what the same orders leave one after the
// other.
TEST(CarvedPart, CarvesAndTakesOrdersBesideTheFrame) {
    MonotonicClock clock;
    Bench bench;
    std::mutex mutex;
    std::optional<scene::SurfaceUpdate> seen;
    scene::SceneThread thread(bench.desk.service(), clock, [&](const scene::SceneThread::Ended&) {
        const std::lock_guard lock(mutex);
        add(seen, bench.desk.take_surface_update());
    });
    bench.stroke();
    thread.start();
    const auto wait_until = [&](auto&& enough) {
        for (int i = 0; i < 3000; ++i) {  // a guard against hanging, not a measure
            {
                const std::lock_guard lock(mutex);
                if (seen && enough(*seen)) return true;
            }
            std::this_thread::sleep_for(std::chrono::milliseconds(2));
        }
        return false;
    };
    ASSERT_TRUE(wait_until([](const scene::SurfaceUpdate& n) { return n.undoable == 1; }));
    thread.order([&] { bench.desk.order(workpiece::UndoStroke{}); });
    ASSERT_TRUE(wait_until([](const scene::SurfaceUpdate& n) { return n.redoable == 1; }));
    thread.order([&] { bench.desk.order(workpiece::RedoStroke{}); });
    thread.stop();  // carries out what was ordered
    EXPECT_FALSE(thread.failure());
    EXPECT_EQ(bench.carving.history()->undoable(), 1u);

    Bench alone;
    alone.stroke();
    ASSERT_TRUE(alone.desk.update(0));
    ASSERT_TRUE(alone.desk.update(0));
    EXPECT_TRUE(bench.carving.engine().solid().same_content(alone.carving.engine().solid()));
}

// ---- Strokes and undo

namespace {
// A press at a place of its own on the ball's front, each of which carves.
void press_at(Bench& bench, double x) {
    for (int i = 0; i < 5; ++i) bench.sample({x, 0.002 * i, 0.09}, true);
}
void release_at(Bench& bench, double x) { bench.sample({x, 0.0, 0.2}, false); }

// Undoes one stroke after the other; what was left each time must be what the strokes before it leave alone.
void expect_each_is_undone_alone(Bench& bench, const std::vector<double>& strokes) {
    for (std::size_t left = strokes.size(); left-- > 0;) {
        ASSERT_EQ(bench.carving.history()->undoable(), left + 1);
        bench.desk.order(workpiece::UndoStroke{});
        Bench alone;
        for (std::size_t i = 0; i < left; ++i) {
            press_at(alone, strokes[i]);
            release_at(alone, strokes[i]);
        }
        ASSERT_TRUE(alone.desk.update(0));
        EXPECT_TRUE(bench.carving.engine().solid().same_content(alone.carving.engine().solid())) << left;
    }
    EXPECT_EQ(bench.carving.history()->undoable(), 0u);
}
}  // namespace

TEST(CarvedPart, EachReleaseOfTheButtonEndsAStrokeThatIsUndoneAlone) {
    const std::vector<double> strokes{-0.05, 0.0, 0.05};
    Bench bench;
    for (const double x : strokes) {  // as in a session: pressed over several updates, released in a later one
        press_at(bench, x);
        ASSERT_TRUE(bench.desk.update(0));
        press_at(bench, x);
        ASSERT_TRUE(bench.desk.update(0));
        release_at(bench, x);
        ASSERT_TRUE(bench.desk.update(0));
    }
    expect_each_is_undone_alone(bench, strokes);
}

TEST(CarvedPart, QuickClicksAreStrokesOfTheirOwnAlsoWithinOneUpdate) {
    const std::vector<double> strokes{-0.05, 0.0, 0.05};
    Bench bench;
    press_at(bench, strokes[0]);  // pressed and released between two updates
    release_at(bench, strokes[0]);
    ASSERT_TRUE(bench.desk.update(0));
    for (const double x : {strokes[1], strokes[2]}) {  // carving came late: two clicks wait for it
        press_at(bench, x);
        release_at(bench, x);
    }
    ASSERT_TRUE(bench.desk.update(0));
    EXPECT_FALSE(bench.channels.ticks.oldest()) << "all samples were taken";
    expect_each_is_undone_alone(bench, strokes);
}

// What a file holds can be had back: an undo after it takes away only what was carved since.
// A hand comes after the cursor: what was asked for as the button came up reached the part in mid-stroke, and the rest
// of the stroke stayed.
TEST(CarvedPart, AnUndoWhileTheHandStillCutsTakesBackTheWholeStroke) {
    Bench bench;
    ASSERT_TRUE(bench.desk.update(0));
    const double whole_m3 = bench.carving.surface().volume_m3();
    for (int i = 0; i < 5; ++i) bench.sample({0.01 * i - 0.05, 0.0, 0.1}, true);
    ASSERT_TRUE(bench.desk.update(10'000'000));
    bench.desk.order(workpiece::UndoStroke{});
    bench.desk.order(workpiece::RedoStroke{});
    bench.desk.order(workpiece::UndoStroke{});
    for (int i = 5; i < 10; ++i) bench.sample({0.01 * i - 0.05, 0.0, 0.1}, true);
    ASSERT_TRUE(bench.desk.update(20'000'000));
    EXPECT_LT(bench.carving.surface().volume_m3(), whole_m3) << "it waits";
    bench.sample({0.05, 0.0, 0.2}, false);
    ASSERT_TRUE(bench.desk.update(30'000'000));
    EXPECT_EQ(bench.carving.surface().volume_m3(), whole_m3);
    static_cast<void>(bench.desk.take_surface_update());
    bench.desk.order(workpiece::RedoStroke{});
    const auto news = bench.desk.take_surface_update();
    ASSERT_TRUE(news);
    EXPECT_EQ(news->undoable, 1u);
    EXPECT_TRUE(news->messages.empty());
}

TEST(CarvedPart, AnUndoWaitsNoLongerThanAHandIsLate) {
    Bench bench;
    ASSERT_TRUE(bench.desk.update(0));
    const double whole_m3 = bench.carving.surface().volume_m3();
    bench.sample({0.0, 0.0, 0.1}, true);  // and no more: a device that is lost with its button down
    ASSERT_TRUE(bench.desk.update(10'000'000));
    bench.desk.order(workpiece::UndoStroke{});
    ASSERT_TRUE(bench.desk.update(20'000'000));
    EXPECT_LT(bench.carving.surface().volume_m3(), whole_m3);
    ASSERT_TRUE(bench.desk.update(20'000'000 + CarvedPart::kMostWait_ns));
    EXPECT_EQ(bench.carving.surface().volume_m3(), whole_m3);
}

TEST(CarvedPart, AnExportInMidStrokeEndsTheStroke) {
    const Workplace place;
    Bench bench;
    press_at(bench, -0.05);
    ASSERT_TRUE(bench.desk.update(0));
    bench.desk.order(workpiece::ExportSurface{(place / "part.stl").string()});
    const compute::Solid exported = bench.carving.engine().solid();
    bench.desk.finish_export();
    press_at(bench, 0.05);  // the button is still down
    release_at(bench, 0.05);
    ASSERT_TRUE(bench.desk.update(0));
    EXPECT_EQ(bench.carving.history()->undoable(), 2u);
    bench.desk.order(workpiece::UndoStroke{});
    EXPECT_TRUE(bench.carving.engine().solid().same_content(exported));
}

TEST(SurfaceUpdate, MergedTellsTheNewestOfEverythingAndEveryMessage) {
    const auto tile = std::make_shared<const geometry::SurfaceTile>();
    scene::SurfaceUpdate news, later;
    news.tiles = {{3, nullptr, nullptr}, {5, tile, nullptr}};
    news.inner_boxes_object = {Box{Vec3(0.0), Vec3(1.0)}};
    news.cut_ns = 1000;
    news.undoable = 1, news.redoable = 2;
    news.exporting = true;
    news.messages = {"first"};
    later.tiles = {{3, tile, nullptr}, {7, tile, nullptr}};
    later.inner_boxes_object = {Box{Vec3(0.0), Vec3(2.0)}};
    later.cut_ns = 2000;
    later.undoable = 4, later.redoable = 0;
    later.messages = {"second"};
    merge(news, later);
    ASSERT_EQ(news.tiles.size(), 3u);
    EXPECT_EQ(news.tiles[0].tile, 3u);
    EXPECT_EQ(news.tiles[0].surface, tile) << "the later one of the same tile";
    EXPECT_EQ(news.tiles[1].tile, 5u);
    EXPECT_EQ(news.tiles[2].tile, 7u);
    ASSERT_EQ(news.inner_boxes_object.size(), 1u);
    EXPECT_EQ(news.inner_boxes_object[0].hi, Vec3(2.0));
    EXPECT_EQ(news.cut_ns, 2000);
    EXPECT_EQ(news.undoable, 4u);
    EXPECT_EQ(news.redoable, 0u);
    EXPECT_FALSE(news.exporting) << "it has ended";
    EXPECT_EQ(news.messages, (std::vector<std::string>{"first", "second"}));
    merge(news, {});  // news of a desk that has not cut since it was made
    EXPECT_EQ(news.cut_ns, 2000);
}

// ---- Where the tool works

namespace {
// Pushes a pressed sample whose hand and proxy are apart, with its flags and phase.
void push(Bench& bench, const Vec3& hand, const Vec3& proxy, std::uint32_t flags,
          haptics::WorkspacePhase phase = haptics::WorkspacePhase::editing) {
    haptics::TickRecord s;
    s.tick = ++bench.ticks;
    s.time_ns = static_cast<Nanoseconds>(s.tick) * 1'000'000;
    s.contact.points[0].hip_object_m = s.contact.cut_object_m = hand;
    s.contact.points[0].proxy_object_m = proxy;
    s.sample.buttons = 1;
    s.flags = flags;
    s.motion.workspace.phase = phase;
    ASSERT_TRUE(bench.channels.ticks.push(s));
}

std::uint64_t changed_rays(Bench& bench) {
    EXPECT_TRUE(bench.desk.update(0));
    return bench.carving.figures().rays_changed;
}

toolbox::Tool tool_for(compute::Operation operation) {
    toolbox::Tool tool = Bench::tool();
    tool.operation = operation;
    return tool;
}

// Returns whether a message since the last call has this part.
bool said(Bench& bench, const std::string& part) {
    const auto update = bench.desk.take_surface_update();
    if (!update) return false;
    return std::ranges::any_of(update->messages, [&](const std::string& m) { return m.contains(part); }) ||
           std::ranges::any_of(update->exports,
                               [&](const scene::ExportOutcome& e) { return e.message.contains(part); });
}

}  // namespace

TEST(CarvedPart, AStrokeOverSeveralUpdatesCarvesWhatItDoesInOne) {
    Bench whole, parts;
    for (int i = 0; i < 12; ++i) {  // 15 mm a sample: what lies between two of them is swept
        const Vec3 at(0.015 * i - 0.08, 0.0, 0.08);
        whole.sample(at, true);
        parts.sample(at, true);
        ASSERT_TRUE(parts.desk.update(0));
    }
    ASSERT_TRUE(whole.desk.update(0));
    // In one update the samples, which lie on a line, make one sweep; where several meet they round ends differently.
    const auto removed_m3 = [](Bench& bench) {
        return bench.carving.initial_volume_m3() - bench.carving.surface().volume_m3();
    };
    EXPECT_GT(removed_m3(whole), 1e-5);
    EXPECT_NEAR(removed_m3(parts) / removed_m3(whole), 1.0, 1e-4);
}

TEST(CarvedPart, NothingIsCarvedWhileTheWorkspaceMoves) {
    Bench bench;
    for (const haptics::WorkspacePhase phase :
         {haptics::WorkspacePhase::paused, haptics::WorkspacePhase::dragging, haptics::WorkspacePhase::jumping,
          haptics::WorkspacePhase::clutched, haptics::WorkspacePhase::gliding})
        push(bench, {0.0, 0.0, 0.1}, {0.0, 0.0, 0.1}, 0, phase);
    EXPECT_EQ(changed_rays(bench), 0u);
    push(bench, {0.0, 0.0, 0.1}, {0.0, 0.0, 0.1}, 0);
    EXPECT_GT(changed_rays(bench), 0u);
}

TEST(CarvedPart, FillingWorksWhereTheToolRestsAndPaintingOnlyWhereItTouches) {
    {
        Bench bench;  // the hand is deep inside, where there is nothing to fill
        bench.desk.order(workpiece::UseTool{tool_for(compute::Operation::fill), {"skin"}, 0.0});
        push(bench, Vec3(0.0), {0.0, 0.0, 0.11}, haptics::kTickInContact);
        EXPECT_GT(changed_rays(bench), 0u);
    }
    Bench bench;
    bench.desk.order(workpiece::UseTool{tool_for(compute::Operation::paint), {"paint", {255, 0, 0}}, 0.0});
    push(bench, {0.0, 0.0, 0.1}, {0.0, 0.0, 0.1}, 0);
    EXPECT_EQ(changed_rays(bench), 0u) << "in the air";
    push(bench, {0.0, 0.0, 0.1}, {0.0, 0.0, 0.12}, haptics::kTickInContact);
    EXPECT_GT(changed_rays(bench), 0u);
}

TEST(CarvedPart, AToolThatCannotSmoothCarvesNothingSaysWhyAndLeavesTheRestAlone) {
    Bench bench;
    // More than a hundred cells of 6.25 mm.
    toolbox::Tool smooth = tool_for(compute::Operation::smooth);
    smooth.shape = compute::BallTool{0.7};
    bench.desk.order(workpiece::UseTool{smooth, {"skin"}, 0.0});
    ASSERT_TRUE(bench.desk.update(0));
    EXPECT_TRUE(said(bench, "too large"));
    bench.stroke();
    ASSERT_TRUE(bench.desk.update(0)) << "a session does not end for it";
    EXPECT_TRUE(said(bench, "too large")) << "nor leaves it unexplained why nothing happens";
    EXPECT_EQ(changed_rays(bench), 0u) << "with this tool or the one before";
    bench.desk.order(workpiece::UseTool{Bench::tool(), {"skin"}, 0.0});
    bench.stroke();
    EXPECT_GT(changed_rays(bench), 0u);
}

TEST(CarvedPart, ASampleThatCannotBeCarvedIsLeftOutAndSaidOnceAStroke) {
    Bench bench;
    bench.sample({0.0, 0.0, 0.1}, true);
    for (int i = 0; i < 3; ++i) bench.sample({1e9, 0.0, 0.1}, true);
    ASSERT_TRUE(bench.desk.update(0));
    EXPECT_TRUE(said(bench, "too far"));
    bench.sample({1e9, 0.0, 0.1}, true);
    ASSERT_TRUE(bench.desk.update(0));
    EXPECT_FALSE(said(bench, "too far")) << "once a stroke";
}

TEST(CarvedPart, ExportsAFarWorkpieceOnlyWhereNumbersSuffice) {
    const Workplace place;
    Bench bench{Vec3(1e6, 0.0, 0.0)};
    bench.desk.order(workpiece::ExportSurface{(place / "far.stl").string()});
    bench.desk.finish_export();
    EXPECT_TRUE(said(bench, "single-precision"));
    EXPECT_EQ(place.files(), 0u);
    bench.desk.order(workpiece::ExportSurface{(place / "far.obj").string()});
    bench.desk.finish_export();
    EXPECT_TRUE(said(bench, "exported"));
    EXPECT_EQ(place.files(), 1u);
}

TEST(CarvedPart, AnotherToolBeginsWhereItIsAndNotWhereTheOldOneWas) {
    const auto carved = [](bool begins_apart) {
        Bench bench;
        bench.sample({-0.08, 0.0, 0.08}, true);
        EXPECT_TRUE(bench.desk.update(0));
        if (begins_apart) {
            bench.sample({-0.08, 0.0, 0.2}, false);
            EXPECT_TRUE(bench.desk.update(0));
        }
        bench.desk.order(workpiece::UseTool{Bench::tool(), {"skin"}, 0.0});
        bench.sample({0.08, 0.0, 0.08}, true);
        EXPECT_TRUE(bench.desk.update(0));
        return bench.carving.engine().solid();
    };
    EXPECT_TRUE(carved(false).same_content(carved(true))) << "nothing between the two was swept";
}

TEST(CarvedPart, EachUpdateHandsTouchASurfaceOfItsOwnNumberAndTime) {
    Bench bench;
    for (std::uint64_t i = 1; i <= 3; ++i) {
        ASSERT_TRUE(bench.desk.update(static_cast<Nanoseconds>(i) * 10'000'000));
        const geometry::LocalSurface& surface = bench.channels.surface.newest();
        EXPECT_EQ(surface.sequence, i);
        EXPECT_EQ(surface.made_ns, static_cast<Nanoseconds>(i) * 10'000'000);
    }
}

}  // namespace burin::sculpt
