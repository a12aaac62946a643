// SPDX-License-Identifier: MIT
// A PHANTOM Omni by its maker's library, from end to end: the real driver, the emulated library that it loads, and the
// emulated device behind that.
#include "devices/drivers/omni_device.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "devices/drivers/hd_api.hpp"
#include "devices/drivers/hd_servo.hpp"
#include "devices/emulators/emulated_omni.hpp"
#include "devices/registry/device_registry.hpp"
#include "tests/devices/ticked_arm.hpp"
#include "tests/devices/tries.hpp"

namespace burin::devices {
namespace {

// Names of this process's own, so that tests beside it and a user's emulators are not met.
std::string own_name(const std::string& number = "") { return "emulated-test-" + std::to_string(::getpid()) + number; }

std::string library_named(const std::string& name) {
    const auto folder = std::filesystem::read_symlink("/proc/self/exe").parent_path();
    for (const auto& at : {folder, folder.parent_path()})
        if (std::filesystem::exists(at / name)) return (at / name).string();
    return name;
}

// Stands where it is told to from the beginning.
std::vector<HandPose> standing_at(const Vec3& place_device_m, std::uint32_t buttons = 0) {
    return {{0.0, place_device_m, {1.0, 0.0, 0.0, 0.0}, buttons}};
}

// An emulated Omni that runs while it lives.
class RunningOmni {
public:
    explicit RunningOmni(const std::string& name, std::vector<HandPose> script = standing_at(Vec3(0.0)))
        : omni_(EmulatedOmni::create(name, {.script = std::move(script), .silence = {}}).value()) {
        omni_.dies_after(kEnded_ns);
        thread_ = std::thread([this] { omni_.run([this] { return ends_.load(); }); });
        // It can be found from its first step on.
        const auto is_found = [&] { return std::ranges::count(emulated_omnis(), name) > 0; };
        EXPECT_TRUE(tried(is_found));
    }
    ~RunningOmni() {
        ends_ = true;
        thread_.join();
    }
    [[nodiscard]] EmulatedOmni& operator*() { return omni_; }
    [[nodiscard]] EmulatedOmni* operator->() { return &omni_; }

private:
    EmulatedOmni omni_;
    std::atomic<bool> ends_ = false;
    std::thread thread_;
};

std::string refusal(const std::string& device) {
    MonotonicClock clock;
    const auto opened = open_haptic_device(device, {clock, nobodys_hand()});
    return opened ? "nothing" : opened.error().line();
}

}  // namespace

TEST(Omni, P3ReadsPlaceTurnAndButtonInTheDeviceFrame) {
    const Quat turned = glm::angleAxis(0.4, glm::normalize(Vec3(0.2, 0.9, -0.3)));
    const Vec3 place(0.021, -0.013, 0.011);
    RunningOmni running(own_name(), {{0.0, place, turned, 3}});
    TickedArm omni("omni:" + own_name());
    const DeviceDescription& description = omni.opened().parts[0].device->description();
    EXPECT_EQ(description.workspace_m, OmniModel{}.workspace_m);
    EXPECT_EQ(description.max_force_N, 3.3);
    EXPECT_TRUE(description.felt_by_person);
    ASSERT_TRUE(omni.is_well());
    DeviceSample sample;
    EXPECT_TRUE(omni.ticks_until(Vec3(0.0), [&](const DeviceSample& s) {
        sample = s;
        return glm::distance(s.position_device_m, place) < 0.0001;
    })) << sample.position_device_m.x;
    EXPECT_GT(std::abs(glm::dot(sample.orientation_device, turned)), 1.0 - 1e-9);
    EXPECT_EQ(sample.buttons, 3u);
}

TEST(Omni, P3GivesItsForceToTheStylusAndSeesItGiveWay) {
    RunningOmni running(own_name());
    TickedArm omni("omni:" + own_name());
    ASSERT_TRUE(omni.is_well());
    // The hand's 200 N/m give way by 5 mm to a newton, less the arm's friction of 0.26 N.
    DeviceSample sample;
    EXPECT_TRUE(omni.ticks_until(Vec3(0.0, 1.0, 0.0), [&](const DeviceSample& s) {
        sample = s;
        return s.position_device_m.y > 0.0035;
    })) << sample.position_device_m.y;
    EXPECT_EQ(running->written_N(), Vec3(0.0, 1.0, 0.0));
    EXPECT_LT(sample.position_device_m.y, 0.0065);
    static_cast<void>(omni.tick(Vec3(0.0, 50.0, 0.0)));
    EXPECT_TRUE(
        omni.ticks_until(Vec3(0.0, 50.0, 0.0), [&](const DeviceSample&) { return running->written_N().y > 3.0; }));
    EXPECT_LE(glm::length(running->written_N()), 3.3 + 1e-12) << "no more than the library says it gives";
}

// Ticks and servo turns, each by its own clock: 1.003 ms and 1 ms. A hand that moves evenly does so for the ticks, too.
TEST(Omni, SeesAMotionAndNoStepsWhereTwoClocksBeat) {
    constexpr Nanoseconds kTurn_ns = 1'000'000, kTick_ns = 1'003'000;
    constexpr double kSpeed_m_per_s = 0.1;
    const auto turn_at = [](Nanoseconds time_ns) {
        ServedState state;
        state.time_ns = time_ns;
        state.pose_device.position_m.x = kSpeed_m_per_s * seconds(time_ns);
        return state;
    };
    Vec3 last_m(0.0);
    for (Nanoseconds now_ns = 10 * kTurn_ns, first_ns = now_ns; now_ns < 2000 * kTick_ns; now_ns += kTick_ns) {
        const Nanoseconds newest_ns = now_ns / kTurn_ns * kTurn_ns;
        const Pose pose = served_pose_at(turn_at(newest_ns - kTurn_ns), turn_at(newest_ns), now_ns - kTurn_ns);
        const double step_m = now_ns > first_ns ? pose.position_m.x - last_m.x : kSpeed_m_per_s * seconds(kTick_ns);
        EXPECT_NEAR(step_m, kSpeed_m_per_s * seconds(kTick_ns), 1e-12);
        last_m = pose.position_m;
    }
    const ServedState from = turn_at(5 * kTurn_ns), to = turn_at(6 * kTurn_ns);
    EXPECT_EQ(served_pose_at(from, to, 9 * kTurn_ns).position_m, to.pose_device.position_m)
        << "it does not go on by itself";
    EXPECT_EQ(served_pose_at(from, to, 1 * kTurn_ns).position_m, from.pose_device.position_m);
    EXPECT_EQ(served_pose_at({}, to, 0).position_m, to.pose_device.position_m) << "the first of all turns";
    EXPECT_EQ(served_pose_at(from, turn_at(500 * kTurn_ns), 6 * kTurn_ns).position_m,
              turn_at(500 * kTurn_ns).pose_device.position_m)
        << "after a gap it is where it is";
}

TEST(Omni, UnpluggedWhilePressingIsLeftWithoutForceEveryTime) {
    RunningOmni running(own_name());
    TickedArm omni("omni:" + own_name());
    ASSERT_TRUE(omni.is_well());
    const Vec3 presses(0.0, 0.0, 2.0);
    constexpr int kDrills = 8;  // each takes a third of a second; in told time: HdCalls
    int without_force = 0;
    for (int drill = 0; drill < kDrills; ++drill) {
        ASSERT_TRUE(omni.ticks_until(presses, [&](const DeviceSample& s) {
            return s.fault == DeviceFault::none && running->written_N() == presses;
        })) << drill;
        running->fall_silent(true);
        // The session goes on pressing, as a tick would that has not seen the fault.
        ASSERT_TRUE(omni.ticks_until(presses, [](const DeviceSample& s) { return s.fault != DeviceFault::none; }));
        EXPECT_TRUE(omni.ticks_until(presses, [&](const DeviceSample&) { return running->written_N() == Vec3(0.0); }));
        without_force += running->written_N() == Vec3(0.0) ? 1 : 0;
        running->fall_silent(false);
        ASSERT_TRUE(omni.is_well()) << drill << ": it is found again";
    }
    EXPECT_EQ(without_force, kDrills);
    EXPECT_TRUE(omni.messages().contains("there is no communication with the device (0x0302"));
}

TEST(Omni, AHapticThreadThatStandsStillIsNoForce) {
    RunningOmni running(own_name());
    TickedArm omni("omni:" + own_name());
    ASSERT_TRUE(omni.is_well());
    const Vec3 presses(1.0, 0.0, 0.0);
    ASSERT_TRUE(omni.ticks_until(presses, [&](const DeviceSample&) { return running->written_N() == presses; }));
    for (int i = 0; i < 2000 && running->written_N() != Vec3(0.0); ++i)
        omni.clock().sleep_until(omni.clock().now_ns() + 1'000'000);
    EXPECT_EQ(running->written_N(), Vec3(0.0));
}

TEST(Omni, APoseThatIsNoneAndErrorsOfTheMotorsTakeTheForce) {
    RunningOmni running(own_name());
    TickedArm omni("omni:" + own_name());
    ASSERT_TRUE(omni.is_well());
    const Vec3 presses(0.0, 1.0, 0.0);
    const auto loses_force_by = [&](DeviceFault fault) {
        EXPECT_TRUE(omni.ticks_until(presses, [&](const DeviceSample& s) { return s.fault == fault; }));
        EXPECT_TRUE(omni.ticks_until(presses, [&](const DeviceSample&) { return running->written_N() == Vec3(0.0); }));
    };
    running->lose_its_pose(true);
    loses_force_by(DeviceFault::other);
    const DeviceSample lost = omni.tick(presses);
    EXPECT_TRUE(finite(lost.position_device_m)) << "what a tick sees is a number, whatever came";
    running->lose_its_pose(false);
    ASSERT_TRUE(omni.is_well());
    running->raise(kHdWarmMotors);
    loses_force_by(DeviceFault::overheated);
    running->raise(kHdTooFast);
    loses_force_by(DeviceFault::overspeed);
    running->raise(0);
    ASSERT_TRUE(omni.is_well());
    EXPECT_TRUE(omni.ticks_until(presses, [&](const DeviceSample&) { return running->written_N() == presses; }));
    const std::string said = omni.messages();
    EXPECT_TRUE(said.contains("the motors are warm (0x0200")) << said;
    EXPECT_TRUE(said.contains("the velocity is too great (0x0203")) << said;
}

TEST(Omni, TellsTheGraverOfTwoErrorsAndNotBothAnewWithEachTurn) {
    RunningOmni running(own_name());
    TickedArm omni("omni:" + own_name());
    ASSERT_TRUE(omni.is_well());
    running->raise(kHdWarmMotors);
    ASSERT_TRUE(omni.ticks_until(Vec3(0.0), [](const DeviceSample& s) { return s.fault == DeviceFault::overheated; }));
    static_cast<void>(omni.messages());
    running->fall_silent(true);
    ASSERT_TRUE(
        omni.ticks_until(Vec3(0.0), [](const DeviceSample& s) { return s.fault == DeviceFault::disconnected; }));
    for (int i = 0; i < 20; ++i) static_cast<void>(omni.tick(Vec3(0.0)));
    const std::vector<std::string> said = omni.opened().messages->take_messages();
    EXPECT_FALSE(said.empty());
    EXPECT_LE(said.size(), 2u);
}

TEST(Omni, WaitsForItsCalibrationWithoutForceAndSaysWhatToDo) {
    RunningOmni running(own_name());
    running->need_calibration(kHdCalibrationNeedsHand);
    TickedArm omni("omni:" + own_name());
    const Vec3 presses(0.0, 1.0, 0.0);
    for (int i = 0; i < 150; ++i) EXPECT_NE(omni.tick(presses).fault, DeviceFault::none);
    EXPECT_EQ(running->written_N(), Vec3(0.0));
    EXPECT_TRUE(omni.messages().contains("put the stylus into the inkwell"));
    running->need_calibration(kHdCalibrationNeedsUpdate);  // the stylus is in the inkwell
    ASSERT_TRUE(omni.is_well());
    EXPECT_EQ(running->calibrations(), 1u);
    EXPECT_TRUE(omni.ticks_until(presses, [&](const DeviceSample&) { return running->written_N() == presses; }));
    EXPECT_TRUE(omni.messages().contains("is calibrated"));
}

// A PHANTOM Desktop or Premium has no inkwell.
TEST(Omni, IsCalibratedByAResetWhenSomebodyHoldsItThereAndPressesItsButton) {
    for (const unsigned int says : {kHdCalibrationNeedsHand, kHdCalibrationNeedsUpdate}) {
        // Presses twice, for a while each.
        std::vector<HandPose> script;
        for (const auto& [time_s, buttons] : {std::pair{0.0, 0u}, {0.5, 1u}, {0.6, 0u}, {1.4, 1u}, {1.5, 0u}})
            script.push_back({time_s, Vec3(0.0), {1.0, 0.0, 0.0, 0.0}, buttons});
        RunningOmni running(own_name(), script);
        running->calibrate_by(kHdByEncoderReset);
        running->need_calibration(says);
        TickedArm omni("omni:" + own_name());
        const Vec3 presses(0.0, 1.0, 0.0);
        std::uint32_t was = 0;
        int clicks = 0;
        EXPECT_TRUE(omni.ticks_until(presses, [&](const DeviceSample& s) {
            EXPECT_NE(s.fault, DeviceFault::none) << "it was not held in its reset position";
            clicks += s.buttons != 0 && std::exchange(was, s.buttons) == 0 ? 1 : 0;
            was = s.buttons;
            return clicks == 1 && s.buttons == 0;
        }));
        EXPECT_EQ(running->written_N(), Vec3(0.0));
        EXPECT_EQ(running->calibrations(), 0u);
        const std::string said = omni.messages();
        EXPECT_TRUE(said.contains("hold it in its reset position")) << said;
        EXPECT_FALSE(said.contains("inkwell")) << said;
        running->stand_at_reset(true);
        ASSERT_TRUE(omni.is_well()) << "by the second press";
        EXPECT_EQ(running->calibrations(), 1u);
        EXPECT_TRUE(omni.ticks_until(presses, [&](const DeviceSample&) { return running->written_N() == presses; }));
        EXPECT_TRUE(omni.messages().contains("is calibrated"));
    }
}

TEST(Omni, AGreatestForceThatIsNoneIsNoForceAndIsTold) {
    for (const double says :
         {0.0, -3.3, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 1e9}) {
        RunningOmni running(own_name());
        running->say_most(says);
        TickedArm omni("omni:" + own_name());
        ASSERT_TRUE(omni.is_well());
        for (int i = 0; i < 100; ++i) {
            static_cast<void>(omni.tick(Vec3(0.0, 1.0, 0.0)));
            EXPECT_EQ(running->written_N(), Vec3(0.0)) << says;
        }
        EXPECT_TRUE(omni.messages().contains("gives no force")) << says;
    }
}

TEST(Omni, TwoOfThemEachHaveTheirOwnForceAndFault) {
    RunningOmni right(own_name("-r"), standing_at({0.01, 0.0, 0.0})),
        left(own_name("-l"), standing_at({-0.01, 0.0, 0.0}));
    TickedArm first("omni:" + own_name("-r")), second("omni:" + own_name("-l"));
    ASSERT_TRUE(first.is_well());
    ASSERT_TRUE(second.is_well());
    const Vec3 up(0.0, 1.0, 0.0), down(0.0, -1.0, 0.0);
    const auto both_until = [&](auto holds) {
        for (int i = 0; i < 5000; ++i) {
            const DeviceSample a = first.tick(up), b = second.tick(down);
            if (holds(a, b)) return true;
        }
        return false;
    };
    EXPECT_TRUE(both_until([&](const DeviceSample& a, const DeviceSample& b) {
        return right->written_N() == up && left->written_N() == down && a.position_device_m.x > 0.005 &&
               b.position_device_m.x < -0.005;
    }));
    left->fall_silent(true);
    EXPECT_TRUE(both_until([&](const DeviceSample&, const DeviceSample& b) {
        return b.fault == DeviceFault::disconnected && left->written_N() == Vec3(0.0);
    }));
    EXPECT_TRUE(both_until([&](const DeviceSample& a, const DeviceSample&) {
        return a.fault == DeviceFault::none && right->written_N() == up;
    })) << "the other goes on";
}

TEST(Omni, ItsEndLeavesNoForceAndGivesItBack) {
    RunningOmni running(own_name());
    const Vec3 presses(0.0, 1.0, 0.0);
    {
        TickedArm omni("omni:" + own_name());
        ASSERT_TRUE(omni.is_well());
        ASSERT_TRUE(omni.ticks_until(presses, [&](const DeviceSample&) { return running->written_N() == presses; }));
        EXPECT_TRUE(refusal("omni:" + own_name()).contains("the device is in use (0x0301)"))
            << refusal("omni:" + own_name());
        EXPECT_TRUE(omni.ticks_until(presses, [&](const DeviceSample& s) {
            return s.fault == DeviceFault::none && running->written_N() == presses;
        })) << "who asked in vain has not taken it away";
    }
    EXPECT_EQ(running->written_N(), Vec3(0.0));
    EXPECT_TRUE(TickedArm("omni:" + own_name()).is_well());
}

TEST(Omni, SaysWhatIsWrongWithALibraryAndADevice) {
    EXPECT_TRUE(refusal("omni:x@/no/such/libHD.so").contains("the library /no/such/libHD.so cannot be loaded"));
    EXPECT_TRUE(refusal("omni:x@/no/such/libHD.so").contains("burin devices emulate omni"));
    EXPECT_TRUE(refusal("omni:x@libc.so.6").contains("has no function hdInitDevice")) << refusal("omni:x@libc.so.6");
    EXPECT_TRUE(refusal("omni:x@" + library_named("libburin_emulated_hd_lacking.so"))
                    .contains("has no function hdScheduleAsynchronous"));
    EXPECT_TRUE(refusal("omni:" + own_name("-none")).contains("there is no communication with the device (0x0302)"))
        << refusal("omni:" + own_name("-none"));
    {
        RunningOmni running(own_name());
        std::string other;
        EXPECT_TRUE(tried([&] {
            other = refusal("omni:" + own_name() + "@" + library_named("libburin_emulated_hd_9.so"));
            return other.contains("HDAPI");
        }));
        EXPECT_TRUE(other.contains("is HDAPI 9.01.2, and Burin knows version 3")) << other;
        EXPECT_FALSE(EmulatedOmni::create(own_name())) << "there is one of that name";
        EXPECT_TRUE(TickedArm("omni:" + own_name()).is_well()) << "and what was refused has given it back";
    }
    EXPECT_FALSE(EmulatedOmni::create("omni"));
    EXPECT_FALSE(EmulatedOmni::create("emulated/../x"));
    SimulatedClock simulated;
    const auto opened = open_haptic_device("omni", {simulated, nobodys_hand()});
    ASSERT_FALSE(opened);
    EXPECT_TRUE(opened.error().line().contains("time is simulated"));
    const auto again = open_haptic_device("omni:whatever", {simulated, nobodys_hand(), true});
    ASSERT_TRUE(again) << "a recording is done again without one";
    EXPECT_EQ(again->parts[0].device->description().max_force_N, 3.3);
}

TEST(Omni, IsListedWithItsCauseAndWhileItIsEmulated) {
    const auto names_it = [](const std::string& name) {
        for (const DevicePresence& one : look_for_omnis())
            if (one.name == "omni:" + name) return one.presence == Presence::there;
        return false;
    };
    EXPECT_FALSE(names_it(own_name()));
    {
        RunningOmni running(own_name());
        EXPECT_TRUE(tried([&] { return names_it(own_name()); }));
    }
    EXPECT_FALSE(names_it(own_name()));
    EXPECT_EQ(look_for_omnis().front().name, "omni");
    EXPECT_FALSE(look_for_omnis().front().cause.empty());
}

}  // namespace burin::devices
