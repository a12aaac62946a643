// SPDX-License-Identifier: MIT
// A Quanser wand by its maker's library, from end to end: the real driver, the emulated library that it loads, and the
// emulated wand behind that.
#include "devices/drivers/wand_device.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <limits>
#include <thread>

#include "devices/drivers/hil_wand.hpp"
#include "devices/drivers/library_beside.hpp"
#include "devices/emulators/emulated_wand.hpp"
#include "devices/haptic/wand_file.hpp"
#include "devices/registry/device_registry.hpp"
#include "tests/devices/running_wand.hpp"
#include "tests/support/run_command.hpp"

namespace burin::devices {
namespace {

std::string refusal_of_wand(const std::string& device) {
    MonotonicClock clock;
    const auto opened = open_haptic_device(device, {clock, nobodys_hand()});
    return opened ? "nothing" : opened.error().line();
}

}  // namespace

TEST(Wand, W2ReadsPlaceAndTurnInTheDeviceFrame) {
    const Vec3 place(0.05, -0.06, 0.03);
    const Quat turned = glm::angleAxis(0.4, Vec3(1.0, 0.0, 0.0));
    RunningWand running(own_wand(), out_to(place, turned));
    TickedWand wand(own_wand());
    const DeviceDescription& description = wand.opened().parts[0].device->description();
    EXPECT_LT(glm::distance(description.workspace_m, Vec3(0.48, 0.45, 0.25)), 1e-12);
    EXPECT_EQ(description.axis_max_force_N, Vec3(2.3, 3.0, 2.1)) << "x, y and z of the maker's are x, z and y here";
    EXPECT_EQ(description.max_torque_Nm, Vec3(0.230, 0.0, 0.250)) << "yaw is passive";
    EXPECT_EQ(description.joints.count, 6u);
    EXPECT_GT(description.resolution_m, 2e-5);
    EXPECT_LT(description.resolution_m, 1e-3);
    EXPECT_TRUE(description.felt_by_person);
    ASSERT_TRUE(wand.is_well());
    DeviceSample sample;
    EXPECT_TRUE(wand.ticks_until({},
                                 [&](const DeviceSample& s) {
                                     sample = s;
                                     return glm::distance(s.position_device_m, place) <
                                                0.0035 &&  // the arm's friction keeps it from the hand's
                                            std::abs(glm::dot(s.orientation_device, turned)) > 1.0 - 1e-4;
                                 }))
        << sample.position_device_m.x << " " << sample.position_device_m.y << " " << sample.position_device_m.z;
    EXPECT_NE(sample.joints[0], 0.0);
}

TEST(Wand, StaysInItsJigUntilABusyMachineHasSetItsCounters) {
    RunningWand running(own_wand());
    const auto api = load_hil_api(library_of_tests(kEmulatedHilLibrary));
    ASSERT_TRUE(api) << api.error().line();
    constexpr std::array<std::uint32_t, kWandJoints> kChannels{0, 1, 2, 3, 4, 5};
    constexpr std::array<std::int32_t, kWandJoints> kZero{};
    HilCard card = nullptr;
    ASSERT_TRUE(tried([&] { return api->open("emulated", own_wand().c_str(), &card) == 0; }));
    std::array<std::int32_t, kWandJoints> at_first{}, counts{};
    const auto read = [&](auto& to) { return api->read_encoder(card, kChannels.data(), kWandJoints, to.data()) >= 0; };
    EXPECT_TRUE(read(at_first));
    for (int i = 0; i < 300; ++i) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
        EXPECT_TRUE(!read(counts) || counts == at_first);
    }
    EXPECT_EQ(api->set_encoder_counts(card, kChannels.data(), kWandJoints, kZero.data()), 0);
    bool moves = false;
    for (int i = 0; i < 5000 && !moves; ++i) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
        moves = read(counts) && counts != kZero;
    }
    EXPECT_TRUE(moves);
    EXPECT_EQ(api->close(card), 0);
}

TEST(Wand, W6GivesForceAndTorqueToTheHandleThroughItsMotors) {
    RunningWand running(own_wand());
    TickedWand wand(own_wand());
    ASSERT_TRUE(wand.is_well());
    const DeviceWrench asks{Vec3(0.3, -0.4, 0.5), Vec3(0.05, 0.0, -0.08)};
    DeviceWrench acts;
    EXPECT_TRUE(wand.ticks_until(asks,
                                 [&](const DeviceSample&) {
                                     acts = running->acting();
                                     return glm::distance(acts.force_device_N, asks.force_device_N) < 0.005 &&
                                            glm::distance(acts.torque_device_Nm, asks.torque_device_Nm) < 0.003;
                                 }))
        << acts.force_device_N.x << " " << acts.force_device_N.y << " " << acts.force_device_N.z << ", "
        << acts.torque_device_Nm.x << " " << acts.torque_device_Nm.y << " " << acts.torque_device_Nm.z;
    // The hand's 200 N/m give way.
    EXPECT_TRUE(wand.ticks_until(kPresses, [&](const DeviceSample& s) { return s.position_device_m.z > 0.004; }));
}

