// SPDX-License-Identifier: MIT
// Ticks of two hands whose streams go out meanwhile: the haptic thread allocates, locks, throws and opens nothing, also
// where the library does not take what it is given.
#include <gtest/gtest.h>

#include <array>
#include <utility>
#include <vector>

#include "haptics/channels.hpp"
#include "haptics/haptic_loop.hpp"
#include "session/hands/session_hands.hpp"
#include "session/stream/tick_pump.hpp"
#include "tests/session/stream/stand_in.hpp"
#include "tests/support/realtime_counters.hpp"

namespace burin::session {
namespace {

// Returns what so many turns of the loop have cost its thread, while their ticks are streamed.
test::RealtimeCounts cost_of_turns(StandInLsl& library, int turns, StreamFigures& figures) {
    MonotonicClock clock;
    SessionHands hands({4096, 4096}, 1.0);
    const std::array wanted{HandToOpen{"right", "simulated", {}}, HandToOpen{"left", "simulated", {}}};
    EXPECT_TRUE(hands.open(wanted, clock));
    StreamPlan plan;
    plan.source = "burin-test";
    plan.rows = 256;
    std::vector<Ring<haptics::TickRecord>*> rings;
    for (std::size_t part = 0; part < hands.parts(); ++part) {
        plan.parts.push_back({hands.name_of(part), hands.device(part), {}, 1000.0});
        rings.push_back(&hands.channels(part).records);
    }
    auto streams = LslStreams::open(library.api, std::move(plan), clock).value();
    TickPump pump(std::move(rings),
                  [&](std::size_t part, const haptics::TickRecord& tick) { streams->tick(part, tick); });
    test::RealtimeCounts counts;
    for (int turn = 0; turn < turns; ++turn) {
        clock.sleep_until(clock.now_ns() + 1'000'000);
        const test::RealtimeScope scope;
        static_cast<void>(hands.loop().step());
        counts += scope.counts();
    }
    pump.stop();
    library.set([&] { library.lsl.blocks_pushes = false; });
    figures = streams->close();
    return counts;
}

void expect_no_cost(const test::RealtimeCounts& counts) {
    EXPECT_EQ(counts.allocations, 0u);
    EXPECT_EQ(counts.frees, 0u);
    EXPECT_EQ(counts.locks, 0u);
    EXPECT_EQ(counts.throws, 0u);
    EXPECT_EQ(counts.files, 0u);
}

}  // namespace

TEST(StreamedTicks, CostTheHapticThreadNothing) {
    StandInLsl library;
    StreamFigures figures;
    expect_no_cost(cost_of_turns(library, 2000, figures));
    EXPECT_EQ(figures.ticks + figures.dropped_ticks, 4000u) << "two hands' ticks, each once";
    EXPECT_EQ(figures.refused_ticks + figures.unordered, 0u);
}

TEST(StreamedTicks, CostTheHapticThreadNothingWhereTheLibraryTakesNone) {
    StandInLsl library;
    library.set([&] { library.lsl.blocks_pushes = true; });
    StreamFigures figures;
    expect_no_cost(cost_of_turns(library, 1000, figures));
    EXPECT_EQ(figures.ticks + figures.dropped_ticks, 2000u);
    EXPECT_GT(figures.dropped_ticks, 0u) << "256 rows hold a quarter of them";
}

}  // namespace burin::session
