// SPDX-License-Identifier: MIT
// What a tracker's reports mean for each of its bodies, wands, buttons and sticks: the same table for the first and the
// second, poses in which nothing is equal, and each loss twice.
#include "devices/trackers/tracker_bodies.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "tests/support/uneven_poses.hpp"

namespace burin::devices {
namespace {

constexpr Nanoseconds kReport_ns = 10'000'000;

// A head and two wands with buttons and sticks, each of a device of its own, with its own numbers.
TrackerBodies bodies_of_all() {
    TrackerBodies bodies{.head = {{"Head", 3}},
                         .wands = {{{{"Wand", 4}}, {{"Wand", 7}}}},
                         .buttons = {{{{"Keys", 0}}, {{"OtherKeys", 2}}}},
                         .sticks = {{{{"Stick", 1}}, {{"Stick", 3}}}}};
    bodies.head_mount.body_from_point = uneven_pose(0);
    for (std::size_t wand = 0; wand < kTrackedWands; ++wand)
        bodies.wand_mounts[wand].body_from_point = uneven_pose(1 + wand);
    bodies.frame.unit_m = kUnevenScales[0];
    bodies.frame.tracker_from_system = uneven_turn(3);
    bodies.frame.world_from_tracker = uneven_pose(4);
    return bodies;
}

class TrackedAll {
public:
    explicit TrackedAll(TrackerBodies bodies = bodies_of_all()) : bodies_(std::move(bodies)) {}
    TrackerTranslator& operator*() { return translator_; }
    TrackerTranslator* operator->() { return &translator_; }
    template <typename Input>
    std::vector<Input> heard() {
        std::vector<Input> inputs;
        for (const TrackerSample& sample : inbox_.take())
            if (const auto* input = std::get_if<Input>(&sample.input)) inputs.push_back(*input);
        return inputs;
    }
    std::vector<TrackerInput> all_heard() {
        std::vector<TrackerInput> inputs;
        for (const TrackerSample& sample : inbox_.take()) inputs.push_back(sample.input);
        return inputs;
    }
    void button(std::size_t wand, std::int32_t button, bool pressed) {
        translator_.button(wand == 0 ? "Keys" : "OtherKeys", button + (wand == 0 ? 0 : 2), pressed, time_ns());
    }
    void stick(std::size_t wand, const Vec2& to) {
        std::vector<double> channels{0.11, 0.22, 0.33, 0.44, 0.55};
        // The other's keep their place.
        for (std::size_t other = 0; other < kTrackedWands; ++other) {
            const Vec2& at = other == wand ? to : sticks_[other];
            channels[1 + 2 * other] = at.x, channels[2 + 2 * other] = at.y;
        }
        sticks_[wand] = to;
        translator_.channels("Stick", channels, time_ns());
    }
    void pose(std::size_t body, const Pose& pose_system, bool is_tracked = true) {
        translator_.pose(body == 2 ? "Head" : "Wand",
                         body == 0   ? 4
                         : body == 1 ? 7
                                     : 3,
                         pose_system, is_tracked, time_ns());
    }
    Nanoseconds time_ns() { return time_ns_ += kReport_ns; }

private:
    TrackerBodies bodies_;
    TrackerInbox inbox_;
    TrackerTranslator translator_{"vrpn:x", bodies_, inbox_};
    std::array<Vec2, kTrackedWands> sticks_{};
    Nanoseconds time_ns_ = kNanosecondsPerSecond;
};

// world_from_point = world_from_tracker tracker_from_body body_from_point, by matrices.
glm::dmat4 matrix_of(const Pose& pose) { return matrix({pose.position_m, pose.orientation, 1.0}); }

void expect_is(const Pose& pose, const glm::dmat4& expected, const std::string& of) {
    const glm::dmat4 found = matrix_of(pose);
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row)
            EXPECT_NEAR(found[column][row], expected[column][row], 1e-12) << of << " " << column << " " << row;
}

}  // namespace

