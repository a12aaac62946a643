// SPDX-License-Identifier: MIT
#include "devices/hand/steered_hand.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <thread>
#include <vector>

#include "devices/haptic/simulated_omni.hpp"

namespace burin::devices {
namespace {

constexpr Nanoseconds kMs = 1'000'000;
constexpr Nanoseconds kFrame = 16'666'667;

class Steering {
public:
    void to(const Vec3& position_m, Nanoseconds time_ns, std::uint32_t buttons = 0, const Quat& q = {1, 0, 0, 0}) {
        channel.draft() = {++sequence_, time_ns, position_m, q, buttons};
        channel.publish();
    }
    HandSteering channel;

private:
    std::uint64_t sequence_ = 0;
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

TEST(SteeredHand, MakesAnEvenMotionOfAnEvenMouse) {
    // 0.1 m/s as 60 targets a second. Fed straight to a spring the steps would be seen; here the velocity stays even,
    // and the hand is one target and the lag behind.
    Steering steering;
    SteeredHand hand = *SteeredHand::create(&steering.channel, {}, SteeringLimits{.speed_m_per_s = 0.6});
    double slowest = 1.0, fastest = 0.0, most_behind_s = 0.0, least_behind_s = 1.0;
    Nanoseconds next = 0;
    for (Nanoseconds t = 0; t < 1000 * kMs; t += 50'000) {
        if (t >= next) {
            steering.to({0.1 * seconds(next), 0.0, 0.0}, next);
            next += kFrame;
        }
        const HandTarget at = hand.target(seconds(t));
        if (t < 300 * kMs) continue;
        slowest = std::min(slowest, at.velocity_device_m_per_s.x);
        fastest = std::max(fastest, at.velocity_device_m_per_s.x);
        most_behind_s = std::max(most_behind_s, seconds(t) - at.position_device_m.x / 0.1);
        least_behind_s = std::min(least_behind_s, seconds(t) - at.position_device_m.x / 0.1);
    }
    EXPECT_NEAR(slowest, 0.1, 0.002);
    EXPECT_NEAR(fastest, 0.1, 0.002);
    EXPECT_NEAR(most_behind_s, seconds(kFrame) + 0.004, 0.0005);
    EXPECT_NEAR(least_behind_s, seconds(kFrame) + 0.004, 0.0005);
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
    steering.to({0.001, 0.0, 0.0}, 32 * kMs, 2);
    EXPECT_EQ(hand.target(0.034).buttons, 1u);
    steering.to({0.001, 0.0, 0.0}, 34 * kMs, 0);  // cuts the one before short: its button is not lost
    EXPECT_EQ(hand.target(0.03405).buttons, 2u);
    EXPECT_EQ(hand.target(0.0365).buttons, 0u);
}

TEST(SteeredHand, TurnsAlongWithTheTargetTheShorterWay) {
    Steering steering;
    SteeredHand hand = *SteeredHand::create(&steering.channel);
    const double half = 0.25 * 3.14159265358979;  // a quarter turn about y, given by the longer quaternion
    steering.to(Vec3(0.0), 0);
    static_cast<void>(hand.target(0.01));
    steering.to(Vec3(0.0), 10 * kMs, 0, Quat(-3.0 * std::cos(half), 0.0, -3.0 * std::sin(half), 0.0));
    const Quat midway = hand.target(0.015).orientation_device;
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
    const Vec3 there = hand.target(0.5).position_device_m;
    steering.to({nan, 0.0, 0.0}, 1);
    static_cast<void>(hand.target(0.55));
    steering.to({0.0, std::numeric_limits<double>::infinity(), 0.0}, 2);
    static_cast<void>(hand.target(0.6));
    steering.to(Vec3(0.0), 3, 0, {0.0, 0.0, 0.0, 0.0});
    EXPECT_LT(glm::length(hand.target(0.65).position_device_m - there), 1e-6);
    EXPECT_EQ(hand.refused(), 3u);
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

TEST(SteeredHand, ATargetAfterALongRestIsReachedAsSoonAsAnyAndNoneAtOnce) {
    Steering steering;
    SteeredHand hand = *SteeredHand::create(&steering.channel);
    steering.to(Vec3(0.0), 0);
    static_cast<void>(hand.target(0.016));
    steering.to({0.001, 0.0, 0.0}, 10'000 * kMs, 1);  // ten seconds after the one before, by the writer's clock
    static_cast<void>(hand.target(0.016));
    EXPECT_EQ(hand.target(0.016 + seconds(SteeredHand::kMostInterval_ns) - 0.001).buttons, 0u);
    EXPECT_EQ(hand.target(0.016 + seconds(SteeredHand::kMostInterval_ns) + 0.001).buttons, 1u);
    static_cast<void>(hand.target(0.1));
    steering.to({0.001, 0.0, 0.0}, 10'000 * kMs, 2);  // at the same time as the one before
    EXPECT_EQ(hand.target(0.1 + seconds(SteeredHand::kLeastInterval_ns) - 0.0005).buttons, 1u);
    EXPECT_EQ(hand.target(0.1 + seconds(SteeredHand::kLeastInterval_ns) + 0.0005).buttons, 2u);
}

TEST(SteeredHand, AGoalThatIsCutShortTurnsRoundWhereItIs) {
    // So brisk a hand is where the goal is, but for a tenth of a millisecond.
    Steering steering;
    SteeredHand hand = *SteeredHand::create(&steering.channel, {}, {100.0, 1e6, 1e-4});
    steering.to(Vec3(0.0), 0);
    static_cast<void>(hand.target(0.02));
    steering.to({0.04, 0.0, 0.0}, 40 * kMs);  // 1 m/s
    static_cast<void>(hand.target(0.02));
    EXPECT_NEAR(hand.target(0.03).position_device_m.x, 0.01, 3e-4);
    steering.to(Vec3(0.0), 60 * kMs);
    double farthest = 0.0;
    for (int i = 0; i <= 30; ++i) farthest = std::max(farthest, hand.target(0.03 + 0.001 * i).position_device_m.x);
    EXPECT_LT(farthest, 0.01 + 3e-4);
    EXPECT_NEAR(hand.target(0.06).position_device_m.x, 0.0, 1e-6);
}

}  // namespace burin::devices
