// SPDX-License-Identifier: MIT
#include "devices/hand/steered_hand.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <random>
#include <thread>
#include <vector>

#include "devices/haptic/simulated_omni.hpp"
#include "tests/support/test_units.hpp"

namespace burin::devices {
namespace {

constexpr Nanoseconds kFrame = 16'666'667;

class Steering {
public:
    void to(const Vec3& position_m, Nanoseconds time_ns, std::uint32_t buttons = 0, const Quat& q = {1, 0, 0, 0}) {
        static_cast<void>(channel.push({time_ns, position_m, q, buttons}));
    }
    HandSteering channel;
};

// A mouse path: leaps, even stretches and rests, with a fixed seed.
std::vector<Vec3> mouse_path(unsigned seed, int count) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> place(-0.08, 0.08), small(-0.004, 0.004);
    std::vector<Vec3> path{Vec3(0.0)};
    for (int i = 1; i < count; ++i) {
        const Vec3 before = path.back();
        if (i % 7 == 0)
            path.emplace_back(place(random), place(random), place(random));
        else if (i % 5 == 0)
            path.push_back(before);
        else
            path.push_back(before + Vec3(small(random), small(random), small(random)));
    }
    return path;
}

struct Instant {
    Vec3 position_m, velocity_m_per_s;
    std::uint32_t buttons;
};

// Asks every query_ns; targets are published at multiples of 8 ms.
std::vector<Instant> follow(const std::vector<Vec3>& path, Nanoseconds query_ns, Nanoseconds keep_ns) {
    Steering steering;
    SteeredHand hand = *SteeredHand::create(&steering.channel);
    std::vector<Instant> seen;
    std::size_t next = 0;
    for (Nanoseconds t = 0; t < static_cast<Nanoseconds>(path.size()) * 8 * kMs; t += query_ns) {
        const HandTarget at = hand.target(seconds(t));
        if (t % keep_ns == 0) seen.push_back({at.position_device_m, at.velocity_device_m_per_s, at.buttons});
        if (t % (8 * kMs) == 0 && next < path.size()) {
            steering.to(path[next], t, static_cast<std::uint32_t>(next % 3));
            ++next;
        }
    }
    return seen;
}

}  // namespace

TEST(SteeredHand, RestsWhereItStartsUntilItIsTold) {
    Steering steering;
    const HandTarget start{{0.01, 0.02, 0.03}, Vec3(5.0), {0.0, 2.0, 0.0, 0.0}, 3};
    SteeredHand hand = *SteeredHand::create(&steering.channel, start);
    for (const double t : {0.0, 0.1, 7.0}) {
        const HandTarget at = hand.target(t);
        EXPECT_EQ(at.position_device_m, start.position_device_m);
        EXPECT_EQ(at.velocity_device_m_per_s, Vec3(0.0));
        EXPECT_EQ(at.orientation_device, Quat(0.0, 1.0, 0.0, 0.0));  // normalised
        EXPECT_EQ(at.buttons, 3u);
    }
}

TEST(SteeredHand, StaysWithinSpeedAndAccelerationWhateverTheMouseDoes) {
    const SteeringLimits limits;
    const std::vector<Instant> seen = follow(mouse_path(7, 250), 50'000, 50'000);
    double fastest = 0.0, hardest = 0.0;
    for (std::size_t i = 1; i < seen.size(); ++i) {
        fastest = std::max(fastest, glm::length(seen[i].velocity_m_per_s));
        hardest = std::max(hardest, glm::length(seen[i].velocity_m_per_s - seen[i - 1].velocity_m_per_s) / 50e-6);
        // The velocity told is that of the position told.
        const Vec3 moved = (seen[i].position_m - seen[i - 1].position_m) / 50e-6;
        ASSERT_LT(glm::length(moved - seen[i].velocity_m_per_s), 1e-9);
    }
    EXPECT_LE(fastest, limits.speed_m_per_s * (1.0 + 1e-12));
    EXPECT_GT(fastest, 0.9 * limits.speed_m_per_s);  // the path has leaps that ask for all of it
    EXPECT_LE(hardest, limits.acceleration_m_per_s2 * (1.0 + 1e-9));
    EXPECT_GT(hardest, 0.9 * limits.acceleration_m_per_s2);
}

