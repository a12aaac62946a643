// SPDX-License-Identifier: MIT
// A fingertip of five points that close upon a ball and upon the edge of a block, turn under load and open again. Each
// point moves by itself: it is a part with a pose, a gate and an account of its own, and its way is that of the hand
// and its own motion relative to the hand. One piston displays the sum of their forces.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <numbers>

#include "base/plot/figures.hpp"
#include "haptics/forces/piston.hpp"
#include "tests/haptics/fingertip.hpp"

namespace burin::haptics {
namespace {

using test::PartsRig;

constexpr std::size_t kPoints = 5;
constexpr double kPoint_m = 0.003, kStiffness_N_per_m = test::kStiffness_N_per_m;  // radius of a point's ball
constexpr int kTicks = 2600, kFull = 500;  // from the latter on the ramp of the gates is over
constexpr double kTurn = 2.0 * std::numbers::pi;

// ---- What is grasped

struct Object {
    const char* name;
    test::Surface surface;
    Vec3 (*nearest)(const Vec3& position_m);  // the surface's point nearest to a point outside
    Vec3 closing;                             // unit; from where the fingertip comes
    double wrap;                              // how far a point beside the middle curls in, of its way beside it
    Vec3 foot_m;                              // of the piston, in the palm
    double tolerance_N, tilt;                 // of a point's force: in magnitude, and of it in direction
};

Vec3 nearest_on_ball(const Vec3& p) {
    return test::kSphereCenter + test::kSphere_m * glm::normalize(p - test::kSphereCenter);
}
Vec3 nearest_on_block(const Vec3& p) { return glm::clamp(p, Vec3(-0.03), Vec3(0.0, 0.0, 0.03)); }

// An edge may sink into the ball of a point by a thousandth of its radius, and a proxy is found to a micrometre.
constexpr double kFound_m = 1e-3 * kPoint_m + 1e-6;

// The mesh lies up to 8 um below its sphere. A facet's normal differs from the sphere's by what its corners are away,
// over the radius.
Object ball() {
    return {"a ball",
            test::fingertip_sphere(),
            nearest_on_ball,
            {0.0, 1.0, 0.0},
            0.08,
            {0.03, -0.07, 0.0},
            kStiffness_N_per_m * (8e-6 + kFound_m),
            0.0007 / test::kSphere_m};
}

// Its edge lies along z through the origin.
Object block() {
    return {"the edge of a block",
            test::box(Vec3(-0.03), {0.0, 0.0, 0.03}, 3),
            nearest_on_block,
            glm::normalize(Vec3(1.0, 1.0, 0.0)),
            0.9,
            {-0.02, -0.06, 0.0},
            kStiffness_N_per_m * kFound_m,
            0.01};
}

Vec3 force_by_the_book(const Object& object, const Vec3& position_m) {
    const Vec3 out = position_m - object.nearest(position_m);
    const double distance = glm::length(out);
    return std::max(0.0, kStiffness_N_per_m * (kPoint_m - distance)) * (out / distance);
}

// ---- The hand and its fingertip

double smooth(double from_s, double to_s, double t) {
    const double u = std::clamp((t - from_s) / (to_s - from_s), 0.0, 1.0);
    return u * u * (3.0 - 2.0 * u);
}

// The fingertip closes until 0.7 s, turns to both sides between 0.9 and 2.1 s, and opens from 2.2 s on.
struct TipPose {
    Vec3 position_m;
    Quat orientation;
};

TipPose tip_at(const Object& object, double t) {
    const double closed = smooth(0.3, 0.7, t) * (1.0 - smooth(2.2, 2.5, t));
    const double turned = t > 0.9 && t < 2.1 ? 0.4 * std::sin(kTurn * (t - 0.9) / 1.2) : 0.0;
    const Vec3 touching = object.nearest(Vec3(0.0)) + kPoint_m * object.closing;
    const Quat towards = glm::angleAxis(-std::atan2(object.closing.x, object.closing.y), Vec3(0.0, 0.0, 1.0));
    return {touching + (0.008 - 0.0115 * closed) * object.closing,
            glm::angleAxis(turned, Vec3(0.0, 0.0, 1.0)) * towards * glm::angleAxis(0.4 * turned, Vec3(1.0, 0.0, 0.0))};
}

// The point's own motion, in the fingertip's axes: one in the middle, four around it. Each spreads and presses in a
// rhythm of its own, and those beside the middle curl around what is grasped as the fingertip closes.
Vec3 own_motion(const Object& object, std::size_t index, double t) {
    static constexpr std::array kPeriods_s{0.71, 0.47, 0.53, 0.83, 0.61};
    const double swing = std::sin(kTurn * t / kPeriods_s[index] + static_cast<double>(index));
    const double around = 0.35 + 0.25 * kTurn * static_cast<double>(index);
    const double away_m = index == 0 ? 0.0 : 0.0045 * (1.0 + 0.15 * swing);
    const Vec3 beside(away_m * std::cos(around), 0.0, away_m * std::sin(around));
    const double curled_m = object.wrap * std::abs(beside.x) * smooth(0.4, 0.8, t);
    return beside - Vec3(0.0, curled_m + 0.001 * swing, 0.0);
}

devices::SimulatedHand hand_of(const Object& object, std::size_t index) {
    std::vector<devices::HandPose> script;
    for (double t = 0.0; t <= 1e-3 * kTicks; t += 0.01) {
        const TipPose tip = tip_at(object, t);
        script.push_back({t, tip.position_m + tip.orientation * own_motion(object, index, t)});
    }
    return *devices::SimulatedHand::create(std::move(script), devices::HandPath::monotone_cubic);
}

std::vector<devices::SimulatedHand> hands_of(const Object& object) {
    std::vector<devices::SimulatedHand> hands;
    for (std::size_t i = 0; i < kPoints; ++i) hands.push_back(hand_of(object, i));
    return hands;
}

TickParameters parameters(bool keeps_promise) {
    TickParameters p = test::point_parameters();
    p.probe = ball_probe(kPoint_m);
    p.passivity.control = keeps_promise;
    return p;
}

// ---- A turn of all five, and their piston

struct Fingertip {
    const Object& object;
    PartsRig rig;
    GateState gate;  // the piston's own

