// SPDX-License-Identifier: MIT
// The energy account: the work of wrenches that were held over lost ticks, silenced by a watchdog, or turned; and what
// may be commanded with it.
#include "haptics/stability/energy_account.hpp"
#include "tests/support/test_units.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace burin::haptics {
namespace {

constexpr PromiseLimits kPromise{0.15, 2.0, 5, 0.001};

devices::DeviceDescription account_device() {
    devices::DeviceDescription d;
    d.friction_N = 0.26;
    d.delay_s = 0.001;
    return d;
}

AccountInput account_input(Nanoseconds time_ns, double y_m) {
    AccountInput in;
    in.position_device_m = {0.0, y_m, 0.0};
    in.time_ns = time_ns;
    in.in_contact = true;
    return in;
}

// In contact since 1 ms, with 1 N commanded then and 2 N a millisecond later.
EnergyAccount begun(const devices::DeviceDescription& d) {
    EnergyAccount account = count_energy({}, account_input(kMs, 0.0), kPromise, d).next;
    remember(account, {{0.0, 1.0, 0.0}, Vec3(0.0)}, kMs);
    account = count_energy(account, account_input(2 * kMs, 0.0), kPromise, d).next;
    remember(account, {{0.0, 2.0, 0.0}, Vec3(0.0)}, 2 * kMs);
    return account;
}

}  // namespace

TEST(EnergyAccount, CountsTheWorkOfTheForceThatWasHeldOverLostTicks) {
    // 1 N acts for the first of six milliseconds, 2 N for the others; the tool moves out by 6 mm.
    const AccountStep step =
        count_energy(begun(account_device()), account_input(8 * kMs, 0.006), kPromise, account_device());
    EXPECT_NEAR(step.taken_J, -(1.0 * 0.001 + 2.0 * 0.005), 1e-12);
    EXPECT_NEAR(step.dissipated_J, 0.26 * 0.006, 1e-12);
}

TEST(EnergyAccount, CountsNothingOnceTheWatchdogHasTakenTheForceOff) {
    devices::DeviceDescription d = account_device();
    d.watchdog_s = 0.003;  // written last at 2 ms
    const AccountStep step = count_energy(begun(d), account_input(8 * kMs, 0.006), kPromise, d);
    EXPECT_NEAR(step.taken_J, -(1.0 * 0.001 + 2.0 * 0.002), 1e-12);
}

TEST(EnergyAccount, CountsTorqueTimesRotation) {
    devices::DeviceDescription d = account_device();
    d.angular_friction_Nm = 0.002;
    AccountInput first = account_input(kMs, 0.0), second = account_input(3 * kMs, 0.0);
    first.turns = second.turns = true;
    second.orientation_device = {std::cos(0.005), 0.0, 0.0, std::sin(0.005)};  // 0.01 rad about z
    EnergyAccount account = count_energy({}, first, kPromise, d).next;
    remember(account, {Vec3(0.0), {0.0, 0.0, -0.1}}, kMs);
    const AccountStep step = count_energy(account, second, kPromise, d);
    EXPECT_NEAR(step.taken_J, 0.1 * 0.01 * 0.5, 1e-8);  // against the torque, which acts for the second half
    // Where it changes, the rotation is uncertain by what the turning speed leaves: 2 rad/s against 5.
    EXPECT_NEAR(step.next.budget_J, step.taken_J + 0.002 * 0.01, 1e-8);
}

// What a surface gives is what the acting force does along its announced way; what it takes back gives nothing up.
TEST(EnergyAccount, CountsWhatAMovingSurfaceGivesOnceAndNeverTheWayBack) {
    for (const double speed : {0.1, -0.1}) {
        AccountInput in = account_input(8 * kMs, 0.0);
        const EnergyAccount before = begun(account_device());
        const double resting_J = count_energy(before, in, kPromise, account_device()).next.budget_J;
        in.surface_velocity_device_m_per_s = {0.03, speed, 0.0};  // the force is along y
        const AccountStep step = count_energy(before, in, kPromise, account_device());
        EXPECT_NEAR(step.given_by_surface_J, speed * (1.0 * 0.001 + 2.0 * 0.005), 1e-15);
        EXPECT_NEAR(step.next.budget_J - resting_J, std::max(0.0, step.given_by_surface_J), 1e-15) << speed;
        EXPECT_EQ(step.taken_J, 0.0) << "the tool has not moved";
    }
}

