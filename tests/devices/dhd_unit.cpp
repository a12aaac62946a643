// SPDX-License-Identifier: MIT
// A Force Dimension device by its maker's library, from end to end: the real driver, the emulated library that it
// loads, and the emulated device behind that.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <thread>

#include "devices/drivers/dhd_api.hpp"
#include "devices/drivers/dhd_device.hpp"
#include "devices/drivers/dhd_line.hpp"
#include "devices/drivers/library_beside.hpp"
#include "devices/emulators/emulated_dhd.hpp"
#include "devices/registry/device_registry.hpp"
#include "tests/devices/ticked_arm.hpp"
#include "tests/devices/tries.hpp"

namespace burin::devices {
namespace {

// Names of this process's own, so that tests beside it and a user's emulators are not met.
std::string own_dhd(const std::string& number = "") { return "emulated-test-" + std::to_string(::getpid()) + number; }

std::vector<HandPose> dhd_stands_at(const Vec3& place_device_m) {
    return {{0.0, place_device_m, {1.0, 0.0, 0.0, 0.0}, 0}};
}

// An emulated device that runs while it lives.
class RunningDhd {
public:
    explicit RunningDhd(const std::string& name, std::vector<HandPose> script = dhd_stands_at(Vec3(0.0)),
                        int type = kDhdOmega3)
        : dhd_(EmulatedDhd::create(name, {.script = std::move(script), .silence = {}, .type = type}).value()) {
        dhd_.dies_after(kEnded_ns);
        thread_ = std::thread([this] { dhd_.run([this] { return ends_.load(); }); });
        // It can be found from its first step on.
        const auto is_found = [&] { return std::ranges::count(emulated_dhds(), name) > 0; };
        EXPECT_TRUE(tried(is_found));
    }
    ~RunningDhd() {
        ends_ = true;
        thread_.join();
    }
    [[nodiscard]] EmulatedDhd* operator->() { return &dhd_; }

private:
    EmulatedDhd dhd_;
    std::atomic<bool> ends_ = false;
    std::thread thread_;
};

std::string refused_dhd(const std::string& choice) {
    MonotonicClock clock;
    const auto opened = open_haptic_device("dhd:" + choice, {clock, nobodys_hand()});
    return opened ? "nothing" : opened.error().line();
}

}  // namespace

TEST(Dhd, ReadsPlaceTurnAndButtonsInTheDeviceFrame) {
    const Quat turned = glm::angleAxis(0.4, glm::normalize(Vec3(0.2, 0.9, -0.3)));
    const Vec3 place(0.021, -0.013, 0.011);
    constexpr int kOmega6 = 34;  // an omega.3 has no wrist
    RunningDhd running(own_dhd(), {{0.0, place, turned, 3}}, kOmega6);
    TickedArm dhd("dhd:" + own_dhd());
    EXPECT_EQ(dhd.opened().parts[0].device->description().max_force_N, 12.0);
    ASSERT_TRUE(dhd.is_well());
    DeviceSample sample;
    EXPECT_TRUE(dhd.ticks_until(Vec3(0.0), [&](const DeviceSample& s) {
        sample = s;
        return glm::distance(s.position_device_m, place) < 0.0001;
    })) << sample.position_device_m.x;
    EXPECT_GT(std::abs(glm::dot(sample.orientation_device, turned)), 1.0 - 1e-9);
    EXPECT_EQ(sample.buttons, 3u);
    EXPECT_EQ(running->watchdog(), 160u) << "20 ms in steps of 125 us";
}

TEST(Dhd, AHandleWithoutAWristIsNotTurnedAndHasItsForce) {
    const Quat turned = glm::angleAxis(0.4, glm::normalize(Vec3(0.2, 0.9, -0.3)));
    RunningDhd running(own_dhd(), {{0.0, Vec3(0.01, 0.0, 0.0), turned, 0}}, kDhdOmega3);
    TickedArm dhd("dhd:" + own_dhd());
    ASSERT_TRUE(dhd.is_well()) << "the library leaves the matrix as it was given";
    EXPECT_EQ(dhd.tick(Vec3(0.0)).orientation_device, Quat(1.0, 0.0, 0.0, 0.0));
    const Vec3 presses(1.0, 0.0, 0.0);
    EXPECT_TRUE(dhd.ticks_until(presses, [&](const DeviceSample&) { return running->written_N() == presses; }));
    EXPECT_FALSE(dhd.messages().contains("reads a pose that is none"));
}

// The axes are the library's by its manual: x to the user, y to the right, z up. Asked of the library itself.
TEST(Dhd, TakesTheLibrarysAxesAsItsManualHasThem) {
    RunningDhd running(own_dhd(), dhd_stands_at(Vec3(0.01, 0.02, 0.03)));
    const auto api = load_dhd_api(library_beside(kEmulatedDhdLibrary));
    ASSERT_TRUE(api) << api.error().line();
    const int device = tried([&] { return api->open_by_serial(emulated_serial(own_dhd())) + 1; }) - 1;
    ASSERT_GE(device, 0);
    double x = 0.0, y = 0.0, z = 0.0, turn[3][3];
    ASSERT_EQ(api->read_pose(&x, &y, &z, turn, static_cast<char>(device)), 0);
    EXPECT_NEAR(x, 0.03, 1e-4) << "to the user";
    EXPECT_NEAR(y, 0.01, 1e-4) << "to the right";
    EXPECT_NEAR(z, 0.02, 1e-4) << "up";
    static_cast<void>(api->enable_force(1, static_cast<char>(device)));
    EXPECT_EQ(api->write_force(1.0, 2.0, 3.0, 0, 0, 0, 0, static_cast<char>(device)), 0);
    EXPECT_EQ(running->written_N(), Vec3(2.0, 3.0, 1.0));
    EXPECT_EQ(api->close(static_cast<char>(device)), 0);
}

TEST(Dhd, TheEmulatedLibrarysExpertSectionIsShutAsTheHeaderHasIt) {
    RunningDhd running(own_dhd());
    const auto api = load_dhd_api(library_beside("libburin_emulated_dhd_shut.so"));
    ASSERT_TRUE(api) << api.error().line();
    const int device = tried([&] { return api->open_by_serial(emulated_serial(own_dhd())) + 1; }) - 1;
    ASSERT_GE(device, 0);
    const auto id = static_cast<char>(device);
    EXPECT_EQ(api->set_watchdog(160, id), -1);
    EXPECT_EQ(api->last_error(), 9) << "DHD_ERROR_EXPERT_MODE_DISABLED";
    EXPECT_EQ(running->watchdog(), 0u);
    EXPECT_EQ(api->enable_expert_mode(), 0);
    EXPECT_EQ(api->set_watchdog(160, id), 0);
    EXPECT_EQ(running->watchdog(), 160u);
    EXPECT_EQ(api->close(id), 0);
}

TEST(Dhd, GivesItsForceAndSeesTheHandGiveWay) {
    RunningDhd running(own_dhd());
    TickedArm dhd("dhd:" + own_dhd());
    ASSERT_TRUE(dhd.is_well());
    for (const Vec3& way : {Vec3(1.0, 0.0, 0.0), Vec3(0.0, 1.0, 0.0), Vec3(0.0, 0.0, -1.0)}) {
        DeviceSample sample;
        EXPECT_TRUE(dhd.ticks_until(way,
                                    [&](const DeviceSample& s) {
                                        sample = s;
                                        return glm::dot(s.position_device_m, way) > 0.0035;
                                    }))
            << way.x << way.y << way.z;
        EXPECT_EQ(running->written_N(), way);
        EXPECT_LT(glm::dot(sample.position_device_m, way), 0.0065);
    }
    ASSERT_TRUE(
        dhd.ticks_until(Vec3(0.0, 80.0, 0.0), [&](const DeviceSample&) { return running->written_N().y > 11.0; }));
    EXPECT_LE(glm::length(running->written_N()), 12.0 + 1e-12);
}

TEST(Dhd, UnpluggedWhilePressingIsLeftWithoutForceEveryTime) {
    RunningDhd running(own_dhd());
    TickedArm dhd("dhd:" + own_dhd());
    ASSERT_TRUE(dhd.is_well());
    const Vec3 presses(0.0, 0.0, 2.0);
    constexpr int kDrills = 3;  // each takes more than a second; in told time: AfterAFault
    int without_force = 0;
    for (int drill = 0; drill < kDrills; ++drill) {
        ASSERT_TRUE(dhd.ticks_until(presses, [&](const DeviceSample& s) {
            return s.fault == DeviceFault::none && running->written_N() == presses;
        })) << drill;
        running->fall_silent(true);
        ASSERT_TRUE(dhd.ticks_until(presses, [](const DeviceSample& s) { return s.fault != DeviceFault::none; }));
        EXPECT_TRUE(dhd.ticks_until(presses, [&](const DeviceSample&) { return running->written_N() == Vec3(0.0); }));
        without_force += running->written_N() == Vec3(0.0) ? 1 : 0;
        running->fall_silent(false);
        ASSERT_TRUE(dhd.is_well()) << drill << ": it is found again";
    }
    EXPECT_EQ(without_force, kDrills);
    const std::string said = dhd.messages();
    EXPECT_TRUE(said.contains("is gone: communication error (2); see that its cable")) << said;
    EXPECT_TRUE(said.contains("is there again")) << said;
}

// A library that fails from a turn on, whatever is asked of it, and keeps what was written.
struct FailingDhd {
    static inline int turns_left = 0;
    static inline Vec3 last_written_N{0.0};

