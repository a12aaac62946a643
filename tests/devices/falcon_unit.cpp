// SPDX-License-Identifier: MIT
// A Novint Falcon from end to end: the real driver, and an emulated device that speaks its bytes from the boot loader
// on.
#include "devices/falcon/falcon_device.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <thread>

#include "devices/emulators/emulated_falcon.hpp"
#include "devices/falcon/falcon_line.hpp"
#include "devices/registry/device_registry.hpp"
#include "tests/devices/ticked_arm.hpp"

namespace burin::devices {
namespace {

// Names of this process's own, so that tests beside it and a user's emulators are not met.
std::string own_falcon(const std::string& number = "") {
    return "emulated-test-" + std::to_string(::getpid()) + number;
}

std::vector<HandPose> falcon_stands_at(const Vec3& place_device_m, std::uint32_t buttons = 0) {
    return {{0.0, place_device_m, {1.0, 0.0, 0.0, 0.0}, buttons}};
}

// An emulated Falcon that runs while it lives.
class RunningFalcon {
public:
    explicit RunningFalcon(const std::string& name,
                           EmulatedFalconOptions options = {.script = falcon_stands_at(Vec3(0.0)), .silence = {}})
        : falcon_(EmulatedFalcon::create(name, std::move(options)).value()) {
        thread_ = std::thread([this] { falcon_.run([this] { return ends_.load(); }); });
    }
    ~RunningFalcon() {
        ends_ = true;
        thread_.join();
    }
    [[nodiscard]] EmulatedFalcon& operator*() { return falcon_; }
    [[nodiscard]] EmulatedFalcon* operator->() { return &falcon_; }

private:
    EmulatedFalcon falcon_;
    std::atomic<bool> ends_ = false;
    std::thread thread_;
};

// A file of so many bytes, while it lives.
class FirmwareFile {
public:
    explicit FirmwareFile(std::size_t bytes, const std::string& name = "firmware")
        : path_((std::filesystem::temp_directory_path() /
                 ("burin-" + name + "-" + std::to_string(::getpid()) + "-" + std::to_string(bytes)))
                    .string()) {
        std::ofstream file(path_, std::ios::binary);
        for (std::size_t i = 0; i < bytes; ++i) file.put(static_cast<char>(i * 7 % 251));
    }
    ~FirmwareFile() {
        std::error_code ignored;
        std::filesystem::remove(path_, ignored);
    }
    [[nodiscard]] const std::string& path() const { return path_; }

private:
    std::string path_;
};

bool is_zero(const FalconCounts& counts) { return counts == FalconCounts{}; }

std::string refused_falcon(const std::string& choice) {
    MonotonicClock clock;
    const auto opened = open_haptic_device("falcon:" + choice, {clock, nobodys_hand()});
    return opened ? "nothing" : opened.error().line();
}

}  // namespace

TEST(Falcon, ReadsItsPlaceAndButtonsInTheDeviceFrame) {
    const Vec3 place(0.021, -0.013, 0.017);
    RunningFalcon running(own_falcon(), {.script = falcon_stands_at(place, 5), .silence = {}});
    TickedArm falcon("falcon:" + own_falcon());
    const DeviceDescription& description = falcon.opened().parts[0].device->description();
    EXPECT_EQ(description.workspace_m, Vec3(0.1016));
    EXPECT_TRUE(description.felt_by_person);
    EXPECT_GT(description.resolution_m, 0.00004) << "a step of one encoder is 0.038 mm";
    EXPECT_LT(description.resolution_m, 0.0003);
    ASSERT_TRUE(falcon.is_well());
    DeviceSample sample;
    EXPECT_TRUE(falcon.ticks_until(Vec3(0.0), [&](const DeviceSample& s) {
        sample = s;
        return glm::distance(s.position_device_m, place) < description.resolution_m;
    })) << sample.position_device_m.x;
    EXPECT_EQ(sample.buttons, 5u);
}

TEST(Falcon, GivesItsForceAndSeesTheHandGiveWay) {
    RunningFalcon running(own_falcon());
    TickedArm falcon("falcon:" + own_falcon());
    ASSERT_TRUE(falcon.is_well());
    for (const Vec3& way : {Vec3(1.0, 0.0, 0.0), Vec3(0.0, 1.0, 0.0), Vec3(0.0, 0.0, -1.0)}) {
        // The hand's 200 N/m give way by 5 mm to a newton, less the arm's friction.
        DeviceSample sample;
        EXPECT_TRUE(falcon.ticks_until(way,
                                       [&](const DeviceSample& s) {
                                           sample = s;
                                           return glm::dot(s.position_device_m, way) > 0.0035;
                                       }))
            << way.x << way.y << way.z;
        EXPECT_LT(glm::distance(running->written_N(), way), 0.02) << "to a count of the motors' commands";
        EXPECT_LT(glm::dot(sample.position_device_m, way), 0.0065);
    }
    EXPECT_EQ(running->lamps(), kFalconBlue);
    // More than its motors give: the force keeps its direction.
    ASSERT_TRUE(
        falcon.ticks_until(Vec3(0.0, 80.0, 0.0), [&](const DeviceSample&) { return running->written_N().y > 5.0; }));
    const FalconCounts most = running->written();
    for (const std::int16_t count : most) EXPECT_LE(std::abs(count), kFalconMostCommand);
    EXPECT_LT(glm::length(glm::cross(running->written_N(), Vec3(0.0, 1.0, 0.0))), 0.2);
}

TEST(Falcon, UnpluggedWhilePressingIsLeftWithoutForceEveryTime) {
    RunningFalcon running(own_falcon());
    TickedArm falcon("falcon:" + own_falcon());
    ASSERT_TRUE(falcon.is_well());
    const Vec3 presses(0.0, 0.0, 2.0);
    constexpr int kDrills = 4;  // each takes more than a second; in told time: AfterAFault
    int without_force = 0;
    for (int drill = 0; drill < kDrills; ++drill) {
        ASSERT_TRUE(falcon.ticks_until(presses, [&](const DeviceSample& s) {
            return s.fault == DeviceFault::none && !is_zero(running->written());
        })) << drill;
        if (drill % 2 == 0)
            running->fall_silent(true);
        else
            running->pull_cable(true);
        // The session goes on pressing, as a tick would that has not seen the fault.
        ASSERT_TRUE(
            falcon.ticks_until(presses, [](const DeviceSample& s) { return s.fault == DeviceFault::disconnected; }));
        // Of a cable that was pulled nothing more can be written to the device, which then has no force of its own.
        if (drill % 2 == 0) {
            EXPECT_TRUE(falcon.ticks_until(presses, [&](const DeviceSample&) { return is_zero(running->written()); }));
        }
        running->fall_silent(false);
        running->pull_cable(false);
        ASSERT_TRUE(falcon.is_well()) << drill << ": it is found again";
        without_force += drill % 2 == 1 || is_zero(running->written()) ? 1 : 0;
    }
    EXPECT_EQ(without_force, kDrills);
    const std::string said = falcon.messages();
    EXPECT_TRUE(said.contains("is gone: see that its cable and its power are plugged in")) << said;
    EXPECT_TRUE(said.contains("is there again")) << said;
}

// A cable that says how it goes: the driver's code is the real one, and what it writes is kept.
class LoggedPort final : public FalconPort {
public:
    struct Log {
        std::atomic<int> fails_after = -1;  // exchanges; then the cable is pulled
        FalconCounts last_written{};        // also what a pulled cable no longer carries
        int exchanges = 0;
    };
    explicit LoggedPort(Log& log) : log_(log) {}
    Cable request(FtdiRequest, std::uint16_t) noexcept override { return is_pulled() ? Cable::pulled : Cable::well; }
    Cable write(std::span<const std::byte> bytes, Nanoseconds) noexcept override {
        FalconBytes packet{};
        std::ranges::copy(bytes.first(std::min(bytes.size(), packet.size())), packet.begin());
        if (const auto command = falcon_command(packet)) log_.last_written = command->motors;
        return is_pulled() ? Cable::pulled : Cable::well;
    }
    Cable read(std::span<std::byte, kFtdiPiece> piece, std::size_t& count, Nanoseconds) noexcept override {
        ++log_.exchanges;
        if (is_pulled()) return Cable::pulled;
        const FalconBytes bytes =
            falcon_bytes(FalconReport{.encoders = falcon_encoders(*falcon_inverse(kFalconMiddle_m)), .homed = 7});
        std::ranges::copy(bytes, piece.begin() + kFtdiOwn);
        count = kFtdiOwn + bytes.size();
        return Cable::well;
    }

private:
    [[nodiscard]] bool is_pulled() const { return log_.fails_after >= 0 && log_.exchanges > log_.fails_after; }
    Log& log_;
};

TEST(Falcon, TriesZeroLastWhereverItsCableIsPulledInAHundredOfAHundred) {
    int zero = 0, pressed = 0;
    for (int pulled_after = 5; pulled_after < 105; ++pulled_after) {
        LoggedPort::Log log;
        FalconLine line("falcon",
                        [&]() -> Result<std::unique_ptr<FalconPort>> { return std::make_unique<LoggedPort>(log); }, {});
        ASSERT_TRUE(line.open());
        log.fails_after = pulled_after;
        ServedState state;
        bool is_there = true;
        FalconCounts before{};
        // As LineServo turns it: with force while it is well, and once with none when it is not.
        for (int i = 0; i < 300 && is_there; ++i) {
            before = log.last_written;
            is_there = line.turn({Vec3(0.5, 1.0, 2.0), Vec3(0.0)}, state);
        }
        pressed += is_zero(before) ? 0 : 1;
        EXPECT_FALSE(is_there);
        static_cast<void>(line.turn({}, state));
        line.close();
        zero += is_zero(log.last_written) ? 1 : 0;
    }
    EXPECT_EQ(zero, 100);
    EXPECT_EQ(pressed, 100) << "it was pressing when it was pulled";
}

TEST(Falcon, AHapticThreadThatStandsStillIsNoForce) {
    RunningFalcon running(own_falcon());
    TickedArm falcon("falcon:" + own_falcon());
    ASSERT_TRUE(falcon.is_well());
    const Vec3 presses(1.0, 0.0, 0.0);
    ASSERT_TRUE(falcon.ticks_until(presses, [&](const DeviceSample&) { return !is_zero(running->written()); }));
    for (int i = 0; i < 2000 && !is_zero(running->written()); ++i)
        falcon.clock().sleep_until(falcon.clock().now_ns() + 1'000'000);
    EXPECT_TRUE(is_zero(running->written()));
}

TEST(Falcon, AnglesThatItsLegsCannotHaveAndALostHomeTakeTheForce) {
    RunningFalcon running(own_falcon());
    TickedArm falcon("falcon:" + own_falcon());
    ASSERT_TRUE(falcon.is_well());
    const Vec3 presses(0.0, 1.0, 0.0);
    const auto loses_force = [&] {
        EXPECT_TRUE(falcon.ticks_until(presses, [](const DeviceSample& s) { return s.fault == DeviceFault::other; }));
        EXPECT_TRUE(falcon.ticks_until(presses, [&](const DeviceSample&) { return is_zero(running->written()); }));
        EXPECT_TRUE(finite(falcon.tick(presses).position_device_m)) << "what a tick sees is a number";
    };
    const auto presses_again = [&] {
        ASSERT_TRUE(falcon.is_well());
        EXPECT_TRUE(falcon.ticks_until(presses, [&](const DeviceSample&) { return !is_zero(running->written()); }));
    };
    presses_again();
    running->lose_its_pose(true);
    loses_force();
    running->lose_its_pose(false);
    presses_again();
    running->home(false);
    loses_force();
    EXPECT_EQ(running->lamps(), kFalconRed);
    running->home(true);
    presses_again();
    const std::string said = falcon.messages();
    EXPECT_TRUE(said.contains("reads angles that its legs cannot have")) << said;
    EXPECT_TRUE(said.contains("pull the grip all the way out, then push it in")) << said;
    EXPECT_TRUE(said.contains("is homed")) << said;
}

TEST(Falcon, RubbishBetweenPacketsIsLeftOut) {
    RunningFalcon running(own_falcon());
    running->babble(5);
    TickedArm falcon("falcon:" + own_falcon());
    ASSERT_TRUE(falcon.is_well());
    // Of the ticks that a busy machine leaves it in a row, a hundred are without a fault and with its force.
    int well = 0;
    EXPECT_TRUE(falcon.ticks_until(Vec3(0.0, 1.0, 0.0), [&](const DeviceSample& s) {
        well = s.fault == DeviceFault::none && !is_zero(running->written()) ? well + 1 : 0;
        return well == 100;
    })) << well;
}

TEST(Falcon, IsGivenItsFirmwareFromTheFileThatTheUserNames) {
    const FirmwareFile firmware(kNovintFirmware);
    RunningFalcon running(
        own_falcon(),
        {.script = falcon_stands_at(Vec3(0.01, 0.0, 0.0)), .silence = {}, .has_firmware = false, .is_homed = false});
    EXPECT_TRUE(refused_falcon(own_falcon()).contains("has no firmware yet, as after it is switched on"))
        << refused_falcon(own_falcon());
    EXPECT_TRUE(refused_falcon(own_falcon()).contains("name a firmware file"));
    EXPECT_EQ(running->firmware_loads(), 0);
    TickedArm falcon("falcon:" + own_falcon() + "@" + firmware.path());
    EXPECT_EQ(running->firmware_loads(), 1);
    EXPECT_TRUE(
        falcon.ticks_until(Vec3(0.0, 1.0, 0.0), [](const DeviceSample& s) { return s.fault == DeviceFault::other; }));
    EXPECT_TRUE(is_zero(running->written())) << "it is not homed";
    running->home(true);
    ASSERT_TRUE(falcon.is_well());
    // Its power is gone for a moment: it needs both again, and gets the firmware by itself.
    running->pull_cable(true);
    ASSERT_TRUE(
        falcon.ticks_until(Vec3(0.0), [](const DeviceSample& s) { return s.fault == DeviceFault::disconnected; }));
    running->pull_cable(false);
    EXPECT_TRUE(falcon.ticks_until(Vec3(0.0), [&](const DeviceSample&) { return running->firmware_loads() == 2; }));
    running->home(true);
    EXPECT_TRUE(falcon.is_well());
}

TEST(Falcon, IsFoundAtTheTenthLoadOfItsFirmwareAndNotAtTheEleventh) {
    const FirmwareFile firmware(kNventFirmware);
    for (const int bad : {0, 1, 2, 9, 10}) {
        const std::string name = own_falcon("-bad-" + std::to_string(bad));
        RunningFalcon running(name, {.script = falcon_stands_at(Vec3(0.0)),
                                     .silence = {},
                                     .has_firmware = false,
                                     .is_homed = true,
                                     .bad_loads = bad});
        FalconLine line(
            "falcon", [&] { return open_emulated_falcon(name); }, read_falcon_firmware(firmware.path()).value());
        const auto opened = line.open();
        EXPECT_EQ(opened.has_value(), bad < 10) << bad << (opened ? "" : opened.error().line());
        EXPECT_EQ(running->firmware_loads(), bad < 10 ? 1 : 0) << bad;
        const std::string said = line.words_for(line.notice());
        EXPECT_EQ(said.contains("which it was given " + std::to_string(bad + 1) + " times"), bad > 0 && bad < 10)
            << bad << said;
        EXPECT_TRUE(opened || opened.error().line().contains("10 times in a row"));
        line.close();
    }
}

TEST(Falcon, RefusesAFirmwareFileThatIsNone) {
    const FirmwareFile small(100), empty(0);
    RunningFalcon running(own_falcon(), {.script = {}, .silence = {}, .has_firmware = false});
    EXPECT_TRUE(
        refused_falcon(own_falcon() + "@" + small.path()).contains("has 100 bytes, as no firmware of a Falcon has"))
        << refused_falcon(own_falcon() + "@" + small.path());
    EXPECT_TRUE(refused_falcon(own_falcon() + "@" + empty.path()).contains("has 0 bytes"));
    EXPECT_TRUE(refused_falcon(own_falcon() + "@/no/such/file").contains("cannot be read"));
    EXPECT_TRUE(refused_falcon(own_falcon() + "@/").contains("cannot be read"));
    EXPECT_EQ(running->firmware_loads(), 0);
}

TEST(Falcon, TwoOfThemEachHaveTheirOwnForceAndFault) {
    RunningFalcon right(own_falcon("-r"), {.script = falcon_stands_at({0.01, 0.0, 0.0}), .silence = {}}),
        left(own_falcon("-l"), {.script = falcon_stands_at({-0.01, 0.0, 0.0}), .silence = {}});
    TickedArm first("falcon:" + own_falcon("-r")), second("falcon:" + own_falcon("-l"));
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
        return right->written_N().y > 0.9 && left->written_N().y < -0.9 && a.position_device_m.x > 0.005 &&
               b.position_device_m.x < -0.005;
    }));
    left->fall_silent(true);
    EXPECT_TRUE(both_until([&](const DeviceSample&, const DeviceSample& b) {
        return b.fault == DeviceFault::disconnected && is_zero(left->written());
    }));
    EXPECT_TRUE(both_until([&](const DeviceSample& a, const DeviceSample&) {
        return a.fault == DeviceFault::none && right->written_N().y > 0.9;
    })) << "the other goes on";
}

