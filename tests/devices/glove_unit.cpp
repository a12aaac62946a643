// SPDX-License-Identifier: MIT
// A glove: where its fingertips are, what its pistons give there, and the emulated one at the far end of a line.
#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <cmath>
#include <thread>

#include "devices/emulators/emulated_glove.hpp"
#include "devices/gloves/glove_device.hpp"
#include "devices/registry/device_registry.hpp"
#include "devices/registry/haptic_host.hpp"

namespace burin::devices {
namespace {

const SimulatedHand& still_hand() {
    static const SimulatedHand hand = SimulatedHand::create({{0.0, Vec3(0.0), {1.0, 0.0, 0.0, 0.0}, 0}}).value();
    return hand;
}

FingerAngles flexed(double first_rad) { return {0.0, first_rad, 0.8 * first_rad, 0.5 * first_rad}; }

// An emulated glove that runs while it lives.
class RunningGlove {
public:
    explicit RunningGlove(GloveMotion motion) : port_(GlovePort::create().value()) {
        thread_ = std::thread([this, motion] { port_.run({.motion = motion}, [this] { return ends_.load(); }); });
    }
    ~RunningGlove() {
        ends_ = true;
        thread_.join();
    }
    [[nodiscard]] GlovePort& port() { return port_; }

private:
    GlovePort port_;
    std::atomic<bool> ends_ = false;
    std::thread thread_;
};

}  // namespace

TEST(GloveHands, FlexingBringsEveryTipNearerToThePalmWhichItsPistonOpposes) {
    for (std::size_t i = 0; i < kGloveFingers; ++i) {
        const FingerChain& finger = usual_hand()[i];
        double before_m = 1.0;
        for (double angle_rad = 0.0; angle_rad <= 1.2; angle_rad += 0.1) {
            const FingertipPlace place = place_of(finger, flexed(angle_rad));
            const double piston_m = glm::distance(place.hand_from_tip.position_m, finger.piston_hand_m);
            EXPECT_LT(piston_m, before_m) << i << " at " << angle_rad;
            before_m = piston_m;
            EXPECT_LT(glm::dot(place.flexes_hand, place.piston_hand), 0.0) << i << " at " << angle_rad;
            // Where the tip goes, by a small step of the first joint.
            FingerAngles more = flexed(angle_rad);
            more[1] += 1e-6;
            const Vec3 way = place_of(finger, more).hand_from_tip.position_m - place.hand_from_tip.position_m;
            EXPECT_GT(glm::dot(glm::normalize(way), place.flexes_hand), 0.999999) << i << " at " << angle_rad;
        }
    }
}

TEST(GloveHands, StraightFingersAreAsLongAsTheirSegments) {
    for (const FingerChain& finger : usual_hand()) {
        const FingertipPlace place = place_of(finger, {});
        const double length_m =
            glm::length(finger.segments_base_m[0] + finger.segments_base_m[1] + finger.segments_base_m[2]);
        EXPECT_NEAR(glm::distance(place.hand_from_tip.position_m, finger.hand_from_base.position_m), length_m, 1e-12);
    }
}

TEST(GloveHands, G6APistonDoesTheSameWorkAndPushesAlone) {
    const FingerChain& index = usual_hand()[1];
    const FingertipPlace place = place_of(index, flexed(0.8));
    const Vec3 against = -2.0 * place.flexes_hand;  // what is grasped pushes the tip open
    const PistonForce given = piston_force(place, against);
    EXPECT_FALSE(given.is_bounded);
    EXPECT_NEAR(given.force_N * glm::dot(place.piston_hand, place.flexes_hand), glm::dot(against, place.flexes_hand),
                1e-12);
    EXPECT_EQ(piston_force(place, 2.0 * place.flexes_hand).force_N, 0.0) << "it cannot pull";
    const PistonForce most = piston_force(place, -100.0 * place.flexes_hand);
    EXPECT_EQ(most.force_N, kMostPistonForce_N);
    EXPECT_TRUE(most.is_bounded);
    FingertipPlace square = place;
    square.piston_hand = glm::normalize(glm::cross(place.flexes_hand, Vec3(0.3, 0.5, 0.9)));
    EXPECT_TRUE(piston_force(square, against).is_bounded);
    EXPECT_LE(piston_force(square, against).force_N, 2.0 / kLeastPistonCosine + 1e-12);
}

TEST(EmulatedGloves, G16APistonFollowsAsALowPassOpensItsFingerAndStopsByItself) {
    EmulatedGlove glove{.motion = GloveMotion::still};
    const EmulatedGlove straight = stepped(glove);
    for (int i = 0; i < 100; ++i)
        glove = stepped(with_command(glove, {.number = 0, .stop = false, .forces_N = {0, 4, 0, 0}}));
    EXPECT_NEAR(glove.given_N[1], 4.0, 0.01);
    EXPECT_EQ(glove.given_N[0], 0.0);
    EXPECT_LT(glove.joints[1][1], straight.joints[1][1] - 0.05) << "it opens";
    // One time constant of 25 Hz is 6.4 ms.
    EmulatedGlove jump = with_command(EmulatedGlove{.motion = GloveMotion::still},
                                      {.number = 0, .stop = false, .forces_N = {8, 0, 0, 0}});
    for (int i = 0; i < 3; ++i) jump = stepped(jump);
    EXPECT_NEAR(jump.given_N[0], 8.0 * (1.0 - std::exp(-0.006 * 2.0 * 3.14159265 * 25.0)), 0.02);
    for (int i = 0; i < 200; ++i) glove = stepped(glove);  // nobody commands any more
    EXPECT_LT(glove.given_N[1], 1e-6);
}

TEST(GloveHands, AFistInOneSetIsAFaultAndNoiseOfOneStepPastABoundIsNone) {
    constexpr double kStep_rad = kAngleRange_rad / 4095, kSet_s = 1.0 / 120.0;
    for (std::size_t i = 0; i < kGloveFingers; ++i) {
        const FingerAngles open = bent_in(GripShape::whole, i, 0.0), fist = bent_in(GripShape::whole, i, 1.0);
        EXPECT_EQ(angle_fault(i, open, open, kSet_s), AngleFault::none);
        EXPECT_EQ(angle_fault(i, open, fist, kSet_s), AngleFault::jumped) << i;
        // A quick hand closes in a tenth of a second.
        EXPECT_EQ(angle_fault(i, bent_in(GripShape::whole, i, 0.0), bent_in(GripShape::whole, i, kSet_s / 0.1), kSet_s),
                  AngleFault::none);
        for (std::size_t k = 0; k < kFingerJoints; ++k) {
            FingerAngles end = open;
            end[k] = angle_bounds(i).highest[k] + kStep_rad;
            EXPECT_EQ(angle_fault(i, end, end, kSet_s), AngleFault::none) << "noise";
            end[k] += kStep_rad;
            EXPECT_EQ(angle_fault(i, end, end, kSet_s), AngleFault::beyond_bounds);
            end[k] = angle_bounds(i).lowest[k] - kStep_rad;
            EXPECT_EQ(angle_fault(i, end, end, kSet_s), AngleFault::none) << "noise";
            end[k] -= kStep_rad;
            EXPECT_EQ(angle_fault(i, end, end, kSet_s), AngleFault::beyond_bounds);
        }
        FingerAngles none = open;
        none[2] = std::nan("");
        EXPECT_NE(angle_fault(i, open, none, kSet_s), AngleFault::none);
    }
}

// Hands that a therapist sees: each as a person's joints have it, in degrees, and passed from set to set.
TEST(GloveHands, ReadingsOfCommonHandsAreNoFaults) {
    const auto degrees = [](double angle) { return angle * 3.14159265358979 / 180.0; };
    for (const FingerAngles& hand : {FingerAngles{0, 0, -1, 0},          // a middle joint a little past straight
                                     FingerAngles{0, 20, -35, 60},       // a swan neck
                                     FingerAngles{0, 10, 75, -40},       // a boutonniere
                                     FingerAngles{0, -30, 0, 0},         // a loose knuckle
                                     FingerAngles{0, 95, 115, 85},       // a tight fist
                                     FingerAngles{-45, 60, 10, 0},       // drift to the side
                                     FingerAngles{0, -60, -30, -30}}) {  // one that another hand bends back
        for (std::size_t i = 1; i < kGloveFingers; ++i) {
            FingerAngles angles{};
            for (std::size_t k = 0; k < kFingerJoints; ++k) angles[k] = degrees(hand[k]);
            EXPECT_EQ(angle_fault(i, angles, angles, 0.0083), AngleFault::none)
                << i << " " << hand[1] << " " << hand[2];
            EXPECT_TRUE(finite(place_of(usual_hand()[i], angles).piston_hand));
        }
    }
    const FingerAngles hitchhiker{0.0, 0.0, degrees(-40), degrees(-80)};
    EXPECT_EQ(angle_fault(0, hitchhiker, hitchhiker, 0.0083), AngleFault::none);
    // A torn wire reads an end of the scale, whichever joint it is of.
    for (std::size_t i = 0; i < kGloveFingers; ++i)
        for (std::size_t k = 0; k < kFingerJoints; ++k)
            for (const double end : {-90.0, 180.0}) {
                FingerAngles torn{};
                torn[k] = degrees(end);
                EXPECT_EQ(joint_beyond(i, torn), k) << i << " " << end;
            }
}

TEST(GloveHands, AFalseReadingIsToldByFingerJointAndAngle) {
    EXPECT_EQ(false_reading_text(1, 2, -1.57079632679),
              "the index finger's middle joint reads -90 degrees, and none bends beyond -75 to 140: see to its sensor");
    EXPECT_EQ(false_reading_text(0, 0, 3.14159265359),
              "the thumb's base to the side reads 180 degrees, and none bends beyond -75 to 75: see to its sensor");
}

// What the controller is left to render: it goes from the host's force to its own, and back, without a step.
TEST(EmulatedGloves, G2TakeALawOverAndGiveItBackWithoutAStepOfForce) {
    constexpr std::size_t kIndex = 1;
    EmulatedGlove glove{.motion = GloveMotion::still};
    const GloveCommand forces{.number = 0, .forces_N = {0, 2, 0, 0}};
    for (int i = 0; i < 200; ++i) glove = stepped(with_command(glove, forces));
    const double host_N = glove.given_N[kIndex];
    EXPECT_NEAR(host_N, 2.0, 0.01);
    // A spring that gives the same here, and is twice as strong a little deeper.
    DriveLaw law{.holds = true, .spring_N_per_m = 400.0, .damping_Ns_per_m = 0.5, .most_N = 8.0};
    law.start_m = glove.pistons_m[kIndex] + host_N / law.spring_N_per_m;
    glove = with_command(glove, {.number = 1, .law = GloveCommand::Law{kIndex, law}});
    GloveCommand started = forces;
    started.local = 1u << kIndex;
    double before_N = glove.given_N[kIndex], greatest_step_N = 0.0;
    const auto go_on = [&](const GloveCommand& command, int steps) {
        for (int i = 0; i < steps; ++i) {
            glove = stepped(with_command(glove, command));
            greatest_step_N = std::max(greatest_step_N, std::abs(glove.given_N[kIndex] - before_N));
            before_N = glove.given_N[kIndex];
        }
    };
    go_on(started, 100);
    EXPECT_LT(greatest_step_N, 0.02);
    EXPECT_TRUE(set_of(glove).is_local);
    // The host's force is of no account to it now; the length is.
    GloveCommand other = started;
    other.forces_N[kIndex] = 7.0;
    go_on(other, 100);
    EXPECT_LT(greatest_step_N, 0.02);
    EXPECT_NEAR(glove.given_N[kIndex], 400.0 * (law.start_m - glove.pistons_m[kIndex]), 0.02);
    go_on(forces, 100);
    EXPECT_LT(greatest_step_N, 0.05);
    EXPECT_NEAR(glove.given_N[kIndex], 2.0, 0.01);
    EXPECT_FALSE(set_of(glove).is_local);
}

TEST(EmulatedGloves, G2RenderByTheirLawAsLongAsTheHostIsHeardAndNoLonger) {
    EmulatedGlove glove{.motion = GloveMotion::still};
    glove = stepped(glove);
    const DriveLaw law{.holds = true, .spring_N_per_m = 1000.0, .start_m = glove.pistons_m[2] + 0.01, .most_N = 3.0};
    glove = with_command(glove, {.law = GloveCommand::Law{2, law}});
    for (int i = 0; i < 100; ++i) glove = stepped(with_command(glove, {.local = 1u << 2}));
    EXPECT_GT(glove.given_N[2], 1.0);
    EXPECT_LE(glove.given_N[2], 3.0) << "never more than the law allows";
    for (int i = 0; i < 100; ++i) glove = stepped(glove);  // nobody commands any more
    EXPECT_LT(glove.given_N[2], 1e-3);
    EXPECT_FALSE(set_of(glove).is_local);
    // A finger that is to be local and has no law follows the host.
    for (int i = 0; i < 100; ++i) glove = stepped(with_command(glove, {.forces_N = {0, 0, 1, 0}, .local = 1u << 2}));
    EXPECT_NEAR(glove.given_N[2], 1.0, 0.01);
    glove = with_command(glove, {.stop = true});
    for (int i = 0; i < 100; ++i) glove = stepped(glove);
    EXPECT_LT(glove.given_N[2], 1e-3);
}

// A host says stop from when it has opened the line; its session begins much later on a busy machine.
TEST(EmulatedGloves, BeginTheirScriptWithTheFirstForcesAndNotWithStopsOrLaws) {
    EmulatedGlove glove{.motion = GloveMotion::closing};
    const EmulatedGlove straight = stepped(glove);
    for (int i = 0; i < 5000; ++i) glove = stepped(with_command(glove, {.stop = true}));
    glove = stepped(with_command(glove, {.law = GloveCommand::Law{2, DriveLaw{.holds = true}}}));
    EXPECT_EQ(glove.scripted_s, 0.0);
    EXPECT_EQ(glove.joints, straight.joints) << "the hand is open";
    // It closes after two seconds, and goes on where the host stops it.
    glove = stepped(with_command(glove, {.forces_N = {}}));
    for (int i = 0; i < 1500; ++i) glove = stepped(with_command(glove, {.stop = true}));
    EXPECT_NEAR(glove.scripted_s, 1501 * EmulatedGlove::kStep_s, 1e-9);
    for (std::size_t finger = 0; finger < kGloveFingers; ++finger)
        EXPECT_GT(glove.joints[finger][1], straight.joints[finger][1] + 0.1) << finger;
}

TEST(EmulatedGloves, ADelayOfTheirOwnIsNoSilenceOfTheHost) {
    EmulatedGlove glove{.motion = GloveMotion::still};
    glove = with_command(glove, {.forces_N = {1.0, 2.0, 3.0, 4.0}});
    for (int i = 0; i < 200; ++i) glove = stepped(glove, false);
    for (std::size_t finger = 0; finger < kGloveFingers; ++finger)
        EXPECT_NEAR(glove.given_N[finger], 1.0 + static_cast<double>(finger), 0.01) << finger;
    for (int i = 0; i < 200; ++i) glove = stepped(glove);
    for (std::size_t finger = 0; finger < kGloveFingers; ++finger) EXPECT_LT(glove.given_N[finger], 1e-6) << finger;
}

TEST(Gloves, SayWhatIsWrongWithAPort) {
    MonotonicClock clock;
    const auto refused = [&](const std::string& name) {
        const auto opened = open_haptic_device(name, {clock, still_hand()});
        return opened ? std::string("nothing") : opened.error().line();
    };
    EXPECT_TRUE(refused("glove").contains("names no port")) << refused("glove");
    EXPECT_TRUE(refused("glove:/dev/no-such-port").contains("there is no such port"));
    EXPECT_TRUE(refused("glove:/dev/null").contains("is no serial line")) << refused("glove:/dev/null");
    GlovePort silent = GlovePort::create().value();
    EXPECT_TRUE(refused("glove:" + silent.name()).contains("sends nothing"));
    SimulatedClock simulated;
    const auto in_simulated_time = open_haptic_device("glove:/dev/null", {simulated, still_hand()});
    ASSERT_FALSE(in_simulated_time);
    EXPECT_TRUE(in_simulated_time.error().line().contains("time is simulated")) << in_simulated_time.error().line();
    const auto again = open_haptic_device("glove:/dev/no-such-port", {simulated, still_hand(), true});
    ASSERT_TRUE(again) << "a recording is done again without one";
    EXPECT_EQ(again->parts.size(), kGloveFingers);
}

TEST(Gloves, G1FeelFourFingersThatMoveAndGiveTheirForcesToThePistons) {
    RunningGlove running(GloveMotion::closing);
    MonotonicClock clock;
    auto opened = open_haptic_device("glove:" + running.port().name(), {clock, still_hand()});
    ASSERT_TRUE(opened) << opened.error().line();
    ASSERT_EQ(opened->parts.size(), 4u);
    EXPECT_EQ(opened->parts[1].name, "index");
    // Ticks of a millisecond until the fingers have closed a good deal and have been pushed open again.
    Vec3 first_m(0.0), along(0.0);
    double farthest_m = 0.0, given_N = 0.0, measured_N = 0.0;
    const Nanoseconds until_ns = clock.now_ns() + 30 * kNanosecondsPerSecond;
    for (int tick = 0; clock.now_ns() < until_ns && (given_N < 1.0 || measured_N < 0.5); ++tick) {
        clock.sleep_until(clock.now_ns() + 1'000'000);
        for (std::size_t i = 0; i < 4; ++i) {
            const DeviceSample sample = opened->parts[i].device->read();
            // A busy machine may keep the emulated controller from sending for a while, which is a fault, and told so.
            const bool is_late = sample.fault == DeviceFault::disconnected;
            ASSERT_TRUE(is_late || sample.fault == DeviceFault::none) << tick;
            if (i != 1) continue;
            along = sample.drive.along_device;
            EXPECT_TRUE(is_late || (sample.drive.state & kDriveMeasured) != 0);
            measured_N = std::max(measured_N, sample.drive.measured_N);
            if (tick == 0) first_m = sample.position_device_m;
            farthest_m = std::max(farthest_m, glm::distance(sample.position_device_m, first_m));
        }
        for (std::size_t i = 0; i < 4; ++i)
            opened->parts[i].device->write({i == 1 && farthest_m > 0.03 ? 2.0 * along : Vec3(0.0), Vec3(0.0)});
        given_N = running.port().given_N(1);
    }
    EXPECT_GT(farthest_m, 0.03);
    EXPECT_GT(given_N, 1.0) << "the index finger is pushed open";
    EXPECT_LT(running.port().given_N(0), 0.01);
    EXPECT_GT(measured_N, 0.5) << "what the controller measures comes back";
}

TEST(Gloves, AreNotSharedByTwoPrograms) {
    RunningGlove running(GloveMotion::still);
    MonotonicClock clock;
    const auto first = open_haptic_device("glove:" + running.port().name(), {clock, still_hand()});
    ASSERT_TRUE(first) << first.error().line();
    const auto second = open_haptic_device("glove:" + running.port().name(), {clock, still_hand()});
    ASSERT_FALSE(second);
    EXPECT_TRUE(second.error().line().contains("in use by another program")) << second.error().line();
}

TEST(Gloves, ALineThatFallsSilentIsAFaultOfAllParts) {
    RunningGlove running(GloveMotion::still);
    MonotonicClock clock;
    auto opened = open_haptic_device("glove:" + running.port().name(), {clock, still_hand()});
    ASSERT_TRUE(opened) << opened.error().line();
    EXPECT_EQ(opened->parts[0].device->read().fault, DeviceFault::none);
    running.port().fall_silent(true);
    DeviceSample sample;
    for (int i = 0; i < 2000 && sample.fault == DeviceFault::none; ++i) {
        clock.sleep_until(clock.now_ns() + 1'000'000);
        sample = opened->parts[0].device->read();
    }
    EXPECT_EQ(sample.fault, DeviceFault::disconnected);
    EXPECT_TRUE(sample.fault_is_of_all);
    running.port().fall_silent(false);
    for (int i = 0; i < 2000 && sample.fault != DeviceFault::none; ++i) {
        clock.sleep_until(clock.now_ns() + 1'000'000);
        sample = opened->parts[0].device->read();
    }
    EXPECT_EQ(sample.fault, DeviceFault::none) << "it comes back";
}

}  // namespace burin::devices