TEST(SteeredHand, ArrivesAfterALeapWithoutPassingTheTarget) {
    Steering steering;
    SteeredHand hand = *SteeredHand::create(&steering.channel);
    const Vec3 there(0.08, -0.03, 0.02);
    steering.to(there, 0);
    double farthest = 0.0;
    for (Nanoseconds t = 0; t <= 600 * kMs; t += 50'000) {
        const Vec3 p = hand.target(seconds(t)).position_device_m;
        farthest = std::max(farthest, glm::dot(p, glm::normalize(there)));
        EXPECT_LT(glm::length(glm::cross(p, glm::normalize(there))), 1e-12);  // a straight line
    }
    EXPECT_LE(farthest, glm::length(there) + 1e-12);
    EXPECT_LT(glm::length(hand.target(0.6).position_device_m - there), 1e-6);
}

TEST(SteeredHand, TakesAboutAsLongAsTheBestMotionWithinTheLimits) {
    // From rest to rest over d: the fastest is d / v + v / a when the speed limit is reached. Braking takes half the
    // acceleration, which costs v / (2 a) more, and the last bit dies out with the lag.
    Steering steering;
    const SteeringLimits limits;
    SteeredHand hand = *SteeredHand::create(&steering.channel);
    steering.to({0.1, 0.0, 0.0}, 0);
    Nanoseconds t = 0;
    while (t < 1000 * kMs && hand.target(seconds(t)).position_device_m.x < 0.099) t += 50'000;
    const double best = 0.1 / limits.speed_m_per_s + limits.speed_m_per_s / limits.acceleration_m_per_s2;
    EXPECT_GT(seconds(t), 0.9 * best);
    EXPECT_LT(seconds(t), 1.2 * best);
}

// 0.1 m/s, so many targets a second: the slowest and the fastest speed, and how long the hand is behind. Between 60 and
// 240 a second it was one target and the lag of 4 ms before the hand followed a curve, and is no later now.
struct Evenness {
    double slowest_m_per_s = 1.0, fastest_m_per_s = 0.0, least_behind_s = 1.0, most_behind_s = 0.0;
};
Evenness evenness_at(double rate_Hz) {
    Steering steering;
    SteeredHand hand = *SteeredHand::create(&steering.channel);
    Evenness even;
    int next = 0;
    for (Nanoseconds t = 0; t < 4000 * kMs; t += 50'000) {
        if (t >= nanoseconds(next / rate_Hz)) {
            steering.to({0.1 * next / rate_Hz, 0.0, 0.0}, nanoseconds(next / rate_Hz));
            ++next;
        }
        const HandTarget at = hand.target(seconds(t));
        if (t < 1500 * kMs) continue;
        even.slowest_m_per_s = std::min(even.slowest_m_per_s, at.velocity_device_m_per_s.x);
        even.fastest_m_per_s = std::max(even.fastest_m_per_s, at.velocity_device_m_per_s.x);
        even.most_behind_s = std::max(even.most_behind_s, seconds(t) - at.position_device_m.x / 0.1);
        even.least_behind_s = std::min(even.least_behind_s, seconds(t) - at.position_device_m.x / 0.1);
    }
    return even;
}

TEST(SteeredHand, MakesAnEvenMotionOfAnEvenMouseAtAnyRate) {
    for (const double rate_Hz : {5.0, 10.0, 30.0, 60.0, 240.0, 1000.0}) {
        const Evenness even = evenness_at(rate_Hz);
        EXPECT_NEAR(even.slowest_m_per_s, 0.1, 1e-6) << rate_Hz;
        EXPECT_NEAR(even.fastest_m_per_s, 0.1, 1e-6) << rate_Hz;
        const double intervals = rate_Hz > 20.0 ? 1.0 : 2.0;  // where targets are sparse the one beyond is waited for
        EXPECT_NEAR(even.most_behind_s, intervals / rate_Hz + 0.004, 0.0002) << rate_Hz;
        EXPECT_NEAR(even.least_behind_s, intervals / rate_Hz + 0.004, 0.0002) << rate_Hz;
    }
}

