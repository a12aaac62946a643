// SPDX-License-Identifier: MIT
// A SpaceMouse from end to end: the real driver, and an emulated device that sends its reports in either layout; and
// the kernel's files of HID devices, here a folder with such files.
#include "devices/spacemouse/spacemouse_device.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <future>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "devices/emulators/emulated_spacemouse.hpp"
#include "devices/presence/emulator_socket.hpp"
#include "devices/spacemouse/spacemouse_line.hpp"
#include "devices/trackers/spacemouse_tracker.hpp"
#include "devices/trackers/tracker_bodies.hpp"
#include "tests/devices/ticked_arm.hpp"
#include "tests/support/test_units.hpp"

namespace burin::devices {
namespace {

std::string own_spacemouse(const std::string& number = "") {
    return "emulated-test-" + std::to_string(::getpid()) + number;
}

// An emulated SpaceMouse that runs while it lives, and whose cap stands as it is told.
class RunningSpaceMouse {
public:
    explicit RunningSpaceMouse(const std::string& name, bool joined = true)
        : spacemouse_(EmulatedSpaceMouse::create(
                          name, {.joined = joined, .script = [this](double) { return standing(); }, .silence = {}})
                          .value()) {
        thread_ = std::thread([this] { spacemouse_.run([this] { return ends_.load(); }); });
    }
    ~RunningSpaceMouse() {
        ends_ = true;
        thread_.join();
    }
    void stand(const CapStand& cap) {
        const std::scoped_lock lock(mutex_);
        stand_ = cap;
    }
    [[nodiscard]] EmulatedSpaceMouse* operator->() { return &spacemouse_; }

private:
    [[nodiscard]] CapStand standing() {
        const std::scoped_lock lock(mutex_);
        return stand_;
    }
    std::mutex mutex_;
    CapStand stand_;
    EmulatedSpaceMouse spacemouse_;
    std::atomic<bool> ends_ = false;
    std::thread thread_;
};

const CapStand kPushedRight{.push = Vec3(0.7, 0.0, 0.0)};

// The way that the stylus makes in so many ticks.
Vec3 way_in(TickedArm& arm, int ticks) {
    const Vec3 begin_m = arm.tick(Vec3(0.0)).position_device_m;
    DeviceSample sample;
    for (int i = 0; i < ticks; ++i) sample = arm.tick(Vec3(0.0));
    return sample.position_device_m - begin_m;
}

bool stands_still(TickedArm& arm) {
    for (int i = 0; i < 20; ++i)
        if (glm::length(way_in(arm, 50)) < 1e-6) return true;
    return false;
}

// A folder as the kernel's, with devices that a test adds.
class HidFolder {
public:
    HidFolder()
        : root_(std::filesystem::temp_directory_path() / ("burin-hid-" + std::to_string(::getpid()))),
          places_{root_ / "class", root_ / "dev"} {
        std::filesystem::create_directories(places_.devices);
        std::filesystem::create_directories(places_.files);
    }
    ~HidFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(root_, ignored);
    }
    // Adds a device whose file is a pipe; returns its path.
    std::filesystem::path add(const std::string& place, const std::string& id, const std::string& descriptor) {
        std::filesystem::create_directories(places_.devices / place / "device");
        std::ofstream(places_.devices / place / "device" / "uevent")
            << "DRIVER=hid-generic\nHID_ID=" << id << "\nHID_NAME=3Dconnexion SpaceNavigator\nHID_PHYS=usb-1\n";
        std::ofstream(places_.devices / place / "device" / "report_descriptor", std::ios::binary) << descriptor;
        const std::filesystem::path file = places_.files / place;
        EXPECT_EQ(::mkfifo(file.c_str(), 0600), 0);
        return file;
    }
    [[nodiscard]] const HidrawPlaces& places() const { return places_; }

private:
    std::filesystem::path root_;
    HidrawPlaces places_;
};
// An administrator may open every file: while this lives the process is nobody in particular.
class AsAnybody {
public:
    AsAnybody() {
        if (was_ == 0) become(65534);
    }
    ~AsAnybody() {
        if (was_ == 0) become(was_);
    }

private:
    static void become(uid_t user) { EXPECT_EQ(::seteuid(user), 0); }
    uid_t was_ = ::geteuid();
};
const std::string kMultiAxis("\x05\x01\x09\x08\xa1\x01", 6), kKeyboard("\x05\x01\x09\x06\xa1\x01", 6);

}  // namespace

