// SPDX-License-Identifier: MIT
// burin devices, by the command line.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "base/json.hpp"
#include "desk/panel/device_look.hpp"
#include "devices/emulators/emulator_registry.hpp"
#include "devices/registry/device_registry.hpp"
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

}  // namespace
}  // namespace burin::app
