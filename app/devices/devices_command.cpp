// SPDX-License-Identifier: MIT
#include "app/devices/devices_command.hpp"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <optional>
#include <random>
#include <string>

#include "app/cli/output_files.hpp"
#include "app/devices/check_terminal.hpp"
#include "base/clock.hpp"
#include "base/json.hpp"
#include "base/try.hpp"
#include "bench/devices/device_check.hpp"
#include "devices/emulators/circling_hand.hpp"
#include "devices/emulators/emulator_registry.hpp"
#include "devices/registry/device_nature.hpp"
#include "devices/registry/device_registry.hpp"
#include "devices/registry/haptic_host.hpp"
#include "devices/registry/present_devices.hpp"
#include "haptics/realtime.hpp"
#include "session/drive/end_signals.hpp"
#include "session/record/recordings.hpp"

namespace burin::app {
namespace {

Json described(const std::vector<devices::LookedForKind>& all) {
    Json list = Json::array();
    for (const devices::LookedForKind& kind : all)
        for (const devices::DevicePresence& one : kind.found)
            list.push_back({{"name", one.name},
                            {"option", kind.option},
                            {"state", devices::name_of(one.presence)},
                            {"cause", one.cause},
                            {"remedy", one.remedy},
                            {"usage", kind.usage}});
    return {{"devices", list}};
}

void print(const std::vector<devices::LookedForKind>& all) {
    for (const devices::LookedForKind& kind : all)
        for (const devices::DevicePresence& one : kind.found) {
            std::printf("%-9s  %s%s%s: %s\n", devices::name_of(one.presence), std::string(kind.option).c_str(),
                        one.name.empty() ? "" : " ", one.name.c_str(), one.cause.c_str());
            if (!one.remedy.empty()) std::printf("           -> %s\n", one.remedy.c_str());
        }
}

Json described(const std::string& device, const std::vector<bench::CheckLine>& lines) {
    const bool failed = !bench::checks_with(bench::Verdict::failed, lines).empty();
    const bool unclear = !failed && !bench::checks_with(bench::Verdict::unclear, lines).empty();
    Json list = Json::array();
    for (const bench::CheckLine& line : lines)
        list.push_back({{"check", line.check},
                        {"verdict", bench::name_of(line.verdict)},
                        {"found", line.found},
                        {"figures", line.figures}});
    return {{"device", device}, {"passed", !failed && !unclear}, {"cannot_tell", unclear}, {"checks", list}};
}

Result<void> list_devices(const std::string& json) {
    BURIN_TRY_DO(check_place(json));
    const auto all = devices::look_for_devices();
    if (json != kStandardOutput) print(all);
    return write_output(json, json_text(described(all)));
}

struct AskedEmulator {
    std::string name;
    devices::EmulatorOptions emulator;
    double for_s = 0.0;
};

Result<void> emulate_device(const AskedEmulator& asked) {
    if (asked.emulator.silence.for_s > 0.0 && asked.emulator.silence.from_s == 0.0)
        return fail("--silent-for", "says for how long, and nothing says from when on", "give --silent-from too");
    const session::EndSignals signals;
    MonotonicClock clock;
    const Nanoseconds begun_ns = clock.now_ns();
    devices::EmulatorOptions options = asked.emulator;
    options.ends = [&] {
        return signals.came() || (asked.for_s > 0.0 && seconds(clock.now_ns() - begun_ns) >= asked.for_s);
    };
    options.is_there = [](const std::string& how) {
        std::printf("%s\n", how.c_str());
        std::fflush(stdout);
    };
    return devices::run_emulator(asked.name, options);
}

CommandAction add_devices_emulate(Command command) {
    const auto options = std::make_shared<AskedEmulator>();
    command.option("NAME", options->name, devices::emulator_usage()).required();
    command.option(
        "--at", options->emulator.at,
        "Where it is found, HOST, PORT or HOST:PORT, or a name that begins with emulated; else its usual place");
    command.option("--layout", options->emulator.layout, "Of a spacemouse's reports: split or joined, which is usual");
    command.option("--seconds", options->for_s, "End after so many; 0: when it is ended by a signal")
        .within(0.0, 86400.0)
        .show_default();
    command
        .option("--silent-from", options->emulator.silence.from_s,
                "A drill: is gone from so many seconds on, as a device whose cable is pulled; 0: never")
        .within(0.0, 86400.0);
    command.option("--silent-for", options->emulator.silence.for_s, "... for so many seconds; 0: for good")
        .within(0.0, 86400.0);
    return action([options] { return emulate_device(*options); });
}

struct AskedCheck {
    std::string device, json;
    bench::CheckOptions check;
    std::optional<double> watch_s;
    std::optional<std::uint64_t> seed;
};

Result<int> test_device(const AskedCheck& asked) {
    const std::string where = "burin devices test " + asked.device;
    bench::CheckOptions check = asked.check;
    check.watch_s = asked.watch_s.value_or(check.by_itself ? 15.0 : 60.0);
    check.seed = asked.seed ? *asked.seed : std::random_device{}();
    BURIN_TRY(nature, devices::nature_of_device(asked.device, &session::session_recordings()));
    if (nature.is_played)
        return fail(where, "is a recording, which moves whatever is asked of it and takes no force",
                    "play it in a session: burin sculpt --device " + asked.device);
    if (!check.by_itself && !TerminalGuide::is_there())
        return fail(where, "asks a person at a terminal, and there is none",
                    "run it in a terminal, or with --yes for a device that is emulated or held");
    BURIN_TRY_DO(check_place(asked.json));
    MonotonicClock clock;
    // Leads the handle of a simulated device as emulated ones are led.
    BURIN_TRY(hand, devices::SimulatedHand::create(devices::circling_hand(), devices::HandPath::monotone_cubic));
    BURIN_TRY(device, devices::open_haptic_device(asked.device, {clock, std::move(hand)}));
    // The check is the haptic loop here; where real-time priority is refused it goes on without.
    static_cast<void>(haptics::ask_for_realtime());
    std::vector<bench::CheckLine> lines;
    {
        TerminalGuide guide(asked.json == kStandardOutput, !check.by_itself);
        lines = bench::check_device(device, clock, guide, check);
    }
    BURIN_TRY_DO(write_output(asked.json, json_text(described(asked.device, lines))));
    const auto outcome = bench::outcome_of(where, lines);
    if (outcome && *outcome == bench::kCannotTell)
        std::fprintf(stderr, "burin: %s: cannot tell: %s; the lines above say what to do, then try again\n",
                     where.c_str(), bench::checks_with(bench::Verdict::unclear, lines).c_str());
    return outcome;
}

CommandAction add_devices_test(Command command) {
    const auto options = std::make_shared<AskedCheck>();
    command.option("NAME", options->device, "The device, as --device takes it").required();
    command.option("--json", options->json, "A file for the verdicts; - for standard output");
    command.option("--force", options->check.force_N, "The most that it taps with, in newtons")
        .within(0.1, 3.0)
        .show_default();
    command
        .option("--seconds", options->watch_s,
                "The longest that it waits for the handle's motion and for buttons; 60, or 15 with --yes")
        .within(0.1, 600.0);
    command.flag(
        "--yes", options->check.by_itself,
        "Nobody is there: what is asked for counts as done, and the space bar as held. For emulated devices, or "
        "where somebody holds the handle");
    command.option("--seed", options->seed, "Of the order of the taps; else another each time, which is told");
    command.flag("!--no-force", options->check.pushes, "Try no force");
    return action([options] { return test_device(*options); });
}

CommandAction add_devices(Command command) {
    const auto json = std::make_shared<std::string>();
    command.option("--json", *json, "A file for the list; - for standard output");
    return add_commands(
        command,
        {{"emulate", "A device that is not there: prints how a session finds it, and runs until it is ended",
          add_devices_emulate},
         {"test",
          "A guided check of a force-feedback device: position, buttons, and a gentle force while a key is held",
          add_devices_test}},
        action([json] { return list_devices(*json); }));
}

}  // namespace

CommandRow devices_row() {
    return {"devices", "Which devices and trackers there are, and why others are not", add_devices};
}

}  // namespace burin::app