TEST(SpaceMouse, LeadsTheStylusByItsPushInBothLayouts) {
    for (const bool joined : {true, false}) {
        RunningSpaceMouse running(own_spacemouse(), joined);
        TickedArm arm("spacemouse:" + own_spacemouse() + ",speed=0.1,dead=0.1");
        ASSERT_TRUE(arm.is_well());
        EXPECT_STREQ(arm.opened().parts[0].device->description().led_by, "a SpaceMouse");
        EXPECT_TRUE(stands_still(arm));
        running.stand({.push = Vec3(0.55, 0.0, 0.0), .turn = {}, .buttons = 1});
        ASSERT_TRUE(arm.ticks_until(Vec3(0.0), [](const DeviceSample& s) { return s.position_device_m.x > 0.005; }));
        // Half of the way beyond the dead zone is a quarter of 0.1 m/s, by the clock of the samples themselves.
        // A thread that was kept from its ticks for long is no measure: the stylus rests then.
        const DeviceSample begin = arm.tick(Vec3(0.0));
        DeviceSample end = begin;
        double way_m = 0.0, took_s = 0.0;
        for (int i = 0; i < 500; ++i) {
            const DeviceSample next = arm.tick(Vec3(0.0));
            if (next.time_ns - end.time_ns < 10 * kMs) {
                way_m += next.position_device_m.x - end.position_device_m.x;
                took_s += seconds(next.time_ns - end.time_ns);
            }
            end = next;
        }
        const double speed = way_m / took_s;
        EXPECT_NEAR(speed, 0.025, 0.002) << joined;
        EXPECT_LT(std::abs(end.position_device_m.y - begin.position_device_m.y), 0.0005);
        EXPECT_EQ(end.buttons, 1u);
        running.stand({});
        EXPECT_TRUE(stands_still(arm));
        EXPECT_EQ(arm.tick(Vec3(0.0)).buttons, 0u);
    }
}

TEST(SpaceMouse, TurnsTheStylusInBothLayouts) {
    for (const bool joined : {true, false}) {
        RunningSpaceMouse running(own_spacemouse(), joined);
        TickedArm arm("spacemouse:" + own_spacemouse() + ",turn=2");
        ASSERT_TRUE(arm.is_well());
        const Quat begin = arm.tick(Vec3(0.0)).orientation_device;
        running.stand({.push = {}, .turn = Vec3(0.0, 1.0, 0.0)});
        DeviceSample sample;
        ASSERT_TRUE(arm.ticks_until(Vec3(0.0), [&](const DeviceSample& s) {
            sample = s;
            return glm::length(s.orientation_device * glm::conjugate(begin) * Vec3(1.0, 0.0, 0.0) -
                               Vec3(1.0, 0.0, 0.0)) > 0.5;
        }));
        const Quat by = sample.orientation_device * glm::conjugate(begin);
        EXPECT_LT((by * Vec3(1.0, 0.0, 0.0)).z, -0.4) << "to the left, as seen from above";
        EXPECT_LT(glm::distance(by * Vec3(0.0, 1.0, 0.0), Vec3(0.0, 1.0, 0.0)), 1e-6);
    }
}

TEST(SpaceMouse, KeepsTheHandNearAStylusThatIsHeldBack) {
    RunningSpaceMouse running(own_spacemouse());
    TickedArm arm("spacemouse:" + own_spacemouse() + ",speed=0.1");
    ASSERT_TRUE(arm.is_well());
    running.stand({.push = Vec3(0.0, 0.0, -1.0)});
    // A wall at the middle, as stiff as the device takes it.
    const auto pressed = [&](int ticks) {
        DeviceSample sample = arm.tick(Vec3(0.0));
        for (int i = 0; i < ticks; ++i)
            sample = arm.tick(Vec3(0.0, 0.0, std::min(-700.0 * std::min(sample.position_device_m.z, 0.0), 3.3)));
        return sample.position_device_m.z;
    };
    EXPECT_GT(pressed(2000), -0.006) << "the cap would have gone 0.2 m, and the stylus is a few millimetres deep";
    running.stand({.push = Vec3(0.0, 0.0, 1.0)});
    EXPECT_TRUE(arm.ticks_until(
        Vec3(0.0), [](const DeviceSample& s) { return s.position_device_m.z > 0.005; }, 400))
        << "the way back is as short";
}

