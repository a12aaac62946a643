// SPDX-License-Identifier: MIT
// A soft ball that a hand squeezes, carries, throws and drops: its way against what the hand did and against free fall,
// and the force on the fingers where it changes hands.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include "bodies/soft_part.hpp"

namespace burin::bodies {
namespace {

constexpr double kCarriedBall_m = 0.03;
constexpr Nanoseconds kTurn_ns = 1'000'000;
constexpr Vec3 kPedestal_m{0.0, 0.5, 0.0};  // where the ball's middle stands

SoftPartSetup on_a_table() {
    SoftPartSetup setup;
    setup.scene_from_body.position_m = kPedestal_m;
    setup.half_axes_m = Vec3(kCarriedBall_m);
    setup.spacing_m = kCarriedBall_m / 3.2;
    FlightRoom room;
    room.restitution = 0.6;
    room.obstacles = {Box{{-0.2, 0.0, -0.2}, {0.2, 0.5 - kCarriedBall_m, 0.2}}, HalfSpace{}};
    setup.room = room;
    return setup;
}

// Two fingertips that press the ball from both sides along x, so deep each, of a hand whose middle is somewhere.
std::array<haptics::TickRecord, 2> two_fingers(const Vec3& middle_m, double depth_m, Nanoseconds now_ns) {
    std::array<haptics::TickRecord, 2> ticks;
    for (std::size_t finger = 0; finger < 2; ++finger) {
        const double side = finger == 0 ? -1.0 : 1.0;
        haptics::TickRecord& tick = ticks[finger];
        tick.time_ns = now_ns;
        // The hand does not turn, and its palm does not go with its fingers: they have no joints here.
        tick.sample.position_device_m = middle_m;
        tick.contact.point_count = 5;
        const Vec3 tip = middle_m + Vec3(side * (kCarriedBall_m - depth_m), 0.0, 0.0);
        constexpr double kWide_m = 0.004;
        const std::array places{tip, tip + Vec3(0, kWide_m, 0), tip - Vec3(0, kWide_m, 0), tip + Vec3(0, 0, kWide_m),
                                tip - Vec3(0, 0, kWide_m)};
        for (std::size_t i = 0; i < places.size(); ++i) tick.contact.points[i].hip_object_m = places[i];
    }
    return ticks;
}

// A session of such a hand: ticks each millisecond, updates each four.
class Carrying {
public:
    explicit Carrying(const SoftPartSetup& setup = on_a_table()) : part_(SoftPart::create(setup).value()) {}

