// SPDX-License-Identifier: MIT
// The watch over contacts, and balls that are set where they do not fit.
#include "haptics/contact/contact_watch.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "tests/haptics/bodies.hpp"
#include "tests/haptics/ticked_hand.hpp"

namespace burin::haptics {
namespace {

constexpr double kWatchedBall_m = 0.002;

// Whole ticks of a hand that goes where it is told.
struct WatchedHand : test::TickedHand {
    explicit WatchedHand(geometry::LocalSurface touched) {
        surface = std::move(touched);
        parameters.probe = ball_probe(kWatchedBall_m);
        parameters.clearance_ratio = 0.0;
        parameters.limit_stiffness = false;
        parameters.passivity.control = false;
        parameters.max_surface_age_s = 0.0;
    }
    [[nodiscard]] double force_N() const { return glm::length(record.gate.given.force_device_N); }
};

WatchedHand on_a_plate() { return WatchedHand(test::around({{test::plate(0.05, 0.02), 0}})); }

// Two blocks with a slot between them, along y and z, of this width.
geometry::LocalSurface slot(double width_m) {
    const double half = 0.5 * width_m;
    return test::around({{test::snapshot_of(test::box({-0.03, -0.03, -0.03}, {-half, 0.0, 0.03}, 6)), 0},
                         {test::snapshot_of(test::box({half, -0.03, -0.03}, {0.03, 0.0, 0.03}, 6)), 0}});
}

}  // namespace

TEST(ContactWatch, LetsAHandGoThatACaughtToolHolds) {
    WatchedHand hand = on_a_plate();
    for (int i = 0; i < 400; ++i) hand.tick({0.0, kWatchedBall_m - 0.003, 0.0});
    ASSERT_GT(hand.force_N(), 1.5);
    hand.parameters.catch_drill = true;
    int held = 0, let_go = 0;
    double last_N = hand.force_N();
    for (int i = 0; i < 400; ++i) {
        const double up_m = std::min(0.00047 * i, 0.02);
        hand.tick({0.0, kWatchedBall_m - 0.003 + up_m, 0.0});
        const bool is_free = up_m > 0.003 + 0.0001;
        held += is_free && hand.force_N() > 0.0;
        if ((hand.record.flags & kTickLetGo) != 0) {
            ++let_go;
            EXPECT_EQ(hand.record.gate.cause, GateCause::caught);
            EXPECT_LE(last_N, 0.6) << "it has faded out before";
        }
        last_N = hand.force_N();
    }
    EXPECT_EQ(let_go, 1);
    EXPECT_GT(held, 20) << "the drill held it";
    EXPECT_LE(held, 100);
    EXPECT_EQ(hand.force_N(), 0.0);
    // And touches as before.
    hand.parameters.catch_drill = false;
    for (int i = 0; i < 600; ++i) hand.tick({0.0, kWatchedBall_m - 0.003, 0.0});
    EXPECT_GT(hand.force_N(), 1.5);
}

// A doubt that the next look takes back costs no force, however often it comes.
TEST(ContactWatch, FadesNothingBeforeThreeDoubtfulLooksInARow) {
    for (std::uint32_t doubtful = 0; doubtful < ContactWatch::kLooks; ++doubtful) {
        WatchState state;
        for (int i = 0; i < 500; ++i) {
            state.doubtful_looks = i / 12 % 2 == 0 ? doubtful : 0;
            ASSERT_FALSE(ContactWatch::gives_up(state));
            ASSERT_EQ(ContactWatch::share(state), 1.0) << doubtful;
        }
    }
    WatchState state;
    state.doubtful_looks = ContactWatch::kLooks;
    std::uint32_t ticks = 1;
    for (; !ContactWatch::gives_up(state); ++ticks) EXPECT_LT(ContactWatch::share(state), 1.0);
    EXPECT_EQ(ticks, ContactWatch::kFade);
}

// The proxy lies soundly on a thin plate, and the hand is in free air beyond it. That alone is no doubt; a search that
// has run out of work for eight ticks is.
TEST(ContactWatch, DoubtsAContactThatFallsBehindWhileTheHandIsFree) {
    const geometry::LocalSurface plate = test::around({{test::plate(0.05, 0.0005), 0}});
    const geometry::PosedSurface posed(plate);
    const ContactWatch::Contact contact{
        .proxy_m = {0.0, kWatchedBall_m, 0.0}, .hand_m = {0.0, -0.01, 0.0}, .radius_m = kWatchedBall_m};
    const auto doubts_after = [&](int limited_ticks) {
        WatchState state;
        ContactWork work;
        for (int i = 0; i < limited_ticks; ++i) ContactWatch::note(state, true);
        ContactWatch::look(state, contact, posed, work);
        return state.doubtful_looks;
    };
    EXPECT_EQ(doubts_after(0), 0u);
    EXPECT_EQ(doubts_after(static_cast<int>(ContactWatch::kShort) - 1), 0u);
    EXPECT_EQ(doubts_after(static_cast<int>(ContactWatch::kShort)), 1u);
    EXPECT_EQ(doubts_after(500), 1u);
    WatchState caught_up;
    for (int i = 0; i < 500; ++i) ContactWatch::note(caught_up, true);
    ContactWatch::note(caught_up, false);
    ContactWork work;
    ContactWatch::look(caught_up, contact, posed, work);
    EXPECT_EQ(caught_up.doubtful_looks, 0u) << "one tick with enough work ends it";
}

TEST(ContactWatch, DoesNotLetGoWhileTheHandPresses) {
    WatchedHand hand = on_a_plate();
    for (int i = 0; i < 400; ++i) hand.tick({0.0, -0.003, 0.0});
    hand.parameters.catch_drill = true;
    for (int i = 0; i < 1000; ++i) {
        hand.tick({0.005 * std::sin(0.01 * i), -0.003 - 0.002 * std::sin(0.013 * i), 0.0});
        ASSERT_EQ(hand.record.flags & (kTickDoubted | kTickLetGo), 0u) << i;
    }
}

TEST(ContactWatch, SaysNothingOfSoundContacts) {
    // A plate so thin that a hand that presses is in free air beyond it.
    WatchedHand thin(test::around({{test::plate(0.05, 0.0005), 0}}));
    for (int i = 0; i < 1000; ++i) {
        thin.tick({0.01 * std::sin(0.01 * i), std::max(0.003 - 1e-4 * i, kWatchedBall_m - 0.0055), 0.0});
        ASSERT_EQ(thin.record.flags & (kTickDoubted | kTickLetGo), 0u) << i;
    }
    EXPECT_GT(thin.force_N(), 3.0);
    // A hole that the ball does not go through, and the hand does.
    WatchedHand narrow(slot(0.003));
    for (int i = 0; i < 1000; ++i) {
        narrow.tick({0.0, std::max(0.01 - 1e-4 * i, -0.004), 0.0});
        ASSERT_EQ(narrow.record.flags & (kTickDoubted | kTickLetGo), 0u) << i;
    }
    EXPECT_GT(narrow.force_N(), 1.0);
}

TEST(ContactWatch, ABallSetWhereItDoesNotFitGoesOutWithTheHand) {
    for (const double width_m : {0.0005, 0.002, 0.003, 0.0039, 0.00398}) {
        for (int start = 0; start < 40; ++start) {
            WatchedHand hand(slot(width_m));
            // In the slot, from the middle of its depth up, and not quite in its middle.
            const Vec3 from(0.2 * width_m * std::sin(start), -0.005 - 0.0005 * start, 0.01 * std::cos(2.0 * start));
            // Along the slot, or through a block. In the widest the ball fits, to within what edges may sink in: there
            // a block holds it.
            const bool along = start % 2 == 0 || width_m > 0.0039;
            const Vec3 out = along ? Vec3(from.x, 0.03, from.z) : Vec3(0.06, from.y, from.z);
            const int steps = 100 + 30 * (start % 5);
            int held_above = 0;
            for (int i = 0; i <= steps; ++i) {
                hand.tick(from + (static_cast<double>(i) / steps) * (out - from));
                held_above += hand.record.deepest().hip_object_m.y > 2.0 * kWatchedBall_m && hand.force_N() > 0.0;
            }
            for (int i = 0; i < 100; ++i) hand.tick(out);
            EXPECT_EQ(hand.force_N(), 0.0) << width_m << ", start " << start;
            EXPECT_EQ(hand.record.deepest().proxy_object_m, out) << width_m << ", start " << start;
            EXPECT_LE(held_above, 100) << width_m << ", start " << start;
        }
    }
}

TEST(ContactWatch, ABallSetInsideABlockIsPutOutAndItsForceFadesIn) {
    WatchedHand hand = on_a_plate();
    double last_N = 0.0;
    for (int i = 0; i < 400; ++i) {
        hand.tick({0.0, -0.002, 0.0});
        EXPECT_LE(hand.force_N() - last_N, 0.05) << i;
        last_N = hand.force_N();
    }
    EXPECT_NEAR(last_N, 600.0 * 0.004, 0.1);
}

// A thin plate that goes to and fro through a hand at rest, as announced: the ball goes with it.
TEST(ContactWatch, SaysNothingOfAThinPlateThatMoves) {
    for (const double speed : {0.1, 0.3, 0.6}) {
        test::Bodies bodies;
        bodies.parameters.probe = ball_probe(0.0005);
        bodies.surface = test::around({{test::plate(0.05, 0.0003), 0}});
        bodies.motions = {test::along_y([speed](double t) { return 0.003 * std::sin(speed / 0.003 * t); },
                                        [speed](double t) { return speed * std::cos(speed / 0.003 * t); })};
        bodies.publish_every = 1;
        int let_go = 0, contacts = 0;
        for (int i = 0; i < 2000; ++i) {
            const TickRecord record = bodies.tick({0.0, 0.0005 - 0.001, 0.0});
            let_go += (record.flags & kTickLetGo) != 0;
            contacts += record.in_contact();
        }
        EXPECT_GT(contacts, 500) << speed;
        EXPECT_EQ(let_go, 0) << speed;
    }
}

// A press on a place into which a ball could not be set anew: one sample that is not finite does not end it.
TEST(ContactWatch, APressGoesOnAfterABadSample) {
    const test::Surface groove = test::groove(0.004, 0.03, 12, 12, 0.0);
    WatchedHand hand(*groove);
    hand.parameters.probe = ball_probe(0.004);
    hand.parameters.clearance_ratio = 0.02;
    const Vec3 pressed(0.0, -0.0015, 0.0);
    for (int i = 0; i < 600; ++i) hand.tick({0.0, std::max(0.006 - 1e-4 * i, pressed.y), 0.0});
    const double before_N = hand.force_N();
    ASSERT_GT(before_N, 0.5);
    hand.tick(Vec3(std::numeric_limits<double>::quiet_NaN()));
    EXPECT_EQ(hand.force_N(), 0.0);
    for (int i = 0; i < 600; ++i) hand.tick(pressed);
    EXPECT_NEAR(hand.force_N(), before_N, 0.05);
}

}  // namespace burin::haptics