TEST(SpaceMouse, PressesUndoesHoldsAndDoesAgainByItsFirstFourButtons) {
    RunningSpaceMouse running(own_spacemouse(), false);
    TickedArm arm("spacemouse:" + own_spacemouse());
    ASSERT_TRUE(arm.is_well());
    std::vector<std::string> commands;
    for (const auto& [button, bit] : {std::pair{0u, 0u}, {1u, 2u}, {2u, 1u}, {3u, 3u}}) {
        running.stand({.push = {}, .turn = {}, .buttons = 1u << button});
        EXPECT_TRUE(arm.ticks_until(Vec3(0.0), [&](const DeviceSample& s) { return s.buttons == 1u << bit; }))
            << button;
        running.stand({});
        EXPECT_TRUE(arm.ticks_until(Vec3(0.0), [&](const DeviceSample& s) { return s.buttons == 0; }));
        for (std::string& command : arm.opened().messages->take_commands()) commands.push_back(std::move(command));
    }
    EXPECT_EQ(commands, (std::vector<std::string>{"undo", "redo"}));
}

TEST(SpaceMouse, UnpluggedInMotionStandsStillAtOnceSaysSoAndComesBack) {
    RunningSpaceMouse running(own_spacemouse());
    TickedArm arm("spacemouse:" + own_spacemouse());
    ASSERT_TRUE(arm.is_well());
    for (int drill = 0; drill < 2; ++drill) {
        running.stand({.push = drill == 0 ? Vec3(0.8, 0.0, 0.0) : Vec3(-0.8, 0.0, 0.0), .turn = {}, .buttons = 1});
        ASSERT_TRUE(arm.ticks_until(Vec3(0.0), [](const DeviceSample& s) { return s.buttons == 1; }));
        static_cast<void>(way_in(arm, 100));
        running->pull_cable(true);
        DeviceSample lost;
        ASSERT_TRUE(arm.ticks_until(Vec3(0.0), [&](const DeviceSample& s) {
            lost = s;
            return s.fault == DeviceFault::disconnected;
        }));
        EXPECT_EQ(lost.buttons, 0u) << "what was pressed is let go";
        EXPECT_LT(glm::length(way_in(arm, 200)), 0.001) << "the hand brakes, and stays";
        EXPECT_LT(glm::length(way_in(arm, 200)), 1e-6);
        EXPECT_TRUE(arm.messages().contains("unplugged"));
        running.stand({});
        running->pull_cable(false);
        ASSERT_TRUE(arm.is_well()) << "it is looked for each second";
        EXPECT_TRUE(arm.messages().contains("is there again"));
        EXPECT_LT(glm::length(way_in(arm, 100)), 1e-4) << "and begins where the stylus is";
    }
}

TEST(SpaceMouse, SilentWhilePushedCountsAsLetGo) {
    RunningSpaceMouse running(own_spacemouse());
    TickedArm arm("spacemouse:" + own_spacemouse());
    ASSERT_TRUE(arm.is_well());
    running.stand(kPushedRight);
    ASSERT_TRUE(arm.ticks_until(Vec3(0.0), [](const DeviceSample& s) { return s.position_device_m.x > 0.01; }));
    running->fall_silent(true);
    EXPECT_TRUE(stands_still(arm));
    EXPECT_EQ(arm.tick(Vec3(0.0)).fault, DeviceFault::none) << "its cable is there";
    EXPECT_TRUE(arm.messages().contains("silent"));
    running->fall_silent(false);
    EXPECT_TRUE(arm.ticks_until(Vec3(0.0), [](const DeviceSample& s) { return s.position_device_m.x > 0.03; }));
}

