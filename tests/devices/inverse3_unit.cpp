// SPDX-License-Identifier: MIT
// A Haply Inverse3 from end to end: the real driver, and an emulated service behind a websocket of this machine.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "devices/emulators/emulated_inverse3.hpp"
#include "devices/haply/inverse3_device.hpp"
#include "devices/registry/device_registry.hpp"
#include "tests/devices/ticked_arm.hpp"

namespace burin::devices {
namespace {

std::string own_inverse3() { return "emulated-test-" + std::to_string(::getpid()); }

// An emulated service that runs while it lives.
class RunningInverse3 {
public:
    explicit RunningInverse3(EmulatedInverse3Options options = {}) : inverse3_(made(std::move(options))) {
        thread_ = std::thread([this] { inverse3_.run([this] { return ends_.load(); }); });
    }
    ~RunningInverse3() {
        ends_ = true;
        thread_.join();
    }
    [[nodiscard]] EmulatedInverse3* operator->() { return &inverse3_; }

private:
    static EmulatedInverse3 made(EmulatedInverse3Options options) {
        if (options.script.empty()) options.script = {{0.0, Vec3(0.0), {1.0, 0.0, 0.0, 0.0}, 0}};
        return EmulatedInverse3::create(own_inverse3(), std::move(options)).value();
    }
    EmulatedInverse3 inverse3_;
    std::atomic<bool> ends_ = false;
    std::thread thread_;
};

std::string refused_inverse3(const std::string& choice) {
    MonotonicClock clock;
    const auto opened = open_haptic_device("inverse3:" + choice, {clock, nobodys_hand()});
    return opened ? "nothing" : opened.error().line();
}

const Vec3 kPresses_N(0.0, 0.0, 2.0);

}  // namespace

TEST(Inverse3, ReadsPlaceTurnAndButtonsInTheDeviceFrame) {
    const Quat turned = glm::angleAxis(0.4, glm::normalize(Vec3(0.2, 0.9, -0.3)));
    const Vec3 place(0.021, -0.013, 0.011);
    for (const HaplyHandle handle : {HaplyHandle::wireless, HaplyHandle::with_cable, HaplyHandle::none}) {
        RunningInverse3 running({.script = {{0.0, place, turned, 3}}, .handle = handle, .greeting = {}});
        TickedArm inverse3("inverse3:" + own_inverse3());
        ASSERT_TRUE(inverse3.is_well());
        DeviceSample sample;
        EXPECT_TRUE(inverse3.ticks_until(Vec3(0.0), [&](const DeviceSample& s) {
            sample = s;
            return glm::distance(s.position_device_m, place) < 0.0002;
        })) << sample.position_device_m.x;
        const Quat expected = handle == HaplyHandle::none ? Quat(1.0, 0.0, 0.0, 0.0) : turned;
        EXPECT_GT(std::abs(glm::dot(sample.orientation_device, expected)), 1.0 - 1e-7);
        EXPECT_EQ(sample.buttons, handle == HaplyHandle::wireless ? 3u : handle == HaplyHandle::with_cable ? 1u : 0u);
    }
}

TEST(Inverse3, GivesItsForceToServicesOfBothVersionsAndNeverMoreThanItsMost) {
    for (const HaplyVersion version : {HaplyVersion::v3_1, HaplyVersion::v3_5}) {
        RunningInverse3 running({.script = {}, .version = version, .greeting = {}});
        TickedArm inverse3("inverse3:" + own_inverse3());
        ASSERT_TRUE(inverse3.is_well());
        for (const Vec3& way : {Vec3(1.0, 0.0, 0.0), Vec3(0.0, 1.0, 0.0), Vec3(0.0, 0.0, -1.0)}) {
            EXPECT_TRUE(inverse3.ticks_until(way,
                                             [&](const DeviceSample& s) {
                                                 return running->written_N() == way &&
                                                        glm::dot(s.position_device_m, way) > 0.003;
                                             }))
                << way.x << way.y << way.z;
        }
        EXPECT_TRUE(inverse3.ticks_until(Vec3(0.0, 80.0, 0.0),
                                         [&](const DeviceSample&) { return running->written_N().y > 4.9; }));
        EXPECT_LE(glm::length(running->written_N()), 5.0 + 1e-12);
        EXPECT_EQ(running->refused(), 0u) << "each message has a force under the name that the version takes";
    }
}

TEST(Inverse3, MeasuresItsRateAndTheAgeOfItsSamplesAndTellsThem) {
    RunningInverse3 running;
    TickedArm inverse3("inverse3:" + own_inverse3());
    std::string said;
    EXPECT_TRUE(inverse3.ticks_until(
        Vec3(0.0),
        [&](const DeviceSample&) {
            said += inverse3.messages();
            return said.contains("states and forces a second") && said.contains("us, from a force until its answer");
        },
        20'000))
        << said;
    std::printf("%s", said.c_str());
}

TEST(Inverse3, EveryLieIsAnsweredByNoForceAtOnceAndTold) {
    const std::string begin = R"({"inverse3":[{"device_id":"049D","state":{"cursor_position":)";
    const std::string turned = R"({"x":0,"y":-0.13,"z":0.16}}}],"wireless_verse_grip":[{"state":{"orientation":)";
    const std::vector<std::string> lies{
        "no JSON",
        "{}",
        R"({"inverse3":7})",
        R"({"inverse3":[]})",
        R"({"inverse3":[{"device_id":"049E","state":{"cursor_position":{"x":0,"y":0,"z":0}}}]})",
        begin + R"({"x":NaN,"y":0,"z":0}}}]})",
        begin + R"({"x":1e999,"y":0,"z":0}}}]})",
        begin + R"({"x":"0","y":0,"z":0}}}]})",
        begin + R"({"x":null,"y":0,"z":0}}}]})",
        begin + R"({"x":0,"y":0}}}]})",
        begin + "[0,0,0]}}]}",
        begin + turned + R"({"w":0,"x":0,"y":0,"z":0}}}]})",
        begin + turned + R"({"w":1,"x":0,"y":0}}}]})",
        std::string(100'000, '['),
        R"({"inverse3":[{"device_id":"049D","state":{"cursor_position":{"x":0,"y":-0.13,"z":0.16}},)"
        R"("status":{"calibrated":false,"power_supply":true}}]})",
        R"({"inverse3":[{"device_id":"049D","state":{"cursor_position":{"x":0,"y":-0.13,"z":0.16}},)"
        R"("status":{"calibrated":true,"power_supply":false}}]})",
    };
    RunningInverse3 running;
    TickedArm inverse3("inverse3:" + own_inverse3());
    int drills = 0, without_force = 0;
    for (const std::string& lie : lies) {
        ++drills;
        ASSERT_TRUE(inverse3.ticks_until(kPresses_N, [&](const DeviceSample& s) {
            return s.fault == DeviceFault::none && running->written_N() == kPresses_N;
        })) << lie.substr(0, 80);
        running->say(lie);
        ASSERT_TRUE(inverse3.ticks_until(kPresses_N, [&](const DeviceSample& s) {
            return s.fault != DeviceFault::none && running->lies() > 5;
        })) << lie.substr(0, 80);
        without_force += running->pushes_after_lie() == 0 && running->written_N() == Vec3(0.0) ? 1 : 0;
        running->say("");
    }
    EXPECT_EQ(without_force, drills) << "of each lie: no message after it pushed";
    ASSERT_TRUE(inverse3.is_well());
    const std::string said = inverse3.messages();
    for (const char* const words : {"has a state that is none", "is no longer among its service's devices",
                                    "is not calibrated", "has no power: plug its power supply in", "gives force again"})
        EXPECT_TRUE(said.contains(words)) << words << "\n" << said;
    std::printf("no force within a turn of %d lies in %d of %d\n", drills, without_force, drills);
}

TEST(Inverse3, AServiceThatDiesIsLeftWithoutForceAndMetAgain) {
    RunningInverse3 running;
    TickedArm inverse3("inverse3:" + own_inverse3());
    for (int drill = 0; drill < 2; ++drill) {
        ASSERT_TRUE(inverse3.ticks_until(kPresses_N, [&](const DeviceSample& s) {
            return s.fault == DeviceFault::none && running->written_N() == kPresses_N;
        })) << drill;
        running->fall_silent(true);
        ASSERT_TRUE(inverse3.ticks_until(kPresses_N,
                                         [](const DeviceSample& s) { return s.fault == DeviceFault::disconnected; }));
        running->fall_silent(false);
        const auto before = running->messages();
        ASSERT_TRUE(inverse3.ticks_until(kPresses_N, [&](const DeviceSample&) { return running->messages() > before; }))
            << drill << ": it is met again";
    }
    const std::string said = inverse3.messages();
    EXPECT_TRUE(said.contains("is gone: its service does not answer")) << said;
    EXPECT_TRUE(said.contains("is there again")) << said;
}

TEST(Inverse3, AServiceThatIsLateIsGivenZeroAndNotBuried) {
    RunningInverse3 running;
    TickedArm inverse3("inverse3:" + own_inverse3());
    ASSERT_TRUE(inverse3.ticks_until(kPresses_N, [&](const DeviceSample& s) {
        return s.fault == DeviceFault::none && running->written_N() == kPresses_N;
    }));
    running->answer_late_by(0.2);
    ASSERT_TRUE(inverse3.ticks_until(kPresses_N, [](const DeviceSample& s) { return s.fault != DeviceFault::none; }));
    ASSERT_TRUE(
        inverse3.ticks_until(kPresses_N, [&](const DeviceSample&) { return running->written_N() == Vec3(0.0); }));
    // Each late answer is waited for: no more than one further message goes out while one is owed.
    const auto before = running->messages();
    for (int tick = 0; tick < 400; ++tick) {
        static_cast<void>(inverse3.tick(kPresses_N));
        ASSERT_EQ(running->written_N(), Vec3(0.0)) << tick;
    }
    EXPECT_LT(running->messages() - before, 100u);
    running->answer_late_by(0.0);
    ASSERT_TRUE(inverse3.is_well());
    const std::string said = inverse3.messages();
    EXPECT_TRUE(said.contains("is answered too late by its service")) << said;
    EXPECT_FALSE(said.contains("is gone")) << said;
}

TEST(Inverse3, ItsEndLeavesNoForce) {
    RunningInverse3 running;
    {
        TickedArm inverse3("inverse3:" + own_inverse3());
        ASSERT_TRUE(
            inverse3.ticks_until(kPresses_N, [&](const DeviceSample&) { return running->written_N() == kPresses_N; }));
    }
    EXPECT_TRUE(tried([&] { return running->written_N() == Vec3(0.0); }));
    TickedArm again("inverse3:" + own_inverse3());
    EXPECT_TRUE(again.is_well());
}

TEST(Inverse3, IsFoundByItsNumberAndServiceAndRefusedWithReasons) {
    {
        RunningInverse3 running({.script = {}, .greeting = {}});
        const std::string at = running->service().text();
        for (const std::string& choice : {at, "049D@" + at}) {
            TickedArm inverse3("inverse3:" + choice);
            EXPECT_TRUE(inverse3.is_well()) << choice;
        }
        std::string said = refused_inverse3("0001@" + at);
        EXPECT_TRUE(said.contains("write one of those that there are: 049D")) << said;
        const auto found = look_for_inverse3s(running->service());
        ASSERT_GE(found.size(), 2u);
        EXPECT_EQ(found[0].presence, Presence::there);
        EXPECT_EQ(found[0].name, "inverse3:049D@" + at);
        // Anywhere among the emulated ones: other programs may run some of their own.
        EXPECT_EQ(std::ranges::count(found, "inverse3:" + own_inverse3(), &DevicePresence::name), 1);
        running->set_power(false);
        EXPECT_EQ(look_for_inverse3s(running->service())[0].presence, Presence::unusable);
        running->set_power(true);
        running->unplug(true);
        EXPECT_EQ(look_for_inverse3s(running->service())[0].presence, Presence::absent);
        said = refused_inverse3(at);
        EXPECT_TRUE(said.contains("the service sees no Inverse3")) << said;
    }
    EXPECT_TRUE(refused_inverse3(own_inverse3()).contains("no emulator runs by this name"));
    EXPECT_TRUE(refused_inverse3("a:b:c").contains("names neither a device nor a service"));
    const auto absent = look_for_inverse3s({"127.0.0.1", 1});
    EXPECT_EQ(absent[0].presence, Presence::absent);
    EXPECT_TRUE(absent[0].cause.contains("no service of Haply's answers")) << absent[0].cause;
}

TEST(Inverse3, AServiceThatSpeaksAnotherLanguageOrNoneIsRefused) {
    for (const char* const greeting : {"hello", "{}", R"({"devices":[]})", "[]"}) {
        RunningInverse3 running({.script = {}, .greeting = greeting});
        const std::string said = refused_inverse3(own_inverse3());
        EXPECT_TRUE(said.contains("speaks another language")) << said;
        EXPECT_EQ(look_for_inverse3s(running->service())[0].presence, Presence::unusable);
        EXPECT_EQ(running->messages(), 0u) << "nothing was asked of it";
    }
    // It is asked, and then answers.
    RunningInverse3 quiet({.script = {}, .greeting = {}, .greets = false});
    TickedArm inverse3("inverse3:" + own_inverse3());
    EXPECT_TRUE(inverse3.is_well());
}

// Longer than any state: the connection ends.
TEST(Inverse3, AMessageWithoutEndIsNotKept) {
    RunningInverse3 running;
    TickedArm inverse3("inverse3:" + own_inverse3());
    ASSERT_TRUE(inverse3.is_well());
    running->say(std::string(1'000'000, ' '));
    ASSERT_TRUE(
        inverse3.ticks_until(kPresses_N, [](const DeviceSample& s) { return s.fault == DeviceFault::disconnected; }));
    EXPECT_EQ(running->pushes_after_lie(), 0u);
    running->say("");
    EXPECT_TRUE(inverse3.is_well());
}

}  // namespace burin::devices
