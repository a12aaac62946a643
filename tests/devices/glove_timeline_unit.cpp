// SPDX-License-Identifier: MIT
// When a glove's controller took its sets, whatever the line made of them; and which of them are left out as false.
#include "devices/gloves/glove_timeline.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

namespace burin::devices {
namespace {

constexpr double kPeriod_s = 1.0 / 120.0;

// The index' first joint says at which time of the controller a set was taken: it turns by 2 rad/s, there and back.
double angle_at(double time_s) { return 0.2 + std::abs(std::remainder(2.0 * time_s, 2.0)); }

GloveSet numbered_set(int number, double angle_rad) {
    GloveSet set{.number = static_cast<std::uint8_t>(number), .motors_on = true, .joints = {}, .forces_N = {}};
    set.forces_N = GloveForces{};
    set.joints[1][1] = angle_rad;
    return set;
}

// Takes sets that the controller has taken each period, as the line hands them over.
template <typename ArrivesAt>
std::vector<GloveSets> after_sets(int sets, double period_s, ArrivesAt arrives_at_s) {
    GloveTimeline timeline;
    std::vector<GloveSets> after;
    for (int i = 0; i < sets; ++i) {
        EXPECT_TRUE(timeline.take(numbered_set(i, angle_at(i * period_s)), nanoseconds(10.0 + arrives_at_s(i))));
        after.push_back(timeline.sets());
    }
    return after;
}

void expect_even_from_second_on(const std::vector<GloveSets>& after, double period_s, double within_s) {
    for (std::size_t i = static_cast<std::size_t>(1.0 / period_s); i < after.size(); ++i)
        for (std::size_t k = 1; k < after[i].count; ++k)
            EXPECT_NEAR(seconds(after[i].list[k].taken_ns - after[i].list[k - 1].taken_ns), period_s, within_s) << i;
}

}  // namespace

TEST(GloveTimeline, SetsThatArriveInPairsWereTakenAPeriodApart) {
    // Two at a time; and as an adapter does that hands over what it has each 16 ms.
    const auto pairs = after_sets(600, kPeriod_s, [](int i) { return (i / 2 * 2 + 1) * kPeriod_s; });
    expect_even_from_second_on(pairs, kPeriod_s, 0.04 * kPeriod_s);
    EXPECT_NEAR(seconds(pairs.back().needs_ns), 2.0 * kPeriod_s, 0.001);
    const auto by_adapter = after_sets(600, kPeriod_s, [](int i) { return 0.016 * std::ceil(i * kPeriod_s / 0.016); });
    expect_even_from_second_on(by_adapter, kPeriod_s, 0.1 * kPeriod_s);
    EXPECT_LT(seconds(by_adapter.back().needs_ns), 0.016 + kPeriod_s + 0.001);
}

TEST(GloveTimeline, SetsThatArriveOneByOneAreAsLateAsAPeriodAndNoMore) {
    const auto even = after_sets(400, kPeriod_s, [](int i) { return i * kPeriod_s; });
    expect_even_from_second_on(even, kPeriod_s, 1e-6);
    EXPECT_NEAR(seconds(even.back().needs_ns), kPeriod_s, 1e-6);
    // A controller of another pace, 100 sets a second, is followed by its own.
    const auto slower = after_sets(800, 0.01, [](int i) { return i * 0.01; });
    expect_even_from_second_on(slower, 0.01, 1e-5);
    // So is one of 60, which is so slow that a few of its sets take as long as a silence.
    const auto slowest = after_sets(600, 1.0 / 60.0, [](int i) { return i / 60.0; });
    expect_even_from_second_on(slowest, 1.0 / 60.0, 1e-4);
    // Nobody's arrival is exact.
    std::mt19937 random(3);
    const auto jittered =
        after_sets(800, kPeriod_s, [&](int i) { return i * kPeriod_s + 1e-6 * static_cast<double>(random() % 3000); });
    expect_even_from_second_on(jittered, kPeriod_s, 0.1 * kPeriod_s);
}

TEST(GloveTimeline, ASetThatIsLostLeavesItsTimeEmpty) {
    GloveTimeline timeline;
    for (int i = 0; i < 400; ++i)
        if (i % 5 != 3) timeline.take(numbered_set(i, 0.3), nanoseconds(i * kPeriod_s));
    const GloveSets& sets = timeline.sets();
    for (std::size_t k = 1; k < sets.count; ++k) {
        const int apart = static_cast<std::uint8_t>(sets.list[k].set.number - sets.list[k - 1].set.number);
        EXPECT_NEAR(seconds(sets.list[k].taken_ns - sets.list[k - 1].taken_ns), apart * kPeriod_s, 1e-4) << apart;
    }
    EXPECT_NEAR(seconds(sets.needs_ns), 2.0 * kPeriod_s, 1e-4);
}

// A controller that does not count, one that begins again, and a line that was silent for as long as 256 sets take.
TEST(GloveTimeline, NumbersThatSayNothingLeaveTheTimesOfArrival) {
    GloveTimeline timeline;
    for (int i = 0; i < 50; ++i) {
        timeline.take(numbered_set(7, 0.3), nanoseconds(1.0 + 0.011 * i));
        EXPECT_EQ(timeline.sets().newest().taken_ns, nanoseconds(1.0 + 0.011 * i)) << i;
    }
    timeline.take(numbered_set(200, 0.3), nanoseconds(1.6));
    EXPECT_EQ(timeline.sets().newest().taken_ns, nanoseconds(1.6));
    timeline.take(numbered_set(201, 0.3), nanoseconds(1.6 + 256 * kPeriod_s));
    EXPECT_EQ(timeline.sets().newest().taken_ns, nanoseconds(1.6 + 256 * kPeriod_s));
}

TEST(GloveTimeline, ASetInWhichAFingerJumpsIsLeftOutAndCounted) {
    GloveTimeline timeline;
    int number = 0;
    const auto take = [&](double angle_rad) {
        const bool is_taken = timeline.take(numbered_set(number, angle_rad), nanoseconds(1.0 + number * kPeriod_s));
        ++number;
        return is_taken;
    };
    for (int i = 0; i < 20; ++i) EXPECT_TRUE(take(0.3 + 0.3 * (i % 2))) << "36 rad/s, which a finger may";
    EXPECT_FALSE(take(0.3 + 0.8)) << "48 rad/s beyond the last";
    EXPECT_TRUE(take(0.6)) << "the next is sound";
    EXPECT_EQ(timeline.sets().rejected, 1u);
    // A hand that has moved so stays there: the second set says so.
    EXPECT_FALSE(take(1.6));
    EXPECT_TRUE(take(1.6));
    EXPECT_EQ(timeline.sets().rejected, 2u);
    // One that is each time elsewhere is told, and is no silence of the line.
    for (int i = 0; i < 40; ++i) take(i % 4 == 0 ? 0.2 : 0.8 + 0.9 * (i % 4));
    EXPECT_GT(timeline.sets().heard, 20u + 1u + 1u + 8u);
    EXPECT_GT(timeline.sets().rejected, 12u);
    // After a silence nothing is known of how it came there.
    number += 30;
    EXPECT_TRUE(take(-0.9));
}

// Of the two-bit errors that one check lets pass, none turns a joint farther than a finger turns in a set.
TEST(GloveTimeline, NoTwoBitErrorOfVersion1BringsAJointFartherThanAFingerTurns) {
    const GloveSet truth = numbered_set(1, 0.8);
    const GloveBytes whole = frame_of(truth);
    unsigned passed = 0, rejected = 0;
    for (std::size_t a = 0; a < 8 * whole.count; ++a)
        for (std::size_t b = a + 1; b < 8 * whole.count; ++b) {
            GloveBytes damaged = whole;
            for (const std::size_t bit : {a, b}) damaged.bytes[bit / 8] ^= static_cast<std::byte>(1u << (7 - bit % 8));
            GloveFrameReader<GloveSet> reader;
            for (std::size_t i = 0; i < damaged.count; ++i) {
                const auto set = reader.take(damaged.bytes[i]);
                if (!set) continue;
                ++passed;
                GloveTimeline timeline;
                EXPECT_TRUE(timeline.take(numbered_set(0, 0.8), 0));
                if (!timeline.take(*set, nanoseconds(kPeriod_s))) {
                    ++rejected;
                    continue;
                }
                for (std::size_t finger = 0; finger < kGloveFingers; ++finger)
                    for (std::size_t joint = 0; joint < kFingerJoints; ++joint)
                        EXPECT_LE(std::abs(set->joints[finger][joint] - truth.joints[finger][joint]), 40.0 * kPeriod_s)
                            << a << " " << b;
            }
        }
    EXPECT_GT(passed, 0u) << "one check lets some pass";
    EXPECT_GT(rejected, 0u);
    RecordProperty("passed", static_cast<int>(passed));
    RecordProperty("rejected", static_cast<int>(rejected));
}

}  // namespace burin::devices
