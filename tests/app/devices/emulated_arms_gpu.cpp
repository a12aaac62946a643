// SPDX-License-Identifier: MIT
// Emulated arms in sessions by the command line: they carve, two at once, also of two makers, and are done again
// without them.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <sstream>
#include <string>
#include <thread>

#include "devices/emulators/emulated_dhd.hpp"
#include "devices/emulators/emulated_spacemouse.hpp"
#include "gpu/device.hpp"
#include "tests/app/real_time.hpp"
#include "tests/support/places.hpp"
#include "tests/support/run_command.hpp"

namespace burin::app {
namespace {

// Starts emulated arms of this workplace's own names in the background; they end by themselves.
std::string emulators(const std::string& burin, const std::string& suffixes, const std::string& kind = "omni") {
    return "for n in " + suffixes + "; do (" + burin + " devices emulate " + kind +
           " --seconds 60 --at emulated-$$-$n > $n.txt &) ; "
           "while ! test -s $n.txt; do sleep 0.05; done; done; ";
}

// Ticks with the first button down, and those of them with a force, in a table whose first column is the buttons, and
// the last one a force.
struct WorkingTicks {
    int pressed = 0, felt = 0;

    [[nodiscard]] bool carves() const { return pressed > 500 && felt > 100; }
};

WorkingTicks working_in(const std::string& table) {
    WorkingTicks count;
    std::istringstream lines(table);
    for (std::string line; std::getline(lines, line);) {
        count.pressed += line.starts_with("1,") ? 1 : 0;
        count.felt += line.starts_with("1,") && !line.ends_with(",0") ? 1 : 0;
    }
    return count;
}

}  // namespace

TEST(EmulatedArms, P3CarvesIsRecordedAndDoneAgainToTheBitWithoutTheDevice) {
    if (!gpu::list_devices()) GTEST_SKIP() << "no Vulkan driver";
    const Workplace at;
    const std::string burin = kBurinCommand;
    at.write("s.txt", "burin-input 1 omni\n0.1 mouse 160 90\n6 close\n");
    Workplace::Outcome recorded, ticks;
    const auto late = kept_from_real_time(at, "o.session", [&] {
        recorded = at.run(emulators(burin, "a") + burin +
                          " sculpt --workpiece ball:0.08 --resolution 64 --device omni:emulated-$$-a "
                          "--input s.txt --offscreen --width 320 --height 180 --record o.session");
        ticks = at.run(burin + " convert o.session --to csv --columns 'buttons,commanded_force_device_z_N' -");
        return recorded.output.contains("0 lost") && working_in(ticks.output).carves();
    });
    if (late) GTEST_SKIP() << *late;
    ASSERT_EQ(recorded.status, 0) << recorded.output;
    EXPECT_TRUE(recorded.output.contains("0 lost")) << recorded.output;
    ASSERT_EQ(ticks.status, 0) << ticks.output;
    const auto [pressed, felt] = working_in(ticks.output);
    EXPECT_GT(pressed, 500) << "its button is down";
    EXPECT_GT(felt, 100) << "and it feels what it cuts";
    const auto replayed = at.run(burin + " replay o.session");
    EXPECT_EQ(replayed.status, 0) << replayed.output;
    EXPECT_TRUE(replayed.output.contains("equal to the bit")) << replayed.output;
}

TEST(EmulatedArms, TwoOfThemAreTwoHandsOfOneScene) {
    if (!gpu::list_devices()) GTEST_SKIP() << "no Vulkan driver";
    const Workplace at;
    const std::string burin = kBurinCommand;
    at.write("s.txt", "burin-input 1 omni\n0.1 mouse 160 90\n3 close\n");
    const auto recorded = at.run(
        emulators(burin, "a b") + burin +
        " sculpt --workpiece ball:0.08 --resolution 64 --device right=omni:emulated-$$-a "
        "--device left=omni:emulated-$$-b --input s.txt --offscreen --width 320 --height 180 --record o.session");
    ASSERT_EQ(recorded.status, 0) << recorded.output;
    const auto info = at.run(burin + " session info o.session");
    for (const char* hand : {"\nright: ", "\nleft: "}) EXPECT_TRUE(info.output.contains(hand)) << info.output;
    const auto replayed = at.run(burin + " replay o.session");
    EXPECT_EQ(replayed.status, 0) << replayed.output;
    EXPECT_TRUE(replayed.output.contains("equal to the bit")) << replayed.output;
}

TEST(EmulatedArms, TwoOfTwoMakersAreTwoHandsOfOneScene) {
    if (!gpu::list_devices()) GTEST_SKIP() << "no Vulkan driver";
    const Workplace at;
    const std::string burin = kBurinCommand;
    at.write("s.txt", "burin-input 1 two\n0.1 mouse 160 90\n5 close\n");
    Workplace::Outcome recorded;
    const auto felt_by = [&](const std::string& hand) {
        const auto ticks = at.run(burin + " convert o.session --to csv --part " + hand +
                                  " --columns 'buttons,fault,commanded_force_device_z_N' -");
        return working_in(ticks.output).felt;
    };
    const auto late = kept_from_real_time(at, "o.session", [&] {
        recorded = at.run(
            emulators(burin, "a") + emulators(burin, "b", "falcon") + burin +
            " sculpt --workpiece ball:0.08 --resolution 64 --device right=omni:emulated-$$-a "
            "--device left=falcon:emulated-$$-b --input s.txt --offscreen --width 320 --height 180 --record o.session");
        return felt_by("right") > 100 && felt_by("left") > 100;
    });
    if (late) GTEST_SKIP() << *late;
    ASSERT_EQ(recorded.status, 0) << recorded.output;
    for (const char* hand : {"right", "left"}) EXPECT_GT(felt_by(hand), 100) << hand << " feels what it cuts";
    const auto replayed = at.run(burin + " replay o.session");
    EXPECT_EQ(replayed.status, 0) << replayed.output;
    EXPECT_TRUE(replayed.output.contains("equal to the bit")) << replayed.output;
}

TEST(EmulatedArms, AnInverse3CarvesIsRecordedAndDoneAgainToTheBitWithoutItsService) {
    if (!gpu::list_devices()) GTEST_SKIP() << "no Vulkan driver";
    const Workplace at;
    const std::string burin = kBurinCommand;
    at.write("s.txt", "burin-input 1 inverse3\n0.1 mouse 160 90\n6 close\n");
    Workplace::Outcome recorded, ticks;
    const auto late = kept_from_real_time(at, "o.session", [&] {
        recorded = at.run(emulators(burin, "a", "inverse3") + burin +
                          " sculpt --workpiece ball:0.08 --resolution 64 --device inverse3:emulated-$$-a "
                          "--input s.txt --offscreen --width 320 --height 180 --record o.session");
        ticks = at.run(burin + " convert o.session --to csv --columns 'buttons,commanded_force_device_z_N' -");
        return working_in(ticks.output).carves();
    });
    if (late) GTEST_SKIP() << *late;
    ASSERT_EQ(recorded.status, 0) << recorded.output;
    EXPECT_TRUE(working_in(ticks.output).carves()) << "it feels what it cuts";
    const auto replayed = at.run(burin + " replay o.session");
    EXPECT_EQ(replayed.status, 0) << replayed.output;
    EXPECT_TRUE(replayed.output.contains("equal to the bit")) << replayed.output;
}

TEST(EmulatedArms, AModelThatWasFoundIsKeptByTheRecordingAndDoneAgainWithoutTheDevice) {
    if (!gpu::list_devices()) GTEST_SKIP() << "no Vulkan driver";
    const Workplace at;
    const std::string burin = kBurinCommand;
    const std::string name = "emulated-delta-" + std::to_string(::getpid());
    constexpr int kDelta3 = 63;
    auto delta = devices::EmulatedDhd::create(name, {.script = {}, .silence = {}, .type = kDelta3});
    ASSERT_TRUE(delta) << delta.error().line();
    std::atomic<bool> ends = false;
    std::thread runs([&] { delta->run([&] { return ends.load(); }); });
    at.write("s.txt", "burin-input 1 delta\n0.1 mouse 160 90\n3 close\n");
    const auto recorded = at.run(burin + " sculpt --workpiece ball:0.08 --resolution 64 --device dhd:" + name +
                                 " --input s.txt --offscreen --width 320 --height 180 --record o.session");
    ends = true;
    runs.join();
    ASSERT_EQ(recorded.status, 0) << recorded.output;
    const auto info = at.run(burin + " session info o.session");
    EXPECT_TRUE(info.output.contains("dhd:" + name + ",model=delta")) << info.output;
    const auto replayed = at.run(burin + " replay o.session");
    EXPECT_EQ(replayed.status, 0) << replayed.output;
    EXPECT_TRUE(replayed.output.contains("equal to the bit")) << replayed.output;
}

TEST(EmulatedArms, ASpaceMouseLeadsAStylusThatCarvesAndIsDoneAgainWithoutIt) {
    if (!gpu::list_devices()) GTEST_SKIP() << "no Vulkan driver";
    const Workplace at;
    const std::string burin = kBurinCommand;
    at.write("s.txt", "burin-input 1 cap\n0.1 mouse 160 90\n7 close\n");
    for (const char* layout : {"joined", "split"}) {
        const std::string recording = std::string(layout) + ".session";
        Workplace::Outcome recorded, ticks;
        const auto late = kept_from_real_time(at, recording, [&] {
            recorded = at.run(emulators(burin, "a", std::string("spacemouse --layout ") + layout) + burin +
                              " sculpt --workpiece ball:0.08 --resolution 64 --device spacemouse:emulated-$$-a "
                              "--input s.txt --offscreen --width 320 --height 180 --record " +
                              recording);
            ticks =
                at.run(burin + " convert " + recording + " --to csv --columns 'buttons,commanded_force_device_z_N' -");
            return working_in(ticks.output).carves();
        });
        if (late) GTEST_SKIP() << *late;
        ASSERT_EQ(recorded.status, 0) << recorded.output;
        ASSERT_EQ(ticks.status, 0) << ticks.output;
        const auto [pressed, felt] = working_in(ticks.output);
        EXPECT_GT(pressed, 500) << layout;
        EXPECT_GT(felt, 100) << "what it cuts pushes the stylus back: " << layout;
        const auto replayed = at.run(burin + " replay " + layout + ".session");
        EXPECT_EQ(replayed.status, 0) << replayed.output;
        EXPECT_TRUE(replayed.output.contains("equal to the bit")) << replayed.output;
    }
}

TEST(EmulatedArms, ASpaceMouseMovesTheSceneAsATracker) {
    if (!gpu::list_devices()) GTEST_SKIP() << "no Vulkan driver";
    const Workplace at;
    const std::string burin = kBurinCommand;
    at.write("s.txt", "burin-input 1 cap\n0.1 mouse 160 90\n5 close\n");
    const auto recorded = at.run(emulators(burin, "a", "spacemouse --layout split") + burin +
                                 " sculpt --workpiece ball:0.08 --resolution 64 --tracker spacemouse:emulated-$$-a "
                                 "--input s.txt --offscreen --width 320 --height 180 --record o.session");
    ASSERT_EQ(recorded.status, 0) << recorded.output;
    ASSERT_EQ(at.run(burin + " convert o.session --to log o.log").status, 0);
    const std::string log = at.read("o.log");
    EXPECT_TRUE(log.contains(" wand-button 1 press 0")) << "it takes hold of the scene";
    EXPECT_GT(std::count(log.begin(), log.end(), '\n'), 100);
    const auto replayed = at.run(burin + " replay o.session");
    EXPECT_TRUE(replayed.output.contains("equal to the bit")) << replayed.output;
}

TEST(EmulatedArms, TheSecondKeyOfASpaceMouseUndoesAStroke) {
    if (!gpu::list_devices()) GTEST_SKIP() << "no Vulkan driver";
    const std::string name = "emulated-undo-" + std::to_string(::getpid());
    // Presses away and carves as usual, lets go, and presses the second key.
    const auto script = [](double time_s) {
        devices::CapStand cap = devices::circling_cap(std::min(time_s, 5.0));
        if (time_s >= 5.0) cap = {};
        if (time_s >= 5.5 && time_s < 5.8) cap.buttons = 2;
        return cap;
    };
    auto spacemouse = devices::EmulatedSpaceMouse::create(name, {.joined = true, .script = script, .silence = {}});
    ASSERT_TRUE(spacemouse) << spacemouse.error().line();
    std::atomic<bool> ends = false;
    std::thread runs([&] { spacemouse->run([&] { return ends.load(); }); });
    const Workplace at;
    const std::string burin = kBurinCommand;
    at.write("s.txt", "burin-input 1 cap\n0.1 mouse 160 90\n8 close\n");
    const auto recorded = at.run(burin + " sculpt --workpiece ball:0.08 --resolution 64 --device spacemouse:" + name +
                                 " --input s.txt --offscreen --width 320 --height 180 --record o.session");
    ends = true;
    runs.join();
    ASSERT_EQ(recorded.status, 0) << recorded.output;
    ASSERT_EQ(at.run(burin + " convert o.session --to log o.log").status, 0);
    EXPECT_TRUE(at.read("o.log").contains(" command undo")) << at.read("o.log").substr(0, 2000);
    const auto replayed = at.run(burin + " replay o.session");
    EXPECT_EQ(replayed.status, 0) << replayed.output;
    EXPECT_TRUE(replayed.output.contains("equal to the bit")) << replayed.output;
}

TEST(EmulatedArms, SaysThatThereIsNone) {
    const Workplace at;
    at.write("s.txt", "burin-input 1 omni\n0.1 close\n");
    const auto without = at.run(std::string(kBurinCommand) +
                                " sculpt --device omni:emulated-nowhere --input s.txt --offscreen --record h.session");
    EXPECT_EQ(without.status, 1);
    EXPECT_TRUE(without.output.contains("there is no communication with the device")) << without.output;
    EXPECT_TRUE(without.output.contains("burin devices emulate omni --at emulated-nowhere")) << without.output;
}

}  // namespace burin::app