// The state that the tracker takes: pushed or turned alone, what falls silent rests, and what is unplugged lets go.
TEST(SpaceMouse, IsAtRestWhereItFallsSilentAndLetsGoWhereItIsUnpluggedWhateverItDid) {
    RunningSpaceMouse running(own_spacemouse());
    auto line = SpaceMouseLine::open("device", own_spacemouse());
    ASSERT_TRUE(line) << line.error().line();
    const auto comes = [&](const std::function<bool(const SpaceMouseState&)>& what) {
        const auto until = std::chrono::steady_clock::now() + std::chrono::seconds(30);
        while (!what((*line)->newest()) && std::chrono::steady_clock::now() < until)
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        return what((*line)->newest());
    };
    const auto rests = [](const SpaceMouseState& s) { return s.push == Vec3(0.0) && s.turn == Vec3(0.0); };
    for (const bool turns : {false, true}) {
        const Vec3 way(0.3, -0.7, 0.5);
        running.stand({.push = turns ? Vec3(0.0) : way, .turn = turns ? way : Vec3(0.0), .buttons = 2});
        const auto moves = [&](const SpaceMouseState& s) { return !rests(s) && s.buttons == 2; };
        ASSERT_TRUE(comes(moves)) << turns;
        running->fall_silent(true);
        EXPECT_TRUE(comes(rests)) << turns;
        running->fall_silent(false);
        ASSERT_TRUE(comes(moves)) << turns;
        running->pull_cable(true);
        ASSERT_TRUE(comes([](const SpaceMouseState& s) { return !s.is_there; })) << turns;
        EXPECT_TRUE(rests((*line)->newest())) << turns;
        EXPECT_EQ((*line)->newest().buttons, 0u) << turns;
        running.stand({});
        running->pull_cable(false);
        ASSERT_TRUE(comes([](const SpaceMouseState& s) { return s.is_there; })) << "it is looked for each second";
    }
}

TEST(SpaceMouse, LeavesReportsOfAWrongLengthOutAndCountsThem) {
    RunningSpaceMouse running(own_spacemouse());
    auto line = SpaceMouseLine::open("device", own_spacemouse());
    ASSERT_TRUE(line) << line.error().line();
    running->send_instead(HidBytes(9, std::byte{1}));
    MonotonicClock clock;
    for (int i = 0; i < 1000 && (*line)->refused() < 5; ++i) clock.sleep_until(clock.now_ns() + 5'000'000);
    EXPECT_GE((*line)->refused(), 5u);
    EXPECT_EQ((*line)->newest().push, Vec3(0.0));
    const std::vector<std::string> messages = (*line)->take_messages();
    ASSERT_FALSE(messages.empty());
    EXPECT_TRUE(messages[0].contains("report 1 came with 9 bytes")) << messages[0];
    running->send_instead(HidBytes(kMostHidReport + 40, std::byte{3}));
    const std::uint64_t before = (*line)->refused();
    for (int i = 0; i < 1000 && (*line)->refused() < before + 5; ++i) clock.sleep_until(clock.now_ns() + 5'000'000);
    EXPECT_GE((*line)->refused(), before + 5) << "one that is too long is not cut to a sound one";
    EXPECT_EQ((*line)->newest().buttons, 0u);
}

TEST(SpaceMouse, ASecondProgramIsToldThatItIsInUse) {
    RunningSpaceMouse running(own_spacemouse());
    TickedArm arm("spacemouse:" + own_spacemouse());
    const auto second = SpaceMouseLine::open("device", own_spacemouse());
    ASSERT_FALSE(second);
    EXPECT_TRUE(second.error().line().contains("in use by another program")) << second.error().line();
    const auto twin = EmulatedSpaceMouse::create(own_spacemouse());
    ASSERT_FALSE(twin);
    EXPECT_TRUE(twin.error().line().contains("another one may be running")) << twin.error().line();
}

