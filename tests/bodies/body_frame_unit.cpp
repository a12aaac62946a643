// SPDX-License-Identifier: MIT
// How a body goes with the palm of a glove, whichever fingers hold it and however they bend; and that each hold and
// each throw is its own, whatever was before.
#include "bodies/body_frame.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "devices/gloves/glove_hand.hpp"
#include "devices/gloves/grip_shape.hpp"
#include "tests/support/uneven_poses.hpp"

namespace burin::bodies {
namespace {

using Parts = std::vector<std::size_t>;

constexpr Nanoseconds kFrameTick_ns = 4'000'000;
constexpr double kFrameTick_s = 0.004;

// Nothing draws it and nothing is in its way.
FlightRoom weightless() {
    FlightRoom room;
    room.gravity_m_per_s2 = Vec3(0.0);
    return room;
}

// A glove, and a part that is none (number 6), which carries the body itself; in a scene that is turned and scaled.
class GlovedHand {
public:
    explicit GlovedHand(BodyFrame& frame) : frame_(frame) {}

    // Has the palm, in the device's frame, there a tick later, its fingers bent in some shape by so much; each part
    // tells of it.
    void be_at(const Pose& palm, double closed, const Parts& silent = {}) {
        now_ns_ += kFrameTick_ns;
        palm_ = palm;
        for (std::size_t part = 0; part < 7; ++part) {
            if (std::ranges::find(silent, part) != silent.end() || (part >= devices::kGloveFingers && part < 6))
                continue;
            haptics::TickRecord tick;
            tick.time_ns = now_ns_;
            tick.motion.object_from_device = scene_from_device();
            tick.sample.position_device_m = palm.position_m;
            tick.sample.orientation_device = palm.orientation;
            if (part < devices::kGloveFingers) {
                devices::FingerAngles bend = devices::bent_in(devices::GripShape::whole, part, closed);
                bend[0] = 0.1 * (static_cast<double>(part) - 1.5) * closed;
                const Pose tip = devices::place_of(devices::usual_hand()[part], bend).hand_from_tip;
                tick.sample.position_device_m = palm.position_m + palm.orientation * tip.position_m;
                tick.sample.orientation_device = palm.orientation * tip.orientation;
                std::ranges::copy(bend, tick.sample.joints.begin());
            }
            frame_.take_tick(part, tick);
        }
        frame_.update(now_ns_, Vec3(0.0));
    }
    // Time passes without an update.
    void pass(int ticks) { now_ns_ += ticks * kFrameTick_ns; }
    // Time passes and nobody tells anything.
    void be_silent(int ticks) {
        for (int i = 0; i < ticks; ++i) frame_.update(now_ns_ += kFrameTick_ns, Vec3(0.0));
    }
    [[nodiscard]] static Similarity scene_from_device() { return {uneven_offset(4), uneven_turn(4), 1.7}; }
    [[nodiscard]] Pose scene_from_palm() const {
        const Similarity map = scene_from_device();
        return {map * palm_.position_m, map.orientation * palm_.orientation};
    }
    [[nodiscard]] Nanoseconds now_ns() const { return now_ns_; }
    // A velocity of the hand as it is in the scene.
    [[nodiscard]] static Vec3 in_scene(const Vec3& velocity_device) {
        return scene_from_device().scale * (scene_from_device().orientation * velocity_device);
    }

private:
    BodyFrame& frame_;
    Pose palm_;
    Nanoseconds now_ns_ = 0;
};

void expect_near(const Pose& is, const Pose& wanted, const std::string& of) {
    EXPECT_LT(glm::distance(is.position_m, wanted.position_m), 1e-9) << of;
    EXPECT_NEAR(std::abs(glm::dot(is.orientation, wanted.orientation)), 1.0, 1e-12) << of;
}

std::string text_of(const Parts& parts) {
    std::string text = "held by";
    for (const std::size_t part : parts) text += " " + std::to_string(part);
    return text;
}

const std::vector<Parts> kHolds{{0},    {1},    {2},    {3},    {6},          {0, 1},
                                {1, 0}, {1, 2}, {2, 3}, {0, 3}, {0, 1, 2, 3}, {3, 2, 1}};

Pose palm_after(int step) {
    const double way = 0.01 * step;
    return {uneven_offset(1) + way * Vec3(1.0, -2.0, 0.7),
            uneven_turn(1) * glm::angleAxis(0.05 * step, uneven_direction(3))};
}

}  // namespace

TEST(BodyFrame, StandsStillInAPalmWhoseFingersBend) {
    for (const Parts& parts : kHolds) {
        BodyFrame frame(uneven_pose(0), weightless());
        GlovedHand hand(frame);
        hand.be_at(palm_after(0), 0.2);
        frame.take_hold(parts);
        for (int step = 1; step <= 20; ++step) {
            hand.be_at(palm_after(0), 0.2 + 0.035 * step);
            expect_near(frame.pose(), uneven_pose(0), text_of(parts));
            EXPECT_LT(glm::length(frame.velocity_at(frame.pose().position_m + uneven_offset(2))), 1e-9);
        }
    }
}

TEST(BodyFrame, GoesWithThePalmAndTurnsWithItWhicheverFingersHoldIt) {
    for (const Parts& parts : kHolds) {
        BodyFrame frame(uneven_pose(0), weightless());
        GlovedHand hand(frame);
        for (int hold = 0; hold < 2; ++hold) {  // the second begins where the first has left it
            hand.be_at(palm_after(7 * hold), 0.2);
            const Pose body = frame.pose(), palm = hand.scene_from_palm();
            frame.take_hold(parts);
            for (int step = 1; step <= 20; ++step) {
                hand.be_at(palm_after(7 * hold + step), 0.2 + 0.035 * step);
                const Pose wanted =
                    scene::composed(hand.scene_from_palm(), scene::composed(scene::inverse(palm), body));
                expect_near(frame.pose(), wanted, text_of(parts) + ", hold " + std::to_string(hold));
            }
            frame.let_go();
            frame.put(frame.pose().position_m);
        }
    }
}

TEST(BodyFrame, IsThrownWithTheWayOfItsOwnHoldAlone) {
    const Vec3 slow(0.1, -0.2, 0.05), fast(-1.3, 0.9, 2.1);
    for (const Parts& parts : kHolds)
        for (const int ticks : {0, 1, 2, 3, 4, 12}) {
            BodyFrame frame(uneven_pose(0), weightless());
            GlovedHand hand(frame);
            Pose palm = palm_after(0);
            for (const Vec3& velocity : {fast, slow, fast, slow}) {
                const std::string of = text_of(parts) + " for " + std::to_string(ticks) + " ticks";
                const auto go_on = [&] {
                    palm.position_m += kFrameTick_s * velocity;
                    hand.be_at(palm, 0.4);
                };
                go_on();
                frame.take_hold(parts);
                for (int i = 0; i < ticks; ++i) go_on();
                // Of the last 20 ms, and of nothing where there are not two places of this hold.
                const Vec3 wanted = ticks > 1 ? hand.in_scene(velocity) : Vec3(0.0);
                frame.let_go();
                EXPECT_LT(glm::distance(frame.velocity_at(frame.pose().position_m), wanted), 1e-6) << of;
                const Vec3 from_m = frame.pose().position_m;
                const Nanoseconds from_ns = hand.now_ns();
                // Every other hold follows within the time over which a throw is taken.
                for (int i = 0; i < (velocity == fast ? 2 : 10); ++i) hand.be_at(palm, 0.4);
                EXPECT_LT(glm::distance(frame.pose().position_m, from_m + seconds(hand.now_ns() - from_ns) * wanted),
                          1e-6)
                    << of;
            }
        }
}

// Updates of a busy machine come late; a throw is no less one for that.
TEST(BodyFrame, IsThrownWithTheVelocityThatItHasWhereUpdatesComeLate) {
    const Vec3 velocity(1.3, 0.9, -2.1);
    for (const int late : {4, 6, 10, 24, 26}) {  // ticks of 4 ms between two updates
        BodyFrame frame(uneven_pose(0), weightless());
        GlovedHand hand(frame);
        Pose palm = palm_after(0);
        hand.be_at(palm, 0.4);
        frame.take_hold(Parts{0, 1, 2});
        for (int i = 0; i < 4; ++i) {
            palm.position_m += late * kFrameTick_s * velocity;
            hand.pass(late - 1);
            hand.be_at(palm, 0.4);
        }
        frame.let_go();
        const bool is_known = late * kFrameTick_ns <= BodyFrame::kLate_ns;
        EXPECT_LT(
            glm::distance(frame.velocity_at(frame.pose().position_m), is_known ? hand.in_scene(velocity) : Vec3(0.0)),
            1e-6)
            << late;
    }
}

// A table, a thin shelf and a floor; at each speed of the hand, straight down and aslant.
TEST(BodyFrame, StopsAtWhatStandsInItsWayWhileAHandHoldsIt) {
    FlightRoom room;
    room.radius_m = 0.03;
    room.obstacles = {HalfSpace{{0.0, 1.0, 0.0}, 0.0}, Box{Vec3(-0.3, 0.0, -0.3), Vec3(0.3, 0.1, 0.3)},
                      Box{Vec3(0.4, 0.2, -0.3), Vec3(0.8, 0.202, 0.3)}};
    struct Way {
        Vec3 from_m, way_m;
        double lowest_m;  // of its middle
    };
    for (const Way& way : {Way{{0.0, 0.3, 0.0}, {0.0, -0.6, 0.0}, 0.13}, Way{{0.0, 0.3, 0.0}, {0.1, -0.6, 0.05}, 0.13},
                           Way{{0.6, 0.4, 0.0}, {0.0, -0.6, 0.0}, 0.232}, Way{{0.9, 0.3, 0.0}, {0.0, -0.6, 0.0}, 0.03}})
        for (const int steps : {1, 3, 50}) {
            BodyFrame frame({way.from_m, Quat(1.0, 0.0, 0.0, 0.0)}, room);
            haptics::TickRecord tick;
            const auto be_at = [&](const Vec3& place_m) {
                tick.time_ns += kFrameTick_ns;
                tick.sample.position_device_m = place_m;
                frame.take_tick(6, tick);  // a part that carries the body itself
                frame.update(tick.time_ns, Vec3(0.0));
            };
            be_at(way.from_m);
            frame.take_hold(Parts{6});
            for (int i = 1; i <= steps; ++i) {
                be_at(way.from_m + i / static_cast<double>(steps) * way.way_m);
                for (const Obstacle& obstacle : room.obstacles)
                    EXPECT_GT(clearance_m(obstacle, frame.pose().position_m, room.radius_m), -1e-6) << steps;
            }
            EXPECT_NEAR(frame.pose().position_m.y, way.lowest_m, 1e-6) << steps;
            EXPECT_NEAR(frame.pose().position_m.x, way.from_m.x + way.way_m.x, 0.02) << "it slides along there";
            // It comes back into the palm as it lay there.
            be_at(way.from_m);
            EXPECT_LT(glm::distance(frame.pose().position_m, way.from_m), 1e-9) << steps;
        }
}

TEST(BodyFrame, FallsWithoutAThrowFromEachHoldThatFellSilent) {
    BodyFrame frame(uneven_pose(0), weightless());
    GlovedHand hand(frame);
    Pose palm = palm_after(0);
    for (int hold = 0; hold < 3; ++hold) {
        hand.be_at(palm, 0.4);
        frame.take_hold(Parts{1, 2});
        for (int i = 0; i < 10; ++i) {
            palm.position_m += Vec3(0.004, 0.003, -0.002);
            hand.be_at(palm, 0.4);
        }
        EXPECT_GT(glm::length(frame.velocity_at(frame.pose().position_m)), 1.0);
        hand.be_silent(1);
        EXPECT_EQ(frame.velocity_at(frame.pose().position_m), Vec3(0.0)) << "no news: it stands still";
        hand.be_silent(9);
        frame.let_go();
        EXPECT_EQ(frame.velocity_at(frame.pose().position_m), Vec3(0.0)) << hold;
    }
}

TEST(BodyFrame, StandsStillWhereItIsPutWhateverItDid) {
    const Vec3 place_m = uneven_offset(3);
    for (const bool in_room : {true, false})
        for (const bool was_held : {true, false}) {
            BodyFrame frame(uneven_pose(0), in_room ? std::optional(weightless()) : std::nullopt);
            GlovedHand hand(frame);
            for (int time = 0; time < 2; ++time) {
                hand.be_at(palm_after(0), 0.4);
                if (was_held) frame.take_hold(Parts{0, 1});
                if (!was_held) frame.fly({uneven_offset(2), 0.7 * uneven_direction(1), {}}, hand.now_ns());
                for (int step = 1; step < 5; ++step) hand.be_at(palm_after(step), 0.4);
                frame.put(place_m);
                for (int update = 0; update < 3; ++update) {
                    EXPECT_EQ(frame.velocity_at(place_m + uneven_offset(4)), Vec3(0.0)) << in_room << was_held;
                    EXPECT_EQ(frame.pose().position_m, place_m) << in_room << was_held;
                    hand.be_at(palm_after(6 + update), 0.4);
                }
            }
        }
}

// A rolling body that is pushed up flies as a thrown one does: it falls back, and rolls on.
TEST(BodyFrame, IsPushedOffWhatItRollsOnAndFallsBackEachTime) {
    FlightRoom room;
    room.radius_m = 0.03;
    room.restitution = 0.0;
    room.rolling_m_per_s2 = 0.01;
    room.obstacles = {HalfSpace{}};
    BodyFrame frame({{0.1, 0.03, -0.2}, uneven_turn(1)}, room);
    Nanoseconds now_ns = 0;
    const auto update = [&](const Vec3& push_m_per_s2) { frame.update(now_ns += kFrameTick_ns, push_m_per_s2); };
    update(Vec3(0.0));
    frame.fly({{0.1, 0.03, -0.2}, {0.3, 0.0, 0.2}, {}}, now_ns, true);
    for (int i = 0; i < 10; ++i) update(Vec3(0.0));
    for (int time = 0; time < 3; ++time) {
        ASSERT_TRUE(frame.flies()) << "it rolls";
        ASSERT_NEAR(frame.pose().position_m.y, 0.03, 1e-9);
        for (int i = 0; i < 5; ++i) update({0.0, 60.0, 0.0});
        const double from_m = frame.pose().position_m.y, up_m_per_s = frame.velocity_at(Vec3(0.0)).y;
        EXPECT_NEAR(up_m_per_s, 5 * kFrameTick_s * (60.0 - 9.81), 1e-9);
        for (int i = 1; i <= 20; ++i) {
            update(Vec3(0.0));
            const double t = i * kFrameTick_s;
            ASSERT_NEAR(frame.pose().position_m.y, from_m + up_m_per_s * t - 0.5 * 9.81 * t * t, 1e-9) << time << i;
        }
        for (int i = 0; i < 100; ++i) update(Vec3(0.0));
    }
}

// Fingers draw in what they close on at their own speed, in each hold and in each tick of it.
TEST(BodyFrame, ComesToItsSeatAtTheSameSpeedInEachHold) {
    const Vec3 seats[]{uneven_offset(2), uneven_offset(3), uneven_offset(0)};
    BodyFrame frame(uneven_pose(0), weightless());
    GlovedHand hand(frame);
    int step = 0;
    for (const Vec3& seat_m : seats) {
        hand.be_at(palm_after(step % 9), 0.3);
        const Parts parts{0, 1, 2};
        frame.take_hold(parts, seat_m);
        ASSERT_TRUE(frame.palm_from_body());
        Vec3 lay_m = frame.palm_from_body()->position_m;
        const double far_m = glm::distance(lay_m, seat_m);
        int ticks = 0;
        for (; ticks < 1000 && glm::distance(frame.palm_from_body()->position_m, seat_m) > 1e-12; ++ticks) {
            hand.be_at(palm_after(++step % 9), 0.3);
            const Vec3 lies_m = frame.palm_from_body()->position_m;
            ASSERT_LT(glm::distance(lies_m, lay_m), BodyFrame::kSeats_m_per_s * kFrameTick_s + 1e-12) << ticks;
            ASSERT_LT(
                std::abs(glm::distance(lay_m, seat_m) - glm::distance(lies_m, seat_m) - glm::distance(lies_m, lay_m)),
                1e-12)
                << "straight there";
            lay_m = lies_m;
        }
        const double took_s = (ticks - 1) * kFrameTick_s;  // the first update of a hold has nothing before it
        EXPECT_NEAR(took_s, far_m / BodyFrame::kSeats_m_per_s, kFrameTick_s);
        frame.let_go();
        frame.put(hand.scene_from_palm().position_m + uneven_offset(4));
        hand.be_at(palm_after(step % 9), 0.3);
    }
    frame.take_hold(Parts{0, 1});
    const Vec3 lies_m = frame.palm_from_body()->position_m;
    for (int i = 0; i < 20; ++i) hand.be_at(palm_after(i), 0.3);
    EXPECT_LT(glm::distance(frame.palm_from_body()->position_m, lies_m), 1e-12) << "a hold without a seat has none";
}

}  // namespace burin::bodies