    static DhdApi api() {
        DhdApi made;
        made.device_count = [] { return 1; };
        made.open_by_index = [](char) { return 0; };
        made.close = [](char) { return 0; };
        made.enable_force = [](unsigned char, char) { return 0; };
        made.system_type = [](char) { return kDhdOmega3; };
        made.status = [](int* status, char) {
            status[kDhdStatusForce] = 1;
            return turns_left > 0 ? 0 : -1;
        };
        made.buttons = [](char) { return 0u; };
        made.read_pose = [](double* x, double* y, double* z, double(*turn)[3], char) {
            *x = *y = *z = 0.0;
            for (int row = 0; row < 3; ++row)
                for (int column = 0; column < 3; ++column) turn[row][column] = row == column ? 1.0 : 0.0;
            return --turns_left > 0 ? 0 : -1;
        };
        made.write_force = [](double x, double y, double z, double, double, double, double, char) {
            last_written_N = {x, y, z};
            return turns_left > 0 ? 0 : -1;
        };
        made.last_error = [] { return kDhdCommunication; };
        made.error_text = [](int) { return "communication error"; };
        return made;
    }
};

TEST(Dhd, TriesZeroLastWhereverItFailsInAHundredOfAHundred) {
    int zero = 0;
    for (int fails_after = 3; fails_after < 103; ++fails_after) {
        FailingDhd::turns_left = fails_after;
        DhdLine line("dhd", FailingDhd::api(), {});
        ASSERT_TRUE(line.open());
        ServedState state;
        bool is_there = true;
        // As LineServo turns it: with force while it is well, and once with none when it is not.
        for (int i = 0; i < 300 && is_there; ++i) is_there = line.turn({Vec3(0.5, 1.0, 2.0), Vec3(0.0)}, state);
        EXPECT_FALSE(is_there);
        EXPECT_EQ(FailingDhd::last_written_N, Vec3(2.0, 0.5, 1.0)) << "it was pressing";
        static_cast<void>(line.turn({}, state));
        line.close();
        zero += FailingDhd::last_written_N == Vec3(0.0) ? 1 : 0;
    }
    EXPECT_EQ(zero, 100);
}

TEST(Dhd, AHapticThreadThatStandsStillIsNoForce) {
    RunningDhd running(own_dhd());
    TickedArm dhd("dhd:" + own_dhd());
    ASSERT_TRUE(dhd.is_well());
    const Vec3 presses(1.0, 0.0, 0.0);
    ASSERT_TRUE(dhd.ticks_until(presses, [&](const DeviceSample&) { return running->written_N() == presses; }));
    for (int i = 0; i < 2000 && running->written_N() != Vec3(0.0); ++i)
        dhd.clock().sleep_until(dhd.clock().now_ns() + 1'000'000);
    EXPECT_EQ(running->written_N(), Vec3(0.0));
}

TEST(Dhd, APoseThatIsNoneAndAForceThatIsOffTakeTheForceAndSayWhy) {
    RunningDhd running(own_dhd());
    TickedArm dhd("dhd:" + own_dhd());
    ASSERT_TRUE(dhd.is_well());
    const Vec3 presses(0.0, 1.0, 0.0);
    const auto loses_force_by = [&](DeviceFault fault) {
        EXPECT_TRUE(dhd.ticks_until(presses, [&](const DeviceSample& s) { return s.fault == fault; }));
        EXPECT_TRUE(dhd.ticks_until(presses, [&](const DeviceSample&) { return running->written_N() == Vec3(0.0); }));
        EXPECT_TRUE(finite(dhd.tick(presses).position_device_m)) << "what a tick sees is a number";
    };
    running->lose_its_pose(true);
    loses_force_by(DeviceFault::other);
    running->lose_its_pose(false);
    ASSERT_TRUE(dhd.is_well());
    running->switch_force_off(kDhdOffByVelocity);
    loses_force_by(DeviceFault::overspeed);
    running->switch_force_off(kDhdOffByDeadMan);
    loses_force_by(DeviceFault::other);
    running->switch_force_off(0);
    ASSERT_TRUE(dhd.is_well());
    running->need_reset(true);
    loses_force_by(DeviceFault::other);
    running->need_reset(false);
    ASSERT_TRUE(dhd.is_well());
    EXPECT_TRUE(dhd.ticks_until(presses, [&](const DeviceSample&) { return running->written_N() == presses; }));
    const std::string said = dhd.messages();
    for (const char* words : {"reads a pose that is none", "since it was moved too fast; press the force button",
                              "since its handle is not held", "gives force again", "does not know where its handle is"})
        EXPECT_TRUE(said.contains(words)) << words << "\n" << said;
}

TEST(Dhd, TwoOfThemEachHaveTheirOwnForceAndFault) {
    RunningDhd right(own_dhd("-r"), dhd_stands_at({0.01, 0.0, 0.0})),
        left(own_dhd("-l"), dhd_stands_at({-0.01, 0.0, 0.0}));
    TickedArm first("dhd:" + own_dhd("-r")), second("dhd:" + own_dhd("-l"));
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

TEST(Dhd, ItsEndLeavesNoForceAndGivesItBack) {
    RunningDhd running(own_dhd());
    const Vec3 presses(0.0, 1.0, 0.0);
    {
        TickedArm dhd("dhd:" + own_dhd());
        ASSERT_TRUE(dhd.is_well());
        ASSERT_TRUE(dhd.ticks_until(presses, [&](const DeviceSample&) { return running->written_N() == presses; }));
        const std::string twice = "dhd:" + own_dhd() + ": is the device that another hand of this session has opened";
        EXPECT_TRUE(refused_dhd(own_dhd()).contains(twice)) << refused_dhd(own_dhd());
        EXPECT_TRUE(dhd.ticks_until(presses, [&](const DeviceSample&) { return running->written_N() == presses; }))
            << "which is left alone";
    }
    EXPECT_EQ(running->written_N(), Vec3(0.0));
    EXPECT_TRUE(TickedArm("dhd:" + own_dhd()).is_well());
}

TEST(Dhd, SaysWhatIsWrongWithALibraryAndADevice) {
    EXPECT_TRUE(refused_dhd("@/no/such/libdhd.so").contains("the library /no/such/libdhd.so cannot be loaded"));
    EXPECT_TRUE(refused_dhd("@/no/such/libdhd.so").contains("burin devices emulate dhd"));
    EXPECT_TRUE(refused_dhd("0@libc.so.6").contains("has no function dhdGetSDKVersion")) << refused_dhd("0@libc.so.6");
    const std::string lacking = refused_dhd("@" + library_beside("libburin_emulated_dhd_lacking.so"));
    EXPECT_TRUE(lacking.contains("has no function dhdGetButtonMask")) << lacking;
    const std::string other = refused_dhd("@" + library_beside("libburin_emulated_dhd_4.so"));
    EXPECT_TRUE(other.contains("is version 4.17.0 of the Force Dimension SDK, and Burin knows version 3")) << other;
    const std::string none = refused_dhd("9@" + library_beside(kEmulatedDhdLibrary));
    EXPECT_TRUE(none.contains("haptic device dhd:9: cannot be opened: no device found (5); the library sees")) << none;
    EXPECT_TRUE(refused_dhd("-1").contains("names no device"));
    EXPECT_TRUE(refused_dhd("one").contains("names no device"));
    EXPECT_TRUE(refused_dhd(own_dhd("-none")).contains("burin devices emulate dhd --at " + own_dhd("-none")));
    EXPECT_FALSE(EmulatedDhd::create("omega"));
    EXPECT_FALSE(EmulatedDhd::create("emulated/../x"));
    SimulatedClock simulated;
    const auto opened = open_haptic_device("dhd", {simulated, nobodys_hand()});
    ASSERT_FALSE(opened);
    EXPECT_TRUE(opened.error().line().contains("time is simulated"));
    EXPECT_TRUE(open_haptic_device("dhd:whatever", {simulated, nobodys_hand(), true}))
        << "a recording is done again without one";
}

TEST(Dhd, IsListedWithItsCauseAndWhileItIsEmulated) {
    const auto names_it = [](const std::string& name) {
        for (const DevicePresence& one : look_for_dhds())
            if (one.name == "dhd:" + name) return one.presence == Presence::there;
        return false;
    };
    EXPECT_FALSE(names_it(own_dhd()));
    {
        RunningDhd running(own_dhd());
        EXPECT_TRUE(tried([&] { return names_it(own_dhd()); }));
    }
    EXPECT_FALSE(names_it(own_dhd()));
    EXPECT_EQ(look_for_dhds().front().name.substr(0, 3), "dhd");
    EXPECT_FALSE(look_for_dhds().front().cause.empty());
}

}  // namespace burin::devices
