// SPDX-License-Identifier: MIT
// The registry of force-feedback devices.
#include "devices/registry/device_nature.hpp"
#include "devices/registry/device_registry.hpp"
#include "devices/registry/haptic_host.hpp"
#include "devices/registry/haptic_kinds.hpp"
#include "devices/registry/opening.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "devices/haptic/recorded_device.hpp"
#include "devices/haptic/simulated_omni.hpp"
#include "tests/support/run_command.hpp"

namespace burin::devices {
namespace {

HapticHost host_of(Clock& clock) {
    return {clock, *SimulatedHand::create({{0.0, Vec3(0.0)}, {1.0, Vec3(0.02, 0.0, 0.0)}})};
}

}  // namespace

TEST(HapticRegistry, NamesEachKindOnceAndInItsUsage) {
    std::set<std::string_view> names;
    ASSERT_FALSE(haptic_kinds().empty());
    for (const HapticKind& kind : haptic_kinds()) {
        EXPECT_TRUE(names.insert(kind.name).second) << kind.name;
        EXPECT_TRUE(haptic_usage().contains(std::string(kind.name) + ": ")) << haptic_usage();
    }
    EXPECT_TRUE(names.contains(kDefaultHapticDevice));
}

// A row is an aggregate whose fields have no default, and so has no value without them.
TEST(HapticRegistry, HasNoRowOfADriverWithoutAllItsFunctions) {
    static_assert(!std::is_default_constructible_v<Needed<bool>>);
    static_assert(!std::is_default_constructible_v<DriverFunctions>);
    static_assert(!std::is_default_constructible_v<Opening>);
    static_assert(!std::is_default_constructible_v<HapticKind>);
    SimulatedClock clock;
    for (const HapticKind& kind : haptic_kinds()) {
        if (!kind.open.is_driver()) continue;
        const auto opened =
            open_haptic_device(std::string(kind.name) + (kind.takes_text ? ":emulated" : ""), host_of(clock));
        ASSERT_FALSE(opened) << kind.name << " was opened in simulated time";
        EXPECT_TRUE(opened.error().line().contains("time is simulated")) << opened.error().line();
    }
}

TEST(HapticRegistry, OpensTheSimulatedOmniOnTheClockThatItIsGiven) {
    SimulatedClock clock;
    const auto opened = open_haptic_device("simulated", host_of(clock));
    ASSERT_TRUE(opened) << opened.error().line();
    EXPECT_EQ(opened->parts.front().device->description().max_force_N, OmniModel{}.max_force_N);
    SimulatedOmni reference(*SimulatedHand::create({{0.0, Vec3(0.0)}, {1.0, Vec3(0.02, 0.0, 0.0)}}), {}, &clock);
    for (int tick = 1; tick <= 500; ++tick) {
        clock.sleep_until(tick * Nanoseconds{1'000'000});
        ASSERT_EQ(opened->parts.front().device->read().position_device_m, reference.read().position_device_m) << tick;
    }
    EXPECT_GT(reference.read().position_device_m.x, 0.001) << "the hand moves it";
}

// What is known before is what the opened device then is.
TEST(HapticRegistry, KnowsTheNatureOfEachDeviceBeforeItIsOpened) {
    SimulatedClock clock;
    for (const HapticKind& kind : haptic_kinds()) {
        if (std::string_view(kind.name) == kRecordedDevice)
            continue;  // is of what was recorded: recorded_device_unit.cpp
        const auto nature = nature_of_device(kind.name);
        ASSERT_TRUE(nature) << kind.name;
        HapticHost host = host_of(clock);
        host.stands_in = true;  // a glove needs no line then
        const auto opened = open_haptic_device(kind.name, std::move(host));
        ASSERT_TRUE(opened) << opened.error().line();
        EXPECT_EQ(opened->parts.size(), nature->parts) << kind.name;
        EXPECT_EQ(opened->amplifiers != nullptr, nature->has_amplifiers) << kind.name;
        for (const DevicePart& part : opened->parts)
            EXPECT_EQ(part.device->description().felt_by_person, nature->felt_by_person) << kind.name;
        EXPECT_EQ(nature->handle.has_value(), has_handle(kind.name)) << kind.name;
        if (!nature->handle) continue;
        EXPECT_EQ(device_of(*nature->handle).workspace_m, opened->parts[0].device->description().workspace_m);
    }
}

TEST(HapticRegistry, KnowsAHandleByTheFileThatDescribesIt) {
    const Workplace at;
    at.write("w.toml", "name = \"short\"\n[[point]]\nname = \"tip\"\noffset = [0, 0.03, 0]\n");
    const std::string file = (at / "w.toml").string(), device = "simulated-wand:" + file;
    const auto nature = nature_of_device(device);
    ASSERT_TRUE(nature) << nature.error().line();
    ASSERT_TRUE(nature->handle);
    EXPECT_EQ(nature->handle->points.size(), 1u);
    EXPECT_EQ(handle_file_of(device), file);
    EXPECT_EQ(handle_file_of("simulated-wand"), "");
    EXPECT_EQ(handle_file_of("glove:/dev/ttyUSB0"), "") << "a port describes nothing";
    EXPECT_FALSE(has_handle("glove:/dev/ttyUSB0"));
    EXPECT_EQ(devices_with_handles(), "simulated-wand, wand, spacemouse-wand");
    EXPECT_EQ(handle_file_of("wand:emulated," + file), file);
    EXPECT_EQ(handle_file_of("wand:" + file + "@/opt/libhil.so"), file);
    EXPECT_EQ(handle_file_of("wand:emulated"), "");
    const auto missing = nature_of_device("simulated-wand:none.toml");
    ASSERT_FALSE(missing);
    EXPECT_TRUE(missing.error().line().contains("none.toml")) << missing.error().line();
    EXPECT_FALSE(has_handle("simulatd"));
    const auto unknown = nature_of_device("simulatd");
    ASSERT_FALSE(unknown);
    EXPECT_TRUE(unknown.error().line().contains("did you mean simulated?")) << unknown.error().line();
}

TEST(HapticRegistry, RefusesWhatItDoesNotKnowAndSuggestsTheNearest) {
    SimulatedClock clock;
    const auto opened = open_haptic_device("simulatd", host_of(clock));
    ASSERT_FALSE(opened);
    EXPECT_TRUE(opened.error().line().contains("did you mean simulated?")) << opened.error().line();
}

TEST(HapticRegistry, SaysTheRightFormOfATrackersNameAnEmptyLibraryAndAMissingColon) {
    MonotonicClock clock;
    const auto said = [&](const std::string& name) {
        const auto opened = open_haptic_device(name, host_of(clock));
        return opened ? "nothing" : opened.error().line();
    };
    EXPECT_TRUE(said("vrpn:").contains("is a tracker, which has no force; give it as --tracker vrpn:"))
        << said("vrpn:");
    EXPECT_TRUE(said("dtrack:5000").contains("give it as --tracker dtrack:5000"));
    EXPECT_TRUE(said("wand@/x/libhil.so").contains("write wand:@/x/libhil.so")) << said("wand@/x/libhil.so");
    for (const std::string arm : {"omni", "dhd"}) {
        const std::string model = arm == "omni" ? ",model=touch-x" : ",model=delta";
        EXPECT_TRUE(said(arm + model).contains("write " + arm + ":" + model)) << said(arm + model);
        EXPECT_TRUE(said(arm + ":,model=").contains("names no model")) << said(arm + ":,model=");
    }
    EXPECT_TRUE(said("omni,model=delta").contains("write one of ")) << said("omni,model=delta");
    EXPECT_TRUE(said("inverse3@localhost:1").contains("write inverse3:localhost:1")) << said("inverse3@localhost:1");
    EXPECT_TRUE(said("dhd@/x/libdhd.so").contains("write dhd:@/x/libdhd.so"));
    EXPECT_TRUE(said("spacemouse,speed=0.1").contains("write spacemouse:speed=0.1"));
    for (const std::string name : {"dhd:@", "wand:@", "omni:@", "wand:emulated@", "dhd:emulated@", "omni:emulated@"})
        EXPECT_FALSE(said(name).contains("cannot be loaded")) << said(name);
    for (const std::string name : {"dhd:@", "wand:@", "omni:@"})
        EXPECT_TRUE(said(name).contains("names no library behind @")) << said(name);
}

// sample@x was answered with sample:@x, and inverse3@localhost:1 with inverse3:@localhost:1, which are refused too.
TEST(HapticRegistry, NamesNoRemedyForAMissingColonThatItRefusesItself) {
    SimulatedClock clock;
    for (const HapticKind& kind : haptic_kinds()) {
        for (const std::string behind : {"@x", ",x", "=left", "@localhost:1", ",model=touch-x", ",speed=1", "@"}) {
            const std::string wrong = std::string(kind.name) + behind;
            const auto refused = open_haptic_device(wrong, host_of(clock));
            ASSERT_FALSE(refused) << wrong;
            const std::string& remedy = refused.error().remedy;
            if (!remedy.starts_with("write " + std::string(kind.name))) continue;  // an alternative in words
            const std::string right = remedy.substr(6, remedy.find(' ', 6) - 6);
            const auto again = open_haptic_device(right, host_of(clock));
            if (again) continue;
            const std::string line = again.error().line();
            // A simulated one says what it misses itself: a file of that name.
            EXPECT_TRUE(!kind.open.is_driver() || line.contains("time is simulated")) << wrong << ": " << line;
            EXPECT_FALSE(line.contains("takes no description") || line.contains("has no colon"))
                << wrong << ": " << line;
        }
        if (kind.takes_text) continue;
        const auto refused = open_haptic_device(std::string(kind.name) + ":x", host_of(clock));
        ASSERT_FALSE(refused) << kind.name;
        EXPECT_TRUE(refused.error().line().contains("write " + std::string(kind.name) + " alone"))
            << refused.error().line();
    }
}

// That they are there in real time alone was said first, which sent the user on to the next fault.
TEST(HapticRegistry, TellsAMisspeltTextBeforeThatTimeIsSimulated) {
    SimulatedClock clock;
    for (const auto& [name, said] : std::vector<std::pair<std::string, std::string>>{
             {"omni:,model=none", "has no model none"},
             {"dhd:,model=none", "has no model none"},
             {"dhd:x", "names no device"},
             {"wand:1@", "names no library behind @"},
             {"inverse3:@localhost:1", "names neither a device nor a service"},
             {"spacemouse:speed=nan", "'speed=nan' is no number of that setting"},
             {"spacemouse:,speed=1", "has nothing on one side of a comma"},
             {"spacemouse:w.toml", "write spacemouse-wand:w.toml"},
             {"spacemouse-wand:speed=x", "is no number of that setting"},
             {"glove", "names no port"}}) {
        const auto opened = open_haptic_device(name, host_of(clock));
        ASSERT_FALSE(opened) << name;
        EXPECT_TRUE(opened.error().line().contains(said)) << opened.error().line();
    }
}

}  // namespace burin::devices