TEST(Wand, W2KeepsEveryLimitAndCountsWhatIsAtIt) {
    RunningWand running(own_wand());
    const std::string library = library_of_tests(kEmulatedHilLibrary);
    auto served = tried([&] { return HilWand::open(library, own_wand(), quanser_wand_of_maker()); });
    ASSERT_TRUE(served) << served.error().line();
    MonotonicClock clock;
    DeviceWrench worst;
    const auto are_counted = [&] {
        const WandLimits limits = (*served)->limits();
        return std::ranges::all_of(limits.force, [](std::uint64_t count) { return count > 200; });
    };
    // A second and a half; longer where a busy machine lets its card's servo turn seldom.
    for (int i = 0; i < 1500 || (i < 15'000 && !are_counted()); ++i) {
        clock.sleep_until(clock.now_ns() + 1'000'000);
        (*served)->exchange().command({Vec3(50.0, -50.0, 50.0), Vec3(5.0, 5.0, -5.0)}, clock.now_ns());
        const DeviceWrench acts = running->acting();
        worst.force_device_N = glm::max(worst.force_device_N, glm::abs(acts.force_device_N));
        worst.torque_device_Nm = glm::max(worst.torque_device_Nm, glm::abs(acts.torque_device_Nm));
    }
    // Turn and write are a step of the hand apart, by which the pose that the motors' share is computed of has moved.
    for (int axis = 0; axis < 3; ++axis)
        EXPECT_LE(worst.force_device_N[axis], Vec3(2.3, 3.0, 2.1)[axis] * 1.02) << axis;
    for (int axis = 0; axis < 3; ++axis)
        EXPECT_LE(worst.torque_device_Nm[axis], Vec3(0.230, 0.0, 0.250)[axis] * 1.02 + 0.001) << axis;
    EXPECT_GT(worst.force_device_N.z, 0.5) << "and it does push";
    const WandLimits limits = (*served)->limits();
    for (std::size_t axis = 0; axis < 3; ++axis) EXPECT_GT(limits.force[axis], 200u) << axis;
    EXPECT_GT(limits.torque[0], 200u);
    EXPECT_EQ(limits.torque[1], 0u) << "yaw gets none";
    (*served)->exchange().command({Vec3(std::nan(""), 0.0, 0.0), Vec3(0.0)}, clock.now_ns());
    clock.sleep_until(clock.now_ns() + 10'000'000);
    EXPECT_TRUE(running.is_without_force()) << "no number, no force";
}

TEST(Wand, ACurrentThatIsNoNumberIsZeroAndAFault) {
    WandMechanism mechanism;
    const WandJoints torques{0.1, 0.2, 0.3, 0.1, 0.2, 0.3};
    EXPECT_TRUE(volts_of_torques(mechanism, torques).is_sound);
    for (std::size_t joint = 0; joint < kWandJoints; ++joint)
        for (const double wrong : {std::nan(""), std::numeric_limits<double>::infinity()}) {
            WandJoints spoilt = torques;
            spoilt[joint] = wrong;
            const WandVolts volts = volts_of_torques(mechanism, spoilt);
            EXPECT_FALSE(volts.is_sound);
            EXPECT_EQ(volts.volts, WandJoints{}) << joint;
        }
    // A motor without a torque constant: the file's bounds refuse it, the driver does not rely on that.
    WandDescription wand = quanser_wand_of_maker();
    wand.mechanism.torque_Nm_per_A[2] = 0.0;
    RunningWand running(own_wand());
    auto served = tried([&] { return HilWand::open(library_of_tests(kEmulatedHilLibrary), own_wand(), wand); });
    ASSERT_TRUE(served) << served.error().line();
    MonotonicClock clock;
    std::string said;
    bool had_fault = false;
    for (int i = 0; i < 3000 && !(had_fault && !said.empty()); ++i) {
        clock.sleep_until(clock.now_ns() + 1'000'000);
        (*served)->exchange().command(kPresses, clock.now_ns());
        EXPECT_TRUE(running.is_without_force());
        for (const std::string& message : (*served)->take_messages())
            if (message.contains("no number")) said = message;
        had_fault = had_fault || (!said.empty() && (*served)->exchange().newest().fault == DeviceFault::other);
    }
    EXPECT_TRUE(said.contains("comes out as no number: no force")) << said;
    EXPECT_TRUE(had_fault);
}

TEST(Wand, UnpluggedWhilePressingIsLeftWithoutForceEveryTime) {
    RunningWand running(own_wand());
    TickedWand wand(own_wand());
    ASSERT_TRUE(wand.is_out());
    constexpr int kDrills = 3;  // each takes more than a second; in told time: HilCalls
    int without_force = 0;
    for (int drill = 0; drill < kDrills; ++drill) {
        ASSERT_TRUE(wand.ticks_until(
            kPresses,
            [&](const DeviceSample& s) { return s.fault == DeviceFault::none && !running.is_without_force(); }))
            << drill << wand.messages();
        running->fall_silent(true);
        // The session goes on pressing, as a tick would that has not seen the fault.
        ASSERT_TRUE(
            wand.ticks_until(kPresses, [](const DeviceSample& s) { return s.fault == DeviceFault::disconnected; }));
        without_force += running.is_without_force() && !running->are_amplifiers_on() ? 1 : 0;
        running->fall_silent(false);
        ASSERT_TRUE(wand.is_well()) << drill << ": it is found again, " << wand.messages();
    }
    EXPECT_EQ(without_force, kDrills);
    EXPECT_TRUE(wand.messages().contains("the card does not answer")) << wand.messages();
    EXPECT_TRUE(wand.messages().contains("its encoders have gone on counting"));
}

TEST(Wand, ACardThatLostItsCountsNeedsTheJigAgain) {
    RunningWand running(own_wand());
    TickedWand wand(own_wand());
    ASSERT_TRUE(wand.is_out());
    running->fall_silent(true);
    ASSERT_TRUE(wand.ticks_until({}, [](const DeviceSample& s) { return s.fault == DeviceFault::disconnected; }));
    running->lose_counts();
    running->fall_silent(false);
    ASSERT_TRUE(wand.ticks_until(kPresses, [](const DeviceSample& s) { return s.fault == DeviceFault::other; }));
    for (int i = 0; i < 400; ++i) EXPECT_NE(wand.tick(kPresses).fault, DeviceFault::none);
    EXPECT_TRUE(running.is_without_force());
    EXPECT_TRUE(wand.messages().contains("put the handle into its jig")) << wand.messages();
    EXPECT_EQ(wand.opened().amplifiers->switch_amplifiers(true), AmplifierAnswer::done);
    EXPECT_TRUE(wand.is_well());
    DeviceSample sample = wand.tick({});
    EXPECT_LT(glm::distance(sample.position_device_m, jig_device_m()), 0.005) << "where it stood is now the jig";
}

TEST(Wand, WhatIsLostNearItsJigNeedsTheJigAgainSinceZerosCannotBeTold) {
    RunningWand running(own_wand(), {{0.0, jig_device_m(), {1.0, 0.0, 0.0, 0.0}, 0}});
    TickedWand wand(own_wand());
    ASSERT_TRUE(wand.is_well());
    running->fall_silent(true);
    ASSERT_TRUE(wand.ticks_until({}, [](const DeviceSample& s) { return s.fault == DeviceFault::disconnected; }));
    running->fall_silent(false);
    ASSERT_TRUE(wand.ticks_until(kPresses, [](const DeviceSample& s) { return s.fault == DeviceFault::other; }));
    EXPECT_TRUE(wand.messages().contains("put the handle into its jig")) << wand.messages();
}

TEST(Wand, AHapticThreadThatStandsStillIsNoForce) {
    RunningWand running(own_wand());
    TickedWand wand(own_wand());
    ASSERT_TRUE(wand.is_well());
    ASSERT_TRUE(wand.ticks_until(kPresses, [&](const DeviceSample&) { return !running.is_without_force(); }));
    for (int i = 0; i < 2000 && !running.is_without_force(); ++i)
        wand.clock().sleep_until(wand.clock().now_ns() + 1'000'000);
    EXPECT_TRUE(running.is_without_force());
}

TEST(Wand, EncodersThatContradictOneAnotherTakeTheForce) {
    RunningWand running(own_wand());
    TickedWand wand(own_wand());
    ASSERT_TRUE(wand.is_well());
    ASSERT_TRUE(wand.ticks_until(kPresses, [&](const DeviceSample&) { return !running.is_without_force(); }));
    running->miscount(3000.0);  // 54 degrees of a shoulder
    ASSERT_TRUE(wand.ticks_until(kPresses, [](const DeviceSample& s) { return s.fault == DeviceFault::other; }));
    const DeviceSample lost = wand.tick(kPresses);
    EXPECT_TRUE(finite(lost.position_device_m));
    EXPECT_TRUE(running.is_without_force());
    running->miscount(0.0);
    EXPECT_TRUE(wand.is_well());
    EXPECT_TRUE(wand.messages().contains("contradict one another")) << wand.messages();
    EXPECT_TRUE(wand.messages().contains("agree again")) << wand.messages();
}

TEST(Wand, AnErrorOfTheLibraryIsToldInItsWords) {
    RunningWand running(own_wand());
    TickedWand wand(own_wand());
    ASSERT_TRUE(wand.is_well());
    running->raise(-77);
    ASSERT_TRUE(wand.ticks_until(kPresses, [](const DeviceSample& s) { return s.fault == DeviceFault::disconnected; }));
    EXPECT_TRUE(running.is_without_force());
    EXPECT_EQ(wand.opened().amplifiers->switch_amplifiers(true), AmplifierAnswer::cause_remains);
    running->raise(0);
    EXPECT_TRUE(wand.is_well());
    EXPECT_TRUE(wand.messages().contains("fails: an error (-77)")) << wand.messages();
}

TEST(Wand, ItsAmplifiersAreSwitchedAndTheForceComesBackAfterASampleThatSaysSo) {
    RunningWand running(own_wand());
    TickedWand wand(own_wand());
    ASSERT_TRUE(wand.is_well());
    ASSERT_TRUE(running->are_amplifiers_on());
    EXPECT_EQ(wand.opened().amplifiers->switch_amplifiers(false), AmplifierAnswer::done);
    ASSERT_TRUE(wand.ticks_until(kPresses, [](const DeviceSample& s) { return s.fault == DeviceFault::other; }));
    EXPECT_TRUE(wand.ticks_until(kPresses, [&](const DeviceSample&) { return running.is_without_force(); }));
    EXPECT_FALSE(running->are_amplifiers_on());
    EXPECT_EQ(wand.opened().amplifiers->switch_amplifiers(true), AmplifierAnswer::done);
    EXPECT_TRUE(wand.is_well());
    EXPECT_TRUE(running->are_amplifiers_on());
}

TEST(Wand, TwoOfThemEachHaveTheirOwnForceAndFault) {
    RunningWand right(own_wand("-r")), left(own_wand("-l"));
    TickedWand first(own_wand("-r")), second(own_wand("-l"));
    ASSERT_TRUE(first.is_well()) << first.messages();
    ASSERT_TRUE(second.is_well()) << second.messages();
    const DeviceWrench up{Vec3(0.0, 1.0, 0.0), Vec3(0.0)}, down{Vec3(0.0, -1.0, 0.0), Vec3(0.0)};
    const auto both_until = [&](auto holds) {
        for (int i = 0; i < 5000; ++i) {
            const DeviceSample a = first.tick(up), b = second.tick(down);
            if (holds(a, b)) return true;
        }
        return false;
    };
    EXPECT_TRUE(both_until([&](const DeviceSample&, const DeviceSample&) {
        return right->acting().force_device_N.y > 0.9 && left->acting().force_device_N.y < -0.9;
    }));
    left->fall_silent(true);
    EXPECT_TRUE(both_until([&](const DeviceSample&, const DeviceSample& b) {
        return b.fault == DeviceFault::disconnected && left.is_without_force();
    }));
    EXPECT_TRUE(both_until([&](const DeviceSample& a, const DeviceSample&) {
        return a.fault == DeviceFault::none && right->acting().force_device_N.y > 0.9;
    })) << "the other goes on";
}

TEST(Wand, ItsEndLeavesNoForceAndGivesItBackToTheJig) {
    RunningWand running(own_wand());
    {
        TickedWand wand(own_wand());
        ASSERT_TRUE(wand.is_well());
        ASSERT_TRUE(wand.ticks_until(kPresses, [&](const DeviceSample&) { return !running.is_without_force(); }));
        EXPECT_TRUE(refusal_of_wand("wand:" + own_wand()).contains("the card is in use"))
            << refusal_of_wand("wand:" + own_wand());
    }
    EXPECT_TRUE(running.is_without_force());
    EXPECT_FALSE(running->are_amplifiers_on());
}

TEST(Wand, SaysWhatIsWrongWithALibraryACardAndADescription) {
    EXPECT_TRUE(refusal_of_wand("wand:0@/no/such/libhil.so").contains("/no/such/libhil.so cannot be loaded"));
    EXPECT_TRUE(refusal_of_wand("wand:0@/no/such/libhil.so").contains("burin devices emulate wand"));
    EXPECT_TRUE(refusal_of_wand("wand:0@libc.so.6").contains("has no function hil_get_version"));
    EXPECT_TRUE(refusal_of_wand("wand:0@" + library_of_tests("libburin_emulated_hil_lacking.so"))
                    .contains("has no function hil_watchdog_stop"));
    EXPECT_TRUE(refusal_of_wand("wand:0@" + library_of_tests("libburin_emulated_hil_1.so"))
                    .contains("is of version 1.4, and Burin knows those from 2 on"));
    EXPECT_TRUE(refusal_of_wand("wand:" + own_wand("-none")).contains("there is no such card"))
        << refusal_of_wand("wand:" + own_wand("-none"));
    const Workplace at;
    at.write("w.toml", "[mechanism]\nupper = 0.01\nmotor_signs = [1, 2, 1, 1, 1, 1]\nwhat = 1\n");
    const std::string problems = refusal_of_wand("wand:" + own_wand() + "," + (at / "w.toml").string());
    EXPECT_TRUE(problems.contains("motor_signs") && problems.contains("what")) << problems;
    EXPECT_FALSE(EmulatedWand::create("wand"));
    SimulatedClock simulated;
    const auto opened = open_haptic_device("wand", {simulated, nobodys_hand()});
    ASSERT_FALSE(opened);
    EXPECT_TRUE(opened.error().line().contains("time is simulated"));
}

TEST(Wand, ItsAddressNamesCardDescriptionAndLibrary) {
    const auto is = [](const std::string& text, const std::string& card, const std::string& file,
                       const std::string& library) {
        const WandAddress address = wand_address(text);
        return address.card == card && address.file == file && address.library == library;
    };
    EXPECT_TRUE(is("", "0", "", ""));
    EXPECT_TRUE(is("1", "1", "", ""));
    EXPECT_TRUE(is("a/w.toml", "0", "a/w.toml", ""));
    EXPECT_TRUE(is("1,a/w.toml@/x/libhil.so", "1", "a/w.toml", "/x/libhil.so"));
    EXPECT_TRUE(is("0@tcpip://lab:17000", "0@tcpip://lab:17000", "", ""));
    EXPECT_TRUE(wand_address("1@").names_library);
    EXPECT_FALSE(wand_address("0@tcpip://lab:17000").names_library);
}

TEST(Wand, TheDescriptionThatComesWithBurinIsTheMakers) {
    const auto file = read_wand("assets/devices/quanser-wand-hil.toml");
    ASSERT_TRUE(file) << file.error().line();
    WandDescription maker = quanser_wand_of_maker();
    EXPECT_NEAR(file->mechanism.arm.offset_m, maker.mechanism.arm.offset_m, 1e-12);
    EXPECT_NEAR(file->mechanism.jig_rad[1], maker.mechanism.jig_rad[1], 1e-12);
    EXPECT_LT(glm::distance(file->mechanism.arm.upper_m * Vec3(1.0), maker.mechanism.arm.upper_m * Vec3(1.0)), 1e-12);
    maker.mechanism.arm = file->mechanism.arm;
    maker.mechanism.jig_rad = file->mechanism.jig_rad;
    EXPECT_LT(std::abs(1.0 - glm::dot(file->scene_from_maker.orientation, maker.scene_from_maker.orientation)), 1e-12);
    maker.scene_from_maker = file->scene_from_maker;
    EXPECT_EQ(file->lowest_turn_rad, maker.lowest_turn_rad);
    EXPECT_EQ(*file, maker);
}

TEST(Wand, IsListedWithItsCauseAndWhileItIsEmulated) {
    const auto names_it = [](const std::string& name) {
        for (const DevicePresence& one : look_for_wands())
            if (one.name == "wand:" + name) return one.presence == Presence::there;
        return false;
    };
    {
        RunningWand running(own_wand());
        EXPECT_TRUE(tried([&] { return names_it(own_wand()); }));
    }
    EXPECT_FALSE(names_it(own_wand()));
    EXPECT_EQ(look_for_wands().front().name, "wand");
    EXPECT_FALSE(look_for_wands().front().cause.empty());
}

}  // namespace burin::devices
