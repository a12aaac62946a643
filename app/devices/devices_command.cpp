// SPDX-License-Identifier: MIT
#include "app/devices/devices_command.hpp"

#include <algorithm>
#include <cstdio>
#include <optional>
#include <random>

#include "app/cli/output_files.hpp"
#include "app/devices/check_terminal.hpp"
#include "app/devices/device_check.hpp"
#include "base/clock.hpp"
#include "base/json.hpp"
#include "devices/emulators/circling_hand.hpp"
#include "devices/emulators/emulator_registry.hpp"
#include "devices/registry/device_registry.hpp"
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

Json described(const std::string& device, const std::vector<CheckLine>& lines) {
    const bool failed = !checks_with(Verdict::failed, lines).empty();
    const bool unclear = !failed && !checks_with(Verdict::unclear, lines).empty();
    Json list = Json::array();
    for (const CheckLine& line : lines)
        list.push_back({{"check", line.check},
                        {"verdict", name_of(line.verdict)},
                        {"found", line.found},
                        {"figures", line.figures}});
    return {{"device", device}, {"passed", !failed && !unclear}, {"cannot_tell", unclear}, {"checks", list}};
}

}  // namespace

struct DevicesCommand::Options {
    std::string json, emulated, tested, test_json;
    CheckOptions check;
    std::optional<double> watch_s;
    std::optional<std::uint64_t> seed;
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
    emulate_.option(
        "--at", options_->emulator.at,
        "Where it is found, HOST, PORT or HOST:PORT, or a name that begins with emulated; else its usual place");
    emulate_.option("--layout", options_->emulator.layout,
                    "Of a spacemouse's reports: split or joined, which is usual");
    emulate_.option("--seconds", options_->for_s, "End after so many; 0: when it is ended by a signal")
        .within(0.0, 86400.0)
        .show_default();
    emulate_
        .option("--silent-from", options_->emulator.silence.from_s,
                "A drill: is gone from so many seconds on, as a device whose cable is pulled; 0: never")
        .within(0.0, 86400.0);
    emulate_.option("--silent-for", options_->emulator.silence.for_s, "... for so many seconds; 0: for good")
        .within(0.0, 86400.0);
    test_ = command_.subcommand(
        "test", "A guided check of a force-feedback device: position, buttons, and a gentle force while a key is held");
    test_.option("NAME", options_->tested, "The device, as --device takes it").required();
    test_.option("--json", options_->test_json, "A file for the verdicts; - for standard output");
    test_.option("--force", options_->check.force_N, "The most that it taps with, in newtons")
        .within(0.1, 3.0)
        .show_default();
    test_
        .option("--seconds", options_->watch_s,
                "The longest that it waits for the handle's motion and for buttons; 60, or 15 with --yes")
        .within(0.1, 600.0);
    test_.flag("--yes", options_->check.by_itself,
               "Nobody is there: what is asked for counts as done, and the space bar as held. For emulated devices, or "
               "where somebody holds the handle");
    test_.option("--seed", options_->seed, "Of the order of the taps; else another each time, which is told");
    test_.flag("!--no-force", options_->check.pushes, "Try no force");
}

DevicesCommand::~DevicesCommand() = default;

Result<int> DevicesCommand::run() const {
    if (test_.parsed()) return test();
    const auto done = emulate_.parsed() ? emulate() : list();
    if (!done) return std::unexpected(done.error());
    return 0;
}

Result<void> DevicesCommand::list() const {
    if (const auto place = check_place(options_->json); !place) return place;
    const auto all = devices::look_for_devices();
    if (options_->json != kStandardOutput) print(all);
    return write_output(options_->json, json_text(described(all)));
}

Result<void> DevicesCommand::emulate() const {
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

Result<int> DevicesCommand::test() const {
    const std::string where = "burin devices test " + options_->tested;
    CheckOptions check = options_->check;
    check.watch_s = options_->watch_s.value_or(check.by_itself ? 15.0 : 60.0);
    check.seed = options_->seed ? *options_->seed : std::random_device{}();
    const auto nature = devices::nature_of_device(options_->tested, &session::session_recordings());
    if (!nature) return std::unexpected(nature.error());
    if (nature->is_played)
        return fail(where, "is a recording, which moves whatever is asked of it and takes no force",
                    "play it in a session: burin sculpt --device " + options_->tested);
    if (!check.by_itself && !TerminalGuide::is_there())
        return fail(where, "asks a person at a terminal, and there is none",
                    "run it in a terminal, or with --yes for a device that is emulated or held");
    if (const auto place = check_place(options_->test_json); !place) return std::unexpected(place.error());
    MonotonicClock clock;
    // Leads the handle of a simulated device as emulated ones are led.
    auto hand = devices::SimulatedHand::create(devices::circling_hand(), devices::HandPath::monotone_cubic);
    if (!hand) return std::unexpected(hand.error());
    auto device = devices::open_haptic_device(options_->tested, {clock, std::move(*hand)});
    if (!device) return std::unexpected(device.error());
    // The check is the haptic loop here; where real-time priority is refused it goes on without.
    static_cast<void>(haptics::ask_for_realtime());
    std::vector<CheckLine> lines;
    {
        TerminalGuide guide(options_->test_json == kStandardOutput, !check.by_itself);
        lines = check_device(*device, clock, guide, check);
    }
    if (const auto written = write_output(options_->test_json, json_text(described(options_->tested, lines))); !written)
        return std::unexpected(written.error());
    const auto outcome = outcome_of(where, lines);
    if (outcome && *outcome == kCannotTell)
        std::fprintf(stderr, "burin: %s: cannot tell: %s; the lines above say what to do, then try again\n",
                     where.c_str(), checks_with(Verdict::unclear, lines).c_str());
    return outcome;
}

}  // namespace burin::app