TEST(TrackedBodies, WhatIsLostReleasesEachButtonOfEachWandAndNothingElse) {
    for (std::size_t wand = 0; wand < kTrackedWands; ++wand)
        for (std::int32_t button = 0; button < kMostTrackedButtons; ++button) {
            TrackedAll tracked;
            for (int time = 0; time < 2; ++time) {
                tracked.button(wand, button, true);
                const WandClick press{static_cast<std::uint32_t>(wand), static_cast<std::uint32_t>(button), true};
                EXPECT_EQ(tracked.heard<WandClick>(), std::vector{press}) << time;
                tracked->lose_all(tracked.time_ns());
                WandClick release = press;
                release.pressed = false;
                EXPECT_EQ(tracked.heard<WandClick>(), std::vector{release}) << wand << " " << button << " " << time;
                tracked->lose_all(tracked.time_ns());
                EXPECT_TRUE(tracked.all_heard().empty()) << "once";
            }
        }
}

TEST(TrackedBodies, WhatIsLostReleasesAllThatIsDownOnBothWandsAtOnce) {
    TrackedAll tracked;
    for (std::size_t wand = 0; wand < kTrackedWands; ++wand)
        for (std::int32_t button = static_cast<std::int32_t>(wand); button < kMostTrackedButtons; button += 3)
            tracked.button(wand, button, true);
    const auto presses = tracked.heard<WandClick>();
    tracked->lose_all(tracked.time_ns());
    auto releases = tracked.heard<WandClick>();
    ASSERT_EQ(releases.size(), presses.size());
    for (std::size_t i = 0; i < presses.size(); ++i) {
        EXPECT_FALSE(releases[i].pressed);
        releases[i].pressed = true;
        EXPECT_EQ(releases[i], presses[i]);
    }
}

TEST(TrackedBodies, WhatIsLostLetsEachStickRestAndLosesEachBodyWhereItWas) {
    for (std::size_t wand = 0; wand < kTrackedWands; ++wand) {
        TrackedAll tracked;
        for (int time = 0; time < 2; ++time) {
            const Vec2 pushed(0.35, -0.8);
            tracked.stick(wand, pushed);
            const auto number = static_cast<std::uint32_t>(wand);
            EXPECT_EQ(tracked.heard<WandStick>(), (std::vector{WandStick{number, pushed}})) << wand;
            tracked->lose_all(tracked.time_ns());
            EXPECT_EQ(tracked.all_heard(), (std::vector<TrackerInput>{WandStick{number, Vec2(0.0)}})) << wand;
            tracked.stick(wand, Vec2(0.0));
            EXPECT_TRUE(tracked.all_heard().empty()) << "it rests already";
        }
    }
    for (std::size_t body = 0; body < 3; ++body) {
        TrackedAll tracked;
        for (int time = 0; time < 2; ++time) {
            tracked.pose(body, uneven_pose(body));
            auto there = tracked.all_heard();
            ASSERT_EQ(there.size(), 1u);
            tracked->lose_all(tracked.time_ns());
            if (auto* head = std::get_if<HeadInput>(&there[0])) head->tracked = false;
            if (auto* wand = std::get_if<WandInput>(&there[0])) wand->tracked = false;
            EXPECT_EQ(tracked.all_heard(), there) << body << ": where it was, and nothing else";
        }
    }
}

TEST(TrackedBodies, EachBodysPointStandsWhereItsOwnMountHasItWithPlaceAndTurn) {
    for (std::size_t body = 0; body < 3; ++body) {
        TrackedAll tracked;
        const TrackerBodies bodies = bodies_of_all();
        const Pose reported = uneven_pose(2 - body);
        tracked.pose(body, reported);
        const auto heard = tracked.all_heard();
        ASSERT_EQ(heard.size(), 1u);
        // M turns places and turns alike; lengths are of a unit of 1.7 m.
        const glm::dmat3 m = glm::mat3_cast(uneven_turn(3));
        glm::dmat4 tracker_from_body(m * glm::mat3_cast(reported.orientation) * glm::transpose(m));
        tracker_from_body[3] = glm::dvec4(1.7 * (m * reported.position_m), 1.0);
        const Pose mount = uneven_pose(body == 2 ? 0 : 1 + body);
        const glm::dmat4 expected = matrix_of(uneven_pose(4)) * tracker_from_body * matrix_of(mount);
        if (body == 2) {
            expect_is(std::get<HeadInput>(heard[0]).pose_world, expected, "head");
        } else {
            const auto& wand = std::get<WandInput>(heard[0]);
            EXPECT_EQ(wand.wand, body);
            expect_is(wand.pose_world, expected, "wand");
        }
    }
}

