// SPDX-License-Identifier: MIT
// burin devices, by the command line: the list of what there is, and the guided check against emulated devices.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "base/json.hpp"
#include "desk/panel/device_look.hpp"
#include "devices/emulators/emulator_registry.hpp"
#include "devices/registry/device_registry.hpp"
#include "devices/registry/haptic_kinds.hpp"
#include "devices/registry/present_devices.hpp"
#include "devices/trackers/tracker.hpp"
#include "tests/support/places.hpp"
#include "tests/support/run_command.hpp"

namespace burin::app {
namespace {

// Each has a remedy where something is missing, and a cause always.
TEST(DevicesCommand, ListsEveryDeviceAndTrackerWithItsCauseInTextAndJson) {
    const Workplace at;
    const std::string burin = kBurinCommand;
    const auto text = at.run(burin + " devices --json list.json");
    ASSERT_EQ(text.status, 0) << text.output;
    const Json list = Json::parse(at.read("list.json"))["devices"];
    const auto is_listed = [&](std::string_view name, std::string_view option) {
        for (const Json& one : list)
            if (one["name"].get<std::string>().starts_with(name) && one["option"] == option) return true;
        return false;
    };
    for (const auto& kind : devices::haptic_kinds()) EXPECT_TRUE(is_listed(kind.name, "--device")) << kind.name;
    for (const auto& kind : devices::tracker_kinds()) EXPECT_TRUE(is_listed(kind.scheme, "--tracker")) << kind.scheme;
    for (const Json& one : list) {
        EXPECT_FALSE(one["cause"].get<std::string>().empty()) << one;
        EXPECT_TRUE(text.output.contains(one["cause"].get<std::string>())) << one;
        EXPECT_TRUE(text.output.contains(one["state"].get<std::string>())) << one;
        const bool is_there = one["state"] == "there" || one["state"] == "perhaps";
        EXPECT_TRUE(is_there || !one["remedy"].get<std::string>().empty()) << one;
    }
    const auto standard = at.run(burin + " devices --json -");
    EXPECT_EQ(standard.status, 0);
    EXPECT_EQ(Json::parse(standard.output)["devices"].size(), list.size()) << "and nothing else on standard output";
}

TEST(DevicesCommand, EmulatesWhatItsHelpListsAndSaysWhatItDoesNot) {
    const Workplace at;
    const std::string burin = kBurinCommand;
    const auto help = at.run(burin + " devices emulate --help");
    for (const auto& kind : devices::emulator_kinds()) EXPECT_TRUE(help.output.contains(kind.name)) << kind.name;
    const auto unknown = at.run(burin + " devices emulate vprn");
    EXPECT_EQ(unknown.status, 1);
    EXPECT_TRUE(unknown.output.contains("did you mean vrpn?")) << unknown.output;
    const auto nothing = at.run(burin + " devices emulate");
    EXPECT_EQ(nothing.status, 2);
    EXPECT_TRUE(nothing.output.contains("see burin devices emulate --help")) << nothing.output;
    EXPECT_TRUE(at.run(burin + " devices emulate vrpn --silent-for 1").output.contains("give --silent-from too"));
    const auto glove = at.run(burin + " devices emulate glove --seconds 0.2");
    EXPECT_EQ(glove.status, 0);
    EXPECT_TRUE(glove.output.starts_with("--device glove:/dev/pts/")) << glove.output;
    const auto vrpn = at.run(burin + " devices emulate vrpn --at 0 --seconds 0.2");
    EXPECT_EQ(vrpn.status, 0);
    EXPECT_TRUE(vrpn.output.starts_with("--tracker vrpn:127.0.0.1:")) << vrpn.output;
}

std::vector<std::string> lines_of(const std::vector<session::PanelDevice>& page) {
    std::vector<std::string> lines;
    for (const session::PanelDevice& one : page)
        lines.push_back(one.option + "|" + one.name + "|" + one.state + "|" + one.cause + "|" + one.remedy);
    return lines;
}

std::vector<std::string> lines_of(const Json& list) {
    std::vector<std::string> lines;
    for (const Json& one : list) {
        std::string line;
        for (const char* key : {"option", "name", "state", "cause", "remedy"})
            line += (line.empty() ? "" : "|") + one[key].get<std::string>();
        lines.push_back(line);
    }
    return lines;
}

// The program looks in a process of its own. An emulator that somebody else starts or ends between the two looks shows
// in one alone: then both look again.
TEST(DevicesCommand, SaysTheSameAsThePanelsPage) {
    const Workplace at;
    std::vector<std::string> listed, shown;
    for (int i = 0; i < 5 && (i == 0 || listed != shown); ++i) {
        const auto json = at.run(std::string(kBurinCommand) + " devices --json -");
        ASSERT_EQ(json.status, 0) << json.output;
        listed = lines_of(Json::parse(json.output)["devices"]);
        shown = lines_of(session::panel_devices(devices::look_for_devices()));
    }
    EXPECT_GE(listed.size(), devices::haptic_kinds().size() + devices::tracker_kinds().size());
    EXPECT_EQ(listed, shown);
}

TEST(DeviceCheck, TheCommandPassesASimulatedGloveAWandAndASpaceMouse) {
    const Workplace at;
    const std::string burin = kBurinCommand;
    const auto glove = at.run(burin + " devices test simulated-glove --yes");
    EXPECT_EQ(glove.status, 0) << glove.output;
    EXPECT_TRUE(glove.output.contains("skipped  force of thumb: its simulated fingers")) << glove.output;
    for (const std::string kind : {"wand", "spacemouse"}) {
        // A busy machine may keep the emulator or the check from its steps for so long that the device rightly fails.
        const auto tested =
            at.run("(" + burin + " devices emulate " + kind + " --seconds 120 --at emulated-one-$$ > " + kind +
                   ".txt &) ; while ! test -s " + kind + ".txt; do sleep 0.05; done; " + burin + " devices test " +
                   kind + ":emulated-one-$$ --yes || " + burin + " devices test " + kind + ":emulated-one-$$ --yes");
        EXPECT_EQ(tested.status, 0) << tested.output;
        EXPECT_TRUE(tested.output.contains(kind == "wand" ? "skipped  buttons: it has none" : "passed   buttons: seen"))
            << tested.output;
    }
}

TEST(DeviceCheck, TheCommandPassesEveryEmulatedArmWithVerdictsAsJson) {
    const Workplace at;
    const std::string burin = kBurinCommand;
    // Side by side, as each takes half a minute; once more where a busy machine kept one from its steps for too long.
    const auto tested =
        at.run("for k in omni falcon dhd inverse3; do (" + burin +
               " devices emulate $k --seconds 120 --at emulated-check-$$ > $k.txt &) ; while ! test -s "
               "$k.txt; do sleep 0.05; done; (" +
               burin + " devices test $k:emulated-check-$$ --yes --json $k.json > $k.said || " + burin +
               " devices test $k:emulated-check-$$ --yes --json $k.json > $k.said; echo $? > $k.status) & "
               "done; wait");
    EXPECT_EQ(tested.status, 0) << tested.output;
    for (const std::string kind : {"omni", "falcon", "dhd", "inverse3"}) {
        const std::string said = at.read(kind + ".said");
        EXPECT_EQ(at.read(kind + ".status"), "0\n") << said;
        const Json found = Json::parse(at.read(kind + ".json"));
        EXPECT_TRUE(found["passed"].get<bool>());
        EXPECT_EQ(found["checks"].size(), 7u);
        for (const Json& check : found["checks"])
            EXPECT_TRUE(said.contains(check["found"].get<std::string>())) << check;
    }
}

TEST(DeviceCheck, TheCommandFailsWhereADeviceIsPulledAndSaysWhatItNeeds) {
    const Workplace at;
    const std::string burin = kBurinCommand;
    // Once the check has seen the device the emulator is killed, however long either took to get there.
    const auto pulled = at.run("(" + burin +
                               " devices emulate falcon --at emulated-pulled-$$ > f.txt & emulator=$!; while ! test -s "
                               "f.txt; do sleep 0.05; done; " +
                               burin +
                               " devices test falcon:emulated-pulled-$$ --yes --seconds 2 > said.txt 2>&1 & check=$!; "
                               "while ! grep -q answers said.txt && kill -0 $check; do sleep 0.05; done; kill -9 "
                               "$emulator; wait $check; status=$?; cat said.txt; exit $status)");
    EXPECT_EQ(pulled.status, 1);
    EXPECT_TRUE(pulled.output.contains("failed   position")) << pulled.output;
    EXPECT_TRUE(pulled.output.contains("is gone: see that its cable and its power are plugged in")) << pulled.output;
    const auto nobody = at.run(burin + " devices test simulated < /dev/null");
    EXPECT_EQ(nobody.status, 1);
    EXPECT_TRUE(nobody.output.contains("asks a person at a terminal, and there is none")) << nobody.output;
    EXPECT_EQ(at.run(burin + " devices test simulated --yes --force 50").status, 2);
    EXPECT_TRUE(at.run(burin + " devices test nosuch --yes").output.contains("is no device that Burin knows"));
}

}  // namespace
}  // namespace burin::app