    struct Turn {
        std::vector<TickRecord> points;
        Vec3 centre_m{0.0};            // of the fingertip, as the hand leads it
        devices::DeviceWrench sum;     // of the points' commanded forces, about the centre
        PistonForce wanted_of_piston;  // by the rule
        GateOutput piston;
    };

    explicit Fingertip(const Object& grasped, bool keeps_promise = false)
        : object(grasped), rig(hands_of(grasped)), gate() {
        rig.publish(*object.surface);
        rig.publish_to_all(parameters(keeps_promise));
    }

    Turn turn() {
        Turn t;
        t.points = rig.turn();
        t.centre_m = tip_at(object, seconds(rig.clock.now_ns())).position_m;
        t.sum = sum([&](const TickRecord& r) { return r.gate.given.force_device_N; }, t);
        t.wanted_of_piston = piston_force(t.sum.force_device_N, t.centre_m - object.foot_m);
        GateInput in;
        in.wanted.force_device_N = t.wanted_of_piston.force_N;
        in.device_max_force_N = 10.0;
        in.in_contact = t.sum.force_device_N != Vec3(0.0);
        GateLimits limits;
        limits.max_force_N = 10.0;
        const GateStep step = pass_gate(gate, in, limits, 1e-3);
        gate = step.next;
        t.piston = step.output;
        return t;
    }