TEST(SpaceMouse, LeadsAWandWithinItsStops) {
    RunningSpaceMouse running(own_spacemouse());
    TickedArm arm("spacemouse-wand:" + own_spacemouse() + ",turn=3");
    ASSERT_TRUE(arm.is_well());
    EXPECT_NE(arm.opened().amplifiers, nullptr);
    running.stand({.push = {}, .turn = Vec3(1.0, 0.0, 0.0)});
    static_cast<void>(way_in(arm, 2000));
    DeviceSample sample = arm.tick(Vec3(0.0));
    const auto pitch_rad = [&] {
        const Vec3 up = sample.orientation_device * Vec3(0.0, 1.0, 0.0);
        return std::atan2(up.z, up.y);
    };
    EXPECT_GT(pitch_rad(), 0.9) << "it has turned to its stop";
    EXPECT_LT(pitch_rad(), glm::radians(66.0)) << "and not beyond";
    running.stand({.push = {}, .turn = Vec3(-1.0, 0.0, 0.0)});
    EXPECT_TRUE(arm.ticks_until(
        Vec3(0.0),
        [&](const DeviceSample& s) {
            sample = s;
            return pitch_rad() < 0.8;
        },
        1000))
        << "the way back is not longer for having been held at the stop";
}

TEST(SpaceMouse, MovesTheSceneAsAWandThatHoldsItWhileItIsPushed) {
    RunningSpaceMouse running(own_spacemouse(), false);
    MonotonicClock clock;
    auto tracker = open_tracker("spacemouse:" + own_spacemouse() + ",speed=0.5", {clock, [] {}, {}});
    ASSERT_TRUE(tracker) << tracker.error().line();
    std::vector<TrackerSample> samples;
    const auto heard = [&](const auto& holds) {
        for (int i = 0; i < 1000; ++i) {
            for (TrackerSample& sample : (*tracker)->take()) samples.push_back(std::move(sample));
            if (std::ranges::any_of(samples, holds)) return true;
            clock.sleep_until(clock.now_ns() + 5'000'000);
        }
        return false;
    };
    const auto is_click = [](std::uint32_t button, bool pressed) {
        return [=](const TrackerSample& s) { return s.input == TrackerInput(WandClick{1, button, pressed}); };
    };
    running.stand(kPushedRight);
    EXPECT_TRUE(heard([](const TrackerSample& s) {
        const auto* wand = std::get_if<WandInput>(&s.input);
        return wand != nullptr && wand->pose_world.position_m.x > 0.05;
    }));
    running.stand({});
    EXPECT_TRUE(heard(is_click(0, false)));
    // It takes hold where it stands, before it moves.
    ASSERT_GE(samples.size(), 3u);
    EXPECT_EQ(std::get<WandInput>(samples[0].input).pose_world.position_m.x, 0.0);
    EXPECT_TRUE(is_click(0, true)(samples[1]));
    running.stand({.push = {}, .turn = {}, .buttons = 2});
    EXPECT_TRUE(heard(is_click(3, true))) << "the second button brings the scene back";
    running.stand(kPushedRight);
    samples.clear();
    EXPECT_TRUE(heard(is_click(0, true)));
    running->pull_cable(true);
    EXPECT_TRUE(heard(is_click(0, false))) << "a cable that is pulled lets go";
    std::string messages;
    for (const std::string& message : (*tracker)->take_messages()) messages += message;
    EXPECT_TRUE(messages.contains("unplugged")) << messages;
}

TEST(SpaceMouse, HasNoBodiesForATrackersDescription) {
    MonotonicClock clock;
    const TrackerBodies bodies;
    const auto tracker = open_tracker("spacemouse", {clock, [] {}, {}, &bodies, {}});
    ASSERT_FALSE(tracker);
    EXPECT_TRUE(tracker.error().line().contains("has no bodies")) << tracker.error().line();
}

