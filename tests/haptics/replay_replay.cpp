// SPDX-License-Identifier: MIT
// A recorded session, fed through the pure tick again, gives the same bits.
#include <gtest/gtest.h>

#include <cstring>
#include <map>

#include "tests/haptics/rig.hpp"

namespace burin::haptics {

TEST(Replay, RecordedSamplesSurfacesAndParametersGiveTheSameForcesBitForBit) {
    test::Rig rig({{0.0, Vec3(0.0, 0.012, -0.02)},
                   {0.5, Vec3(0.0, 0.002, -0.02)},
                   {2.0, Vec3(0.004, 0.002, 0.02), {0.9, 0.1, 0, 0}, 1},
                   {2.4, Vec3(0.004, 0.02, 0.02)}});
    // What the carving side and the settings panel published, by sequence number.
    std::map<std::uint64_t, test::Surface> surfaces;
    std::map<std::uint64_t, TickParameters> parameters;
    surfaces[0] = std::make_unique<geometry::LocalSurface>();
    parameters[0] = TickParameters{};
    std::vector<TickRecord> told;
    for (int i = 0; i < 2500; ++i) {
        if (i == 20 || i == 900 || i == 1500) {
            TickParameters p;
            p.sequence = static_cast<std::uint64_t>(i);
            p.probe.points[0].radius_m = 0.005;
            p.materials[0].stiffness_N_per_m = 300.0 + 0.2 * i;
            p.workspace.object_from_device.scale = i < 1500 ? 1.0 : 1.25;
            parameters[p.sequence] = p;
            rig.publish(p, p.sequence);
        }
        if (i % 170 == 30) {  // the groove deepens as it is carved
            const auto sequence = static_cast<std::uint64_t>(i);
            surfaces[sequence] = test::groove(0.005 + 1e-6 * i, 0.1, 24, 60, 2e-5);
            surfaces[sequence]->sequence = sequence;
            surfaces[sequence]->made_ns = rig.clock.now_ns();
            rig.publish(*surfaces[sequence], sequence);
        }
        if (i == 1200) rig.omni.inject(devices::InjectedFault::nan_position);
        if (i == 1210) rig.omni.inject(devices::InjectedFault::none);
        told.push_back(rig.tick());
    }

    FullTickState state;
    int in_contact = 0;
    for (const TickRecord& r : told) {
        const FullTick again = full_tick(state, r.sample, *surfaces.at(r.surface_sequence),
                                         parameters.at(r.parameter_sequence), rig.omni.description(), r.time_ns, 1e-3);
        state = again.next;
        in_contact += (r.flags & kTickInContact) != 0;
        const TickRecord& a = again.record;
        ASSERT_EQ(std::memcmp(&a.gate.given.force_device_N, &r.gate.given.force_device_N, sizeof(Vec3)), 0) << r.tick;
        ASSERT_EQ(std::memcmp(&a.wanted.force_device_N, &r.wanted.force_device_N, sizeof(Vec3)), 0) << r.tick;
        ASSERT_EQ(std::memcmp(&a.deepest().proxy_object_m, &r.deepest().proxy_object_m, sizeof(Vec3)), 0) << r.tick;
        ASSERT_EQ(std::memcmp(&a.motion.velocity_device_m_per_s, &r.motion.velocity_device_m_per_s, sizeof(Vec3)), 0)
            << r.tick;
        ASSERT_EQ(a.deepest().active_triangle, r.deepest().active_triangle) << r.tick;
        ASSERT_EQ(a.flags, r.flags) << r.tick;
        ASSERT_EQ(a.gate.cause, r.gate.cause) << r.tick;
        ASSERT_EQ(a.contact.work.triangles_tested, r.contact.work.triangles_tested) << r.tick;
    }
    EXPECT_GT(in_contact, 500);
}

}  // namespace burin::haptics
