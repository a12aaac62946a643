// SPDX-License-Identifier: MIT
// The passivity observer and controller: an energy account against one kept along the true motion, and what the
// controller may and may not do.
#include "haptics/stability/passivity.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "haptics/tick.hpp"
#include "tests/haptics/surfaces.hpp"
#include "tests/support/test_units.hpp"

namespace burin::haptics {
namespace {

devices::DeviceDescription wall_device(double friction = 0.26, double damping = 0.05, double delay_s = 0.001) {
    devices::DeviceDescription d;
    d.resolution_m = kEncoderStep;
    d.friction_N = friction;
    d.damping_Ns_per_m = damping;
    d.delay_s = delay_s;
    return d;
}

// A wall of stiffness K below y = 0, pushing up.
PassivityInput wall_input(double y_m, double stiffness, double max_force_N = 0.0) {
    PassivityInput in;
    in.position_device_m = {0.0, y_m, 0.0};
    const double depth = std::max(0.0, -y_m);
    in.wanted.force_device_N = {0.0, stiffness * depth, 0.0};
    in.stored_J = 0.5 * stiffness * depth * depth;
    in.max_force_N = max_force_N;
    in.in_contact = depth > 0.0;
    return in;
}

// A tick after the last one.
PassivityInput next(const PassivityObserver& state, PassivityInput in) {
    in.time_ns = in.now_ns = state.account.time_ns + nanoseconds(kDt);
    return in;
}

PassivityObserver commanded(PassivityObserver state, const Vec3& force_device_N) {
    set_commanded_wrench(state, {force_device_N, Vec3(0.0)}, state.account.time_ns);
    return state;
}

// Down at the speed, then up again, until the tool has been out for a while. The device gives what it is told, up to
// its force.
struct Push {
    double left_J = 0.0;        // E just before it is reset in free space
    double most_damping = 0.0;  // that the controller gave
    double work_J = 0.0;        // of the force that acted on the tool, along the true motion
};
Push push(double stiffness, double speed, double depth_m, const devices::DeviceDescription& d,
          PassivitySettings settings = {}, double max_force_N = 1e9) {
    PassivityObserver state;
    Push out;
    double told_N = 0.0, acting_N = 0.0, y = 0.0042e-3, before = y;
    bool down = true;
    for (int i = 0; i < 4000 && y < 2e-3; ++i) {
        const double sampled = kEncoderStep * std::floor(y / kEncoderStep + 0.5);
        const PassivityStep step =
            keep_passive(state, next(state, wall_input(sampled, stiffness, max_force_N)), settings, d, kDt);
        out.work_J += acting_N * (y - before);
        if (step.record.energy_J != 0.0) out.left_J = step.record.energy_J;
        out.most_damping = std::max(out.most_damping, step.record.damping_Ns_per_m);
        acting_N = d.delay_s > 0.0 ? told_N : std::min(step.wrench.force_device_N.y, max_force_N);
        told_N = std::min(step.wrench.force_device_N.y, max_force_N);
        state = commanded(step.next, {0.0, told_N, 0.0});
        before = y;
        y += (down ? -speed : speed) * kDt;
        if (y < -depth_m) down = false;
    }
    return out;
}

}  // namespace

TEST(PassivityObserver, CountsTheEnergyOfASampledWallAsTheClosedFormDoes) {
    // In and out at v the force is late by T/2 and the delay, which gives K (T/2 + t_d) v on every metre of the way.
    PassivitySettings observe;
    observe.control = false;
    for (const double delay : {0.0, 0.001}) {
        const double K = 800.0, v = 0.1, depth = 4e-3;
        const Push p = push(K, v, depth, wall_device(0.26, 0.05, delay), observe);
        const double expected = -K * (0.5 * kDt + delay) * v * 2.0 * depth;
        EXPECT_NEAR(p.left_J / expected, 1.0, 0.1) << delay;  // the turn, and the steps of the encoder
        EXPECT_NEAR(p.left_J, -p.work_J, 0.05 * std::abs(p.work_J));
        EXPECT_EQ(p.most_damping, 0.0);
    }
}

TEST(PassivityController, IsQuietWhereTheDevicesFrictionCoversTheWall) {
    // 600 N/m at 0.15 m/s lies within the limiter's promise for this device.
    for (const double v : {0.02, 0.1, 0.15}) EXPECT_EQ(push(600.0, v, 4e-3, wall_device()).most_damping, 0.0) << v;
}

TEST(PassivityController, IsQuietOnASoftWallPressedBeyondTheForceLimit) {
    EXPECT_EQ(push(600.0, 0.12, 15e-3, wall_device(), {}, 3.3).most_damping, 0.0);
}

TEST(PassivityController, TakesBackWhatAStiffWallGivesOutTooMuch) {
    PassivitySettings observe, control;
    observe.control = false;
    const devices::DeviceDescription bare = wall_device(0.0, 0.0, 0.001);
    const Push without = push(1000.0, 0.2, 4e-3, bare, observe), with = push(1000.0, 0.2, 4e-3, bare, control);
    EXPECT_GT(with.most_damping, 0.0);
    EXPECT_LT(with.work_J, 0.5 * without.work_J);
}

TEST(PassivityController, NeverTurnsAForceAddsEnergyOrExceedsItsGainOnAnyMotion) {
    std::mt19937_64 engine(7);
    const auto number = [&](double lo, double hi) {
        return lo + (hi - lo) * static_cast<double>(engine() >> 11) * 0x1p-53;
    };
    int acted = 0;
    for (int run = 0; run < 300; ++run) {
        PassivitySettings settings;
        settings.max_damping_Ns_per_m = number(0.0, 20.0);
        // Half of them without friction and damping: nothing is known of these, so nothing is scaled.
        const double known = run % 2;
        const devices::DeviceDescription d =
            wall_device(known * number(0.0, 0.2), known * number(0.0, 0.2), number(0.0, 0.02));
        PassivityObserver state;
        Vec3 position(0.0);
        for (int i = 0; i < 200; ++i) {
            const Vec3 moved = Vec3(number(-1, 1), number(-1, 1), number(-1, 1)) * number(0.0, 4e-4);
            position += moved;
            PassivityInput in = wall_input(position.y, number(100.0, 20'000.0), 3.3);
            in.position_device_m = position;
            in.wanted.force_device_N.x = number(-0.5, 0.5) * in.wanted.force_device_N.y;
            in.jumped = number(0.0, 1.0) < 0.01;
            const PassivityStep step = keep_passive(state, next(state, in), settings, d, kDt);
            // what the account does not afford is taken away in proportion
            const Vec3 added = step.wrench.force_device_N / step.record.share - in.wanted.force_device_N;
            const double wanted = glm::length(in.wanted.force_device_N);
            EXPECT_LE(glm::dot(added, moved), 1e-15);  // no energy by what it has seen
            EXPECT_GE(glm::dot(step.wrench.force_device_N, in.wanted.force_device_N), 0.0);  // no pull
            EXPECT_NEAR(glm::length(glm::cross(step.wrench.force_device_N, in.wanted.force_device_N)), 0.0, 1e-9);
            EXPECT_LE(glm::length(added), settings.max_damping_Ns_per_m * glm::length(moved) / kDt + 1e-12);
            EXPECT_LE(step.record.damping_Ns_per_m, settings.max_damping_Ns_per_m);
            if (i > 0 && std::abs(glm::dot(moved, in.wanted.force_device_N)) < 1.99 * kEncoderStep * wanted) {
                EXPECT_EQ(step.record.damping_Ns_per_m, 0.0);  // quiet below two steps where there is no window
                EXPECT_LE(glm::length(added), 1e-12);          // rounding of the share
            }
            if (step.record.damping_Ns_per_m > 0.0) ++acted;
            state = commanded(step.next, step.wrench.force_device_N * std::min(1.0, 3.3 / std::max(3.3, wanted)));
        }
    }
    EXPECT_GT(acted, 1000);
}

TEST(PassivityController, ActsOnASlowLeakOverAWindowOfTicksAndNotOnAMotionThatHasTurned) {
    // Drawn out at 20 mm/s, a step in every third tick, with a debt.
    const devices::DeviceDescription d = wall_device(0.0, 0.0, 0.0);
    const auto damping = [&](double last_steps) {
        VelocityWindow window;
        PassivityObserver state;
        state.known = state.account.counting = true;
        state.reserve_J = -1e-6;
        PassivityInput in;
        for (int i = 0; i < 8; ++i) {
            const double steps = i < 7 ? std::floor(i / 3.0) : 2.0 + last_steps;
            state.position_device_m = in.position_device_m;
            in = next(state, wall_input(-2e-3 + kEncoderStep * steps, 500.0));
            window = with_position(window, in.position_device_m);
        }
        in.stored_J = 0.0;  // nothing but the debt
        in.window = &window;
        return keep_passive(state, in, {}, d, kDt).record.damping_Ns_per_m;
    };
    EXPECT_NEAR(damping(0.0), 1e-6 / (std::pow(2.0 * kEncoderStep / (5 * kDt), 2.0) * kDt), 1e-9);
    EXPECT_NEAR(damping(1.0), 1e-6 / (std::pow(2.0 * kEncoderStep / (2 * kDt), 2.0) * kDt), 1e-9);
    EXPECT_EQ(damping(-1.0), 0.0);
}

TEST(PassivityObserver, StartsAnewInFreeSpaceOnceTheLastForceHasActed) {
    PassivityObserver state;
    const devices::DeviceDescription d = wall_device();
    const auto go = [&](double y) {
        const PassivityStep step = keep_passive(state, next(state, wall_input(y, 1000.0)), {}, d, kDt);
        state = commanded(step.next, step.wrench.force_device_N);
        return step.record.energy_J;
    };
    (void)go(0.001);
    (void)go(-0.001);
    (void)go(-0.001);
    EXPECT_NE(go(0.001), 0.0);   // the force of the tick before is still acting
    EXPECT_NE(go(0.0011), 0.0);  // told before the wall was left
    EXPECT_EQ(go(0.0012), 0.0);
}

TEST(PassivityController, DoesNothingWhereNobodySaysWhatTheDeviceWasTold) {
    PassivityObserver state;
    for (int i = 0; i < 40; ++i) {
        const PassivityStep step =
            keep_passive(state, next(state, wall_input(-0.0003 * i, 2000.0)), {}, wall_device(0.0, 0.0, 0.0), kDt);
        EXPECT_EQ(step.record.damping_Ns_per_m, 0.0);
        EXPECT_EQ(step.record.energy_J, 0.0);
        state = step.next;
    }
}

TEST(PassivityController, WaitsWhileTheGateFadesAForceIn) {
    PassivityObserver state;
    const devices::DeviceDescription d = wall_device(0.0, 0.0, 0.0);
    double damping = 0.0;
    for (int i = 0; i < 40; ++i) {
        PassivityInput in = wall_input(-0.0003 * i, 2000.0);
        in.jumped = i <= 1;
        const PassivityStep step = keep_passive(state, next(state, in), {}, d, kDt);
        damping = std::max(damping, step.record.damping_Ns_per_m);
        state = commanded(step.next, step.wrench.force_device_N * (0.01 * i));
    }
    EXPECT_EQ(damping, 0.0);
}

// A body that claims to be faster than anything honest gives no more than one at the limit.
TEST(PassivityController, BelievesABodyUpToASpeed) {
    const devices::DeviceDescription d = wall_device();
    const PassivitySettings settings{.reserve_J = 1.0, .surface_speed_m_per_s = 2.0};
    const auto reserve_after = [&](double speed) {
        PassivityObserver state;
        for (int i = 0; i < 4; ++i) {
            PassivityInput in = wall_input(-0.003, 600.0);
            in.surface_velocity_device_m_per_s = {0.0, speed, 0.0};
            const PassivityStep step = keep_passive(state, next(state, in), settings, d, kDt);
            state = commanded(step.next, step.wrench.force_device_N);
        }
        return state.reserve_J;
    };
    EXPECT_GT(reserve_after(1.0), reserve_after(0.0) + 1e-6);
    EXPECT_GT(reserve_after(2.0), reserve_after(1.0) + 1e-6);
    EXPECT_EQ(reserve_after(1000.0), reserve_after(2.0));
}

// ---- In the tick: the account is of contact alone

namespace {
// Pressed 3 mm into a plane and drawn out again through tick and gate; the account after each tick.
std::vector<double> account_of(const TickParameters& parameters, Vec3* greatest_other_N = nullptr) {
    const test::Surface plane = test::plane();
    FullTickState state;
    std::vector<double> energies;
    for (int i = 0; i < 90; ++i) {
        const Nanoseconds now_ns = (i + 1) * 1'000'000;
        devices::DeviceSample sample;
        sample.time_ns = now_ns;
        const bool is_faulty = i >= 50 && i < 54;  // no force of any kind is given then
        if (is_faulty) sample.fault = devices::DeviceFault::other;
        sample.position_device_m = {0.03, 0.004 + 0.001 - 1e-4 * std::min(i, 80 - i), 0.0};
        const FullTick full = full_tick(state, sample, *plane, parameters, test::kStrongDevice, now_ns, kDt);
        EXPECT_EQ(full.record.gate.cause, is_faulty ? GateCause::device_fault : GateCause::none);
        if (greatest_other_N != nullptr && i == 0)
            *greatest_other_N = full.record.gate.given.force_device_N;  // in free space
        energies.push_back(full.record.passivity.energy_J);
        state = full.next;
    }
    return energies;
}

TickParameters account_parameters() {
    TickParameters p;
    p.probe.points[0].radius_m = 0.004;
    p.clearance_ratio = 0.0;
    p.limit_stiffness = false;
    p.max_surface_age_s = 0.0;
    p.passivity.control = false;  // only counts
    p.limits.max_force_N = 100.0;
    p.limits.max_slew_N_per_s = 1e6;
    p.limits.ramp_s = p.limits.contact_ramp_s = p.limits.recovery_s = 0.0;
    return p;
}
}  // namespace

TEST(PassivityObserver, CountsNeitherTheToolsWeightNorGuidanceNorTheWorkspacesForce) {
    TickParameters weight = account_parameters();
    weight.weight.tool_mass_kg = 0.2;
    TickParameters guided = account_parameters();
    guided.curve.count = 2;
    guided.curve.points_object_m[0] = {-0.1f, 0.012f, 0.0f};
    guided.curve.points_object_m[1] = {0.1f, 0.012f, 0.0f};
    guided.guidance.stiffness_N_per_m = 100.0;
    // Beyond the bubble the hand is pushed back; with no rate the mapping stays where it is.
    TickParameters elastic = account_parameters();
    elastic.workspace.technique = WorkspaceTechnique::bubble;
    elastic.workspace.bubble_rate_per_m2s = 0.0;
    for (const TickParameters& with : {weight, guided, elastic}) {
        TickParameters without = with;
        without.weight = {};
        without.guidance.stiffness_N_per_m = 0.0;
        without.workspace.bubble_stiffness_N_per_m = 0.0;
        Vec3 other_N(0.0);
        const std::vector<double> alone = account_of(without), beside = account_of(with, &other_N);
        EXPECT_GT(glm::length(other_N), 0.4) << "it was to be felt";
        EXPECT_GT(*std::ranges::max_element(alone), 1e-3);
        // 90 sums of millijoules in double.
        for (std::size_t i = 0; i < alone.size(); ++i) ASSERT_NEAR(beside[i], alone[i], 1e-14) << i;
    }
}

TEST(PassivityController, ALongQuietContactSavesUpNoMoreThanTheReserve) {
    PassivityObserver state;
    PassivitySettings settings;
    const devices::DeviceDescription d = wall_device(0.26, 0.05, 0.0);
    double most = 0.0;
    for (int i = 0; i < 2000; ++i) {  // back and forth in a soft wall; friction takes more than the wall gives out
        const PassivityStep step =
            keep_passive(state, next(state, wall_input(-2e-3 - 1e-3 * std::sin(0.05 * i), 200.0)), settings, d, kDt);
        most = std::max(most, step.next.reserve_J);
        state = commanded(step.next, step.wrench.force_device_N);
    }
    EXPECT_DOUBLE_EQ(most, settings.reserve_J) << "it fills up, and no farther";
}

TEST(PassivityController, TakesBackNoMoreInOneTickThanTheOrdersUnderWayWill) {
    // What is ordered goes on acting until the next order arrives: with a delay of three ticks four orders take the
    // same debt back, and each has a quarter of it to take.
    PassivityObserver state;
    state.known = true;
    state.reserve_J = -1e-5;
    PassivitySettings settings;
    settings.max_damping_Ns_per_m = 1e6;
    PassivityInput in = wall_input(-2e-3, 500.0);
    state.position_device_m = {0.0, -2e-3 - 2e-4, 0.0};  // going out at 0.2 m/s
    in.stored_J = state.stored_J = 0.0;                  // nothing but the debt
    const double immediate =
        keep_passive(state, next(state, in), settings, wall_device(0.0, 0.0, 0.0), kDt).record.damping_Ns_per_m;
    const double delayed =
        keep_passive(state, next(state, in), settings, wall_device(0.0, 0.0, 0.003), kDt).record.damping_Ns_per_m;
    EXPECT_NEAR(immediate, 1e-5 / (0.2 * 0.2 * kDt), 1e-6);
    EXPECT_NEAR(delayed, immediate / 4.0, 1e-6);
}

TEST(PassivityObserver, InTheTickALimitOfTheSettingsOrOfTheDeviceIsTheSpringsLimit) {
    // A soft wall pressed beyond what is given: the force stays the same on the way out and gives out nothing too much.
    const test::Surface plane = test::plane();
    for (const bool by_device : {true, false}) {
        TickParameters p = account_parameters();
        p.passivity.control = true;
        devices::DeviceDescription d = test::kStrongDevice;
        d.friction_N = 0.26;
        d.resolution_m = kEncoderStep;
        (by_device ? d.max_force_N : p.limits.max_force_N) = 1.0;
        FullTickState state;
        for (int i = 0; i < 200; ++i) {
            const Nanoseconds now_ns = (i + 1) * 1'000'000;
            devices::DeviceSample sample;
            sample.time_ns = now_ns;
            sample.position_device_m = {0.03, 0.005 - 1.1e-4 * std::min(i, 180 - i), 0.0};  // up to 9 mm deep
            const FullTick full = full_tick(state, sample, *plane, p, d, now_ns, kDt);
            ASSERT_LE(full.record.gate.given.force_device_N.y, 1.0 + 1e-12);
            ASSERT_EQ(full.record.passivity.damping_Ns_per_m, 0.0) << by_device << ' ' << i;
            state = full.next;
        }
        // Nor does what was never given count as taken in: the controller acts where a device without friction needs
        // it.
        p.materials[0].stiffness_N_per_m = 3000.0;
        d.friction_N = d.damping_Ns_per_m = 0.0;
        state = {};
        double most_damping = 0.0;
        for (int i = 0; i < 90; ++i) {
            const Nanoseconds now_ns = (i + 1) * 1'000'000;
            devices::DeviceSample sample;
            sample.time_ns = now_ns;
            sample.position_device_m = {0.03, 0.005 - 1.3e-4 * std::min(i, 80 - i), 0.0};
            const FullTick full = full_tick(state, sample, *plane, p, d, now_ns, kDt);
            most_damping = std::max(most_damping, full.record.passivity.damping_Ns_per_m);
            state = full.next;
        }
        EXPECT_GT(most_damping, 0.0) << by_device;
    }
}

TEST(PassivityController, InTheTickActsTheSameAtAnyGain) {
    // A wall that a device without friction cannot render passively, in a scene four times as large.
    const auto acts = [](double gain) {
        const test::Surface plane = test::plane(0.05 * gain);
        TickParameters p = account_parameters();
        p.passivity.control = true;
        p.probe.points[0].radius_m *= gain;
        p.workspace.object_from_device.scale = gain;
        p.materials[0].stiffness_N_per_m = 3000.0;
        FullTickState state;
        std::vector<double> dampings;
        for (int i = 0; i < 90; ++i) {
            const Nanoseconds now_ns = (i + 1) * 1'000'000;
            devices::DeviceSample sample;
            sample.time_ns = now_ns;
            sample.position_device_m = {0.03, 0.005 - 1.3e-4 * std::min(i, 80 - i), 0.0};
            const FullTick full = full_tick(state, sample, *plane, p, test::kStrongDevice, now_ns, kDt);
            dampings.push_back(full.record.passivity.damping_Ns_per_m);
            state = full.next;
        }
        return dampings;
    };
    const std::vector<double> one = acts(1.0), four = acts(4.0);
    EXPECT_GT(*std::ranges::max_element(one), 0.5);
    // Tolerances of contact are fractions of the radius, so that a gain of a power of two changes next to nothing.
    for (std::size_t i = 0; i < one.size(); ++i) EXPECT_NEAR(four[i], one[i], 1e-3) << i;
}

TEST(PassivityController, IsQuietWhereTheDevicesDampingCoversTheWall) {
    // On every metre the wall gives out K (T/2 + t_d) v too much, and the device's damping takes b v away.
    // Without an allowance for lost ticks, which this damping does not cover.
    PassivitySettings settings;
    settings.lost_ticks = 0;
    const double K = 600.0, covers = K * (0.5 * kDt + 0.001);
    for (const double v : {0.05, 0.15, 0.3}) {
        EXPECT_EQ(push(K, v, 6e-3, wall_device(0.0, 1.3 * covers), settings).most_damping, 0.0) << v;
    }
    EXPECT_GT(push(K, 0.3, 6e-3, wall_device(0.0, 0.0)).most_damping, 0.0) << "else it were no feat";
}

}  // namespace burin::haptics
