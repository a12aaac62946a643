// SPDX-License-Identifier: MIT
// When a device's controller may render a contact by itself, and by which law (haptics/local_law.hpp).
#include "haptics/local_law.hpp"

#include <gtest/gtest.h>

namespace burin::haptics {
namespace {

constexpr double kLawTick_s = 0.001;

// A fingertip that presses two points straight down on an object, its drive along the normal.
struct RestingContact {
    TickRecord record;
    TickState tick;
    TickParameters parameters;
    devices::DeviceDescription device;
    LocalLawState state;

    RestingContact() {
        device.drives_one_way = true;
        device.max_force_N = 10.0;
        device.max_stiffness_N_per_m = 600.0;
        parameters.local_rendering = true;
        parameters.materials[0].stiffness_N_per_m = 300.0;
        parameters.materials[0].damping_Ns_per_m = 1.0;
        parameters.probe.count = 2;
        parameters.probe.points[0].share = 0.75;
        parameters.probe.points[1].share = 0.25;
        record.sample.drive = {{0.0, 1.0, 0.0}, {0.0, 1.0, 0.0}, 0.08};
        record.flags = kTickInContact;
        record.contact.point_count = 2;
        touch(0, 0.002);
        touch(1, 0.004);
        record.contact.deepest = 1;
    }
    void touch(std::size_t point, double depth_m) {
        record.contact.points[point].constraints = 1;
        record.contact.points[point].normal_object = {0.0, 1.0, 0.0};
        record.contact.points[point].penetration_m = depth_m;
        record.contact.points[point].object = 3;
    }
    devices::DriveLaw rest(int ticks) {
        for (int i = 0; i < ticks; ++i) state = step_local_law(state, record, tick, parameters, device, kLawTick_s);
        return state.law;
    }
};

}  // namespace

TEST(LocalLaw, G2HoldsWhenHandAndObjectHaveRestedForATenthOfASecond) {
    RestingContact contact;
    EXPECT_FALSE(contact.rest(95).holds);
    const devices::DriveLaw law = contact.rest(10);
    ASSERT_TRUE(law.holds);
    // Springs of 225 and 75 N/m that are pressed by 2 and 4 mm: 0.75 N, so one of 300 N/m pressed by 2.5 mm.
    EXPECT_NEAR(law.spring_N_per_m, 300.0, 1e-9);
    EXPECT_NEAR(law.start_m, 0.08 + 0.0025, 1e-12);
    EXPECT_NEAR(law.damping_Ns_per_m, 1.0, 1e-12);
    EXPECT_EQ(law.most_N, contact.parameters.limits.max_force_N);
}

TEST(LocalLaw, G2StaysAsItWasMadeWhileTheFingerSqueezes) {
    RestingContact contact;
    const devices::DriveLaw law = contact.rest(150);
    contact.record.sample.drive.length_m = 0.076;
    contact.touch(0, 0.006);
    contact.touch(1, 0.008);
    EXPECT_EQ(contact.rest(100), law);
}

TEST(LocalLaw, G2IsSpringAlongThePistonWhereThatStandsAcross) {
    RestingContact contact;
    // A fingertip that moves twice as far as its piston, along the normal: four times as stiff, half as deep.
    contact.record.sample.drive.moves_device = {0.0, 2.0, 0.0};
    contact.parameters.materials[0].stiffness_N_per_m = 100.0;
    const devices::DriveLaw law = contact.rest(150);
    EXPECT_NEAR(law.spring_N_per_m, 400.0, 1e-9);
    EXPECT_NEAR(law.start_m, 0.08 + 0.00125, 1e-12);
    contact.parameters.materials[0].stiffness_N_per_m = 1000.0;
    contact.state = {};
    EXPECT_EQ(contact.rest(150).spring_N_per_m, 600.0) << "no stiffer than the device should be";
}

TEST(LocalLaw, G2EndsWithTheContactAndWithEveryMotionAgainstTheObject) {
    const auto ends = [](const auto& change) {
        RestingContact contact;
        EXPECT_TRUE(contact.rest(150).holds);
        change(contact);
        return !contact.rest(60).holds;
    };
    EXPECT_TRUE(ends([](RestingContact& c) { c.record.flags = 0; })) << "no contact";
    EXPECT_TRUE(ends([](RestingContact& c) { c.record.contact.points[1].object = 4; })) << "another object";
    EXPECT_TRUE(ends([](RestingContact& c) { c.record.gate.cause = GateCause::device_fault; }));
    EXPECT_TRUE(ends([](RestingContact& c) { c.record.contact.jumped = true; }));
    EXPECT_TRUE(ends([](RestingContact& c) { c.parameters.local_rendering = false; }));
    EXPECT_TRUE(ends([](RestingContact& c) { c.record.sample.drive = {}; })) << "drives every direction";
    EXPECT_TRUE(ends([](RestingContact& c) {
        for (PointRecord& point : c.record.contact.points) point.normal_object = {0.5, 0.8660254, 0.0};
    })) << "the plane has turned by 30 degrees";
    // 0.1 m/s for 60 ms: 6 mm.
    EXPECT_TRUE(ends([](RestingContact& c) { c.tick.motion.foot_velocity_device_m_per_s = {0.1, 0.0, 0.0}; }));
    EXPECT_FALSE(ends([](RestingContact& c) {
        c.tick.motion.foot_velocity_device_m_per_s = {0.1, 0.0, 0.0};
        c.record.contact.surface_velocity_device_m_per_s = {0.1, 0.0, 0.0};
    })) << "what is carried goes along";
    EXPECT_FALSE(ends([](RestingContact& c) { c.tick.motion.foot_velocity_device_m_per_s = {0.02, 0.0, 0.0}; }))
        << "1.2 mm";
}

}  // namespace burin::haptics
