// SPDX-License-Identifier: MIT
// Balls that fall into a hand: a ball of 50 g falls on the stylus of a simulated Omni that a simulated hand holds.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <fstream>

#include "base/plot/figures.hpp"
#include "base/text.hpp"
#include "tests/haptics/bodies.hpp"
#include "tests/haptics/rig.hpp"

namespace burin::haptics {
namespace {

constexpr double kMass_kg = 0.05, kBall_m = 0.05, kTool_m = 0.01, kStep_s = 1e-3;

struct Fall {
    double felt_Ns = 0.0;   // by the hand
    double asked_Ns = 0.0;  // of the contact, within the device's force: what turns the ball round
    double before_m_per_s = 0.0, after_m_per_s = 0.0, contact_s = 0.0;
    int ramping = 0, ticks = 0;
    bool passed_through = false;
    std::vector<double> times_s, heights_mm, hands_mm, forces_N;  // for the picture
};

// The ball moves along y alone. It is published every 10 ms; in between the tick follows it.
Fall fall(double speed_m_per_s, bool announced, double honest_m_per_s = 2.0) {
    test::Rig rig({{0.0, Vec3(0.0)}});
    TickParameters parameters;
    parameters.probe = ball_probe(kTool_m);
    parameters.clearance_ratio = 0.0;
    parameters.passivity.surface_speed_m_per_s = honest_m_per_s;
    rig.publish(parameters, 1);
    geometry::LocalSurface surface = test::around({{test::snapshot_of(test::sphere(kBall_m, 3)), 0}});
    const double drop_m = std::min(0.03, 0.2 * speed_m_per_s * speed_m_per_s / kGravity_m_per_s2);
    double y = kBall_m + kTool_m + drop_m, v = 0.0;
    Fall f;
    constexpr int kReleased = 400;
    for (int i = 0; i < 1500; ++i) {
        if (i == kReleased) v = -std::sqrt(speed_m_per_s * speed_m_per_s - 2.0 * kGravity_m_per_s2 * drop_m);
        if (i % 10 == 0) {
            geometry::MeshMotion& motion = surface.meshes[0].motion;
            motion.body = 1;
            motion.object_from_mesh.position_m.y = y;
            // The mean of a free fall until the next publication.
            if (announced) motion.velocity_object_m_per_s.y = i < kReleased ? 0.0 : v - 0.005 * kGravity_m_per_s2;
            motion.time_ns = rig.clock.now_ns();
            rig.publish(surface, static_cast<std::uint64_t>(i + 1));
        }
        const TickRecord record = rig.tick();
        if (i < kReleased) continue;
        // What the wall asks, as far as the device can give it, acts on the ball.
        const double asked_N = std::clamp(-record.contact.points[0].force_device_N.y, 0.0, 3.3);
        f.asked_Ns += asked_N * kStep_s;
        f.times_s.push_back(kStep_s * (i - kReleased));
        f.heights_mm.push_back(1e3 * (y - kBall_m));
        f.hands_mm.push_back(1e3 * (record.sample.position_device_m.y + kTool_m));
        f.forces_N.push_back(-record.gate.given.force_device_N.y);
        f.felt_Ns -= record.gate.given.force_device_N.y * kStep_s;
        if (record.in_contact()) {
            if (f.ticks++ == 0) f.before_m_per_s = v;
            f.ramping += (record.flags & kTickRamping) != 0;
            f.contact_s = 1e-3 * f.ticks;
        } else if (f.ticks > 0 && v > 0.0) {
            break;
        }
        // Held until it is released.
        v += (asked_N / kMass_kg - kGravity_m_per_s2) * kStep_s;
        y += v * kStep_s;
        f.after_m_per_s = v;
        f.passed_through = f.passed_through || y < record.deepest().proxy_object_m.y;
    }
    return f;
}

TEST(FallingBall, IsFeltByTheHandWithTheMomentumThatItLoses) {
    for (const double speed : {0.2, 0.5, 1.0, 2.0}) {
        const Fall f = fall(speed, true);
        const double lost_Ns = kMass_kg * (f.after_m_per_s - f.before_m_per_s);
        const double theory_Ns = lost_Ns + kMass_kg * kGravity_m_per_s2 * f.contact_s;
        std::printf(
            "%.1f m/s: felt %.4f Ns, momentum and weight %.4f Ns, rises at %.3f m/s after %.0f ms; ramping %d\n", speed,
            f.felt_Ns, theory_Ns, f.after_m_per_s, 1e3 * f.contact_s, f.ramping);
        EXPECT_FALSE(f.passed_through) << speed;
        EXPECT_GT(f.after_m_per_s, 0.0) << speed << ": it bounces";
        EXPECT_LE(f.after_m_per_s, 1.1 * speed) << speed << ": and takes no energy along";
        EXPECT_EQ(f.ramping, 0) << speed;
        EXPECT_NEAR(f.felt_Ns, theory_Ns, 0.25 * theory_Ns) << speed;
    }
}

TEST(FallingBall, DoesItsWorkOnTheHandBecauseTheEnergyAccountCountsItAsHonest) {
    for (const double speed : {0.5, 1.0, 2.0}) {
        const Fall counted = fall(speed, true), not_counted = fall(speed, true, 0.0);
        std::printf("%.1f m/s, work not counted: felt %.4f Ns, counted %.4f Ns\n", speed, not_counted.felt_Ns,
                    counted.felt_Ns);
        EXPECT_LT(not_counted.felt_Ns, 0.8 * counted.felt_Ns) << speed;
    }
}

// docs/pictures/falling-ball.svg is this file.
TEST(FallingBall, IsSeenInAPicture) {
    std::vector<plot::TimePlot> plots;
    for (const double speed : {0.5, 1.0, 2.0}) {
        const Fall f = fall(speed, true);
        plots.push_back({formatted("falls at %.1f m/s", speed),
                         "mm",
                         f.times_s,
                         {{"ball, lowest point", f.heights_mm}, {"top of the tool", f.hands_mm}}});
        plots.push_back({"force on the hand", "N", f.times_s, {{"commanded", f.forces_N}}});
    }
    const std::string text = plot::time_figure("A ball of 50 g falls on a held stylus", plots, 2);
    EXPECT_NE(text.find("force on the hand"), std::string::npos);
    std::ofstream file(testing::TempDir() + "falling-ball.svg");
    file << text;
    EXPECT_TRUE(file.good());
}

TEST(FallingBall, IsHardlyFeltWhereNobodyAnnouncesItsMotion) {
    for (const double speed : {0.5, 1.0, 2.0}) {
        const Fall f = fall(speed, false);
        std::printf("%.1f m/s, not announced: felt %.4f Ns of %.4f\n", speed, f.felt_Ns, f.asked_Ns);
        EXPECT_LT(f.felt_Ns, 0.5 * f.asked_Ns) << speed;
    }
}

}  // namespace
}  // namespace burin::haptics
