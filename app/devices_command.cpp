// SPDX-License-Identifier: MIT
#include "app/devices_command.hpp"

#include <cstdio>

#include "app/output_files.hpp"
#include "base/clock.hpp"
#include "base/json.hpp"
#include "devices/emulators/emulator_registry.hpp"
#include "devices/registry/present_devices.hpp"
#include "session/drive/end_signals.hpp"

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
            std::printf("%-9s  %s %s: %s\n", devices::name_of(one.presence), std::string(kind.option).c_str(),
                        one.name.c_str(), one.cause.c_str());
            if (!one.remedy.empty()) std::printf("           -> %s\n", one.remedy.c_str());
        }
}

}  // namespace

struct DevicesCommand::Options {
    std::string json, emulated;
    devices::EmulatorOptions emulator;
    double for_s = 0.0;
};

DevicesCommand::DevicesCommand(Command app)
    : options_(std::make_unique<Options>()),
      command_(app.subcommand("devices", "Which devices and trackers there are, and why others are not")) {
    command_.option("--json", options_->json, "A file for the list; - for standard output");
    emulate_ = command_.subcommand(
        "emulate", "A device that is not there: prints how a session finds it, and runs until it is ended");
    emulate_.option("NAME", options_->emulated, devices::emulator_usage()).required();
    emulate_.option("--at", options_->emulator.at, "Where it is found, HOST, PORT or HOST:PORT; else its usual place");
    emulate_.option("--seconds", options_->for_s, "End after so many; 0: when it is ended by a signal")
        .within(0.0, 86400.0)
        .show_default();
    emulate_
        .option("--silent-from", options_->emulator.silence.from_s,
                "A drill: is gone from so many seconds on, as a device whose cable is pulled; 0: never")
        .within(0.0, 86400.0);
    emulate_.option("--silent-for", options_->emulator.silence.for_s, "... for so many seconds; 0: for good")
        .within(0.0, 86400.0);
}

DevicesCommand::~DevicesCommand() = default;

Result<void> DevicesCommand::run() const {
    if (!emulate_.parsed()) {
        if (const auto place = check_place(options_->json); !place) return place;
        const auto all = devices::look_for_devices();
        if (options_->json != kStandardOutput) print(all);
        return write_output(options_->json, json_text(described(all)));
    }
    if (options_->emulator.silence.for_s > 0.0 && options_->emulator.silence.from_s == 0.0)
        return fail("--silent-for", "says for how long, and nothing says from when on", "give --silent-from too");
    const session::EndSignals signals;
    MonotonicClock clock;
    const Nanoseconds begun_ns = clock.now_ns();
    devices::EmulatorOptions options = options_->emulator;
    options.ends = [&] {
        return signals.came() || (options_->for_s > 0.0 && seconds(clock.now_ns() - begun_ns) >= options_->for_s);
    };
    options.is_there = [](const std::string& how) {
        std::printf("%s\n", how.c_str());
        std::fflush(stdout);
    };
    return devices::run_emulator(options_->emulated, options);
}

}  // namespace burin::app
