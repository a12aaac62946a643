// SPDX-License-Identifier: MIT
// The loop that drives every session, and the executor that does ticks and updates on the caller's thread.
#include "session/drive/driver.hpp"
#include "session/drive/executors.hpp"

#include <gtest/gtest.h>

#include <string>

#include "desk/run/session.hpp"
#include "devices/haptic/simulated_omni.hpp"
#include "devices/haptic/simulated_wand.hpp"
#include "haptics/channels.hpp"
#include "sculpt/carved_scene.hpp"
#include "sculpt/load_workpiece.hpp"
#include "tests/support/test_units.hpp"

namespace burin::session {
namespace {

// Notes what it is asked for; fails at a time of choice.
class NotingExecutor final : public Executor {
public:
    explicit NotingExecutor(std::vector<std::string>& notes, Nanoseconds fails_at_ns = -1)
        : notes_(notes), fails_at_ns_(fails_at_ns) {}
    [[nodiscard]] Result<void> advance_to(Nanoseconds until_ns) override {
        notes_.push_back("advance to " + std::to_string(until_ns));
        if (until_ns == fails_at_ns_) return fail("executor", "it fails", "");
        return {};
    }
    [[nodiscard]] std::vector<haptics::ToolState> tools() override { return {{}}; }
    void order(Order) override {}
    [[nodiscard]] Result<Taken> take_updates() override { return Taken{}; }
    void stop() override { notes_.emplace_back("stop"); }

private:
    std::vector<std::string>& notes_;
    Nanoseconds fails_at_ns_;
};

// Three frames, of which one fails if that is wanted.
class NotingFrames final : public FrameSource {
public:
    explicit NotingFrames(std::vector<std::string>& notes, Nanoseconds fails_at_ns = -1)
        : notes_(notes), fails_at_ns_(fails_at_ns) {}
    [[nodiscard]] std::optional<Nanoseconds> next() override {
        if (due_ns_ == 3) return std::nullopt;
        return ++due_ns_;
    }
    [[nodiscard]] Result<void> make(Executor&) override {
        notes_.push_back("make " + std::to_string(due_ns_));
        if (due_ns_ == fails_at_ns_) return fail("frames", "one fails", "");
        return {};
    }

private:
    std::vector<std::string>& notes_;
    Nanoseconds fails_at_ns_, due_ns_ = 0;
};

// A loop and a carving side around a small ball, which nobody touches.
struct Parts {
    explicit Parts(Nanoseconds start_ns = 0) : clock(clock_at(start_ns)) {
        haptics::TickParameters& parameters = channels.parameters.draft();
        parameters.sequence = 1;
        channels.parameters.publish();
    }
    static SimulatedClock clock_at(Nanoseconds start_ns) {
        SimulatedClock clock;
        clock.sleep_until(start_ns);
        return clock;
    }
    static std::unique_ptr<compute::CarvingEngine> engine(WorkerPool& pool) {
        Result<workpiece::LoadedWorkpiece> workpiece = sculpt::load_workpiece({"ball:0.05", 16, false}, pool);
        return compute::make_cpu_engine(std::move(workpiece->solid), pool);
    }
    [[nodiscard]] std::uint64_t ticks() const { return loop.ticks(); }

