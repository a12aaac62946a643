// SPDX-License-Identifier: MIT
// Ten thousand ticks in and out of contact, with surfaces and settings arriving and faults happening: not one
// allocation, lock, throw or file.
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <mutex>
#include <stdexcept>

#include "haptics/channels.hpp"
#include "tests/haptics/fingertip.hpp"
#include "tests/haptics/rig.hpp"
#include "tests/haptics/workpiece.hpp"
#include "tests/support/realtime_counters.hpp"

namespace burin::haptics {
namespace {

void expect_none(const burin::test::RealtimeCounts& counts) {
    EXPECT_EQ(counts.allocations, 0u);
    EXPECT_EQ(counts.frees, 0u);
    EXPECT_EQ(counts.locks, 0u);
    EXPECT_EQ(counts.throws, 0u);
    EXPECT_EQ(counts.files, 0u);
}

}  // namespace

TEST(RealtimeCounters, SeeWhatTheyAreMeantToSee) {  // a counter that sees nothing proves nothing
    std::mutex mutex;
    burin::test::RealtimeCounts counts;
    {
        const burin::test::RealtimeScope scope;
        void* volatile plain = std::malloc(10);
        std::free(plain);
        delete new volatile int(3);
        mutex.lock();
        mutex.unlock();
        try {
            throw std::runtime_error("counted");
        } catch (const std::runtime_error&) {
        }
        if (std::FILE* file = std::fopen("/dev/null", "r")) std::fclose(file);
        counts = scope.counts();
    }
    EXPECT_GE(counts.allocations, 2u);
    EXPECT_GE(counts.frees, 2u);
    EXPECT_GE(counts.locks, 1u);
    EXPECT_EQ(counts.throws, 1u);
    EXPECT_GE(counts.files, 1u);
}

TEST(HapticLoop, TenThousandStepsAllocateLockThrowAndOpenNothing) {
    std::vector<devices::HandPose> script;
    for (int i = 0; i < 50; ++i) {  // dips into the groove and out of it again, along it and across its rim
        const double t = 0.2 * i;
        script.push_back({t,
                          Vec3(0.008 * std::sin(0.9 * i), i % 2 == 0 ? 0.012 : 0.001, 0.03 * std::sin(0.31 * i)),
                          {1.0, 0.1 * (i % 3), 0.0, 0.0},
                          static_cast<std::uint32_t>(i % 2)});
    }
    test::Rig rig(script);
    const test::Surface groove = test::groove(0.005, 0.1, 24, 60, 2e-5);
    const test::Surface deeper = test::groove(0.0055, 0.1, 24, 60, 2e-5);
    TickParameters parameters;
    parameters.probe.points[0].radius_m = 0.005;
    int in_contact = 0, faulty = 0;
    burin::test::RealtimeCounts total;
    for (int i = 0; i < 10'000; ++i) {
        // Between ticks the other threads' work goes on; only step() is watched.
        if (i % 100 == 0) rig.publish(i % 200 == 0 ? *groove : *deeper, static_cast<std::uint64_t>(i) + 1);
        if (i % 1000 == 0) {
            parameters.workspace.object_from_device.scale = 1.0 + 1e-4 * i;
            rig.publish(parameters, static_cast<std::uint64_t>(i) + 1);
        }
        if (i % 2500 == 1200) rig.omni.inject(static_cast<devices::InjectedFault>(1 + i / 2500));
        if (i % 2500 == 1230) rig.omni.inject(devices::InjectedFault::none);
        rig.clock.sleep_until(rig.clock.now_ns() + rig.loop.period_ns());
        const burin::test::RealtimeScope scope;
        const TickRecord record = rig.loop.step();
        total += scope.counts();
        in_contact += (record.flags & kTickInContact) != 0;
        faulty += record.gate.cause != GateCause::none;
        EXPECT_LE(cost_ns(record.contact.work), ProxyBudget{}.max_cost_ns);
        EXPECT_LE(record.contact.work.steps, ProxyBudget{}.max_steps);
    }
    expect_none(total);
    EXPECT_GT(in_contact, 1000);
    EXPECT_GT(faulty, 40);
}

TEST(HapticLoop, StepsOnTilesThatAreCarvedMeanwhileAllocateFreeAndLockNothing) {
    // The carving side makes new tiles, lets go of old ones and fills the draft between the steps; the steps do
    // neither.
    std::vector<devices::HandPose> script;
    for (int i = 0; i < 50; ++i) {
        script.push_back(
            {0.2 * i, Vec3(0.03 * std::sin(0.9 * i), i % 2 == 0 ? 0.02 : -0.02, 0.03 * std::sin(0.31 * i))});
    }
    test::Rig rig(script);
    TickParameters parameters;
    parameters.probe.points[0].radius_m = test::kToolRadius_m;
    parameters.workspace.object_from_device.position_m = Vec3(0.0, 0.44, 0.0);
    parameters.workspace.object_from_device.scale = 4.0;
    rig.publish(parameters, 1);
    test::Workpiece work;
    int in_contact = 0;
    burin::test::RealtimeCounts total;
    for (int i = 0; i < 3000; ++i) {
        if (i % 10 == 0) {
            const double a = 0.01 * i;
            if (i % 30 == 0) work.cut(Vec3(0.1 * std::sin(a), 0.42, 0.1 * std::cos(a)), Vec3(0.0, 0.41, 0.0));
            geometry::LocalSurface& draft = rig.channels.surface.draft();
            compute::gather_local_surface(*work.surface, Vec3(0.0, 0.4, 0.0), 0.3, draft);
            draft.sequence = static_cast<std::uint64_t>(i) + 1;
            draft.made_ns = rig.clock.now_ns();
            rig.channels.surface.publish();
        }
        rig.clock.sleep_until(rig.clock.now_ns() + rig.loop.period_ns());
        const burin::test::RealtimeScope scope;
        const TickRecord record = rig.loop.step();
        total += scope.counts();
        in_contact += (record.flags & kTickInContact) != 0;
        EXPECT_LE(cost_ns(record.contact.work), ProxyBudget{}.max_cost_ns);
    }
    expect_none(total);
    EXPECT_GT(in_contact, 300);
}

// A body that gives, beside a carved surface: models come each 4 ms, more of them than there is room for and some that
// are none, and then stay away.
TEST(HapticLoop, StepsOnABodyThatGivesAllocateLockThrowAndOpenNothing) {
    std::vector<devices::HandPose> script;
    for (int i = 0; i < 50; ++i) script.push_back({0.2 * i, Vec3(0.0, i % 2 == 0 ? 0.05 : 0.02, 0.0)});
    test::Rig rig(script);
    TickParameters parameters;
    parameters.probe.points[0].radius_m = 0.005;
    rig.publish(parameters, 1);
    geometry::LocalSurface surface = *test::groove(0.005, 0.1, 24, 60, 2e-5);
    int pushed = 0;
    burin::test::RealtimeCounts total;
    for (int i = 0; i < 5000; ++i) {
        if (i % 4 == 0 && i % 1000 < 800) {
            surface.models = {};
            for (std::uint32_t n = 0; n < geometry::LocalModels::kMost + 3; ++n) {
                geometry::LocalModel model;
                model.point = n % 3;  // the probe has one
                model.object = 2;
                model.normal_object = n % 5 == 4 ? Vec3(0.0) : Vec3(0.0, 1.0, 0.0);
                model.place_object_m = Vec3(0.0, 0.03, 0.0);
                model.stiffness_N_per_m = 10.0;
                model.surface_N_per_m = 100.0;
                model.time_ns = rig.clock.now_ns();
                surface.models.add(model);
            }
            rig.publish(surface, static_cast<std::uint64_t>(i) + 1);
        }
        rig.clock.sleep_until(rig.clock.now_ns() + rig.loop.period_ns());
        const burin::test::RealtimeScope scope;
        const TickRecord record = rig.loop.step();
        total += scope.counts();
        pushed += record.contact.points[0].object == 2;
    }
    expect_none(total);
    EXPECT_GT(pushed, 1000);
    EXPECT_LT(pushed, 4500);
}

TEST(HapticLoop, TurnsOfTwentyPartsAllocateLockThrowAndOpenNothing) {
    test::PartsRig rig(test::point_hands(20, 2.0));
    const test::Surface sphere = test::fingertip_sphere();
    rig.publish_to_all(test::point_parameters());
    int in_contact = 0, faulty = 0;
    burin::test::RealtimeCounts total;
    for (int i = 0; i < 2000; ++i) {
        if (i % 100 == 0) rig.publish(*sphere, static_cast<std::uint64_t>(i) + 1);
        if (i % 500 == 300) rig.fingers.inject(7, static_cast<devices::InjectedFault>(1 + i / 500));
        if (i % 500 == 330) rig.fingers.inject(7, devices::InjectedFault::none);
        if (i == 1600) rig.fingers.lose_link(true);
        if (i == 1610) rig.fingers.lose_link(false);
        rig.clock.sleep_until(rig.clock.now_ns() + rig.loop.period_ns());
        {
            const burin::test::RealtimeScope scope;
            rig.loop.warm_up();
            rig.loop.step();
            total += scope.counts();
        }
        double spent_ns = 0.0;
        for (HapticChannels& one : rig.channels) {
            TickRecord record;
            one.records.pop(record);
            for (TickRecord read; one.ticks.pop(read);) continue;
            in_contact += record.in_contact() ? 1 : 0;
            faulty += record.gate.cause != GateCause::none ? 1 : 0;
            spent_ns += cost_ns(record.contact.work);
        }
        EXPECT_LE(spent_ns, budget_ns(WorkSettings{}, 1e-3));
    }
    expect_none(total);
    EXPECT_GT(in_contact, 10'000);
    EXPECT_GT(faulty, 200 + 4 * 20);
}

}  // namespace burin::haptics