TEST(TrackedBodies, OfALeftHandedSystemPlacesAndTurnsAreMirroredAlike) {
    TrackerBodies bodies = bodies_of_all();
    bodies.frame.is_left_handed = true;
    TrackedAll tracked(bodies);
    const Pose reported = uneven_pose(1);
    tracked.pose(0, reported);
    const auto heard = tracked.heard<WandInput>();
    ASSERT_EQ(heard.size(), 1u);
    // M is a reflection now: minus the rotation that is kept. Turns are M R M^-1, in which the signs cancel.
    const glm::dmat3 m = -1.0 * glm::mat3_cast(uneven_turn(3));
    glm::dmat4 tracker_from_body(m * glm::mat3_cast(reported.orientation) * glm::inverse(m));
    tracker_from_body[3] = glm::dvec4(1.7 * (m * reported.position_m), 1.0);
    expect_is(heard[0].pose_world, matrix_of(uneven_pose(4)) * tracker_from_body * matrix_of(uneven_pose(1)), "wand");
}

TEST(TrackedBodies, EachWandsButtonsAreItsOwnAlsoInAnOrderOfTheirOwn) {
    TrackerBodies bodies = bodies_of_all();
    bodies.button_orders = {{{4, 0, 3}, {1, 5, 2}}};
    for (std::size_t wand = 0; wand < kTrackedWands; ++wand) {
        TrackedAll tracked(bodies);
        for (std::int32_t button = 0; button < 6; ++button) {
            tracked.button(wand, button, true);
            const auto& order = bodies.button_orders[wand];
            const auto place = std::ranges::find(order, button);
            std::vector<WandClick> expected;
            if (place != order.end())
                expected.push_back(
                    {static_cast<std::uint32_t>(wand), static_cast<std::uint32_t>(place - order.begin()), true});
            EXPECT_EQ(tracked.heard<WandClick>(), expected) << wand << " " << button;
        }
    }
}

TEST(TrackedBodies, ABodyThatHasStoppedIsLostAndTheOthersAreNot) {
    for (std::size_t stops = 0; stops < 3; ++stops) {
        TrackedAll tracked;
        for (std::size_t body = 0; body < 3; ++body) tracked.pose(body, uneven_pose(body));
        Nanoseconds last_ns = 0;
        for (int report = 0; report < 110; ++report)
            for (std::size_t body = 0; body < 3; ++body)
                if (body != stops) tracked.pose(body, uneven_pose(body)), last_ns = tracked.time_ns();
        static_cast<void>(tracked.all_heard());
        EXPECT_TRUE(tracked->lose_stopped(last_ns));
        const auto lost = tracked.all_heard();
        ASSERT_EQ(lost.size(), 1u) << stops;
        if (stops == 2) {
            EXPECT_FALSE(std::get<HeadInput>(lost[0]).tracked);
        } else {
            EXPECT_TRUE(std::get<WandInput>(lost[0]).wand == stops && !std::get<WandInput>(lost[0]).tracked);
        }
        EXPECT_FALSE(tracked->lose_stopped(last_ns)) << "once";
    }
}

// A server repeats what it measured last, with the time of the measurement: each body is told of it once, and the other
// bodies' times are no matter.
TEST(TrackedBodies, AMeasurementThatIsRepeatedIsToldOnceOfEachBody) {
    constexpr std::array<std::int32_t, 3> kNumbers{4, 7, 3};
    for (std::size_t repeated = 0; repeated < 3; ++repeated) {
        TrackedAll tracked;
        const auto report = [&](std::size_t body, Nanoseconds stamp_ns) {
            tracked->pose(body == 2 ? "Head" : "Wand", kNumbers[body], uneven_pose(body), true, tracked.time_ns(),
                          stamp_ns);
            return tracked.all_heard().size();
        };
        for (Nanoseconds stamp_ns = 1'000'000; stamp_ns < 5'000'000; stamp_ns += 1'000'000) {
            EXPECT_EQ(report(repeated, stamp_ns), 1u) << repeated;
            for (std::size_t body = 0; body < 3; ++body)
                for (int time = 0; time < 2; ++time)
                    EXPECT_EQ(report(body, stamp_ns), body == repeated || time > 0 ? 0u : 1u) << repeated << body;
        }
    }
}

}  // namespace burin::devices
