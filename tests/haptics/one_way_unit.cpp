// SPDX-License-Identifier: MIT
// A part that drives one way alone (devices::OneWayDrive), a glove's finger on a plate: what is commanded is the
// piston's, and what it gives out is judged by the piston's length. The energy is summed up here, along the way of a
// simulated finger, from the piston's force and the distance between its ends; nothing of the account is asked.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "devices/gloves/glove_hand.hpp"
#include "haptics/tick.hpp"
#include "tests/haptics/surfaces.hpp"

namespace burin::haptics {
namespace {

using devices::FingertipPlace;

constexpr double kPistonTick_s = 0.001;
constexpr int kPistonSteps = 20;  // a tick

devices::DeviceDescription piston_device() {
    devices::DeviceDescription d;
    d.resolution_m = 0.00001;
    d.drives_one_way = true;
    d.max_force_N = 10.0;
    d.max_stiffness_N_per_m = 600.0;
    d.apparent_mass_kg = 0.03;
    d.damping_Ns_per_m = 0.5;
    d.friction_N = 0.014;
    return d;
}

// Palm down over the plate y = 0: the hand's back is up, the fingers point away.
Pose palm_over_plate(double height_m, double tilt_rad = 0.0) {
    const Quat down = glm::angleAxis(-std::acos(0.0), Vec3(1.0, 0.0, 0.0));
    return {{0.0, height_m, 0.0}, glm::normalize(glm::angleAxis(-tilt_rad, Vec3(1.0, 0.0, 0.0)) * down)};
}

devices::FingerAngles bent_by(double first_rad) { return {0.0, first_rad, 0.6 * first_rad, 0.3 * first_rad}; }

FingertipPlace place_at(double first_rad) { return devices::place_of(devices::usual_hand()[1], bent_by(first_rad)); }

devices::DeviceSample piston_sample(const Pose& palm, double first_rad, Nanoseconds time_ns) {
    const FingertipPlace place = place_at(first_rad);
    devices::DeviceSample sample;
    sample.time_ns = time_ns;
    sample.position_device_m = palm * place.hand_from_tip.position_m;
    sample.orientation_device = glm::normalize(palm.orientation * place.hand_from_tip.orientation);
    sample.drive.along_device = palm.orientation * place.piston_hand;
    sample.drive.moves_device = palm.orientation * devices::piston_way(place).moves_hand;
    sample.drive.length_m = place.piston_m;
    return sample;
}

TickParameters plate_parameters() {
    TickParameters p;
    p.sequence = 1;
    p.probe = ball_probe(0.001);
    p.clearance_ratio = 0.0;
    p.materials[0].stiffness_N_per_m = 500.0;
    p.materials[0].damping_Ns_per_m = 0.0;
    p.max_surface_age_s = 0.0;
    p.limits.ramp_s = p.limits.contact_ramp_s = 0.0;
    p.limits.max_force_N = 10.0;
    return p;
}

// A finger whose first joint is drawn towards an angle, with the others in step, and its piston.
struct SimulatedFinger {
    static constexpr double kInertia_kgm2 = 0.0004, kDamping_Nms_per_rad = 0.02;
    double angle_rad = 0.3, speed_rad_per_s = 0.0, force_N = 0.0;
    double grip_Nm_per_rad = 1.5;
    double given_J = 0.0, dissipated_J = 0.0, greatest_N = 0.0;
    double worst_J = -HUGE_VAL;  // what was given beyond what was dissipated
    double by_palm_J = 0.0;      // of the palm's way against the plate, at the piston