    template <typename Force>
    static devices::DeviceWrench sum(Force&& force, const Turn& t) {
        std::array<PointForce, kPoints> forces;
        for (std::size_t i = 0; i < kPoints; ++i)
            forces[i] = {t.points[i].sample.position_device_m - t.centre_m, force(t.points[i])};
        return sum_of(forces);
    }
};

void expect_same_bits(const TickRecord& a, const TickRecord& b) {
    const auto same = [](const Vec3& u, const Vec3& v) { return std::memcmp(&u, &v, sizeof u) == 0; };
    ASSERT_TRUE(same(a.sample.position_device_m, b.sample.position_device_m)) << a.tick;
    ASSERT_TRUE(same(a.deepest().proxy_object_m, b.deepest().proxy_object_m)) << a.tick;
    ASSERT_TRUE(same(a.wanted.force_device_N, b.wanted.force_device_N)) << a.tick;
    ASSERT_TRUE(same(a.gate.given.force_device_N, b.gate.given.force_device_N)) << a.tick;
    ASSERT_EQ(a.flags, b.flags) << a.tick;
}

}  // namespace

TEST(Fingertip, EachOfFivePointsOnItsOwnWayIsPushedByItsOwnDepthAndTheSumAndTorqueAreTheirs) {
    for (const Object& object : {ball(), block()}) {
        Fingertip tip(object);
        std::array<int, kPoints> touched{};
        double most_N = 0.0, most_Nm = 0.0, worst_N = 0.0, worst_sum_N = 0.0, worst_Nm = 0.0;
        for (int i = 0; i < kTicks; ++i) {
            const Fingertip::Turn t = tip.turn();
            const auto book = [&](const TickRecord& r) {
                return force_by_the_book(object, r.sample.position_device_m);
            };
            for (std::size_t k = 0; k < kPoints; ++k) {
                const TickRecord& r = t.points[k];
                const Vec3 right = book(r), force = i < kFull ? r.wanted.force_device_N : r.gate.given.force_device_N;
                worst_N = std::max(worst_N, glm::length(force - right));
                ASSERT_LE(glm::length(force - right), object.tolerance_N + object.tilt * glm::length(right))
                    << object.name << ' ' << i << " point " << k << ' ' << glm::length(right);
                touched[k] += r.in_contact() ? 1 : 0;
                most_N = std::max(most_N, glm::length(right));
            }
            if (i < kFull) continue;
            const devices::DeviceWrench right = Fingertip::sum(book, t);
            worst_sum_N = std::max(worst_sum_N, glm::length(t.sum.force_device_N - right.force_device_N));
            worst_Nm = std::max(worst_Nm, glm::length(t.sum.torque_device_Nm - right.torque_device_Nm));
            most_Nm = std::max(most_Nm, glm::length(right.torque_device_Nm));
            const double all_N = kPoints * object.tolerance_N + object.tilt * kPoints * most_N;
            ASSERT_LE(glm::length(t.sum.force_device_N - right.force_device_N), all_N) << object.name << ' ' << i;
            ASSERT_LE(glm::length(t.sum.torque_device_Nm - right.torque_device_Nm), 0.01 * all_N) << object.name << i;
        }
        std::printf("%s: up to %.3f N a point and %.2f mNm; off by at most %.2f mN, their sum %.2f mN, %.4f mNm\n",
                    object.name, most_N, 1e3 * most_Nm, 1e3 * worst_N, 1e3 * worst_sum_N, 1e3 * worst_Nm);
        for (std::size_t k = 0; k < kPoints; ++k) EXPECT_GT(touched[k], 800) << object.name << " point " << k;
        EXPECT_GT(most_N, 0.4) << object.name;
        EXPECT_GT(most_Nm, 0.001) << object.name;
    }
}

TEST(Fingertip, TurnsUnderLoadWithoutARampOrAStepAndTheLoadGoesToTheSideThatIsPressed) {
    for (const Object& object : {ball(), block()}) {
        Fingertip tip(object);
        Fingertip::Turn last;
        std::array<double, 2> torque_Nms{};  // about z, while the fingertip turns to one side and to the other
        for (int i = 0; i < 2100; ++i) {
            Fingertip::Turn t = tip.turn();
            if (i > 900) {
                for (std::size_t k = 0; k < kPoints; ++k) {
                    const TickRecord &now = t.points[k], &before = last.points[k];
                    ASSERT_EQ(now.flags & (kTickRamping | kTickSlewLimited | kTickFault), 0u) << object.name << i;
                    // No more than by what the point has moved, and what both may be off.
                    const double moved_m = glm::length(now.sample.position_device_m - before.sample.position_device_m);
                    ASSERT_LE(glm::length(now.gate.given.force_device_N - before.gate.given.force_device_N),
                              kStiffness_N_per_m * moved_m + 2.0 * object.tolerance_N + 2.0 * object.tilt)
                        << object.name << ' ' << i << " point " << k;
                }
                torque_Nms[i < 1500 ? 0 : 1] += 1e-3 * t.sum.torque_device_Nm.z;
            }
            last = std::move(t);
        }
        // Turned to the left, its left side is pressed, which turns it back to the right.
        EXPECT_LT(torque_Nms[0], -1e-4) << object.name;
        EXPECT_GT(torque_Nms[1], 1e-4) << object.name;
    }
}

TEST(Fingertip, APointThatIsNoLongerTrackedLosesItsForceAndTheOthersKeepTheirsToTheBit) {
    constexpr std::size_t kLost = 1;
    constexpr int kFrom = 1300, kTo = 1500;
    for (const Object& object : {ball(), block()})
        for (const devices::InjectedFault fault : {devices::InjectedFault::disconnected, devices::InjectedFault::frozen,
                                                   devices::InjectedFault::nan_position}) {
            const bool keeps_promise = fault == devices::InjectedFault::disconnected;  // the energy account too
            Fingertip tip(object, keeps_promise), whole(object, keeps_promise);
            double before_N = 0.0, last_piston_N = 0.0;
            bool returned = false;
            // What repeats a sample is found out when the sample is too old.
            const int off = fault == devices::InjectedFault::frozen
                                ? kFrom + static_cast<int>(1e3 * GateLimits{}.max_sample_age_s) + 1
                                : kFrom;
            for (int i = 0; i < 1900; ++i) {
                if (i == kFrom) tip.rig.fingers.inject(kLost, fault);
                if (i == kTo) tip.rig.fingers.inject(kLost, devices::InjectedFault::none);
                const Fingertip::Turn t = tip.turn(), same = whole.turn();
                for (std::size_t k = 0; k < kPoints; ++k)
                    if (k != kLost || i < kFrom) expect_same_bits(t.points[k], same.points[k]);
                const double force_N = glm::length(t.points[kLost].gate.given.force_device_N);
                if (i == kFrom - 1) before_N = force_N;
                if (i >= off && i < kTo) {
                    ASSERT_EQ(force_N, 0.0) << i;
                    ASSERT_NE(t.points[kLost].gate.cause, GateCause::none) << i;
                    Vec3 rest_N(0.0);
                    for (std::size_t k = 0; k < kPoints; ++k)
                        if (k != kLost) rest_N += t.points[k].gate.given.force_device_N;
                    ASSERT_EQ(t.sum.force_device_N, rest_N) << i;
                }
                returned = returned || (i > kTo + 100 && force_N > 0.0);
                // The piston's own gate makes no step of it either.
                const double piston_N = glm::length(t.piston.given.force_device_N);
                ASSERT_LE(std::abs(piston_N - last_piston_N), 1.0 + 1e-9) << i;
                last_piston_N = piston_N;
            }
            EXPECT_GT(before_N, keeps_promise ? 0.0 : 0.1) << object.name;
            EXPECT_TRUE(returned) << object.name;
        }
}

TEST(Fingertip, ItsPistonGivesTheSumOfThePointsForcesOverTheCosine) {
    for (const Object& object : {ball(), block()}) {
        Fingertip tip(object);
        int pushed = 0;
        for (int i = 0; i < kTicks; ++i) {
            const Fingertip::Turn t = tip.turn();
            const Vec3 sum_N = t.sum.force_device_N, given_N = t.piston.given.force_device_N;
            const Vec3 along = glm::normalize(t.centre_m - object.foot_m);
            if (sum_N == Vec3(0.0)) {
                ASSERT_EQ(t.wanted_of_piston.force_N, Vec3(0.0));
                continue;
            }
            ASSERT_EQ(t.wanted_of_piston.bound, PistonBound::none) << "it is grasped from the foot's side";
            if (i < kFull) continue;
            ++pushed;
            const double cosine = glm::dot(sum_N, along) / glm::length(sum_N);
            ASSERT_NEAR(glm::dot(given_N, along), glm::length(sum_N) / cosine, 1e-9) << object.name << ' ' << i;
            ASSERT_NEAR(glm::length(glm::cross(given_N, along)), 0.0, 1e-9) << object.name << ' ' << i;
        }
        EXPECT_GT(pushed, 1500) << object.name;
    }
}

namespace {

// Every tenth tick: a figure has no room for more.
constexpr int kEvery = 10;

// The object's section across z, or the line at this distance outside it: where it lies within 12 mm of the origin.
plot::PlotSeries outline(const Object& object, double away_m) {
    plot::PlotSeries line{"object, and where a point's ball touches it", {}, away_m == 0.0 ? 2.5 : 1.0};
    const auto add = [&](const Vec3& on, const Vec3& out) {
        const Vec3 p = 1e3 * (on + away_m * out);
        line.points.push_back({p.x, p.y, ""});
    };
    if (object.nearest == nearest_on_ball) {
        for (double angle = -0.4; angle <= 0.4; angle += 0.01) {
            const Vec3 out(std::sin(angle), std::cos(angle), 0.0);
            add(test::kSphereCenter + test::kSphere_m * out, out);
        }
        return line;
    }
    add({-0.012, 0.0, 0.0}, {0.0, 1.0, 0.0});
    for (int i = 0; i <= 20; ++i) add(Vec3(0.0), {std::sin(kTurn * i / 80), std::cos(kTurn * i / 80), 0.0});
    add({0.0, -0.012, 0.0}, {1.0, 0.0, 0.0});
    return line;
}

}  // namespace

// docs/pictures/fingertip.svg is this file.
TEST(Fingertip, IsSeenInAPicture) {
    std::vector<plot::Plot> plots;
    for (const Object& object : {ball(), block()}) {
        Fingertip tip(object);
        plot::Plot ways{std::string(object.name) + ": ways of the points, seen along z", "x, mm", "y, mm", {}};
        plot::Plot forces{std::string(object.name) + ": commanded forces", "time, s", "force, N", {}};
        ways.x_linear = ways.y_linear = ways.same_scale = forces.x_linear = forces.y_linear = true;
        ways.markers = forces.markers = false;
        for (std::size_t k = 0; k < kPoints; ++k) {
            ways.series.push_back({"point " + std::to_string(k + 1), {}});
            forces.series.push_back({"point " + std::to_string(k + 1), {}});
        }
        for (plot::Plot* one : {&ways, &forces}) {
            one->series.push_back({"sum of the five", {}});
            one->series.push_back({"piston", {}, 2.0});
        }
        for (int i = 0; i < kTicks; ++i) {
            const Fingertip::Turn t = tip.turn();
            if (i % kEvery != 0) continue;
            const double time_s = 1e-3 * i;
            for (std::size_t k = 0; k < kPoints; ++k) {
                const Vec3 at = 1e3 * t.points[k].sample.position_device_m;
                ways.series[k].points.push_back({at.x, at.y, ""});
                forces.series[k].points.push_back({time_s, glm::length(t.points[k].gate.given.force_device_N), ""});
            }
            forces.series[kPoints].points.push_back({time_s, glm::length(t.sum.force_device_N), ""});
            forces.series[kPoints + 1].points.push_back({time_s, glm::length(t.piston.given.force_device_N), ""});
        }
        for (std::size_t k = 0; k < kPoints; ++k)  // each way's number stands where it is farthest from the object
            std::ranges::max_element(ways.series[k].points, {}, [&](const plot::PlotPoint& p) {
                return glm::dot(Vec3(p.x, p.y, 0.0), object.closing);
            })->label = std::to_string(k + 1);
        for (const double grown_m : {0.0, kPoint_m}) ways.series.push_back(outline(object, grown_m));
        plots.push_back(std::move(ways));
        plots.push_back(std::move(forces));
    }
    const std::string text =
        plot::svg_figure("A fingertip of five points that move by themselves, and its piston", plots, 2);
    EXPECT_NE(text.find("a ball: ways of the points"), std::string::npos);
    EXPECT_EQ(text.find("nan"), std::string::npos);
    std::ofstream file(testing::TempDir() + "fingertip.svg");
    file << text;
    EXPECT_TRUE(file.good());
}

}  // namespace burin::haptics