TEST(Falcon, ItsEndLeavesNoForceAndGivesItBack) {
    RunningFalcon running(own_falcon());
    {
        TickedArm falcon("falcon:" + own_falcon());
        ASSERT_TRUE(falcon.is_well());
        ASSERT_TRUE(
            falcon.ticks_until(Vec3(0.0, 1.0, 0.0), [&](const DeviceSample&) { return !is_zero(running->written()); }));
        EXPECT_TRUE(refused_falcon(own_falcon()).contains("is in use by another program"))
            << refused_falcon(own_falcon());
    }
    EXPECT_TRUE(is_zero(running->written()));
    const std::vector<std::string> heard = running->heard();
    ASSERT_FALSE(heard.empty());
    EXPECT_EQ(heard.back().substr(0, 13), "<AAAAAAAAAAAA") << "the last packet has no torque";
    EXPECT_TRUE(TickedArm("falcon:" + own_falcon()).is_well());
}

TEST(Falcon, SaysWhatIsWrong) {
    EXPECT_TRUE(
        refused_falcon(own_falcon("-none")).contains("burin devices emulate falcon --at " + own_falcon("-none")))
        << refused_falcon(own_falcon("-none"));
    const std::string on_usb = refused_falcon("9-9.9.9");
    EXPECT_TRUE(on_usb.contains("falcon") && (on_usb.contains("there is none at this place of USB") ||
                                              on_usb.contains("USB cannot be looked through")))
        << on_usb;
    EXPECT_FALSE(EmulatedFalcon::create("falcon"));
    EXPECT_FALSE(EmulatedFalcon::create("emulated/../x"));
    RunningFalcon running(own_falcon());
    EXPECT_FALSE(EmulatedFalcon::create(own_falcon())) << "there is one of that name";
    SimulatedClock simulated;
    const auto opened = open_haptic_device("falcon", {simulated, nobodys_hand()});
    ASSERT_FALSE(opened);
    EXPECT_TRUE(opened.error().line().contains("time is simulated"));
    const auto again = open_haptic_device("falcon:whatever", {simulated, nobodys_hand(), true});
    ASSERT_TRUE(again) << "a recording is done again without one";
    EXPECT_EQ(again->parts[0].device->description().max_force_N, 8.0);
}

TEST(Falcon, IsListedWithItsCauseAndWhileItIsEmulated) {
    const auto names_it = [](const std::string& name) {
        for (const DevicePresence& one : look_for_falcons())
            if (one.name == "falcon:" + name) return one.presence == Presence::there;
        return false;
    };
    EXPECT_FALSE(names_it(own_falcon()));
    {
        RunningFalcon running(own_falcon());
        EXPECT_TRUE(names_it(own_falcon()));
    }
    EXPECT_FALSE(names_it(own_falcon()));
    EXPECT_TRUE(look_for_falcons().front().name.starts_with("falcon"));
    EXPECT_FALSE(look_for_falcons().front().cause.empty());
}

}  // namespace burin::devices