    static double length_at(double angle_rad) {
        const devices::FingerChain& finger = devices::usual_hand()[1];
        return glm::distance(devices::place_of(finger, bent_by(angle_rad)).hand_from_tip.position_m,
                             finger.piston_hand_m);
    }
    // Goes on by a tick in which the force is held.
    void move(double towards_rad, const devices::DeviceDescription& device) {
        const double step_s = kPistonTick_s / kPistonSteps;
        for (int i = 0; i < kPistonSteps; ++i) {
            const double slope_m = (length_at(angle_rad + 1e-5) - length_at(angle_rad - 1e-5)) / 2e-5;
            const double friction_N = device.friction_N * std::clamp(slope_m * speed_rad_per_s / 1e-4, -1.0, 1.0);
            const double torque =
                grip_Nm_per_rad * (towards_rad - angle_rad) + (force_N - friction_N) * slope_m -
                (kDamping_Nms_per_rad + device.damping_Ns_per_m * slope_m * slope_m) * speed_rad_per_s;
            speed_rad_per_s += step_s * torque / kInertia_kgm2;
            const double before_m = length_at(angle_rad);
            angle_rad += step_s * speed_rad_per_s;
            const double moved_m = length_at(angle_rad) - before_m;
            given_J += force_N * moved_m;
            dissipated_J +=
                device.damping_Ns_per_m * moved_m * moved_m / step_s + device.friction_N * std::abs(moved_m);
            worst_J = std::max(worst_J, given_J - dissipated_J - by_palm_J);
        }
    }
};

struct GlovedMotion {
    std::function<Pose(double)> palm;
    std::function<double(double)> towards_rad;
    double duration_s = 3.0;
};

SimulatedFinger pressed_by(const GlovedMotion& motion, SimulatedFinger finger = {}) {
    const auto plate = test::plane(0.5);
    const devices::DeviceDescription device = piston_device();
    const TickParameters parameters = plate_parameters();
    FullTickState state;
    Vec3 foot_before_m = motion.palm(0.0) * devices::usual_hand()[1].piston_hand_m;
    for (int i = 0; i < static_cast<int>(motion.duration_s / kPistonTick_s); ++i) {
        const double time_s = i * kPistonTick_s;
        const Pose palm = motion.palm(time_s);
        const devices::DeviceSample sample =
            piston_sample(palm, finger.angle_rad, 1'000'000'000 + i * Nanoseconds{1'000'000});
        // The palm that comes nearer to the plate has the piston work as one whose other end is pushed: F . way.
        const Vec3 foot_m = palm * devices::usual_hand()[1].piston_hand_m;
        const double moves = sample.drive.moves_device.y;  // along the plate's normal
        if (moves > 0.0) finger.by_palm_J += std::max(0.0, finger.force_N * (foot_before_m.y - foot_m.y) / moves);
        foot_before_m = foot_m;
        const FullTick full = full_tick(state, sample, *plate, parameters, device, sample.time_ns, kPistonTick_s);
        state = full.next;
        const Vec3 given_N = full.record.gate.given.force_device_N;
        finger.force_N = glm::length(given_N);
        finger.greatest_N = std::max(finger.greatest_N, finger.force_N);
        EXPECT_LT(glm::length(given_N - finger.force_N * sample.drive.along_device), 1e-9) << "beside the piston";
        finger.move(motion.towards_rad(time_s), device);
    }
    return finger;
}

double tip_height_m(double angle_rad) {
    return (palm_over_plate(0.0) * place_at(angle_rad).hand_from_tip.position_m).y;
}

}  // namespace

TEST(OneWay, G6CommandsThePistonsForceOfTheSameWork) {
    const auto plate = test::plane(0.5);
    TickParameters parameters = plate_parameters();
    parameters.passivity.control = false;
    parameters.limit_stiffness = false;
    const double angle_rad = 0.8;
    FullTickState state;
    FullTick full;
    for (int i = 0; i < 300; ++i) {
        const Pose palm = palm_over_plate(-tip_height_m(angle_rad) + std::max(0.002 - 0.0001 * i, -0.002));
        full = full_tick(state, piston_sample(palm, angle_rad, 1'000'000'000 + i * Nanoseconds{1'000'000}), *plate,
                         parameters, piston_device(), 1'000'000'000 + i * Nanoseconds{1'000'000}, kPistonTick_s);
        state = full.next;
    }
    // 3 mm deep with the ball's radius: 1.5 N up.
    const Vec3 up_N = full.record.contact.points[0].force_device_N;
    EXPECT_NEAR(up_N.y, 1.5, 1e-3);
    const FingertipPlace place = place_at(angle_rad);
    const Pose palm = palm_over_plate(0.0);
    const Vec3 flexes = palm.orientation * place.flexes_hand, along = palm.orientation * place.piston_hand;
    const Vec3 given_N = full.record.gate.given.force_device_N;
    EXPECT_NEAR(glm::dot(given_N, flexes), glm::dot(up_N, flexes), 1e-9) << "the work of a flexion";
    EXPECT_NEAR(glm::dot(given_N, along), glm::length(given_N), 1e-9) << "along the piston, away from the palm";
    EXPECT_GT(glm::length(given_N), 1.0);
}

TEST(OneWay, NeverPulls) {
    const devices::OneWayDrive drive{{0.0, 1.0, 0.0}, {0.0, 1.0, 0.0}, 0.08};
    EXPECT_EQ(as_driven({{0.0, -3.0, 0.0}, Vec3(1.0)}, drive).force_device_N, Vec3(0.0));
    EXPECT_EQ(as_driven({{2.0, 3.0, 0.0}, Vec3(1.0)}, drive).force_device_N, Vec3(0.0, 3.0, 0.0));
    EXPECT_EQ(as_driven({{2.0, 3.0, 0.0}, Vec3(1.0)}, drive).torque_device_Nm, Vec3(0.0));
    EXPECT_EQ(as_driven({{2.0, 3.0, 0.0}, Vec3(1.0)}, {}).torque_device_Nm, Vec3(1.0)) << "drives every direction";
}

// A palm that is still: what comes out along the piston has gone in along it.
TEST(OneWay, GivesNoMoreThanFlexingHasPutInAndThePistonHasDissipated) {
    const double above_m = -tip_height_m(0.6);
    const SimulatedFinger finger =
        pressed_by({[&](double) { return palm_over_plate(above_m); },
                    [](double t) { return 0.3 + 0.7 * std::pow(std::sin(2.0 * t), 2.0) + 0.1 * std::sin(31.0 * t); }});
    EXPECT_GT(finger.greatest_N, 1.0) << "it was felt";
    EXPECT_LT(finger.worst_J, 1e-6);
}

// The palm carries a finger that is held stiff into the plate, and the finger is then let go: only what the palm's
// own way was worth comes out.
TEST(OneWay, GivesWhatThePalmsWayIsWorthAndNoMore) {
    const double from_m = -tip_height_m(0.6) + 0.003;
    const SimulatedFinger finger =
        pressed_by({[&](double t) { return palm_over_plate(from_m - std::min(0.02 * t, 0.009)); },
                    [](double t) { return t < 1.0 ? 0.6 : 0.3; }},
                   {.angle_rad = 0.6, .grip_Nm_per_rad = 6.0});
    EXPECT_GT(finger.greatest_N, 0.3) << "it was felt";
    EXPECT_LT(finger.worst_J, 1e-6);
    EXPECT_GT(finger.by_palm_J, 1e-5);
}

// A wrist that turns the finger into the plate puts nothing into the piston, however deep the finger is pressed: judged
// by the fingertip's own way, the piston would then push the finger out with energy that nobody has put in.
TEST(OneWay, TakesNoTurnOfTheWristForWorkOnThePiston) {
    const double above_m = -tip_height_m(0.6) + 0.003;
    const SimulatedFinger finger =
        pressed_by({[&](double t) { return palm_over_plate(above_m, std::min(0.1 * t, 0.1)); },
                    [](double t) { return t < 1.5 ? 0.6 : 0.2; }},
                   {.angle_rad = 0.6, .grip_Nm_per_rad = 6.0});
    EXPECT_LT(finger.worst_J, 1e-6);
    EXPECT_GT(finger.given_J + finger.greatest_N, 0.0);
}

// What turns is the direction; the force along it may stay.
TEST(OneWay, TheSlewLimitIsOfTheForceAlongThePiston) {
    GateState state;
    state.ramp = 1.0;
    state.given.force_device_N = {3.0, 0.0, 0.0};
    GateInput input;
    input.device_max_force_N = 10.0;
    input.drives_device = {0.0, 1.0, 0.0};
    input.wanted.force_device_N = {0.0, 3.5, 0.0};
    const GateStep near = pass_gate(state, input, {.max_force_N = 10.0}, kPistonTick_s);
    EXPECT_FALSE(near.output.slew_limited);
    EXPECT_EQ(near.output.given.force_device_N, Vec3(0.0, 3.5, 0.0));
    input.wanted.force_device_N = {0.0, 9.0, 0.0};
    const GateStep far = pass_gate(state, input, {.max_force_N = 10.0}, kPistonTick_s);
    EXPECT_TRUE(far.output.slew_limited);
    EXPECT_NEAR(far.output.given.force_device_N.y, 4.0, 1e-12);
    EXPECT_EQ(far.output.given.force_device_N.x, 0.0);
}

TEST(OneWay, ADriveThatMakesNoSenseGetsNoForce) {
    const auto plate = test::plane(0.5);
    for (const auto& spoil : {std::function<void(devices::OneWayDrive&)>([](auto& d) { d.along_device *= 1.1; }),
                              std::function<void(devices::OneWayDrive&)>([](auto& d) { d.length_m = NAN; }),
                              std::function<void(devices::OneWayDrive&)>([](auto& d) { d.moves_device.x = HUGE_VAL; }),
                              std::function<void(devices::OneWayDrive&)>([](auto& d) { d.along_device.y = NAN; })}) {
        devices::DeviceSample sample = piston_sample(palm_over_plate(0.0), 0.8, 1'000'000'000);
        spoil(sample.drive);
        const FullTick full =
            full_tick({}, sample, *plate, plate_parameters(), piston_device(), sample.time_ns, kPistonTick_s);
        EXPECT_EQ(full.record.gate.cause, GateCause::not_finite);
        EXPECT_EQ(full.record.gate.given.force_device_N, Vec3(0.0));
    }
}

}  // namespace burin::haptics
