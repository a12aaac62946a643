// SPDX-License-Identifier: MIT
// The guided check's taps against hands that do not keep still: what it finds of motors that work and of motors that do
// not. Simulated time; every hand and every order is of a seed.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>

#include "bench/devices/device_check.hpp"
#include "bench/devices/tap_series.hpp"
#include "tests/bench/devices/held_handle.hpp"

namespace burin::bench {
namespace {

constexpr std::array<double, 5> kSways_m{0.0, 0.001, 0.002, 0.004, 0.010};

class SilentGuide final : public CheckGuide {
public:
    void say(const std::string&) override {}
    void show(const std::string&) override {}
    CheckAnswers answers(Nanoseconds) override { return {}; }
};

// Returns the verdicts along the three axes.
std::array<CheckLine, 3> felt_by(const UnsteadyHand& hand, const glm::dmat3& motors, std::mt19937_64& random) {
    const std::uint64_t seed = random();
    SimulatedClock clock;
    clock.sleep_until(1'000'000'000);
    SilentGuide guide;
    devices::OpenedDevice device = devices::of_one_part(std::make_unique<HeldHandle>(hand, motors, clock));
    std::array<CheckLine, 3> found;
    std::size_t count = 0;
    for (CheckLine& line : check_device(device, clock, guide, {.watch_s = 0.1, .by_itself = true, .seed = seed}))
        if (line.check.starts_with("force") && count < found.size()) found[count++] = std::move(line);
    EXPECT_EQ(count, found.size());
    return found;
}

struct Outcomes {
    int passed = 0, failed = 0, unclear = 0;
    [[nodiscard]] int all() const { return passed + failed + unclear; }
    void add(const CheckLine& line) {
        passed += line.verdict == Verdict::passed ? 1 : 0;
        failed += line.verdict == Verdict::failed ? 1 : 0;
        unclear += line.verdict == Verdict::unclear ? 1 : 0;
    }
    [[nodiscard]] std::string text() const {
        return std::to_string(passed) + " passed, " + std::to_string(failed) + " failed, " + std::to_string(unclear) +
               " unclear";
    }
};

// Hands whose motors are what `motors` makes of a hand's number.
template <typename Motors>
Outcomes outcomes(double sway_m, int hands, std::uint64_t seed, const Motors& motors) {
    std::mt19937_64 random(seed);
    Outcomes all;
    for (int i = 0; i < hands; ++i)
        for (const CheckLine& line : felt_by(UnsteadyHand::drawn(random, sway_m), motors(i), random)) all.add(line);
    return all;
}

}  // namespace

TEST(DeviceTaps, NoDeadMotorPassesAndNoGoodOneFailsHoweverTheHandSways) {
    for (const double sway_m : kSways_m) {
        const Outcomes good = outcomes(sway_m, 40, 1, [](int) { return glm::dmat3(1.0); });
        const Outcomes dead = outcomes(sway_m, 40, 2, [](int) { return glm::dmat3(0.0); });
        EXPECT_EQ(good.failed, 0) << sway_m << ": " << good.text();
        EXPECT_EQ(dead.passed, 0) << sway_m << ": " << dead.text();
        EXPECT_EQ(good.all(), 120);
        EXPECT_EQ(dead.all(), 120);
        if (sway_m > 0.001) continue;
        EXPECT_GE(good.passed, sway_m == 0.0 ? 120 : 114) << good.text();
        EXPECT_GE(dead.failed, sway_m == 0.0 ? 120 : 48) << dead.text();
    }
}

TEST(DeviceTaps, ADeadMotorBesideGoodOnesIsFoundByItself) {
    for (const double sway_m : kSways_m) {
        std::mt19937_64 random(3);
        for (int i = 0; i < 12; ++i) {
            const std::size_t dead = static_cast<std::size_t>(i % 3);
            glm::dmat3 motors(1.0);
            motors[static_cast<int>(dead)] = Vec3(0.0);
            const auto found = felt_by(UnsteadyHand::drawn(random, sway_m), motors, random);
            for (std::size_t axis = 0; axis < 3; ++axis)
                EXPECT_NE(found[axis].verdict, axis == dead ? Verdict::passed : Verdict::failed) << found[axis].found;
        }
    }
}

// Four hertz, a tap's own rate, and its half and double, at which an order without chance would see force in the sway.
TEST(DeviceTaps, NoDeadMotorPassesInASwayThatKeepsStepWithTheTaps) {
    std::mt19937_64 random(8);
    for (const double rate_Hz : {1.0 / 3, 1.0, 2.0, 4.0, 8.0, 10.0})
        for (const double sway_m : {0.002, 0.010})
            for (int i = 0; i < 6; ++i) {
                UnsteadyHand hand = UnsteadyHand::drawn(random, 0.0);
                for (auto& waves : hand.waves)
                    waves[0] = {sway_m, 2.0 * std::numbers::pi * rate_Hz, static_cast<double>(i)};
                for (const CheckLine& line : felt_by(hand, glm::dmat3(0.0), random))
                    EXPECT_NE(line.verdict, Verdict::passed) << rate_Hz << " Hz: " << line.found;
                for (const CheckLine& line : felt_by(hand, glm::dmat3(1.0), random))
                    EXPECT_NE(line.verdict, Verdict::failed) << rate_Hz << " Hz: " << line.found;
            }
}

// Reaches are rare and large: some fall into taps with force and into no control.
TEST(DeviceTaps, NoDeadMotorPassesAndNoGoodOneFailsInAHandThatReaches) {
    std::mt19937_64 random(11);
    for (const double most_m : {0.002, 0.010, 0.050})
        for (int i = 0; i < 20; ++i) {
            UnsteadyHand hand = UnsteadyHand::drawn(random, 0.0005);
            hand.reach(random, most_m);
            for (const CheckLine& line : felt_by(hand, glm::dmat3(0.0), random))
                EXPECT_NE(line.verdict, Verdict::passed) << most_m << ": " << line.found;
            for (const CheckLine& line : felt_by(hand, glm::dmat3(1.0), random))
                EXPECT_NE(line.verdict, Verdict::failed) << most_m << ": " << line.found;
        }
}

TEST(DeviceTaps, AReversedAxisNeverPassesAndFailsInASteadyHand) {
    for (const double sway_m : kSways_m) {
        const Outcomes reversed = outcomes(sway_m, 12, 4, [](int) { return glm::dmat3(-1.0); });
        EXPECT_EQ(reversed.passed, 0) << sway_m << ": " << reversed.text();
        if (sway_m <= 0.001) {
            EXPECT_EQ(reversed.failed, 36) << sway_m << ": " << reversed.text();
        }
    }
}

TEST(DeviceTaps, SwappedAxesNeverPassAndFailInASteadyHand) {
    const glm::dmat3 swapped(Vec3(0.0, 1.0, 0.0), Vec3(0.0, 0.0, 1.0), Vec3(1.0, 0.0, 0.0));
    for (const double sway_m : kSways_m) {
        const Outcomes found = outcomes(sway_m, 12, 5, [&](int) { return swapped; });
        EXPECT_EQ(found.passed, 0) << sway_m << ": " << found.text();
        if (sway_m == 0.0) {
            EXPECT_EQ(found.failed, 36) << found.text();
        }
    }
}

TEST(DeviceTaps, NoMotorOfAThirdOfTheForceFails) {
    for (const double sway_m : kSways_m) {
        const Outcomes weak = outcomes(sway_m, 12, 6, [](int) { return glm::dmat3(1.0 / 3); });
        EXPECT_EQ(weak.failed, 0) << sway_m << ": " << weak.text();
    }
}

TEST(DeviceTaps, CannotTellSaysWhatToDoAndHasAnExitStatusOfItsOwn) {
    std::mt19937_64 random(7);
    const auto found = felt_by(UnsteadyHand::drawn(random, 0.010), glm::dmat3(0.0), random);
    for (const CheckLine& line : found) {
        EXPECT_EQ(std::string(name_of(line.verdict)), "unclear") << line.found;
        EXPECT_TRUE(line.found.contains("cannot tell: hold it stiller")) << line.found;
        EXPECT_EQ(line.figures["taps"].get<std::size_t>(), kMostTaps);
    }
    EXPECT_EQ(outcome_of("here", {found.begin(), found.end()}).value(), 3);
    EXPECT_EQ(outcome_of("here", {{"force", Verdict::passed, "", {}}}).value(), 0);
    const auto failed = outcome_of("here", {found[0], {"force up and down", Verdict::failed, "", {}}});
    EXPECT_TRUE(!failed && failed.error().what == "failed: force up and down") << "failed comes before cannot tell";
}

TEST(DeviceTaps, AnOrderHasHalfControlsAndFollowsFromItsSeed) {
    std::mt19937_64 one(1), again(1), other(2);
    for (const bool is_one_way : {false, true}) {
        const std::vector<int> order = tap_order(one, is_one_way);
        EXPECT_EQ(order, tap_order(again, is_one_way));
        EXPECT_NE(order, tap_order(other, is_one_way));
        for (std::size_t look = 0; look < kMostTaps; look += kTapsToALook) {
            const auto begin = order.begin() + static_cast<std::ptrdiff_t>(look), end = begin + kTapsToALook;
            EXPECT_EQ(std::count(begin, end, 0), 12);
            EXPECT_EQ(std::count(begin, end, -1), is_one_way ? 0 : 6);
        }
    }
}

// A piston that gives way by a millimetre a newton, outwards only, in a hand that moves it by half a millimetre.
TEST(DeviceTaps, APartThatDrivesOneWayIsJudgedByItsControls) {
    for (const double strength : {1.0, 0.0, -1.0}) {
        std::mt19937_64 random(9);
        TapSeries series({0, true, working_m(1.0, 0.0, true), 0.0001}, random);
        double force_N = 0.0, length_m = 0.0;
        for (double time_s = 0.0; !series.is_over() && time_s < 20.0; time_s += 0.001) {
            length_m += 0.02 * (0.001 * strength * force_N - length_m);
            const double hand_m = 0.0005 * std::sin(2.0 * std::numbers::pi * 1.1 * time_s);
            force_N = series.tick({time_s, Vec3(length_m + hand_m, 0.0, 0.0), 1.0});
            EXPECT_GE(force_N, 0.0);
        }
        const TapFinding right = strength > 0.0    ? TapFinding::felt
                                 : strength == 0.0 ? TapFinding::absent
                                                   : TapFinding::against;
        EXPECT_EQ(series.answer().finding, right) << strength << ": " << series.answer().moved_m;
    }
}

TEST(DeviceTaps, ATapThatTheGateHeldBackIsTakenOnceMore) {
    std::mt19937_64 random(10);
    TapSeries series({0, false, 0.001, 0.00005}, random);
    const auto tick_until = [&](double begin_s, double end_s, double let_through) {
        for (double time_s = begin_s; time_s < end_s; time_s += 0.001)
            static_cast<void>(series.tick({time_s, Vec3(0.0), let_through}));
    };
    tick_until(0.0, 1.0, 0.5);
    EXPECT_EQ(series.count(), 0u);
    tick_until(1.0, 2.01, 1.0);
    EXPECT_GE(series.count(), 3u);
}

// Of a table in any book: the one-sided quantiles of 0.0005 (3.2905 normal deviations) are 4.587 with 10 degrees of
// freedom, 3.792 with 22 and 3.291 with very many.
TEST(DeviceTaps, StudentsQuantileIsThatOfTheTables) {
    EXPECT_NEAR(student_quantile(3.2905, 10.0), 4.587, 0.005);
    EXPECT_NEAR(student_quantile(3.2905, 22.0), 3.792, 0.001);
    EXPECT_NEAR(student_quantile(3.2905, 1e9), 3.2905, 1e-6);
}

TEST(DeviceTaps, OneJerkThatNoControlHasSeenIsNoAnswer) {
    std::vector<Tap> taps;
    for (int i = 0; i < 24; ++i) taps.push_back({std::array{0, 1, 0, -1}[static_cast<std::size_t>(i % 4)], Vec3(0.0)});
    taps[1].moved_m.x = 0.02;
    EXPECT_EQ(judge_taps(taps, {0, false, 0.0006, 0.00005}).finding, TapFinding::unclear);
    for (Tap& tap : taps) tap.moved_m.x = 0.002 * tap.way;
    EXPECT_EQ(judge_taps(taps, {0, false, 0.0006, 0.00005}).finding, TapFinding::felt);
    for (Tap& tap : taps) tap.moved_m = Vec3(0.001, 0.002, 0.0) * static_cast<double>(tap.way);
    EXPECT_EQ(judge_taps(taps, {0, false, 0.0006, 0.00005}).finding, TapFinding::elsewhere);
}

}  // namespace burin::bench