TEST(EnergyAccount, AffordsFrictionForNothingAndMoreAsEnergyHasComeIn) {
    const devices::DeviceDescription d = account_device();
    EnergyAccount account = count_energy({}, account_input(kMs, 0.0), kPromise, d).next;
    const auto most = [&] { return affordable(account, {{0.0, 5.0, 0.0}, Vec3(0.0)}, kPromise, d, kMs).force_N; };
    EXPECT_DOUBLE_EQ(most(), 0.26);
    account.budget_J = 0.001;
    // 6.5 periods of holding and one of transport at 0.15 m/s
    EXPECT_NEAR(most(), 0.26 + 0.001 / (0.15 * 0.0075), 1e-12);
    EXPECT_NEAR(affordable(account, {{0.0, 5.0, 0.0}, Vec3(0.0)}, kPromise, d, kMs).share, most() / 5.0, 1e-12);
    EXPECT_EQ(affordable(account, {{0.0, 0.5, 0.0}, Vec3(0.0)}, kPromise, d, kMs).share, 1.0);
}

TEST(EnergyAccount, AffordsForceAndTorqueTogether) {
    devices::DeviceDescription d = account_device();
    d.angular_friction_Nm = 0.01;
    EnergyAccount account = count_energy({}, account_input(kMs, 0.0), kPromise, d).next;
    account.budget_J = 0.001;
    const devices::DeviceWrench wrench{{0.0, 3.0, 0.0}, {0.0, 0.0, 0.2}};
    const double share = affordable(account, wrench, kPromise, d, kMs).share;
    EXPECT_LT(share, 1.0);
    // What both may take out in the time is what there is.
    EXPECT_NEAR(0.0075 * ((3.0 * share - 0.26) * 0.15 + (0.2 * share - 0.01) * 2.0), 0.001, 1e-12);
}

TEST(EnergyAccount, AffordsNoTorqueBesideAForceThatTheSlewLimitMayHoldUp) {
    devices::DeviceDescription d = account_device();
    EXPECT_EQ(affordable(begun(d), {}, kPromise, d, 2 * kMs).torque_Nm, HUGE_VAL) << "rotation is not known";
    d.angular_friction_Nm = 0.01;
    EnergyAccount account = count_energy({}, account_input(kMs, 0.0), kPromise, d).next;
    account.budget_J = 0.001;
    // Nothing is commanded: all that there is, for 7.5 ms at 2 rad/s.
    EXPECT_NEAR(affordable(account, {}, kPromise, d, kMs).torque_Nm, 0.01 + 0.001 / (0.0075 * 2.0), 1e-12);
    // 0.5 N is to be commanded, or has been.
    const double left = 0.01 + (0.001 - 0.0075 * 0.15 * (0.5 - 0.26)) / (0.0075 * 2.0);
    EXPECT_NEAR(affordable(account, {{0.0, 0.5, 0.0}, Vec3(0.0)}, kPromise, d, kMs).torque_Nm, left, 1e-12);
    remember(account, {{0.0, 0.5, 0.0}, Vec3(0.0)}, kMs);
    EXPECT_NEAR(affordable(account, {}, kPromise, d, kMs).torque_Nm, left, 1e-6);
    // A force that takes all that there is leaves what friction bears.
    EXPECT_NEAR(affordable(account, {{0.0, 9.0, 0.0}, Vec3(0.0)}, kPromise, d, kMs).torque_Nm, 0.01, 1e-12);
}

}  // namespace burin::haptics
