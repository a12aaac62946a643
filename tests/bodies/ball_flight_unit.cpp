// SPDX-License-Identifier: MIT
// A ball's flight: bounces and parabolas against what is worked out by hand, first contacts against a search that
// knows the distance to the obstacles alone, and the cases in which a flight by steps goes wrong.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "bodies/flight/ball_flight.hpp"
#include "bodies/flight/falling_roots.hpp"

namespace burin::bodies {
namespace {

constexpr double kG = 9.81, kFlyingRadius_m = 0.03;

FlightRoom floor_room(double restitution) {
    FlightRoom room;
    room.restitution = restitution;
    room.obstacles = {HalfSpace{}};
    return room;
}

double energy_of(const FlyingBall& ball) {
    return 0.5 * glm::dot(ball.velocity_m_per_s, ball.velocity_m_per_s) + kG * ball.place_m.y;
}

// A room of some boxes on a floor, and a throw into it, from numbers that are the same everywhere.
class DrawnRoom {
public:
    explicit DrawnRoom(std::uint64_t seed) : random_(seed) {}
    double in(double lo, double hi) { return lo + (hi - lo) * static_cast<double>(random_() >> 11) * 0x1p-53; }
    Vec3 in_box(double reach) { return {in(-reach, reach), in(-reach, reach), in(-reach, reach)}; }
    FlightRoom room() {
        FlightRoom drawn = floor_room(in(0.3, 0.95));
        for (int i = 0; i < 4; ++i) {
            const Vec3 lo(in(-0.8, 0.4), in(0.0, 0.5), in(-0.8, 0.4));
            drawn.obstacles.emplace_back(Box{lo, lo + Vec3(in(0.01, 0.4), in(0.01, 0.4), in(0.01, 0.4))});
        }
        return drawn;
    }
    // A ball that is clear of the room.
    FlyingBall ball(const FlightRoom& room) {
        for (;;) {
            FlyingBall ball{in_box(1.0) + Vec3(0.0, 1.1, 0.0), in_box(5.0), {}};
            const auto is_clear = [&](const Obstacle& of) {
                return clearance_m(of, ball.place_m, kFlyingRadius_m) > 0.01;
            };
            if (std::ranges::all_of(room.obstacles, is_clear)) return ball;
        }
    }

private:
    std::mt19937_64 random_;
};

// The first contact by the distance alone: the ball goes on for as long as it cannot have come through what is left.
double searched_contact_s(const FlyingBall& ball, const FlightRoom& room, double until_s) {
    double t = 0.0;
    while (t < until_s) {
        const Vec3 place = ball.place_m + t * ball.velocity_m_per_s + 0.5 * t * t * room.gravity_m_per_s2;
        double clear_m = 1e9;
        for (const Obstacle& of : room.obstacles) clear_m = std::min(clear_m, clearance_m(of, place, room.radius_m));
        if (clear_m < 1e-10) return t;
        const double fastest = glm::length(ball.velocity_m_per_s) + kG * until_s;
        t += clear_m / fastest;
    }
    return until_s;
}

}  // namespace

TEST(FallingRoots, AreThoseOfTheFactorsWithAFallingSign) {
    // (t - 1)(t - 2)(t - 3)(t - 4) = 24 - 50 t + 35 t^2 - 10 t^3 + t^4: above 0 before 1, between 2 and 3, beyond 4.
    const FallingRoots roots = falling_roots({24.0, -50.0, 35.0, -10.0, 1.0}, 10.0);
    ASSERT_EQ(roots.count, 2u);
    EXPECT_NEAR(roots.times[0], 1.0, 1e-12);
    EXPECT_NEAR(roots.times[1], 3.0, 1e-12);
    EXPECT_EQ(falling_roots({24.0, -50.0, 35.0, -10.0, 1.0}, 2.5).count, 1u);
    EXPECT_EQ(falling_roots({1.0, -2.0, 1.0, 0.0, 0.0}, 5.0).count, 0u) << "it touches zero and rises";
    ASSERT_EQ(falling_roots({0.0, -1.0, 0.0, 0.0, 0.0}, 5.0).count, 1u) << "it falls from where it begins";
    EXPECT_EQ(falling_roots({0.0, 1.0, 0.0, 0.0, 0.0}, 5.0).count, 0u);
    EXPECT_EQ(falling_roots({0.0, 0.0, -4.9, 0.0, 0.0}, 5.0).count, 1u);
    EXPECT_EQ(falling_roots({-1.0, 0.0, 0.0, 0.0, 0.0}, 5.0).count, 0u) << "nothing moves";
}

TEST(BallFlight, IsAParabolaHoweverOftenItIsAskedFor) {
    FlyingBall ball{{0.1, 2.0, -0.3}, {1.0, 3.0, -2.0}, {}};
    const FlightRoom room = floor_room(0.7);
    constexpr int kFrames = 500;
    double t = 0.0;
    for (int i = 0; i < kFrames; ++i) {
        const double dt = i % 3 == 0 ? 0.0007 : 0.0021;
        ball = flight_of(ball, room, dt).ball;
        t += dt;
        ASSERT_NEAR(ball.place_m.x, 0.1 + t, 1e-9);
        ASSERT_NEAR(ball.place_m.y, 2.0 + 3.0 * t - 0.5 * kG * t * t, 1e-9);
        ASSERT_NEAR(ball.place_m.z, -0.3 - 2.0 * t, 1e-9);
    }
}

// The height between two bounces is that of the time between them: t = 2 v / g, h = g t^2 / 8.
TEST(BallFlight, BouncesToTheSquareOfTheRestitution) {
    for (const double e : {0.3, 0.75, 0.95}) {
        FlyingBall ball{{0.0, 1.0 + kFlyingRadius_m, 0.0}, {0.4, 0.0, 0.0}, {}};
        const FlightRoom room = floor_room(e);
        std::vector<double> bounces_s;
        constexpr double kFrame_s = 1.0 / 60.0;
        for (int i = 0; i < 600 && bounces_s.size() < 5; ++i) {
            const Flight flight = flight_of(ball, room, kFrame_s);
            for (const Bounce& bounce : flight.bounces) bounces_s.push_back(i * kFrame_s + bounce.at_s);
            ball = flight.ball;
        }
        if (e < 0.5) bounces_s.resize(3);
        double height_m = 1.0;
        EXPECT_NEAR(bounces_s[0], std::sqrt(2.0 / kG), 1e-9);
        for (std::size_t i = 1; i < bounces_s.size(); ++i) {
            const double between_s = bounces_s[i] - bounces_s[i - 1], rose_m = kG * between_s * between_s / 8.0;
            EXPECT_NEAR(rose_m / height_m, e * e, 1e-9) << "bounce " << i << " at e = " << e;
            height_m = rose_m;
        }
    }
}

TEST(BallFlight, KeepsTheShareOfTheSpeedAlongTheSurface) {
    FlightRoom room = floor_room(0.5);
    room.tangential_kept = 0.8;
    const Flight flight = flight_of({{0.0, 0.5, 0.0}, {2.0, 0.0, 1.0}, {}}, room, 0.35);
    ASSERT_EQ(flight.bounces.size(), 1u);
    EXPECT_NEAR(flight.ball.velocity_m_per_s.x, 1.6, 1e-12);
    EXPECT_NEAR(flight.ball.velocity_m_per_s.z, 0.8, 1e-12);
}

TEST(BallFlight, DoesBothBouncesOfOneFrame) {
    FlightRoom room = floor_room(0.5);
    const double at_m = kFlyingRadius_m + 0.1;
    const Flight whole = flight_of({{0.0, at_m, 0.0}, {0.0, -10.0, 0.0}, {}}, room, 1.2);
    // 0.1 m at 10 m/s and up again at half of that: v = sqrt(100 + 2 g 0.1), back after 2 (v / 2) / g.
    const double v = std::sqrt(100.0 + 2.0 * kG * 0.1), first_s = (v - 10.0) / kG;
    ASSERT_EQ(whole.bounces.size(), 2u);
    EXPECT_NEAR(whole.bounces[0].at_s, first_s, 1e-12);
    EXPECT_NEAR(whole.bounces[1].at_s, first_s + v / kG, 1e-12);
    const double left_s = 1.2 - first_s - v / kG;
    EXPECT_NEAR(whole.ball.place_m.y, kFlyingRadius_m + 0.25 * v * left_s - 0.5 * kG * left_s * left_s, 1e-9);
}

TEST(BallFlight, PassesNoThinWallHoweverFast) {
    DrawnRoom drawn(3);
    FlightRoom room;
    room.gravity_m_per_s2 = Vec3(0.0, -kG, 0.0);
    room.obstacles = {Box{{-5.0, -50.0, -0.0005}, {5.0, 50.0, 0.0}}};
    for (int i = 0; i < 2000; ++i) {
        const double fast = i % 2 == 0 ? 10.0 : 200.0;
        FlyingBall ball{{drawn.in(-1, 1), drawn.in(-1, 1), drawn.in(0.031, 0.5)}, drawn.in_box(2.0), {}};
        ball.velocity_m_per_s.z = -fast;
        const Flight flight = flight_of(ball, room, 0.1);
        ASSERT_EQ(flight.bounces.size(), 1u);
        ASSERT_NEAR(flight.bounces[0].place_m.z, kFlyingRadius_m, 1e-9);
        ASSERT_GT(flight.ball.place_m.z, kFlyingRadius_m);
        ASSERT_NEAR(flight.ball.velocity_m_per_s.z, 0.75 * fast, 1e-9);
    }
}

// Zeno: all bounces together last (2 v / g) e / (1 - e) longer.
TEST(BallFlight, ComesToRestOnTheFloorAfterFiniteTime) {
    FlightRoom room = floor_room(0.6);
    const double height_m = 0.5, v = std::sqrt(2.0 * kG * height_m);
    const double zeno_s = v / kG + 2.0 * v / kG * 0.6 / 0.4;
    FlyingBall ball{{0.0, height_m + kFlyingRadius_m, 0.0}, Vec3(0.0), {}};
    double still_s = 0.0;
    std::size_t bounces = 0;
    for (int i = 0; i < 1000 && !ball.rests(); ++i) {
        const Flight flight = flight_of(ball, room, 0.004);
        ball = flight.ball;
        bounces += flight.bounces.size();
        still_s += 0.004;
    }
    EXPECT_TRUE(ball.rests());
    EXPECT_LT(still_s, zeno_s + 0.005);
    EXPECT_GT(still_s, zeno_s - 0.02) << "it bounces as long as it can be seen to";
    EXPECT_NEAR(static_cast<double>(bounces), 1.0 + std::log(v / kLeastBounce_m_per_s) / -std::log(0.6), 1.0);
    EXPECT_NEAR(ball.place_m.y, kFlyingRadius_m, 1e-12);
    const Flight later = flight_of(ball, room, 1000.0);
    EXPECT_EQ(later.ball, ball);
    EXPECT_TRUE(later.bounces.empty());
}

TEST(BallFlight, RollsOutEvenlyAndFallsOffATable) {
    FlightRoom room = floor_room(0.5);
    room.rolling_m_per_s2 = 0.5;
    room.obstacles.emplace_back(Box{{-1.0, 0.0, -1.0}, {0.0, 0.5, 1.0}});
    const Support table{1, {0.0, 1.0, 0.0}};
    const FlyingBall slow{{-0.5, 0.5 + kFlyingRadius_m, 0.0}, {0.4, 0.0, 0.0}, table};
    const FlyingBall stopped = flight_of(slow, room, 5.0).ball;
    EXPECT_TRUE(stopped.rests());
    EXPECT_NEAR(stopped.place_m.x, -0.5 + 0.4 * 0.4 / (2.0 * 0.5), 1e-12);
    FlyingBall fast = slow;
    fast.velocity_m_per_s.x = 2.0;
    const Flight fell = flight_of(fast, room, 20.0);
    EXPECT_GT(fell.ball.place_m.x, 0.0);
    EXPECT_NEAR(fell.ball.place_m.y, kFlyingRadius_m, 1e-9);
    EXPECT_TRUE(fell.ball.rests());
    const FlyingBall creeping{{-0.001, 0.5 + kFlyingRadius_m, 0.0}, {0.05, 0.0, 0.0}, table};
    FlyingBall off = creeping;
    for (int i = 0; i < 5000 && !off.rests(); ++i) off = flight_of(off, room, 0.004).ball;
    EXPECT_NEAR(off.place_m.y, kFlyingRadius_m, 1e-9) << "it rolls over the edge slowly";
}

TEST(BallFlight, ComesOutOfACornerItIsThrownInto) {
    FlightRoom room = floor_room(0.8);
    room.obstacles.emplace_back(HalfSpace{{1.0, 0.0, 0.0}, 0.0});
    room.obstacles.emplace_back(HalfSpace{{0.0, 0.0, 1.0}, 0.0});
    room.gravity_m_per_s2 = Vec3(0.0);
    // Along the diagonal it meets all three at one time, and goes back as it came, 0.8 times as fast.
    const Flight flight = flight_of({Vec3(1.0 + kFlyingRadius_m), Vec3(-4.0), {}}, room, 0.5);
    EXPECT_EQ(flight.bounces.size(), 3u);
    EXPECT_LT(glm::length(flight.ball.velocity_m_per_s - Vec3(3.2)), 1e-12);
    EXPECT_LT(glm::length(flight.ball.place_m - Vec3(kFlyingRadius_m + 0.25 * 3.2)), 1e-9);
    // With weight it ends on the floor of the corner.
    room.gravity_m_per_s2 = Vec3(0.0, -kG, 0.0);
    room.rolling_m_per_s2 = 1.0;
    FlyingBall ball{{0.5, 0.4, 0.3}, {-5.0, -4.0, -3.0}, {}};
    for (int i = 0; i < 4000 && !ball.rests(); ++i) ball = flight_of(ball, room, 0.004).ball;
    EXPECT_TRUE(ball.rests());
    EXPECT_NEAR(ball.place_m.y, kFlyingRadius_m, 1e-9);
}

TEST(BallFlight, MeetsBoxesWhenTheirDistanceSaysSo) {
    int met = 0, edges = 0;
    for (std::uint64_t seed = 1; seed <= 2000; ++seed) {
        DrawnRoom drawn(seed);
        const FlightRoom room = drawn.room();
        const FlyingBall ball = drawn.ball(room);
        const Flight flight = flight_of(ball, room, 1.0);
        const double searched_s = searched_contact_s(ball, room, 1.0);
        if (searched_s >= 1.0) {
            EXPECT_TRUE(flight.bounces.empty()) << seed;
            continue;
        }
        ASSERT_FALSE(flight.bounces.empty()) << seed;
        const Bounce& first = flight.bounces.front();
        EXPECT_NEAR(first.at_s, searched_s, 1e-6) << seed;
        EXPECT_NEAR(clearance_m(room.obstacles[first.obstacle], first.place_m, kFlyingRadius_m), 0.0, 1e-9) << seed;
        ++met;
        edges += std::ranges::max({std::abs(first.normal.x), std::abs(first.normal.y), std::abs(first.normal.z)}) < 1.0;
    }
    EXPECT_GT(met, 1000);
    EXPECT_GT(edges, 20) << "edges and corners are met as well";
}

TEST(BallFlight, GoesThroughNothingAndGainsNothing) {
    for (std::uint64_t seed = 1; seed <= 60; ++seed) {
        DrawnRoom drawn(seed);
        const FlightRoom room = drawn.room();
        FlyingBall ball = drawn.ball(room);
        for (int frame = 0; frame < 300; ++frame) {
            const double before = energy_of(ball);
            const Flight flight = flight_of(ball, room, 1.0 / 60.0);
            for (const Arc& arc : flight.arcs)
                for (int i = 0; i <= 8; ++i) {
                    const Vec3 place = arc.place_at(arc.begin_s + arc.length_s * i / 8.0);
                    for (const Obstacle& of : room.obstacles)
                        ASSERT_GT(clearance_m(of, place, kFlyingRadius_m), -2e-9) << seed << " " << frame;
                }
            ball = flight.ball;
            ASSERT_TRUE(finite(ball.place_m) && finite(ball.velocity_m_per_s));
            const double off_edges = 0.5 * kLeastOffEdge_m_per_s * kLeastOffEdge_m_per_s;
            ASSERT_LE(energy_of(ball), before + 1e-9 + off_edges * static_cast<double>(flight.bounces.size())) << seed;
        }
    }
}

TEST(BallFlight, EndsTheCrowdOfBouncesInAGapThatItHardlyFitsIn) {
    FlightRoom room;
    room.restitution = 1.0;
    room.gravity_m_per_s2 = Vec3(0.0);
    room.obstacles = {HalfSpace{{1.0, 0.0, 0.0}, -kFlyingRadius_m},
                      HalfSpace{{-1.0, 0.0, 0.0}, -kFlyingRadius_m - 1e-7}};
    const Flight flight = flight_of({Vec3(0.0), {3.0, 0.0, 1.0}, {}}, room, 1.0);
    EXPECT_LE(flight.bounces.size(), kMostBounces);
    EXPECT_TRUE(flight.ball.rests());
}

TEST(BallFlight, PutsABallThatIsInATableOutOfIt) {
    FlightRoom room = floor_room(0.5);
    room.obstacles.emplace_back(Box{{-1.0, 0.0, -1.0}, {1.0, 0.5, 1.0}});
    for (const double y : {0.51, 0.49, 0.4}) {
        const FlyingBall ball = flight_of({{0.2, y, 0.1}, Vec3(0.0), {}}, room, 0.2).ball;
        EXPECT_NEAR(ball.place_m.y, 0.5 + kFlyingRadius_m, 1e-8) << y;
        EXPECT_TRUE(ball.rests());
    }
}

// A hand that closes on a ball is met between the turns: both move, and neither is near the other at either end.
TEST(BallFlight, TellsWhenItComesNearAMovingPoint) {
    const FlightRoom room = floor_room(0.7);
    const FlyingBall ball{{0.0, 1.0, 1.0}, {0.0, 0.0, -50.0}, {}};
    const Flight flight = flight_of(ball, room, 0.04);
    const Vec3 at(0.05, 1.0, -0.6), velocity(0.0, 0.0, 20.0);
    const auto met_s = first_within(flight.arcs, at, velocity, 0.06);
    ASSERT_TRUE(met_s);
    double searched_s = 0.0;
    while (glm::length(flight.arcs[0].place_at(searched_s) - at - searched_s * velocity) > 0.06) searched_s += 1e-6;
    EXPECT_NEAR(*met_s, searched_s, 2e-6);
    EXPECT_FALSE(first_within(flight.arcs, at + Vec3(0.2, 0.0, 0.0), velocity, 0.06));
    // Behind a bounce.
    const Flight bounced = flight_of({{0.0, 0.1, 0.0}, {0.0, -5.0, 0.0}, {}}, room, 0.2);
    const auto behind_s = first_within(bounced.arcs, {0.0, 0.4, 0.0}, Vec3(0.0), 0.01);
    ASSERT_TRUE(behind_s);
    EXPECT_GT(*behind_s, bounced.bounces.front().at_s);
}

}  // namespace burin::bodies
