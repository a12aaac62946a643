// SPDX-License-Identifier: MIT
// A device of several parts: each is felt by itself, with limits, gate and energy account of its own.
#include <gtest/gtest.h>

#include <cstring>
#include <string>

#include "haptics/tick.hpp"
#include "tests/haptics/bodies.hpp"
#include "tests/haptics/fingertip.hpp"

namespace burin::haptics {
namespace {

using test::PartsRig;

template <typename T>
bool same_bits(const T& a, const T& b) {
    return std::memcmp(&a, &b, sizeof(T)) == 0;
}

void expect_same(const TickRecord& a, const TickRecord& b) {
    ASSERT_EQ(a.tick, b.tick);
    ASSERT_EQ(a.time_ns, b.time_ns);
    ASSERT_TRUE(same_bits(a.sample.position_device_m, b.sample.position_device_m)) << a.tick;
    ASSERT_TRUE(same_bits(a.wanted.force_device_N, b.wanted.force_device_N)) << a.tick;
    ASSERT_TRUE(same_bits(a.gate.given.force_device_N, b.gate.given.force_device_N)) << a.tick;
    ASSERT_TRUE(same_bits(a.deepest().proxy_object_m, b.deepest().proxy_object_m)) << a.tick;
    ASSERT_TRUE(same_bits(a.passivity.budget_J, b.passivity.budget_J)) << a.tick;
    ASSERT_EQ(a.flags, b.flags) << a.tick;
    ASSERT_EQ(a.gate.cause, b.gate.cause) << a.tick;
    ASSERT_EQ(a.contact.work.triangles_tested, b.contact.work.triangles_tested) << a.tick;
}

bool is_given_nothing(const TickRecord& record) { return record.gate.given.force_device_N == Vec3(0.0); }

}  // namespace

TEST(Parts, EachPointOfAFingertipIsPushedBackByItsOwnDepth) {
    // The mesh lies up to 8 um below its sphere, and a proxy is found to a micrometre: 4 mN of up to 2 N. A facet's
    // normal differs from the sphere's by what its corners are away, over the radius.
    constexpr double kTolerance_N = test::kStiffness_N_per_m * 9e-6, kTilt = 0.0007 / test::kSphere_m;
    for (const bool keeps_promise : {false, true}) {  // with the energy account, which may give less, and without
        PartsRig rig(test::point_hands(5, 3.0));
        rig.publish(*test::fingertip_sphere());
        TickParameters parameters = test::point_parameters();
        parameters.passivity.control = keeps_promise;
        rig.publish_to_all(parameters);
        std::array<int, 5> touched{}, given{};
        for (int turn = 0; turn < 3000; ++turn) {
            const std::vector<TickRecord> records = rig.turn();
            for (std::size_t i = 0; i < records.size(); ++i) {
                const TickRecord& r = records[i];
                const Vec3 book = test::force_by_the_book(r.sample.position_device_m);
                const Vec3 wanted = r.deepest().force_device_N, force = r.gate.given.force_device_N;
                ASSERT_NEAR(glm::length(wanted), glm::length(book), kTolerance_N) << turn << " part " << i;
                ASSERT_LE(glm::length(wanted - book), kTolerance_N + kTilt * glm::length(book)) << turn << ' ' << i;
                ASSERT_LE(glm::length(force), glm::length(book) + kTolerance_N) << turn << " part " << i;
                touched[i] += r.in_contact() ? 1 : 0;
                given[i] += r.in_contact() && glm::length(force - wanted) < 1e-12 ? 1 : 0;
            }
        }
        for (std::size_t i = 0; i < touched.size(); ++i) {
            EXPECT_GT(touched[i], 1000) << i;
            // All but the ramp at the start; with the account where a press is deep enough to afford it.
            EXPECT_GT(given[i], keeps_promise ? 0 : touched[i] * 9 / 10) << i;
        }
    }
}

TEST(Parts, OneOfFiveTicksAsItDoesAlone) {
    const test::Surface sphere = test::fingertip_sphere();
    PartsRig together(test::point_hands(5, 1.0));
    std::deque<PartsRig> alone;
    for (std::size_t i = 0; i < 5; ++i) {
        std::vector<devices::SimulatedHand> hand{test::point_hand(i, 1.0)};
        alone.emplace_back(std::move(hand)).publish(*sphere);
        alone.back().publish_to_all(test::point_parameters());
    }
    together.publish(*sphere);
    together.publish_to_all(test::point_parameters());
    int touched = 0;
    for (int turn = 0; turn < 1000; ++turn) {
        const std::vector<TickRecord> records = together.turn();
        for (std::size_t i = 0; i < 5; ++i) {
            expect_same(records[i], alone[i].turn()[0]);
            touched += records[i].in_contact() ? 1 : 0;
        }
    }
    EXPECT_GT(touched, 1000);
}

// Two hands, and a hand of four fingers: as the work is counted, on the reference core.
TEST(Parts, CostTogetherAtMostWhatTheyCostAlone) {
    const test::Surface sphere = test::fingertip_sphere();
    for (const std::size_t count : {2u, 4u}) {
        PartsRig together(test::point_hands(count, 1.0));
        std::deque<PartsRig> alone;
        for (std::size_t i = 0; i < count; ++i) {
            std::vector<devices::SimulatedHand> hand{test::point_hand(i, 1.0)};
            alone.emplace_back(std::move(hand)).publish(*sphere);
            alone.back().publish_to_all(test::point_parameters());
        }
        together.publish(*sphere);
        together.publish_to_all(test::point_parameters());
        double together_ns = 0.0, alone_ns = 0.0;
        for (int turn = 0; turn < 2000; ++turn) {
            for (const TickRecord& record : together.turn()) together_ns += cost_ns(record.contact.work);
            for (PartsRig& one : alone) alone_ns += cost_ns(one.turn()[0].contact.work);
        }
        EXPECT_LE(together_ns, alone_ns) << count;
        EXPECT_GT(together_ns, 0.5 * alone_ns) << count << ": they do not do less";
        const std::string parts = std::to_string(count) + "_parts";
        RecordProperty(parts + "_ns_a_turn", std::to_string(together_ns / 2000));
        RecordProperty(parts + "_alone_ns_a_turn", std::to_string(alone_ns / 2000));
    }
}

// A loop of one part against the pure tick, run as a loop without parts runs it.
TEST(Parts, ALoopOfOneGivesTheBitsOfTheTickAlone) {
    PartsRig rig(test::point_hands(1, 2.0));
    const test::Surface sphere = test::fingertip_sphere();
    const TickParameters parameters = test::point_parameters();
    rig.publish(*sphere);
    rig.publish_to_all(parameters);
    FullTickState state;
    int touched = 0;
    for (int turn = 0; turn < 2000; ++turn) {
        if (turn == 900) rig.fingers.inject(0, devices::InjectedFault::nan_position);
        if (turn == 910) rig.fingers.inject(0, devices::InjectedFault::none);
        const TickRecord r = rig.turn()[0];
        FullTick again =
            full_tick(state, r.sample, *sphere, parameters, rig.fingers.part(0).description(), r.time_ns, 1e-3);
        again.record.tick = static_cast<std::uint64_t>(turn) + 1;
        state = again.next;
        if (turn >= 900 && turn < 910) {
            EXPECT_EQ(r.gate.cause, GateCause::not_finite);
        } else {
            expect_same(r, again.record);
        }
        touched += r.in_contact() ? 1 : 0;
    }
    EXPECT_GT(touched, 500);
}

TEST(Parts, ARecordedTurnOfSeveralIsRepeatedToTheBit) {
    PartsRig rig(test::point_hands(5, 1.0)), again(test::point_hands(5, 1.0));
    const test::Surface sphere = test::fingertip_sphere();
    const TickParameters parameters = test::point_parameters();
    const geometry::LocalSurface nothing;
    rig.publish(*sphere);
    rig.publish_to_all(parameters);
    for (int turn = 0; turn < 1000; ++turn) {
        if (turn == 500) rig.fingers.lose_link(true);
        if (turn == 510) rig.fingers.lose_link(false);
        const std::vector<TickRecord> records = rig.turn();
        std::vector<PartInput> inputs;
        for (const TickRecord& r : records) inputs.push_back({r.sample, sphere.get(), &parameters});
        again.loop.repeat(inputs, records[0].time_ns, 0);
        for (std::size_t i = 0; i < 5; ++i) {
            TickRecord repeated;
            ASSERT_TRUE(again.channels[i].records.pop(repeated));
            for (TickRecord read; again.channels[i].ticks.pop(read);) continue;
            expect_same(records[i], repeated);
        }
    }
}

// ---- Faults

TEST(Parts, AFaultOfOneTakesTheForceOffItAloneAndAtOnce) {
    for (const devices::InjectedFault fault :
         {devices::InjectedFault::nan_position, devices::InjectedFault::frozen, devices::InjectedFault::disconnected,
          devices::InjectedFault::overspeed}) {
        PartsRig rig(test::point_hands(5, 2.0)), healthy(test::point_hands(5, 2.0));
        const test::Surface sphere = test::fingertip_sphere();
        for (PartsRig* one : {&rig, &healthy}) {
            one->publish(*sphere);
            one->publish_to_all(test::point_parameters());
        }
        constexpr std::size_t kFaulty = 2;
        constexpr int kFrom = 900, kTo = 1000;
        const auto named = [&](const TickRecord& r) { return r.gate.cause != GateCause::none; };
        int pressed = 0, off = 0;
        for (int turn = 0; turn < 1500; ++turn) {
            if (turn == kFrom) rig.fingers.inject(kFaulty, fault);
            if (turn == kTo) rig.fingers.inject(kFaulty, devices::InjectedFault::none);
            const std::vector<TickRecord> records = rig.turn(), others = healthy.turn();
            for (std::size_t i = 0; i < 5; ++i) {
                if (i != kFaulty) expect_same(records[i], others[i]);
                pressed += i != kFaulty && !is_given_nothing(records[i]) ? 1 : 0;
            }
            if (named(records[kFaulty])) {
                ++off;
                EXPECT_TRUE(is_given_nothing(records[kFaulty]));
                EXPECT_GE(turn, kFrom);
            }
        }
        EXPECT_GT(off, 50) << static_cast<int>(fault);
        EXPECT_GT(pressed, 1000);
    }
}

TEST(Parts, AFaultOfTheWholeDeviceTakesTheForceOffAllInTheSameTurn) {
    PartsRig rig(test::point_hands(5, 2.0));
    rig.publish(*test::fingertip_sphere());
    rig.publish_to_all(test::point_parameters());
    bool pressed = false, returned = false;
    for (int turn = 0; turn < 2000; ++turn) {
        if (turn == 950) rig.fingers.lose_link(true);
        if (turn == 1000) rig.fingers.lose_link(false);
        for (const TickRecord& r : rig.turn()) {
            if (turn < 950) pressed = pressed || !is_given_nothing(r);
            if (turn >= 950 && turn < 1000) {
                EXPECT_EQ(r.gate.cause, GateCause::device_fault) << turn;
                EXPECT_TRUE(is_given_nothing(r)) << turn;
            }
            if (turn >= 1300) returned = returned || !is_given_nothing(r);
        }
    }
    EXPECT_TRUE(pressed);
    EXPECT_TRUE(returned) << "by the ramp";
}

namespace {
// A part that stands still and reports what it is told to.
class StillPart final : public devices::HapticDevice {
public:
    explicit StillPart(Clock& clock) : clock_(clock) { description_.max_force_N = 3.0; }
    [[nodiscard]] const devices::DeviceDescription& description() const noexcept override { return description_; }
    [[nodiscard]] devices::DeviceSample read() noexcept override {
        sample.time_ns = clock_.now_ns();
        return sample;
    }
    void write(const devices::DeviceWrench& wrench) noexcept override { written = wrench; }
    devices::DeviceSample sample;
    devices::DeviceWrench written;

private:
    Clock& clock_;
    devices::DeviceDescription description_;
};
}  // namespace

TEST(Parts, ADeviceThatOnePartReportsAsLostIsLostForThoseReadBeforeItToo) {
    SimulatedClock clock;
    std::deque<StillPart> devices;
    std::deque<HapticChannels> channels;
    std::vector<LoopPart> parts;
    for (int i = 0; i < 3; ++i) parts.push_back({devices.emplace_back(clock), channels.emplace_back(64, 64)});
    HapticLoop loop(parts, clock);
    const auto causes = [&] {
        clock.sleep_until(clock.now_ns() + loop.period_ns());
        loop.step();
        std::vector<GateCause> all;
        for (HapticChannels& one : channels) {
            TickRecord record;
            one.records.pop(record);
            all.push_back(record.gate.cause);
        }
        return all;
    };
    const GateCause none = GateCause::none, fault = GateCause::device_fault;
    EXPECT_EQ(causes(), (std::vector{none, none, none}));
    devices[2].sample.fault = devices::DeviceFault::overheated;
    EXPECT_EQ(causes(), (std::vector{none, none, fault})) << "its own";
    devices[2].sample.fault_is_of_all = true;
    EXPECT_EQ(causes(), (std::vector{fault, fault, fault}));
    devices[2].sample.fault = devices::DeviceFault::none;
    EXPECT_EQ(causes(), (std::vector{none, none, none})) << "of all, but none";
}

// Two devices in one loop: what one of them reports of itself as a whole is nothing to the other.
TEST(Parts, ADeviceThatIsLostTakesNoForceFromAnotherInTheSameLoop) {
    SimulatedClock clock;
    std::deque<StillPart> devices;
    std::deque<HapticChannels> channels;
    std::vector<LoopPart> parts;
    for (const std::size_t device : {0u, 1u, 1u, 2u})
        parts.push_back({devices.emplace_back(clock), channels.emplace_back(64, 64), device});
    HapticLoop loop(parts, clock);
    const auto causes = [&] {
        clock.sleep_until(clock.now_ns() + loop.period_ns());
        loop.step();
        std::vector<GateCause> all;
        for (HapticChannels& one : channels) all.push_back(one.tool.newest().cause);
        return all;
    };
    const GateCause none = GateCause::none, fault = GateCause::device_fault;
    for (const std::size_t reports : {1u, 2u}) {
        devices[reports].sample.fault = devices::DeviceFault::disconnected;
        devices[reports].sample.fault_is_of_all = true;
        EXPECT_EQ(causes(), (std::vector{none, fault, fault, none})) << reports;
        devices[reports].sample.fault = devices::DeviceFault::none;
    }
    EXPECT_EQ(causes(), (std::vector{none, none, none, none}));
}

TEST(Parts, ALoopThatEndsLeavesNoForceOnAnyPart) {
    SimulatedClock clock;
    std::deque<StillPart> devices;
    std::deque<HapticChannels> channels;
    std::vector<LoopPart> parts;
    for (int i = 0; i < 3; ++i) {
        parts.push_back({devices.emplace_back(clock), channels.emplace_back(64, 64)});
        devices.back().written.force_device_N = Vec3(1.0);
    }
    HapticLoop loop(parts, clock);
    loop.run_ticks(0);
    for (const StillPart& device : devices) EXPECT_EQ(device.written.force_device_N, Vec3(0.0));
}

// ---- Limits, work, timing

TEST(Parts, EachHasLimitsAndParametersOfItsOwn) {
    PartsRig rig(test::point_hands(5, 2.0));
    rig.publish(*test::fingertip_sphere());
    rig.publish_to_all(test::point_parameters());
    TickParameters weak = test::point_parameters(), off = weak, wrong = weak;
    weak.limits.max_force_N = 0.2;
    off.enabled = false;
    wrong.materials[0].stiffness_N_per_m = -1.0;
    rig.publish(weak, 1);
    rig.publish(off, 2);
    rig.publish(wrong, 3);
    std::array<double, 5> most_N{};
    for (int turn = 0; turn < 2000; ++turn) {
        const std::vector<TickRecord> records = rig.turn();
        for (std::size_t i = 0; i < 5; ++i)
            most_N[i] = std::max(most_N[i], glm::length(records[i].gate.given.force_device_N));
        EXPECT_EQ(records[3].gate.cause, GateCause::bad_parameters);
        EXPECT_EQ(records[4].gate.cause, GateCause::none);
    }
    EXPECT_GT(most_N[0], 0.4);
    EXPECT_LE(most_N[1], 0.2);
    EXPECT_GT(most_N[1], 0.19);
    EXPECT_EQ(most_N[2], 0.0);
    EXPECT_EQ(most_N[3], 0.0);
    EXPECT_GT(most_N[4], 0.4);
}

TEST(Parts, TogetherDoNoMoreWorkInATurnThanOneMayAlone) {
    for (const double pace : {10.0, 20.0}) {  // machines so slow that the budget is often, or always, used up
        for (const std::size_t count : {std::size_t{1}, std::size_t{5}, std::size_t{20}}) {
            PartsRig rig(test::point_hands(count, 0.4));
            rig.publish(*test::fingertip_sphere());
            TickParameters slow = test::point_parameters();
            slow.work.pace = pace;
            rig.publish_to_all(slow);
            const double budget = budget_ns(slow.work, 1e-3);
            int limited = 0, passed_on = 0, held_over = 0;
            std::vector<int> longest_wait(count, 0), waits(count, 0);
            for (int turn = 0; turn < 400; ++turn) {
                std::vector<TickRecord> records = rig.turn();
                const auto began = std::ranges::find(records, 0.0, [](const TickRecord& r) { return r.turn.spent_ns; });
                ASSERT_NE(began, records.end());
                const auto first = static_cast<std::size_t>(began - records.begin());
                std::ranges::rotate(records, began);
                double spent_ns = 0.0;
                for (const TickRecord& r : records) {
                    ASSERT_EQ(r.turn.spent_ns, spent_ns);
                    ASSERT_EQ(r.turn.held_over,
                              spent_ns > 0.0 &&
                                  budget - spent_ns < std::max(TurnShare::kLeast * budget, TurnShare::kLeast_ns));
                    ASSERT_EQ((r.flags & kTickHeldOver) != 0, r.turn.held_over);
                    passed_on += spent_ns > 0.0 && !r.turn.held_over ? 1 : 0;
                    held_over += r.turn.held_over ? 1 : 0;
                    limited += (r.flags & kTickWorkLimited) != 0 ? 1 : 0;
                    spent_ns += cost_ns(r.contact.work);
                }
                // What each costs that does nothing.
                const double idle_ns = WorkCost::kTick_ns * static_cast<double>(count - 1);
                ASSERT_LE(spent_ns, budget + idle_ns) << count << " parts";
                for (std::size_t n = 0; n < count; ++n) {
                    const std::size_t i = (n + first) % count;
                    waits[i] = records[n].turn.held_over ? waits[i] + 1 : 0;
                    longest_wait[i] = std::max(longest_wait[i], waits[i]);
                }
            }
            EXPECT_EQ(passed_on > 0, count > 1) << "what some leave over is there for the others";
            EXPECT_TRUE(limited > 0 || held_over > 0 || count == 1) << "and what is left goes on in the next turn";
            for (std::size_t i = 0; i < count; ++i) EXPECT_LT(longest_wait[i], static_cast<int>(count)) << i;
        }
    }
}

// A body that moves without a word is felt no harder by a part that is held over than by one that is not; one that was
// set elsewhere holds nobody.
TEST(Parts, OneThatIsHeldOverFeelsNoUnannouncedMotionAtOnce) {
    for (const double jump_m : {0.001, 0.003, 0.05}) {
        geometry::LocalSurface surface = test::around({{test::plate(0.05, 0.02), 0}});
        TickParameters parameters = test::point_parameters();
        parameters.passivity.control = false;
        surface.meshes[0].motion.body = 1;
        FullTickState state;
        FullTick full;
        double before_N = 0.0;
        for (int i = 0; i < 410; ++i) {
            const Nanoseconds now_ns = (1000 + i) * Nanoseconds{1'000'000};
            const bool held_over = i >= 400;
            if (i % 10 == 0) {
                ++surface.sequence;
                surface.meshes[0].motion.time_ns = surface.made_ns = now_ns;
                surface.meshes[0].motion.object_from_mesh.position_m.y = held_over ? jump_m : 0.0;
            }
            devices::DeviceSample sample;
            sample.time_ns = now_ns;
            sample.position_device_m = {0.0, test::kPointBall_m - 0.0005, 0.0};
            full = full_tick(state, sample, surface, parameters, test::kStrongDevice, now_ns, 1e-3, {0.0, held_over});
            state = full.next;
            if (!held_over) before_N = full.record.gate.given.force_device_N.y;
            if (held_over && jump_m > 0.02) {
                EXPECT_FALSE(full.record.in_contact()) << i;
            } else if (held_over) {
                EXPECT_LE(full.record.gate.given.force_device_N.y, before_N + 0.01) << jump_m << " tick " << i;
            }
        }
        EXPECT_NEAR(before_N, 0.2, 0.01);
    }
}

TEST(Parts, RestOnlyWhenAllAreStillAndWakeTogether) {
    std::vector<devices::SimulatedHand> hands;
    hands.push_back(*devices::SimulatedHand::create({{0.0, Vec3(0.0)}}));
    // Still until 3 s; then it moves.
    hands.push_back(*devices::SimulatedHand::create({{0.0, Vec3(0.0)}, {3.0, Vec3(0.0)}, {4.0, Vec3(0.02, 0.0, 0.0)}}));
    PartsRig rig(std::move(hands));
    const auto took = [&](std::uint64_t ticks) {
        const Nanoseconds from_ns = rig.clock.now_ns();
        rig.loop.run_ticks(ticks, nullptr, {.rests = true});
        return rig.clock.now_ns() - from_ns;
    };
    took(1100);
    EXPECT_EQ(took(2), 1'000'000 + HapticLoop::kRest_ns);
    while (rig.clock.now_ns() < 3'300'000'000) took(2);
    EXPECT_EQ(took(2), 2'000'000) << "one of them moves";
}

TEST(Parts, LateTurnsAreFlaggedForAllAndCountedOnce) {
    PartsRig rig(test::point_hands(3, 1.0));
    rig.clock.sleep_until(1'000'000);
    rig.loop.step(600'000);
    EXPECT_EQ(rig.loop.late_ticks(), 1u);
    EXPECT_EQ(rig.loop.ticks(), 1u);
    for (HapticChannels& one : rig.channels) {
        TickRecord record;
        ASSERT_TRUE(one.records.pop(record));
        EXPECT_NE(record.flags & kTickLate, 0u);
        EXPECT_EQ(record.tick, 1u);
    }
}

TEST(Parts, AWarmUpThatTakesTooLongEndsBeforeTheTurnIsLate) {
    // Looking at the time takes a tenth of a millisecond: the lead is over after a few parts.
    struct SlowClock final : Clock {
        Nanoseconds now = 0;
        Nanoseconds now_ns() noexcept override { return now += 100'000; }
        void sleep_until(Nanoseconds deadline_ns) noexcept override { now = std::max(now, deadline_ns); }
        void spin_until(Nanoseconds deadline_ns) noexcept override {
            latest = std::max(latest, now - deadline_ns);
            now = std::max(now, deadline_ns);
        }
        Nanoseconds latest = INT64_MIN;
    };
    SlowClock clock;
    std::deque<StillPart> devices;
    std::deque<HapticChannels> channels;
    std::vector<LoopPart> parts;
    SimulatedClock still;  // reading them takes no time
    for (int i = 0; i < 20; ++i) parts.push_back({devices.emplace_back(still), channels.emplace_back(64, 64)});
    HapticLoop loop(parts, clock);
    loop.run_ticks(5, nullptr, {.lead_ns = 250'000});
    EXPECT_LE(clock.latest, 100'000) << "no later than by the last look at the time";
}

}  // namespace burin::haptics
