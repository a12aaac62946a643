// SPDX-License-Identifier: MIT
#include "app/devices/glove_command.hpp"

#include <array>
#include <cstdint>
#include <cstdio>
#include <string>

#include "base/clock.hpp"
#include "devices/emulators/emulated_glove.hpp"
#include "session/drive/end_signals.hpp"

namespace burin::app {

namespace {

constexpr std::array kDeadNames{"thumb", "index", "middle", "ring"};

}  // namespace

struct GloveCommand::Options {
    devices::GloveMotion motion = devices::GloveMotion::closing;
    double for_s = 0.0, silent_from_s = 0.0, silent_for_s = 0.0;
    bool motors_off = false, in_pairs = false;
    unsigned version = 1;
    std::string dead;
    Command emulate;
};

GloveCommand::GloveCommand(Command app)
    : options_(std::make_unique<Options>()),
      command_(app.subcommand("glove", "A force-feedback glove on a serial line")) {
    command_.require_subcommand();
    options_->emulate = command_.subcommand(
        "emulate",
        "A glove that is not there: prints the port on which a session finds it, and runs until it is ended");
    options_->emulate.choice("--motion", options_->motion, "closing: its fingers close and open again; still: straight",
                             {{"closing", devices::GloveMotion::closing}, {"still", devices::GloveMotion::still}});
    options_->emulate.option("--seconds", options_->for_s, "End after so many; 0: when it is ended by a signal")
        .within(0.0, 86400.0)
        .show_default();
    options_->emulate
        .option("--silent-from", options_->silent_from_s,
                "A drill: send nothing from so many seconds on after a session has begun, as a glove whose cable is "
                "pulled; 0: never")
        .within(0.0, 86400.0);
    options_->emulate.option("--silent-for", options_->silent_for_s, "... for so many seconds; 0: for good")
        .within(0.0, 86400.0);
    options_->emulate.flag("--motors-off", options_->motors_off, "A drill: the motors are off, and it says so");
    options_->emulate
        .option("--dead", options_->dead, "A drill: the piston of a finger gives nothing, whatever it is told")
        .one_of(kDeadNames);
    options_->emulate.flag("--in-pairs", options_->in_pairs,
                           "A drill: its sets come two at a time, as through an adapter that waits for 16 ms");
    options_->emulate.option("--frames", options_->version, "The version of its frames, 1 or 2: docs/glove.md")
        .within(std::uint64_t{1}, std::uint64_t{2})
        .show_default();
}

GloveCommand::~GloveCommand() = default;

bool GloveCommand::parsed() const { return command_.parsed(); }

Result<void> GloveCommand::run() const {
    if (options_->silent_for_s > 0.0 && options_->silent_from_s == 0.0)
        return fail("--silent-for", "says for how long, and nothing says from when on", "give --silent-from too");
    auto port = devices::GlovePort::create();
    if (!port) return std::unexpected(port.error());
    std::printf("%s\n", port->name().c_str());
    std::fflush(stdout);
    const session::EndSignals signals;
    MonotonicClock clock;
    const Nanoseconds begun_ns = clock.now_ns();
    const double for_s = options_->for_s;
    std::uint8_t dead = 0;
    for (std::size_t i = 0; i < kDeadNames.size(); ++i)
        if (options_->dead == kDeadNames[i]) dead = static_cast<std::uint8_t>(1u << i);
    port->run({.motion = options_->motion,
               .silent_from_s = options_->silent_from_s,
               .silent_for_s = options_->silent_for_s,
               .motors_on = !options_->motors_off,
               .in_pairs = options_->in_pairs,
               .dead = dead,
               .version = static_cast<std::uint8_t>(options_->version)},
              [&] { return signals.came() || (for_s > 0.0 && seconds(clock.now_ns() - begun_ns) >= for_s); });
    return {};
}

}  // namespace burin::app
