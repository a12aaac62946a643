// SPDX-License-Identifier: MIT
// Several hands at one sculpture: the order of what they do, however late their threads are; undo; what each is handed.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <deque>
#include <random>
#include <thread>

#include "sculpt/sculpt_service.hpp"
#include "sculpt/workpiece.hpp"

namespace burin::sculpt {
namespace {

constexpr Nanoseconds kMs = 1'000'000;

Tool ball_tool(compute::Operation operation = compute::Operation::cut, double radius_m = 0.02) {
    return {compute::BallTool{radius_m}, operation};
}

haptics::StrokeSample sample_at(std::uint64_t tick, const Vec3& place, bool pressed) {
    haptics::StrokeSample s;
    s.tick = tick;
    s.time_ns = static_cast<Nanoseconds>(tick) * kMs;
    s.position_object_m = s.cut_object_m = s.proxy_object_m = place;
    s.buttons = pressed ? 1u : 0u;
    return s;
}

// A ball on which hands work whose samples a test pushes; material without hardness gives way where the hand is.
struct Table {
    WorkerPool pool{1};
    Sculpture carving;
    std::deque<haptics::HapticChannels> channels;
    std::optional<SculptService> service;

    explicit Table(const std::vector<Tool>& tools)
        : carving(std::move(choose_engine(EngineChoice::cpu, *compute::make_ball(0.1, 32, {"skin"}), pool)->engine),
                  pool) {
        for (const Tool& tool : tools) {
            haptics::HapticChannels& one = channels.emplace_back(std::size_t{4096}, std::size_t{2});
            if (!service) {
                service.emplace(carving, one, tool, 0.0, 0.02, std::size_t{1} << 24);
            } else {
                EXPECT_EQ(service->add_hand(one, tool, 0.0), channels.size() - 1);
            }
        }
    }
    [[nodiscard]] const compute::Solid& solid() const { return carving.engine().solid(); }
    [[nodiscard]] std::size_t undoable() { return carving.history()->undoable(); }
    void push(std::size_t hand, const haptics::StrokeSample& sample) {
        ASSERT_TRUE(channels[hand].stroke.push(sample));
    }
    void push(std::size_t hand, const std::vector<haptics::StrokeSample>& samples) {
        for (const haptics::StrokeSample& sample : samples) push(hand, sample);
    }
    void update(Nanoseconds now_ns = 0) { ASSERT_TRUE(service->update(now_ns)); }
};

using Strokes = std::vector<haptics::StrokeSample>;

// A hand that wanders over the ball's front and presses and releases now and then; ends released, long after.
Strokes wandering(std::uint64_t seed, std::uint64_t ticks, double side_m) {
    std::mt19937_64 dice(seed);
    const auto between = [&](double lo, double hi) {
        return lo + (hi - lo) * static_cast<double>(dice() >> 11) * 0x1p-53;
    };
    Strokes strokes;
    Vec3 at(side_m, 0.0, 0.09), speed(0.0);
    bool pressed = false;
    for (std::uint64_t tick = 1; tick <= ticks; ++tick) {
        if (tick % 7 == 1) speed = {between(-0.002, 0.002), between(-0.002, 0.002), between(-0.0005, 0.0005)};
        if (dice() % 12 == 0) pressed = !pressed;
        at += speed;
        at = glm::clamp(at, Vec3(side_m - 0.03, -0.03, 0.085), Vec3(side_m + 0.03, 0.03, 0.095));
        strokes.push_back(sample_at(tick, at, pressed));
        strokes.back().orientation_object = glm::normalize(Quat(1.0, at.x, 10.0 * at.y, at.z));
        strokes.back().flags = haptics::kTickInContact;
    }
    strokes.push_back(sample_at(ticks + 1, at, false));
    strokes.push_back(sample_at(ticks + 50, at, false));  // so that all before is complete
    return strokes;
}

// Pressed at a place from one tick to another, and released in the next; in the air before and after.
Strokes press(const Vec3& place, std::uint64_t from, std::uint64_t to, std::uint64_t until = 100) {
    Strokes strokes;
    for (std::uint64_t tick = 1; tick <= until; ++tick)
        strokes.push_back(sample_at(tick, place + Vec3(0.0, 0.0005 * double(tick), 0.0), tick >= from && tick <= to));
    return strokes;
}

const Vec3 kHere(0.0, 0.0, 0.095);

}  // namespace

// ---- The order

TEST(Hands, AtOnePlaceGiveTheSameSolidHoweverLateTheirSamplesAre) {
    const Tool box{compute::BoxTool{Vec3(0.012, 0.008, 0.005)}, compute::Operation::fill};
    const Tool smooth = ball_tool(compute::Operation::smooth, 0.015);
    for (const Tool& other : {ball_tool(), ball_tool(compute::Operation::fill, 0.015), box, smooth}) {
        const std::vector<Tool> tools{ball_tool(), other};
        const std::vector<Strokes> hands{wandering(1, 200, -0.005), wandering(2, 200, 0.005)};
        Table at_once(tools);
        for (std::size_t hand = 0; hand < 2; ++hand) at_once.push(hand, hands[hand]);
        at_once.update();
        ASSERT_GT(at_once.undoable(), 3u);
        for (std::uint64_t seed = 0; seed < 3; ++seed) {
            // Samples come in bursts, one hand up to 15 ms before the other; updates come whenever they like.
            std::mt19937_64 dice(seed);
            Table table(tools);
            std::size_t done[2] = {0, 0};
            while (done[0] < hands[0].size() || done[1] < hands[1].size()) {
                const std::size_t hand = dice() % 2;
                for (std::uint64_t burst = dice() % 6; burst > 0 && done[hand] < hands[hand].size(); --burst) {
                    if (done[hand] > done[1 - hand] + 15) break;
                    table.push(hand, hands[hand][done[hand]++]);
                }
                if (dice() % 3 == 0) table.update();
            }
            table.update();
            EXPECT_TRUE(table.solid().same_content(at_once.solid())) << seed;
            EXPECT_EQ(table.undoable(), at_once.undoable()) << seed;
        }
    }
}

TEST(Hands, OfTwoThreadsGiveTheSameSolidAsInOrder) {
    const std::vector<Tool> tools{ball_tool(), ball_tool(compute::Operation::fill, 0.015)};
    const std::vector<Strokes> hands{wandering(3, 150, -0.005), wandering(4, 150, 0.005)};
    Table in_order(tools), table(tools);
    for (std::size_t hand = 0; hand < 2; ++hand) in_order.push(hand, hands[hand]);
    in_order.update();
    std::atomic<int> writing = 2;
    std::vector<std::thread> threads;
    for (std::size_t hand = 0; hand < 2; ++hand) {
        threads.emplace_back([&, hand] {
            for (std::size_t i = 0; i < hands[hand].size(); ++i) {
                EXPECT_TRUE(table.channels[hand].stroke.push(hands[hand][i]));
                if (i % (3 + hand) == 0) std::this_thread::sleep_for(std::chrono::microseconds(300));
            }
            --writing;
        });
    }
    while (writing > 0) table.update();
    for (std::thread& thread : threads) thread.join();
    table.update();
    EXPECT_TRUE(table.solid().same_content(in_order.solid()));
    EXPECT_EQ(table.undoable(), in_order.undoable());
}

TEST(Hands, WhoComesLaterWinsAndOfTheSameTickTheSecondHand) {
    struct Case {
        std::uint64_t cut_tick, fill_tick;
        bool filled;
    };
    // Stamps at one place; the filling hand is the first one in half of the cases.
    for (const Case& c : {Case{20, 21, true}, {21, 20, false}, {4, 6, true}, {6, 4, false}, {4, 93, true}}) {
        for (const std::size_t filler : {std::size_t{0}, std::size_t{1}}) {
            std::vector<Tool> tools{ball_tool(), ball_tool()};
            tools[filler] = ball_tool(compute::Operation::fill);
            Table table(tools);
            for (std::size_t hand = 0; hand < 2; ++hand) {
                const std::uint64_t tick = hand == filler ? c.fill_tick : c.cut_tick;
                for (std::uint64_t i = 1; i < 100; ++i) table.push(hand, sample_at(i, kHere, i == tick));
            }
            table.update();
            // In the middle of the two stamps there is material exactly when it was filled last.
            const compute::ToolSweep cut = ball_tool().sweep({kHere, {1, 0, 0, 0}}, {kHere, {1, 0, 0, 0}});
            compute::ToolSweep fill = cut;
            fill.operation = compute::Operation::fill;
            Table expected({ball_tool()});
            ASSERT_TRUE(expected.carving.update(c.filled ? std::vector{cut, fill} : std::vector{fill, cut}));
            EXPECT_TRUE(table.solid().same_content(expected.solid()))
                << c.cut_tick << ' ' << c.fill_tick << ' ' << filler;
        }
    }
    for (const std::size_t filler : {std::size_t{0}, std::size_t{1}}) {  // at the same tick
        std::vector<Tool> tools{ball_tool(), ball_tool()};
        tools[filler] = ball_tool(compute::Operation::fill);
        Table table(tools), expected({ball_tool()});
        std::vector<compute::ToolSweep> sweeps;
        for (std::size_t hand = 0; hand < 2; ++hand) {
            for (std::uint64_t i = 1; i < 100; ++i) table.push(hand, sample_at(i, kHere, i == 42));
            sweeps.push_back(tools[hand].sweep({kHere, {1, 0, 0, 0}}, {kHere, {1, 0, 0, 0}}));
        }
        table.update();
        ASSERT_TRUE(expected.carving.update(sweeps));
        EXPECT_TRUE(table.solid().same_content(expected.solid())) << filler;
    }
}

TEST(Hands, FarApartCarveWhatEachCarvesAlone) {
    // Each is released at the end of a slice.
    const Strokes hands[2] = {press({-0.06, -0.02, 0.07}, 12, 78), press({0.06, -0.02, 0.07}, 21, 58)};
    const Tool small = ball_tool(compute::Operation::cut, 0.008);
    Table both({small, small}), alone({small});
    for (std::size_t hand = 0; hand < 2; ++hand) both.push(hand, hands[hand]);
    both.update();
    // One after the other, each by a service of its own at the same sculpture, updated as often as there are slices.
    for (const Strokes& strokes : hands) {
        haptics::HapticChannels channels(4096, 2);
        SculptService service(alone.carving, channels, small, 0.0, 0.02, {});
        Nanoseconds slice = 0;
        for (const haptics::StrokeSample& sample : strokes) {
            const bool begins_a_slice = sample.time_ns / SculptService::kSlice_ns != slice;
            if (begins_a_slice) {
                ASSERT_TRUE(service.update(0));
            }
            slice = sample.time_ns / SculptService::kSlice_ns;
            ASSERT_TRUE(channels.stroke.push(sample));
        }
        ASSERT_TRUE(service.update(0));
    }
    EXPECT_TRUE(both.solid().same_content(alone.solid()));
    EXPECT_LT(both.carving.surface().volume_m3(), 0.9999 * both.carving.initial_volume_m3());
    EXPECT_EQ(both.carving.figures().sweeps, alone.carving.figures().sweeps)
        << "as few sweeps as stand for the samples";
}

TEST(Hands, AHandThatWritesNothingHoldsTheOthersUpForAMomentOnly) {
    Table table({ball_tool(), ball_tool()});
    for (std::uint64_t tick = 100; tick <= 110; ++tick) table.push(0, sample_at(tick, kHere, true));
    table.push(1, sample_at(99, kHere, false));
    table.update(110 * kMs);
    EXPECT_EQ(table.carving.figures().rays_changed, 0u) << "the other may have worked there before";
    table.update(100 * kMs + SculptService::kPatience_ns);
    EXPECT_GT(table.carving.figures().rays_changed, 0u);
    // What it says in the end is carved after what has not waited for it, is counted, and is told once.
    Table late({ball_tool(), ball_tool(compute::Operation::fill)}), expected({ball_tool()});
    for (std::uint64_t tick = 100; tick <= 110; ++tick) late.push(0, sample_at(tick, kHere, tick == 104));
    late.update(300 * kMs);
    for (std::uint64_t tick = 100; tick <= 110; ++tick)
        late.push(1, sample_at(tick, kHere, tick == 102 || tick == 103));
    late.update(301 * kMs);
    const auto stamp = [](const Tool& tool) { return tool.sweep({kHere, {1, 0, 0, 0}}, {kHere, {1, 0, 0, 0}}); };
    ASSERT_TRUE(expected.carving.update(std::vector{stamp(ball_tool()), stamp(ball_tool(compute::Operation::fill))}));
    EXPECT_TRUE(late.solid().same_content(expected.solid()));
    EXPECT_EQ(late.service->late_samples(0), 0u);
    EXPECT_EQ(late.service->late_samples(1), 11u);
    const auto told = late.service->take_surface_update();
    ASSERT_TRUE(told);
    ASSERT_EQ(told->messages.size(), 1u);
    EXPECT_NE(told->messages[0].find("hand 1"), std::string::npos);
    // The last update waits for nobody.
    Table ended({ball_tool(), ball_tool()});
    for (std::uint64_t tick = 100; tick <= 110; ++tick) ended.push(0, sample_at(tick, kHere, true));
    ASSERT_TRUE(ended.service->finish(111 * kMs));
    EXPECT_GT(ended.carving.figures().rays_changed, 0u);
}

TEST(Hands, ARecordedUpdateIsRepeatedAlsoWhereSamplesCameTooLate) {
    const std::vector<Tool> tools{ball_tool(), ball_tool(compute::Operation::fill, 0.015)};
    const std::vector<Strokes> hands{wandering(7, 120, -0.005), wandering(8, 120, 0.005)};
    Table table(tools), again(tools);
    std::vector<UpdateSeen> seen;
    std::size_t done[2] = {0, 0};
    // The second hand is 140 ms behind, so that it is not waited for.
    for (Nanoseconds now_ns = 0; done[1] < hands[1].size(); now_ns += 7 * kMs) {
        while (done[0] < hands[0].size() && hands[0][done[0]].time_ns <= now_ns) table.push(0, hands[0][done[0]++]);
        while (done[1] < hands[1].size() && hands[1][done[1]].time_ns <= now_ns - 140 * kMs)
            table.push(1, hands[1][done[1]++]);
        table.update(now_ns);
        seen.push_back(table.service->seen());
    }
    for (std::size_t hand = 0; hand < 2; ++hand) again.push(hand, hands[hand]);  // all there from the start
    for (const UpdateSeen& one : seen) {
        ASSERT_TRUE(again.service->repeat(one));
        EXPECT_EQ(again.service->seen(), one);
    }
    EXPECT_TRUE(again.solid().same_content(table.solid()));
    EXPECT_EQ(again.undoable(), table.undoable());
    Table in_order(tools);
    for (std::size_t hand = 0; hand < 2; ++hand) in_order.push(hand, hands[hand]);
    in_order.update();
    EXPECT_FALSE(in_order.solid().same_content(table.solid())) << "lateness made no difference: the test shows nothing";
}

// ---- Undo

// Strokes at different places, one after the other, overlapping in time, or one within the other.
TEST(Hands, AStrokeOfOneIsUndoneAloneAlsoWhereTheOthersLieBetween) {
    const Vec3 places[2] = {Vec3(-0.05, 0.0, 0.08), Vec3(0.05, 0.0, 0.08)};
    struct Case {
        std::uint64_t from[2], to[2];
        std::size_t ends_last;
    };
    for (const Case& c : {Case{{10, 60}, {30, 80}, 1}, Case{{10, 20}, {30, 80}, 1}, Case{{10, 20}, {80, 30}, 0},
                          Case{{10, 12}, {13, 12}, 0}, Case{{10, 10}, {30, 30}, 1}}) {
        for (const compute::Operation second : {compute::Operation::cut, compute::Operation::fill}) {
            const std::vector<Tool> tools{ball_tool(), ball_tool(second)};
            Table table(tools), alone(tools);
            const compute::Solid before = table.solid();
            for (std::size_t hand = 0; hand < 2; ++hand) {
                table.push(hand, press(places[hand], c.from[hand], c.to[hand]));
                const bool stays = hand != c.ends_last;
                alone.push(hand, press(places[hand], stays ? c.from[hand] : 200, c.to[hand]));
            }
            table.update();
            alone.update();
            ASSERT_EQ(table.undoable(), 2u) << c.from[0] << ' ' << c.from[1];
            const compute::Solid both = table.solid();
            table.service->order(UndoStroke{});
            EXPECT_EQ(table.undoable(), 1u);
            EXPECT_TRUE(table.solid().same_content(alone.solid())) << c.from[0] << ' ' << c.from[1];
            EXPECT_FALSE(table.solid().same_content(before));
            table.service->order(UndoStroke{});
            EXPECT_TRUE(table.solid().same_content(before));
            for (int i = 0; i < 2; ++i) table.service->order(RedoStroke{});
            EXPECT_TRUE(table.solid().same_content(both));
        }
    }
}

TEST(Hands, StrokesThatMetWhileBothPressedAreOneUndoAndNothingIsLost) {
    struct Case {
        std::uint64_t from[2], to[2];
        std::size_t strokes;
    };
    // A hand is released in the tick after its last pressed one.
    for (const Case& c : {Case{{10, 60}, {30, 80}, 2},     // one after the other
                          Case{{10, 20}, {30, 80}, 1},     // overlapping
                          Case{{10, 20}, {80, 30}, 1},     // one within the other
                          Case{{10, 31}, {30, 80}, 1},     // pressed in the tick in which the other is released
                          Case{{10, 32}, {30, 80}, 2},     // a tick later
                          Case{{10, 10}, {30, 30}, 1},     // together
                          Case{{11, 13}, {11, 13}, 2}}) {  // clicks within a slice
        const std::vector<Tool> tools{ball_tool(), ball_tool(compute::Operation::fill, 0.015)};
        Table table(tools), first(tools);
        for (std::size_t hand = 0; hand < 2; ++hand) {
            table.push(hand, press(kHere, c.from[hand], c.to[hand]));
            first.push(hand, press(kHere, hand == 0 ? c.from[0] : 200, c.to[hand]));
        }
        const compute::Solid before = table.solid();
        table.update();
        first.update();
        ASSERT_EQ(table.undoable(), c.strokes) << c.from[0] << ' ' << c.from[1];
        table.service->order(UndoStroke{});
        if (c.strokes == 2) {
            EXPECT_TRUE(table.solid().same_content(first.solid())) << c.from[0] << ' ' << c.from[1];
            table.service->order(UndoStroke{});
        }
        EXPECT_TRUE(table.solid().same_content(before));
        EXPECT_EQ(table.undoable(), 0u);
    }
}

// ---- What each hand has of its own

TEST(Hands, EachIsHandedTheSurfaceAroundItsOwnTool) {
    Table table({ball_tool(), ball_tool(compute::Operation::cut, 0.01)});
    const Vec3 left(-0.05, 0.0, 0.09), right(0.05, 0.0, 0.09);
    table.service->start_at(left, 0);
    table.service->start_at(right, 1);
    table.update(5 * kMs);
    const geometry::LocalSurface* surfaces[2] = {&table.channels[0].surface.newest(),
                                                 &table.channels[1].surface.newest()};
    EXPECT_EQ(surfaces[0]->center_object, left);
    EXPECT_EQ(surfaces[1]->center_object, right);
    EXPECT_GT(surfaces[0]->radius_m, surfaces[1]->radius_m) << "it has the larger tool";
    for (const geometry::LocalSurface* surface : surfaces) {
        EXPECT_EQ(surface->sequence, 1u);
        EXPECT_EQ(surface->made_ns, 5 * kMs);
    }
    // Also before its samples are carved, as they wait for those of the other: the tool is there already.
    table.push(1, sample_at(1, left, false));
    table.update();
    EXPECT_EQ(table.channels[1].surface.newest().center_object, left);
    // And each sees what the other has carved.
    const double before = table.carving.surface().volume_m3();
    for (std::uint64_t tick = 10; tick < 40; ++tick) {
        table.push(0, sample_at(tick, left, tick < 30));
        table.push(1, sample_at(tick, left, false));
    }
    table.update();
    EXPECT_LT(table.carving.surface().volume_m3(), before);
    EXPECT_EQ(table.channels[1].surface.newest().sequence, 3u);
}

TEST(Hands, AnOrderForAToolIsForOneHand) {
    Table table({ball_tool(), ball_tool()});
    table.service->order(UseTool{ball_tool(compute::Operation::fill), {"skin"}, 0.0, 1});
    for (std::uint64_t tick = 1; tick < 100; ++tick) {
        table.push(0, sample_at(tick, kHere + Vec3(-0.05, 0.0, 0.0), tick > 50 && tick < 60));
        table.push(1, sample_at(tick, Vec3(0.05, 0.0, 0.11), tick > 10 && tick < 20));
    }
    const double before = table.carving.initial_volume_m3();
    table.update();
    const double both = table.carving.surface().volume_m3();
    table.service->order(UndoStroke{});  // of the first hand, which cut
    const double filled = table.carving.surface().volume_m3();
    EXPECT_GT(filled, before);
    EXPECT_LT(both, filled);
    static_cast<void>(table.service->take_surface_update());
    table.service->order(UseTool{ball_tool(), {"skin"}, 0.0, 2});
    const auto update = table.service->take_surface_update();
    ASSERT_TRUE(update);
    EXPECT_EQ(update->messages, std::vector<std::string>{"there is no hand 2"});
}

TEST(Hands, AToolThatOneCannotUseLeavesTheOtherCarving) {
    Table table({ball_tool(), ball_tool()});
    Tool smooth = ball_tool(compute::Operation::smooth, 0.7);  // more than a hundred cells of 6.25 mm
    table.service->order(UseTool{smooth, {"skin"}, 0.0, 0});
    const auto ray_changes = [&](std::size_t hand, std::uint64_t from) {
        for (std::uint64_t tick = from; tick < from + 40; ++tick)
            for (std::size_t i = 0; i < 2; ++i) {
                haptics::StrokeSample sample = sample_at(tick, kHere, i == hand && tick < from + 20);
                sample.flags = haptics::kTickInContact;
                table.push(i, sample);
            }
        const std::uint64_t before = table.carving.figures().rays_changed;
        table.update();
        return table.carving.figures().rays_changed - before;
    };
    EXPECT_EQ(ray_changes(0, 1), 0u);
    EXPECT_GT(ray_changes(1, 100), 0u);
}

// A ring that overflows, and a hand that ends in the middle of a stroke: the other's strokes are what they are alone.
TEST(Hands, WhatOneLosesIsItsOwn) {
    const Strokes left = press({-0.06, -0.02, 0.07}, 12, 78), right = press({0.06, -0.02, 0.07}, 22, 60, 60);
    const auto samples = [](std::uint64_t from, std::uint64_t to, const Strokes& of) {
        return Strokes(of.begin() + static_cast<std::ptrdiff_t>(from), of.begin() + static_cast<std::ptrdiff_t>(to));
    };
    for (const bool overflows : {true, false}) {
        Table table({ball_tool(), ball_tool()}), alone({ball_tool(), ball_tool()});
        for (std::uint64_t tick = 0; tick < 100; tick += 10) {
            table.push(0, samples(tick, tick + 10, left));
            alone.push(0, samples(tick, tick + 10, left));
            alone.push(1, sample_at(tick + 10, {0.06, 0.0, 0.2}, false));
            if (tick < 60) table.push(1, samples(tick, tick + 10, right));
            if (overflows && tick == 30) {  // the ring is full before the carving side comes to it
                int lost = 0;
                for (int i = 0; i < 5000; ++i)
                    lost += table.channels[1].stroke.push(sample_at(41, {0.06, 0.0, 0.09}, true)) ? 0 : 1;
                EXPECT_EQ(table.channels[1].stroke.refused(), static_cast<std::uint64_t>(lost));
                EXPECT_GT(lost, 0);
            }
            table.update(static_cast<Nanoseconds>(tick + 10) * kMs);
            alone.update(static_cast<Nanoseconds>(tick + 10) * kMs);
        }
        EXPECT_EQ(table.channels[0].stroke.refused(), 0u);
        table.update(300 * kMs);
        alone.update(300 * kMs);
        ASSERT_EQ(table.undoable(), 2u);
        table.service->order(UndoStroke{});  // of the second hand, which did not let go
        EXPECT_TRUE(table.solid().same_content(alone.solid())) << overflows;
    }
}

}  // namespace burin::sculpt