TEST(Hidraw, IsFoundByItsNumbersAndItsDescriptorAndRead) {
    HidFolder folder;
    static_cast<void>(folder.add("hidraw10", "0003:0000046D:0000C626", kMultiAxis));
    const auto second = folder.add("hidraw2", "0003:0000256F:0000C652", kMultiAxis);
    static_cast<void>(folder.add("hidraw1", "0003:0000256F:0000C652", kKeyboard));
    static_cast<void>(folder.add("hidraw0", "0003:0000046D:0000C077", kMultiAxis));
    static_cast<void>(folder.add("hidraw3", "nonsense", kMultiAxis));
    const std::vector<DevicePresence> found = look_for_spacemice(folder.places());
    ASSERT_GE(found.size(), 2u);
    EXPECT_EQ(found[0].name, "spacemouse:hidraw2");
    EXPECT_EQ(found[1].name, "spacemouse:hidraw10");
    EXPECT_EQ(found[0].presence, Presence::there);
    EXPECT_TRUE(found[1].cause.contains("SpaceNavigator")) << found[1].cause;
    const int device = ::open(second.c_str(), O_RDWR | O_CLOEXEC);
    auto line = SpaceMouseLine::open("device", "", {}, folder.places());
    ASSERT_TRUE(line) << line.error().line();
    EXPECT_EQ((*line)->product().name, "Universal Receiver");
    const HidBytes report = cap_joined_report(Vec3(0.0, 1.0, 0.0), Vec3(0.0));
    ASSERT_EQ(::write(device, report.data(), report.size()), static_cast<ssize_t>(report.size()));
    MonotonicClock clock;
    bool is_read = false;
    for (int i = 0; i < 400 && !is_read; ++i) {
        is_read = (*line)->newest().push == Vec3(0.0, 1.0, 0.0);
        clock.sleep_until(clock.now_ns() + 500'000);
    }
    EXPECT_TRUE(is_read);
    ::close(device);
    for (int i = 0; i < 1000 && (*line)->newest().is_there; ++i) clock.sleep_until(clock.now_ns() + 5'000'000);
    EXPECT_FALSE((*line)->newest().is_there) << "the kernel ends the file of a device that is unplugged";
}

TEST(Hidraw, SaysWhichRuleIsMissingWhereItMayNotBeOpened) {
    const AsAnybody user;
    HidFolder folder;
    std::filesystem::permissions(folder.add("hidraw4", "0003:0000256F:0000C635", kMultiAxis),
                                 std::filesystem::perms::none);
    const std::vector<DevicePresence> found = look_for_spacemice(folder.places());
    EXPECT_EQ(found[0].presence, Presence::forbidden);
    EXPECT_TRUE(found[0].remedy.contains("70-burin-devices.rules")) << found[0].remedy;
    const auto port = open_spacemouse_port("device", "", folder.places());
    ASSERT_FALSE(port);
    EXPECT_TRUE(port.error().line().contains("may not be opened by this user")) << port.error().line();
    EXPECT_TRUE(port.error().line().contains("70-burin-devices.rules")) << port.error().line();
}

TEST(Hidraw, SaysThatThereIsNone) {
    HidFolder folder;
    const std::vector<DevicePresence> found = look_for_spacemice(folder.places());
    EXPECT_EQ(found[0].presence, Presence::absent);
    EXPECT_TRUE(found[0].remedy.contains("burin devices emulate spacemouse"));
    EXPECT_TRUE(open_spacemouse_port("device", "hidraw9", folder.places()).error().line().contains("none at hidraw9"));
    EXPECT_TRUE(look_for_spacemice({"/nowhere", "/nowhere"})[0].presence == Presence::absent);
}

// An emulator that was stopped accepts nobody: whoever asks is told so, also when the queue of those who ask is full.
TEST(EmulatorSocket, OfAnEmulatorThatDoesNotAnswerKeepsNobodyWaiting) {
    const std::string name = own_spacemouse("-that-is-stopped");
    const auto listener = listen_as_emulator("spacemouse", name);
    ASSERT_TRUE(listener) << listener.error().line();
    // All at once, since each that is let in waits for a second.
    std::vector<std::future<std::string>> asked;
    for (int i = 0; i < 8; ++i)
        asked.push_back(std::async(std::launch::async, [&name] {
            const auto connection = connect_to_emulator("it", "spacemouse", name);
            return connection ? "nothing" : connection.error().line();
        }));
    int others_wait = 0;
    for (auto& one : asked) {
        const std::string told = one.get();
        EXPECT_TRUE(told.contains("does not answer")) << told;
        others_wait += told.contains("others wait") ? 1 : 0;
    }
    EXPECT_GT(others_wait, 0);
    EXPECT_LT(others_wait, 8);
}

}  // namespace burin::devices