TEST(SteeredHand, GivesTheSameBitsForTheSameTargetsAndTimes) {
    const std::vector<Vec3> path = mouse_path(3, 100);
    const std::vector<Instant> a = follow(path, 50'000, 1 * kMs);
    const std::vector<Instant> b = follow(path, 50'000, 1 * kMs);
    const std::vector<Instant> rarely = follow(path, 1 * kMs, 1 * kMs);  // asked twenty times less often
    ASSERT_EQ(a.size(), rarely.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
        EXPECT_EQ(std::memcmp(&a[i].position_m, &b[i].position_m, sizeof(Vec3)), 0);
        EXPECT_EQ(std::memcmp(&a[i].velocity_m_per_s, &b[i].velocity_m_per_s, sizeof(Vec3)), 0);
        EXPECT_EQ(a[i].position_m, rarely[i].position_m) << i;
        EXPECT_EQ(a[i].buttons, rarely[i].buttons) << i;
    }
}

TEST(SteeredHand, PressesItsButtonsWhereTheTargetIs) {
    Steering steering;
    SteeredHand hand = *SteeredHand::create(&steering.channel);
    steering.to(Vec3(0.0), 0);
    static_cast<void>(hand.target(0.016));
    steering.to({0.001, 0.0, 0.0}, 16 * kMs, 1);  // 16 ms after the one before
    EXPECT_EQ(hand.target(0.020).buttons, 0u);
    EXPECT_EQ(hand.target(0.0319).buttons, 0u);
    EXPECT_EQ(hand.target(0.0321).buttons, 1u);
    steering.to({0.002, 0.0, 0.0}, 32 * kMs, 2);
    steering.to({0.003, 0.0, 0.0}, 32 * kMs, 0);
    EXPECT_EQ(hand.target(0.0479).buttons, 1u);
    EXPECT_EQ(hand.target(0.0483).buttons, 2u);
    EXPECT_EQ(hand.target(0.0495).buttons, 2u);  // though pressed for no time, a tick sees it
    EXPECT_EQ(hand.target(0.0505).buttons, 0u);
}

TEST(SteeredHand, SkipsNoButtonOfAThousandTargetsAtOnce) {
    Steering steering;
    SteeredHand hand = *SteeredHand::create(&steering.channel);
    constexpr std::uint32_t kCount = 1000;
    for (std::uint32_t i = 1; i <= kCount; ++i) steering.to({1e-5 * i, 0.0, 0.0}, i * kMs, i / 10);
    std::uint32_t buttons = 0;
    Nanoseconds t = 0;
    for (; t < 3000 * kMs && buttons < kCount / 10; t += kMs) {
        const std::uint32_t now = hand.target(seconds(t)).buttons;
        ASSERT_LE(now - buttons, 1u) << t;
        buttons = now;
    }
    EXPECT_EQ(buttons, kCount / 10);
    EXPECT_LT(seconds(t), 1.2);  // gone through in their own time, or faster
    EXPECT_EQ(steering.channel.lost(), 0u);
}

TEST(SteeredHand, CountsTheTargetsThatAFullChannelLoses) {
    HandSteering channel(16);
    for (int i = 0; i < 20; ++i) EXPECT_EQ(channel.push({i * kMs, Vec3(0.001 * i)}), i < 16);
    EXPECT_EQ(channel.lost(), 4u);
    SteeredHand hand = *SteeredHand::create(&channel);
    for (int i = 0; i < 100; ++i) static_cast<void>(hand.target(0.01 * i));
    EXPECT_LT(glm::length(hand.target(1.0).position_device_m - Vec3(0.015)), 1e-6);
}

TEST(SteeredHand, TurnsAlongWithTheTargetTheShorterWay) {
    Steering steering;
    SteeredHand hand = *SteeredHand::create(&steering.channel);
    const double half = 0.25 * 3.14159265358979;  // a quarter turn about y, given by the longer quaternion
    steering.to(Vec3(0.0), 0);
    static_cast<void>(hand.target(0.01));
    steering.to(Vec3(0.0), 10 * kMs, 0, Quat(-3.0 * std::cos(half), 0.0, -3.0 * std::sin(half), 0.0));
    const Quat midway = hand.target(0.01505).orientation_device;
    EXPECT_NEAR(2.0 * std::atan2(std::abs(midway.y), std::abs(midway.w)), half, 1e-9);
    EXPECT_NEAR(glm::length(midway), 1.0, 1e-12);
    const Quat there = hand.target(0.03).orientation_device;
    EXPECT_NEAR(2.0 * std::atan2(std::abs(there.y), std::abs(there.w)), 2.0 * half, 1e-9);
}

TEST(SteeredHand, PassesOverTargetsThatAreNoPlace) {
    Steering steering;
    SteeredHand hand = *SteeredHand::create(&steering.channel);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    steering.to({0.01, 0.0, 0.0}, 0);
    for (int i = 0; i < 60; ++i) static_cast<void>(hand.target(0.01 * i));
    const Vec3 there = hand.target(0.6).position_device_m;
    steering.to({nan, 0.0, 0.0}, 1);
    steering.to({0.0, std::numeric_limits<double>::infinity(), 0.0}, 2);
    steering.to(Vec3(0.0), 3, 0, {0.0, 0.0, 0.0, 0.0});
    EXPECT_LT(glm::length(hand.target(0.65).position_device_m - there), 1e-6);
    EXPECT_EQ(steering.channel.refused(), 3u);
    EXPECT_EQ(steering.channel.lost(), 0u);
}

TEST(SteeredHand, SaysWhatIsWrongWithItsSettings) {
    Steering steering;
    EXPECT_FALSE(SteeredHand::create(nullptr));
    EXPECT_FALSE(SteeredHand::create(&steering.channel, {{NAN, 0.0, 0.0}, Vec3(0.0), {1, 0, 0, 0}, 0}));
    EXPECT_FALSE(SteeredHand::create(&steering.channel, {Vec3(0.0), Vec3(0.0), {0, 0, 0, 0}, 0}));
    EXPECT_FALSE(SteeredHand::create(&steering.channel, {}, {0.0, 20.0, 0.004}));
    EXPECT_FALSE(SteeredHand::create(&steering.channel, {}, {0.5, -1.0, 0.004}));
    EXPECT_FALSE(SteeredHand::create(&steering.channel, {}, {0.5, 20.0, 1e-6}));
    const auto bad_grip = SteeredHand::create(&steering.channel, {}, {}, {-0.1, 200.0, 6.0});
    ASSERT_FALSE(bad_grip);
    EXPECT_NE(bad_grip.error().line().find("grip"), std::string::npos);
}

TEST(SteeredHand, HoldsTheOmniSoThatAThrownMouseDoesNotThrowTheStylus) {
    Steering steering;
    SimulatedOmni omni(*SteeredHand::create(&steering.channel));
    EXPECT_EQ(omni.scripted_hand(), nullptr);
    steering.to({0.06, 0.04, 0.0}, 0, 1);
    double fastest = 0.0;
    for (int i = 0; i < 600; ++i) {
        omni.advance(kMs);
        static_cast<void>(omni.read());
        fastest = std::max(fastest, glm::length(omni.true_velocity_device_m_per_s()));
    }
    // The spring of the grip overshoots (damping ratio 0.56); a step of the target would give several m/s.
    EXPECT_LT(fastest, 1.3 * SteeringLimits{}.speed_m_per_s);
    EXPECT_LT(glm::length(omni.true_position_device_m() - Vec3(0.06, 0.04, 0.0)), 0.0025);  // friction keeps the rest
    EXPECT_EQ(omni.read().buttons, 1u);
}

TEST(SteeredHand, FollowsAScriptedHandsPathInTheOmniToWithinItsDelay) {
    // The same slow circle once as a script and once as live targets: the styluses keep together but for the delay.
    std::vector<HandPose> script;
    for (int i = 0; i <= 125; ++i) {
        const double t = 0.016 * i;
        script.push_back({t, {0.02 * std::cos(t), 0.02 * std::sin(t), 0.0}});
    }
    SimulatedOmni scripted(*SimulatedHand::create(script));
    Steering steering;
    HandTarget start;
    start.position_device_m = script[0].position_device_m;
    SimulatedOmni steered(*SteeredHand::create(&steering.channel, start));
    double apart = 0.0;
    for (int i = 0; i < 2000; ++i) {
        if (i % 16 == 0) steering.to(script[static_cast<std::size_t>(i / 16)].position_device_m, i * kMs);
        scripted.advance(kMs);
        steered.advance(kMs);
        static_cast<void>(scripted.read());
        static_cast<void>(steered.read());
        apart = std::max(apart, glm::length(scripted.true_position_device_m() - steered.true_position_device_m()));
    }
    EXPECT_LT(apart, 0.0012);  // 20 ms at 20 mm/s is 0.4 mm; sticking at the start the rest
}

TEST(SteeredHand, TakesTargetsFromAnotherThread) {
    Steering steering;
    SteeredHand hand = *SteeredHand::create(&steering.channel);
    std::jthread writer([&] {
        for (int i = 1; i <= 2000; ++i) steering.to(Vec3(1e-5 * i), i * kMs);
    });
    Vec3 before = hand.target(0.0).position_device_m;
    for (int i = 1; i <= 2000; ++i) {
        const Vec3 p = hand.target(1e-3 * i).position_device_m;
        ASSERT_LE(glm::length(p - before), 1.01e-3 * SteeringLimits{}.speed_m_per_s);
        before = p;
    }
    writer.join();
    EXPECT_LT(glm::length(hand.target(2.5).position_device_m - Vec3(0.02)), 0.02 * 2);
    for (int i = 26; i < 40; ++i) static_cast<void>(hand.target(0.1 * i));
    EXPECT_LT(glm::length(hand.target(4.0).position_device_m - Vec3(0.02)), 1e-6);
}

// After a debugger's pause, say, the hand is asked again ten seconds later, and stood still for all but a tenth of one.
TEST(SteeredHand, AfterAPauseItGoesOnFromWhereItStoodNoFartherThanItsCatchingUpTakesIt) {
    constexpr Nanoseconds kPause = 10'000 * kMs;
    for (const double there_m : {0.3, 0.02}) {  // half a second away; near, so that hand and goal go side by side
        Steering a, b;
        SteeredHand paused = *SteeredHand::create(&a.channel), steady = *SteeredHand::create(&b.channel);
        const auto tell_both = [&](const Vec3& position_m, Nanoseconds time_ns, std::uint32_t buttons) {
            a.to(position_m, time_ns, buttons);
            b.to(position_m, time_ns, buttons);
        };
        const auto ask_both = [&](Nanoseconds t, Nanoseconds lost_ns) {
            const HandTarget of_paused = paused.target(seconds(t + lost_ns)), of_steady = steady.target(seconds(t));
            EXPECT_EQ(of_paused.position_device_m, of_steady.position_device_m) << t;
            EXPECT_EQ(of_paused.velocity_device_m_per_s, of_steady.velocity_device_m_per_s) << t;
            EXPECT_EQ(of_paused.buttons, of_steady.buttons) << t;
            return of_paused;
        };
        tell_both(Vec3(0.0), 0, 0);
        ask_both(16 * kMs, 0);
        tell_both({there_m, 0.0, 0.0}, 40 * kMs, 1);  // its goal is under way for 40 ms
        ask_both(20 * kMs, 0);
        const HandTarget before = ask_both(30 * kMs, 0);
        EXPECT_EQ(before.buttons, 0u);
        // The other hand, which did not pause, is asked a tenth of a second on.
        const HandTarget after = ask_both(130 * kMs, kPause);
        const double moved_m = after.position_device_m.x - before.position_device_m.x;
        EXPECT_LE(moved_m, SteeringLimits{}.speed_m_per_s * 0.1 + 1e-12);
        for (int i = 1; i < 10; ++i) ask_both((130 + 10 * i) * kMs, kPause);
    }
}

TEST(SteeredHand, AfterAGapOfSecondsItSetsOutAnewAtOnce) {
    Steering steering;
    SteeredHand hand = *SteeredHand::create(&steering.channel);
    steering.to(Vec3(0.0), 0);
    for (int i = 0; i <= 100; ++i) static_cast<void>(hand.target(0.1 * i));
    steering.to({0.001, 0.0, 0.0}, 10'000 * kMs, 1);  // ten seconds after the one before
    const double restart_s = seconds(HandSteering::kRestart_ns);
    EXPECT_EQ(hand.target(10.0 + restart_s - 0.001).buttons, 0u);
    EXPECT_GT(hand.target(10.0 + restart_s - 0.001).position_device_m.x, 0.0008);
    EXPECT_EQ(hand.target(10.0 + restart_s + 0.001).buttons, 1u);
}

// Times that stand still, go back, leap ahead or are beyond all bounds: the hand goes where it is told, within half a
// second of being told, and what comes afterwards is on time again.
TEST(SteeredHand, GoesWhereItIsToldWhateverTheTimesAre) {
    constexpr Nanoseconds kMost = std::numeric_limits<Nanoseconds>::max();
    const std::vector<std::function<Nanoseconds(int)>> clocks{
        [](int) { return 5 * kMs; },
        [](int i) { return -i * 16 * kMs; },
        [](int i) { return i * 16 * kMs + (i > 50 ? 30'000 * kMs : 0); },
        [](int i) { return i * 16 * kMs - (i > 50 ? 30'000 * kMs : 0); },
        [](int i) { return i % 2 == 0 ? kMost : std::numeric_limits<Nanoseconds>::min(); },
        [](int i) { return i * 16 * kMs + (i % 2) * 20 * kMs; },
    };
    for (std::size_t clock = 0; clock < clocks.size(); ++clock) {
        Steering steering;
        SteeredHand hand = *SteeredHand::create(&steering.channel);
        double before_m = 0.0, farthest_behind_m = 0.0;
        for (int t = 0; t < 3700; ++t) {
            if (t % 16 == 0 && t < 3000) steering.to({1e-6 * t, 0.0, 0.0}, clocks[clock](t / 16));
            const double x = hand.target(1e-3 * t).position_device_m.x;
            ASSERT_GE(x, before_m - 1e-12) << clock << " at " << t;
            before_m = x;
            farthest_behind_m = std::max(farthest_behind_m, 1e-6 * std::min(t, 2992) - x);
        }
        EXPECT_LT(farthest_behind_m, 1e-3 * 0.55) << clock;
        EXPECT_NEAR(before_m, 1e-6 * 2992, 1e-7) << clock;
    }
}

// So brisk a hand is where the goal is, but for a tenth of a millisecond.
constexpr SteeringLimits kBrisk{100.0, 1e6, 1e-4};

TEST(SteeredHand, TurnsRoundAtTheTargetAndNotBefore) {
    Steering steering;
    SteeredHand hand = *SteeredHand::create(&steering.channel, {}, kBrisk);
    double farthest = 0.0;
    for (int t = 0; t < 400; ++t) {
        if (t % 20 == 0) steering.to({0.02 - std::abs(0.02 - 1e-4 * std::min(t, 400)), 0.0, 0.0}, t * kMs);
        farthest = std::max(farthest, hand.target(1e-3 * t).position_device_m.x);
    }
    EXPECT_LE(farthest, 0.02);
    EXPECT_GT(farthest, 0.0199);
}

// A path that stops is not gone beyond, however the targets near its end lie.
TEST(SteeredHand, NeverPassesATargetAtWhichThePathRests) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> step(0.0, 0.01);
    std::uniform_int_distribution<int> interval(2, 250);
    for (int path = 0; path < 200; ++path) {
        Steering steering;
        SteeredHand hand = *SteeredHand::create(&steering.channel, {}, kBrisk);
        Vec3 at(0.0), u = glm::normalize(Vec3(1.0, step(random) * 100.0, -0.3));
        Nanoseconds t = 0;
        double farthest = 0.0;
        const auto until = [&](Nanoseconds end) {
            for (; t < end; t += kMs) {
                const Vec3 p = hand.target(seconds(t)).position_device_m;
                ASSERT_LT(glm::length(glm::cross(p, u)), 1e-12);  // a straight path stays straight
                ASSERT_GE(glm::dot(p, u), farthest - 1e-12);      // and is never gone back
                farthest = std::max(farthest, glm::dot(p, u));
            }
        };
        for (int i = 0; i < 12; ++i) {
            if (i < 9) at += step(random) * u;  // three targets where it rests
            steering.to(at, t);
            until(t + interval(random) * kMs);
        }
        until(t + 1500 * kMs);
        EXPECT_LE(farthest, glm::length(at) + 1e-12) << path;
        EXPECT_NEAR(farthest, glm::length(at), 1e-6) << path;
    }
}

// Targets on a circle, so many a turn: how far the hand is off it, as a part of its radius, some targets from its ends.
double off_circle(int targets_a_turn) {
    constexpr double kRadius_m = 0.05, kTurn = 6.283185307179586;
    const Nanoseconds interval = 200 * kMs;
    const auto on_circle = [&](int i) {
        const double angle = kTurn * i / targets_a_turn;
        return Vec3(kRadius_m * std::cos(angle), kRadius_m * std::sin(angle), 0.0);
    };
    Steering steering;
    HandTarget start;
    start.position_device_m = on_circle(0);
    SteeredHand hand = *SteeredHand::create(&steering.channel, start, kBrisk);
    double off = 0.0;
    for (Nanoseconds t = 0; t < targets_a_turn * interval; t += kMs) {
        if (t % interval == 0) steering.to(on_circle(static_cast<int>(t / interval)), t);
        const double radius_m = glm::length(hand.target(seconds(t)).position_device_m);
        if (t > 6 * interval) off = std::max(off, std::abs(radius_m / kRadius_m - 1.0));
    }
    return off;
}

TEST(SteeredHand, FollowsACircleOfFewTargets) {
    RecordProperty("off_10_a_turn", std::to_string(off_circle(10)));
    RecordProperty("off_20_a_turn", std::to_string(off_circle(20)));
    // A cubic with the circle's own velocities is off by t^4 / 384, t the angle from target to target; those here are
    // wrong by t^4 / 20, which adds t^6 / 80. Straight lines are off by t^2 / 8.
    for (const int targets : {10, 16, 24, 48}) {
        const double t = 6.283185307179586 / targets;
        EXPECT_LT(off_circle(targets), t * t * t * t / 384.0 + t * t * t * t * t * t / 60.0) << targets;
    }
}

// A target that comes late finds the goal waiting; the next are on time again, and the delay that was needed is there.
TEST(SteeredHand, WaitsOnceForTargetsThatComeLateAgainAndAgain) {
    Steering steering;
    SteeredHand hand = *SteeredHand::create(&steering.channel, {}, kBrisk);
    int next = 0, stops = 0;
    double before = 0.0;
    for (Nanoseconds t = 0; t < 4000 * kMs; t += kMs) {
        // Each tenth target is 20 ms on the way, and holds up those behind it.
        while (next * kFrame + (next % 10 == 5 ? 20 * kMs : 0) <= t) {
            steering.to({0.02 * seconds(next * kFrame), 0.0, 0.0}, next * kFrame);
            ++next;
        }
        const double x = hand.target(seconds(t)).position_device_m.x;
        if (t > 50 * kMs && x - before < 1e-6) ++stops;  // 20 um a tick is even
        before = x;
    }
    EXPECT_LE(stops, 25);  // ticks, of the first late target
    EXPECT_NEAR(4.0 - before / 0.02, 0.020 + seconds(kFrame), 0.003);
}

}  // namespace burin::devices