    WorkerPool pool{1};
    sculpt::Sculpture carving{engine(pool), pool};
    SimulatedClock clock;
    haptics::HapticChannels channels;
    devices::SimulatedOmni omni{
        *devices::SimulatedHand::create({{0.0, Vec3(0.0), Quat{1, 0, 0, 0}, 0}}, devices::HandPath::straight, {}),
        {},
        &clock};
    haptics::HapticLoop loop{omni, clock, channels};
    sculpt::CarvedScene carved{carving, channels, toolbox::Tool{compute::BallTool{0.005}}, 1e6, 0.01, {}};
    SteppedExecutor executor{clock, loop, {&channels}, carved.service()};
};

}  // namespace

TEST(Driver, AdvancesToEachFrameBeforeItIsMadeAndStopsAtTheEnd) {
    std::vector<std::string> notes;
    NotingExecutor executor(notes);
    NotingFrames frames(notes);
    EXPECT_TRUE(drive(executor, frames));
    EXPECT_EQ(notes, (std::vector<std::string>{"advance to 1", "make 1", "advance to 2", "make 2", "advance to 3",
                                               "make 3", "stop"}));
}

TEST(Driver, EndsAtTheFirstErrorAndStopsTheThreadsAllTheSame) {
    std::vector<std::string> notes;
    NotingExecutor failing(notes, 2);
    NotingFrames frames(notes);
    const Result<void> carving = drive(failing, frames);
    ASSERT_FALSE(carving);
    EXPECT_NE(carving.error().line().find("executor"), std::string::npos);
    EXPECT_EQ(notes, (std::vector<std::string>{"advance to 1", "make 1", "advance to 2", "stop"}));

    notes.clear();
    NotingExecutor executor(notes);
    NotingFrames failing_frames(notes, 2);
    const Result<void> drawing = drive(executor, failing_frames);
    ASSERT_FALSE(drawing);
    EXPECT_NE(drawing.error().line().find("frames"), std::string::npos);
    EXPECT_EQ(notes, (std::vector<std::string>{"advance to 1", "make 1", "advance to 2", "make 2", "stop"}));
}

// A loop that rests takes 71 ticks a second: times in contact and smoothness of a trial would be those of another
// motion.
TEST(Pace, RestsOnlyWhereNeitherAnActivityNorAPersonMissesATick) {
    devices::DeviceDescription held, simulated;
    simulated.felt_by_person = false;
    for (const bool asked : {false, true})
        for (const bool has_activity : {false, true})
            for (const devices::DeviceDescription& device : {held, simulated}) {
                const haptics::LoopPace pace =
                    pace_of({.lead_ns = 7, .rests = asked}, device.felt_by_person, has_activity);
                EXPECT_EQ(pace.rests, asked && !has_activity && !device.felt_by_person);
                EXPECT_EQ(pace.lead_ns, 7);
            }
    EXPECT_TRUE(held.felt_by_person) << "a driver that does not say is a real device's";
}

TEST(Pace, KnowsThatASimulatedDeviceIsFeltByNobody) {
    const auto hand = devices::SimulatedHand::create({{}});
    ASSERT_TRUE(hand) << hand.error().line();
    EXPECT_FALSE(devices::SimulatedOmni(*hand).description().felt_by_person);
    EXPECT_FALSE(devices::SimulatedWand(*hand).description().felt_by_person);
}

TEST(SteppedExecutor, TicksEachPeriodAndCarvesAfterEveryTenthTick) {
    Parts parts;
    ASSERT_TRUE(parts.executor.advance_to(9 * kMs));
    EXPECT_EQ(parts.ticks(), 9u);
    EXPECT_EQ(parts.carved.service().seen().last_ticks[0], 0u) << "an update came before its time";
    ASSERT_TRUE(parts.executor.advance_to(10 * kMs));
    EXPECT_EQ(parts.carved.service().seen().last_ticks[0], 10u) << "the update of 10 ms has the sample of that tick";
    EXPECT_EQ(parts.carved.published(), 1u);
    ASSERT_TRUE(parts.executor.advance_to(95 * kMs));
    EXPECT_EQ(parts.ticks(), 95u);
    EXPECT_EQ(parts.carved.published(), 9u);
    EXPECT_EQ(parts.carved.service().seen().last_ticks[0], 90u);
}

TEST(SteppedExecutor, DoesNothingOfATimeThatHasPassedAndNoPartOfATick) {
    Parts parts(5 * kNanosecondsPerSecond);
    const Nanoseconds start_ns = parts.clock.now_ns();
    ASSERT_TRUE(parts.executor.advance_to(0));
    EXPECT_EQ(parts.ticks(), 0u);
    ASSERT_TRUE(parts.executor.advance_to(start_ns + 2 * kMs + kMs / 2));
    EXPECT_EQ(parts.ticks(), 2u);
    EXPECT_EQ(parts.clock.now_ns(), start_ns + 2 * kMs);
    ASSERT_TRUE(parts.executor.advance_to(start_ns + 3 * kMs));
    EXPECT_EQ(parts.ticks(), 3u) << "half a tick was lost";
    ASSERT_TRUE(parts.executor.advance_to(start_ns + 10 * kMs));
    EXPECT_EQ(parts.carved.published(), 1u) << "updates count from the executor's start";
}

TEST(SteppedExecutor, MeasuresEachTick) {
    Parts parts;
    ASSERT_TRUE(parts.executor.advance_to(3 * kMs));
    std::vector<std::uint32_t> durations_ns;
    parts.executor.measure_ticks(durations_ns);
    ASSERT_TRUE(parts.executor.advance_to(20 * kMs));
    EXPECT_EQ(durations_ns.size(), 17u);
}

}  // namespace burin::session
