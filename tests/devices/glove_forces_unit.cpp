// SPDX-License-Identifier: MIT
// What a glove's pistons give beside what they are told: motors that are off, and a piston that gives something else.
#include <gtest/gtest.h>

#include <cstddef>
#include <vector>

#include "tests/devices/opened_glove.hpp"

namespace burin::devices {

TEST(GloveForces, MotorsThatAreOffAreAFaultOfAllFingersWhateverItMeasures) {
    OpenedGlove opened;
    GloveSet set = healthy_set(1);
    set.motors_on = false;
    const auto off = opened.after(set, 2.0);
    set.motors_on = true;
    const auto on = opened.after(set, 2.5);
    set.motors_on = false;
    const auto again = opened.after(set, 3.0);
    for (std::size_t i = 0; i < kGloveFingers; ++i) {
        EXPECT_EQ(off[i].fault, DeviceFault::motors_off) << i;
        EXPECT_TRUE(off[i].fault_is_of_all) << i;
        EXPECT_EQ(off[i].drive.state & kDriveOn, 0u) << i;
        EXPECT_EQ(on[i].fault, DeviceFault::none) << i;
        EXPECT_EQ(again[i].fault, DeviceFault::motors_off) << i;
    }
}

// Sets come 8.3 ms apart. What a piston gives follows what it is told within some 20 ms.
TEST(GloveForces, APistonThatGivesAnotherForceThanItIsToldForLongHasAFaultOfItsOwn) {
    constexpr int kSetsOfFault = 37;  // just over 0.3 s
    struct Case {
        double told_N, given_N;
        int sets;
        bool is_fault;
        bool is_local = false, measures = true;
    };
    for (const Case& one :
         {Case{4.0, 4.0, 100, false}, Case{4.0, 3.1, 100, false}, Case{4.0, 0.0, 25, false},
          Case{4.0, 0.0, kSetsOfFault + 12, true}, Case{0.0, 3.0, kSetsOfFault + 12, true}, Case{0.3, 0.0, 100, false},
          Case{4.0, 0.0, 100, false, true}, Case{8.0, 5.0, kSetsOfFault + 12, true}, Case{8.0, 6.1, 100, false}})
        for (std::size_t own = 0; own < kGloveFingers; ++own) {
            OpenedGlove opened;
            GloveSet set = healthy_set(1);
            set.is_local = one.is_local;
            GloveForces told_N{1.0, 1.0, 1.0, 1.0};
            told_N[own] = one.told_N;
            std::vector<DeviceSample> samples;
            for (int i = 0; i < one.sets; ++i) {
                opened.tick(told_N);
                // Others give what they are told, but for a jitter that says that a set has come.
                set.forces_N = GloveForces{1.0, 1.0, 1.0, 1.0};
                (*set.forces_N)[own] = one.given_N;
                (*set.forces_N)[(own + 1) % kGloveFingers] = i % 2 == 0 ? 1.0 : 1.1;
                samples = opened.after_finger(set, (own + 1) % kGloveFingers);
            }
            for (std::size_t i = 0; i < kGloveFingers; ++i) {
                EXPECT_EQ(samples[i].fault, i == own && one.is_fault ? DeviceFault::force_differs : DeviceFault::none)
                    << one.told_N << " told, " << one.given_N << " given, finger " << own << " seen at " << i;
                EXPECT_FALSE(samples[i].fault_is_of_all);
            }
            if (!one.is_fault) continue;
            // It is told nothing and gives nothing, and is not trusted again.
            for (int i = 0; i < 50; ++i) {
                opened.tick({});
                set.forces_N = GloveForces{};
                (*set.forces_N)[(own + 1) % kGloveFingers] = i % 2 == 0 ? 0.2 : 0.1;
                samples = opened.after_finger(set, (own + 1) % kGloveFingers);
            }
            EXPECT_EQ(samples[own].fault, DeviceFault::force_differs) << own;
        }
}

}  // namespace burin::devices
