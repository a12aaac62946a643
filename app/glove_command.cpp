// SPDX-License-Identifier: MIT
#include "app/glove_command.hpp"

#include <cstdio>

#include "base/clock.hpp"
#include "devices/emulators/emulated_glove.hpp"
#include "session/drive/end_signals.hpp"

namespace burin::app {

struct GloveCommand::Options {
    devices::GloveMotion motion = devices::GloveMotion::closing;
    double for_s = 0.0, silent_from_s = 0.0, silent_for_s = 0.0;
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
    port->run(
        {.motion = options_->motion, .silent_from_s = options_->silent_from_s, .silent_for_s = options_->silent_for_s},
        [&] { return signals.came() || (for_s > 0.0 && seconds(clock.now_ns() - begun_ns) >= for_s); });
    return {};
}

}  // namespace burin::app