    // Goes on for a time; where the hand is and how deep it presses follow from the time in seconds.
    void go_on(double for_s, const std::function<Vec3(double)>& middle, const std::function<double(double)>& depth) {
        const auto turns = static_cast<int>(for_s * 1000.0 + 0.5);
        for (int i = 0; i < turns; ++i) {
            now_ns_ += kTurn_ns;
            const auto ticks = two_fingers(middle(now_s()), depth(now_s()), now_ns_);
            std::array<double, 2> felt_N{};
            for (std::size_t finger = 0; finger < 2; ++finger)
                for (const geometry::LocalModel& model : part_->models(finger))
                    felt_N[finger] += model.force_at(ticks[finger].contact.points[model.point].hip_object_m, now_ns_);
            if (has_felt_)
                for (std::size_t f = 0; f < 2; ++f) step_N_ = std::max(step_N_, std::abs(felt_N[f] - felt_N_[f]));
            felt_N_ = felt_N;
            has_felt_ = true;
            most_N_ = std::max(most_N_, felt_N[0]);
            if (now_ns_ % (4 * kTurn_ns) != 0) continue;
            for (std::size_t finger = 0; finger < 2; ++finger) part_->take_ticks(finger, {&ticks[finger], 1});
            EXPECT_TRUE(part_->update(now_ns_, nullptr));
        }
    }
    // Updates alone, as when the device has fallen silent.
    void updates_without_ticks(double for_s, double each_s = 0.004) {
        for (int i = static_cast<int>(for_s / each_s + 0.5); i > 0; --i) {
            now_ns_ += nanoseconds(each_s);
            EXPECT_TRUE(part_->update(now_ns_, nullptr));
        }
    }
    void grasp() { part_->frame().take_hold(std::array<std::size_t, 2>{0, 1}); }
    void let_go() { part_->frame().let_go(); }
    // The largest change of a finger's force from a turn to the next since the last call, and the largest force.
    double step_N() { return std::exchange(step_N_, 0.0); }
    double most_N() { return std::exchange(most_N_, 0.0); }
    [[nodiscard]] double now_s() const { return seconds(now_ns_); }
    [[nodiscard]] SoftPart& part() { return *part_; }
    [[nodiscard]] Vec3 place_m() const { return part_->frame().pose().position_m; }

private:
    std::unique_ptr<SoftPart> part_;
    Nanoseconds now_ns_ = 0;
    bool has_felt_ = false;
    std::array<double, 2> felt_N_{};
    double step_N_ = 0.0, most_N_ = 0.0;
};

std::function<Vec3(double)> still_at(const Vec3& place_m) {
    return [place_m](double) { return place_m; };
}
std::function<double(double)> pressed(double depth_m) {
    return [depth_m](double) { return depth_m; };
}
constexpr double kOpenHand_m = -0.02;

// From 2 mm outside to 4 mm deep and back within a second; the points' own radius is 1 mm.
double squeezed_at(double t_s) { return 0.001 - 0.003 * std::cos(2.0 * std::numbers::pi * t_s); }

}  // namespace

TEST(CarriedBody, GoesWithTheHandAndLeavesTheForceAsItIs) {
    Carrying hand;
    hand.go_on(2.0, still_at(kPedestal_m), squeezed_at);
    const double squeeze_N = hand.most_N();
    EXPECT_GT(squeeze_N, 3.0);
    hand.go_on(0.5, still_at(kPedestal_m), squeezed_at);  // 4 mm deep
    hand.step_N();
    hand.grasp();
    // It is lifted, and carried to and fro at up to 0.5 m/s.
    const double from_s = hand.now_s();
    const auto way = [&](double t) {
        const double s = t - from_s;
        return kPedestal_m + Vec3(0.08 * (1.0 - std::cos(6.0 * s)), 0.05 * s, 0.0);
    };
    hand.go_on(2.0, way, pressed(0.004));
    const Vec3 wanted = way(hand.now_s());
    EXPECT_LT(glm::length(hand.place_m() - wanted), 1e-12);
    EXPECT_LT(hand.step_N(), 0.015 * squeeze_N) << "at the grasp and on the way";
    EXPECT_NEAR(hand.most_N(), squeeze_N, 0.02 * squeeze_N);
}

// Fingers that are still in it go on pushing it. Nothing rubs, so sooner or later they squeeze it out, which is quick.
TEST(CarriedBody, IsLetGoOfWithoutAStepOfTheForce) {
    Carrying hand;
    hand.go_on(2.0, still_at(kPedestal_m), squeezed_at);
    const double squeeze_step_N = hand.step_N();
    hand.go_on(0.5, still_at(kPedestal_m), squeezed_at);
    hand.grasp();
    const Vec3 up = kPedestal_m + Vec3(0.0, 0.2, 0.0);
    const double from_s = hand.now_s();
    const auto lift = [&](double t) {
        return kPedestal_m + 0.5 * (1.0 - std::cos(std::numbers::pi * (t - from_s))) * (up - kPedestal_m);
    };
    hand.go_on(1.0, lift, pressed(0.004));
    hand.step_N();
    hand.most_N();
    hand.let_go();
    const double since_s = hand.now_s();
    const auto opening = [&](double t) { return squeezed_at(0.5 + t - since_s); };
    hand.go_on(0.02, still_at(up), opening);
    EXPECT_GT(hand.most_N(), 3.0);
    EXPECT_LT(hand.step_N(), 2.0 * squeeze_step_N);
    hand.go_on(0.5, still_at(up), opening);
    hand.go_on(3.0, still_at(up), pressed(kOpenHand_m));
    EXPECT_TRUE(hand.part().frame().stands());
    EXPECT_LT(hand.place_m().y, 0.51) << "it lies on the table, or below";
}

TEST(CarriedBody, FliesAsItWasThrown) {
    Carrying hand;
    hand.go_on(0.1, still_at(kPedestal_m), pressed(kOpenHand_m));
    hand.grasp();
    const double from_s = hand.now_s();
    const Vec3 velocity(0.3, 0.9, -0.2);
    const auto way = [&](double t) { return kPedestal_m + (t - from_s) * velocity; };
    hand.go_on(0.1, way, pressed(kOpenHand_m));
    const Vec3 thrown_at = hand.place_m();
    hand.let_go();
    hand.go_on(0.14, still_at({0.0, 5.0, 0.0}), pressed(kOpenHand_m));
    const Vec3 fallen = thrown_at + 0.14 * velocity + Vec3(0.0, -0.5 * 9.81 * 0.14 * 0.14, 0.0);
    EXPECT_LT(glm::length(hand.place_m() - fallen), 1e-9);
    EXPECT_TRUE(hand.part().frame().flies());
}

// A device that tells nothing more leaves the ball where the hand was last, which is no throw.
TEST(CarriedBody, FallsWithoutAThrowFromAHandThatHasFallenSilent) {
    Carrying hand;
    hand.go_on(0.1, still_at(kPedestal_m), pressed(kOpenHand_m));
    hand.grasp();
    const double from_s = hand.now_s();
    hand.go_on(0.1, [&](double t) { return kPedestal_m + Vec3(0.0, (t - from_s) * 2.0, 0.0); }, pressed(kOpenHand_m));
    const Vec3 silent_at = hand.place_m();
    hand.updates_without_ticks(0.5);
    hand.let_go();
    hand.updates_without_ticks(0.1);
    EXPECT_LT(glm::length(hand.place_m() - silent_at - Vec3(0.0, -0.5 * 9.81 * 0.1 * 0.1, 0.0)), 1e-9);
}

// The push is as old as the update before: it is not what pressed through all the time that an update is late.
TEST(CarriedBody, IsNotHurledByAnUpdateThatComesLate) {
    Carrying hand;
    hand.go_on(0.1, still_at(kPedestal_m), pressed(0.003));
    hand.part().frame().fly({kPedestal_m + Vec3(0.003, 1.0, 0.0), Vec3(0.0), {}}, nanoseconds(hand.now_s()));
    hand.go_on(0.012, still_at(kPedestal_m + Vec3(0.0, 1.0, 0.0)), pressed(0.001));
    const Vec3 before = hand.part().frame().velocity_at(hand.place_m());
    hand.updates_without_ticks(0.3, 0.3);
    const Vec3 after = hand.part().frame().velocity_at(hand.place_m());
    EXPECT_LT(std::abs(after.x - before.x), 1.0);
}

TEST(CarriedBody, ThatRollsFallsWhenWhatItRolledOnIsTakenAway) {
    SoftPartSetup setup = on_a_table();
    std::swap(setup.room->obstacles[0], setup.room->obstacles[1]);  // the table last
    Carrying hand(setup);
    hand.part().frame().fly({kPedestal_m, {0.3, 0.0, 0.0}, {}}, 0);
    hand.updates_without_ticks(0.1);
    ASSERT_NEAR(hand.place_m().y, 0.5, 1e-6);
    ASSERT_TRUE(hand.part().frame().flies()) << "it rolls";
    FlightRoom room = *setup.room;
    room.obstacles.pop_back();
    hand.part().fall_among(room);
    hand.updates_without_ticks(0.2);
    EXPECT_NEAR(hand.place_m().y, 0.5 - 0.5 * 9.81 * 0.2 * 0.2, 0.005);
}

TEST(CarriedBody, FallsOnTheTableBouncesAndCanBeSqueezedThere) {
    Carrying hand;
    hand.grasp();  // nobody knows the hand yet: it stays where it is
    EXPECT_TRUE(hand.part().frame().stands());
    hand.go_on(0.02, still_at(kPedestal_m), pressed(kOpenHand_m));
    hand.grasp();
    const Vec3 up = kPedestal_m + Vec3(0.1, 0.15, 0.05);
    const double from_s = hand.now_s();
    hand.go_on(
        0.5, [&](double t) { return kPedestal_m + 2.0 * (t - from_s) * (up - kPedestal_m); }, pressed(kOpenHand_m));
    hand.go_on(0.1, still_at(up), pressed(kOpenHand_m));
    hand.let_go();
    double top_m = 0.0, low_m = 1.0;
    bool has_landed = false;
    for (int i = 0; i < 1000 && !hand.part().frame().stands(); ++i) {
        hand.go_on(0.004, still_at({0.0, 3.0, 0.0}), pressed(kOpenHand_m));
        low_m = std::min(low_m, hand.place_m().y);
        has_landed = has_landed || hand.place_m().y < 0.505;
        if (has_landed) top_m = std::max(top_m, hand.place_m().y);
    }
    EXPECT_NEAR(top_m - 0.5, 0.6 * 0.6 * 0.15, 5e-4) << "within what it falls in half an update at its top";
    EXPECT_GT(low_m, 0.5 - 1e-9);
    EXPECT_LT(glm::length(hand.place_m() - Vec3(up.x, 0.5, up.z)), 1e-9);
    hand.most_N();
    const double since_s = hand.now_s();
    hand.go_on(1.0, still_at(hand.place_m()), [&](double t) { return squeezed_at(t - since_s); });
    EXPECT_GT(hand.most_N(), 3.0);
    EXPECT_TRUE(hand.part().frame().stands());
}

TEST(CarriedBody, DoesItAllAgainToTheBit) {
    const auto ways = [] {
        Carrying hand;
        std::vector<Vec3> all;
        hand.go_on(0.3, still_at(kPedestal_m), squeezed_at);
        hand.grasp();
        hand.go_on(0.3, [](double t) { return kPedestal_m + Vec3(0.1 * t, 0.2 * t * t, 0.0); }, pressed(0.002));
        hand.let_go();
        for (int i = 0; i < 100; ++i) {
            hand.go_on(0.004, still_at(kPedestal_m), squeezed_at);
            all.push_back(hand.place_m());
            for (const auto& model : hand.part().models(0)) all.push_back(model.place_object_m * model.force_N);
        }
        return all;
    };
    EXPECT_EQ(ways(), ways());
}

TEST(CarriedBody, StaysWhereItIsLeftWithoutARoom) {
    SoftPartSetup setup = on_a_table();
    setup.room.reset();
    Carrying hand(setup);
    hand.go_on(0.1, still_at(kPedestal_m), pressed(kOpenHand_m));
    hand.grasp();
    const Vec3 there(0.1, 0.7, 0.2);
    hand.go_on(0.1, still_at(there), pressed(kOpenHand_m));
    hand.let_go();
    hand.go_on(0.1, still_at(kPedestal_m), pressed(kOpenHand_m));
    EXPECT_LT(glm::length(hand.place_m() - there), 1e-12);
    EXPECT_TRUE(hand.part().frame().stands());
}

}  // namespace burin::bodies
