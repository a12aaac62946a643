// SPDX-License-Identifier: MIT
// What ticks feel of a body that gives, by its local models: the plane's force, never below 0, continuous as the point
// comes and goes, gone when the body is no longer stepped.
#include <gtest/gtest.h>

#include <cmath>

#include "haptics/forces/body_push.hpp"
#include "haptics/tick.hpp"

namespace burin::haptics {
namespace {

constexpr Nanoseconds kTick_ns = 1'000'000;

geometry::LocalModel model_at(double force_N, Nanoseconds time_ns) {
    geometry::LocalModel model;
    model.object = 3;
    model.normal_object = {0.0, 1.0, 0.0};
    model.force_N = force_N;
    model.stiffness_N_per_m = 200.0;
    model.surface_N_per_m = 800.0;
    model.time_ns = time_ns;
    return model;
}

// A hand that is led up and down, and a surface that has models alone.
class PushedHand {
public:
    PushedHand() {
        surface_.sequence = 1;
        surface_.radius_m = 1.0;
        parameters_.sequence = 1;
        parameters_.passivity.control = false;
        parameters_.limit_stiffness = false;
        parameters_.workspace.object_from_device = {};
    }
    geometry::LocalSurface& surface() { return surface_; }
    TickParameters& parameters() { return parameters_; }
    TickRecord tick(double height_m) {
        ++tick_;
        now_ns_ = tick_ * kTick_ns;
        surface_.made_ns = now_ns_;
        devices::DeviceSample sample;
        sample.position_device_m = {0.0, height_m, 0.0};
        sample.time_ns = now_ns_;
        const FullTick done = full_tick(state_, sample, surface_, parameters_, device_, now_ns_, 0.001);
        state_ = done.next;
        return done.record;
    }
    [[nodiscard]] Nanoseconds now_ns() const { return now_ns_; }

private:
    geometry::LocalSurface surface_;
    TickParameters parameters_;
    devices::DeviceDescription device_{.max_force_N = 3.3};
    FullTickState state_;
    std::int64_t tick_ = 0;
    Nanoseconds now_ns_ = 0;
};

}  // namespace

TEST(LocalModel, IsAPlaneThatNeverPulls) {
    const geometry::LocalModel model = model_at(1.0, 0);
    EXPECT_DOUBLE_EQ(model.force_at({0.0, 0.0, 0.0}, 0), 1.0);
    EXPECT_DOUBLE_EQ(model.force_at({0.3, -0.002, 0.1}, 0), 1.4) << "across the plane nothing changes";
    EXPECT_NEAR(model.force_at({0.0, 0.005, 0.0}, 0), 0.0, 1e-15);
    EXPECT_EQ(model.force_at({0.0, 0.1, 0.0}, 0), 0.0);
    geometry::LocalModel outside = model_at(-0.4, 0);  // 2 mm away
    EXPECT_EQ(outside.force_at({0.0, -0.0019, 0.0}, 0), 0.0);
    EXPECT_NEAR(outside.force_at({0.0, -0.003, 0.0}, 0), 0.2, 1e-12);
    geometry::LocalModel moving = model_at(1.0, 0);
    moving.velocity_object_m_per_s = {0.0, 0.1, 0.0};
    EXPECT_NEAR(moving.force_at({0.0, 0.0, 0.0}, 10 * kTick_ns), 1.2, 1e-12);
}

TEST(LocalModel, FadesToNothingWhereTheBodyIsNoLongerStepped) {
    const geometry::LocalModel model = model_at(2.0, 50 * kTick_ns);
    EXPECT_DOUBLE_EQ(model.force_at(Vec3(0.0), 80 * kTick_ns), 2.0);
    double last_N = 2.0;
    for (Nanoseconds age_ns = 30 * kTick_ns; age_ns <= 100 * kTick_ns; age_ns += kTick_ns) {
        const double now_N = model.force_at(Vec3(0.0), model.time_ns + age_ns);
        EXPECT_LE(now_N, last_N);
        EXPECT_LT(last_N - now_N, 0.03);
        last_N = now_N;
    }
    EXPECT_EQ(model.force_at(Vec3(0.0), model.time_ns + 100 * kTick_ns), 0.0);
    EXPECT_EQ(model.force_at(Vec3(0.0), model.time_ns + 3'600'000 * kTick_ns), 0.0);
}

TEST(BodyPush, IsFeltByTheTickAndRecordedAsAContact) {
    PushedHand felt;
    TickRecord record;
    for (int i = 0; i < 400; ++i) {
        felt.surface().models = {};
        felt.surface().models.add(model_at(1.0, felt.now_ns()));
        record = felt.tick(-0.001);
    }
    EXPECT_NEAR(record.gate.given.force_device_N.y, 1.2, 1e-9);
    EXPECT_NEAR(record.gate.given.force_device_N.x, 0.0, 1e-12);
    EXPECT_TRUE(record.in_contact());
    const PointRecord& point = record.contact.points[0];
    EXPECT_EQ(point.object, 3u);
    EXPECT_EQ(point.normal_object, Vec3(0.0, 1.0, 0.0));
    EXPECT_NEAR(point.proxy_object_m.y - point.hip_object_m.y, 1.2 / 800.0, 1e-12) << "the surface is above the point";
    EXPECT_NEAR(record.contact.spring_energy_J, 0.5 * 1.2 * 1.2 / 200.0, 1e-12);
    // Nobody steps the body any more: the force goes, and with it the contact.
    for (int i = 0; i < 100; ++i) record = felt.tick(-0.001);
    EXPECT_EQ(record.gate.given.force_device_N, Vec3(0.0));
    EXPECT_FALSE(record.in_contact());
}

TEST(BodyPush, ComesAndGoesWithoutAStep) {
    PushedHand felt;
    double last_N = 0.0, most_N = 0.0;
    for (int i = 0; i < 2000; ++i) {
        felt.surface().models = {};
        geometry::LocalModel model = model_at(0.0, felt.now_ns());
        model.damping_Ns_per_m = 5.0;
        felt.surface().models.add(model);
        const double now_N = felt.tick(0.004 * std::cos(0.01 * i)).gate.given.force_device_N.y;
        EXPECT_LT(std::abs(now_N - last_N), 0.025) << i;  // 200 N/m at 40 mm/s is 0.008 N a tick, and the damper's
        EXPECT_GE(now_N, 0.0);
        most_N = std::max(most_N, now_N);
        last_N = now_N;
    }
    EXPECT_GT(most_N, 0.7);
}

TEST(BodyPush, LeavesOutModelsThatAreNoneAndPointsThatAreNot) {
    PushedHand felt;
    geometry::LocalModel broken = model_at(1.0, 0), other = model_at(1.0, 0);
    broken.force_N = std::nan("");
    other.point = 7;
    felt.surface().models.add(broken);
    EXPECT_EQ(felt.surface().models.count, 0u);
    felt.surface().models.add(other);
    felt.surface().models.list[1] = broken;
    felt.surface().models.count = 4'000'000'000;
    const TickRecord record = felt.tick(-0.001);
    EXPECT_EQ(record.gate.given.force_device_N, Vec3(0.0));
    EXPECT_FALSE(record.in_contact());
}

TEST(BodyPush, IsNoStifferThanTheDeviceRendersPassively) {
    const geometry::LocalModel model = model_at(1.0, 0);
    const BodyPush push = push_of(model, {{0.0, -0.01, 0.0}, Vec3(0.0), 50.0, 0});
    EXPECT_NEAR(push.force_N, 1.5, 1e-12) << "the force at the last step stays, the slope is the device's";
}

}  // namespace burin::haptics
