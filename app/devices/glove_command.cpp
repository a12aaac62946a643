// SPDX-License-Identifier: MIT
#include "app/devices/glove_command.hpp"

#include <array>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>

#include "base/clock.hpp"
#include "base/try.hpp"
#include "devices/emulators/emulated_glove.hpp"
#include "session/drive/end_signals.hpp"

namespace burin::app {
namespace {

constexpr std::array kDeadNames{"thumb", "index", "middle", "ring"};

struct AskedGlove {
    devices::GloveMotion motion = devices::GloveMotion::closing;
    double for_s = 0.0, silent_from_s = 0.0, silent_for_s = 0.0;
    bool motors_off = false, in_pairs = false;
    unsigned version = 1;
    std::string dead;
};

Result<void> emulate_glove(const AskedGlove& asked) {
    if (asked.silent_for_s > 0.0 && asked.silent_from_s == 0.0)
        return fail("--silent-for", "says for how long, and nothing says from when on", "give --silent-from too");
    BURIN_TRY(port, devices::GlovePort::create());
    std::printf("%s\n", port.name().c_str());
    std::fflush(stdout);
    const session::EndSignals signals;
    MonotonicClock clock;
    const Nanoseconds begun_ns = clock.now_ns();
    const double for_s = asked.for_s;
    std::uint8_t dead = 0;
    for (std::size_t i = 0; i < kDeadNames.size(); ++i)
        if (asked.dead == kDeadNames[i]) dead = static_cast<std::uint8_t>(1u << i);
    port.run({.motion = asked.motion,
              .silent_from_s = asked.silent_from_s,
              .silent_for_s = asked.silent_for_s,
              .motors_on = !asked.motors_off,
              .in_pairs = asked.in_pairs,
              .dead = dead,
              .version = static_cast<std::uint8_t>(asked.version)},
             [&] { return signals.came() || (for_s > 0.0 && seconds(clock.now_ns() - begun_ns) >= for_s); });
    return {};
}

CommandAction add_glove_emulate(Command command) {
    const auto options = std::make_shared<AskedGlove>();
    command.choice("--motion", options->motion, "closing: its fingers close and open again; still: straight",
                   {{"closing", devices::GloveMotion::closing}, {"still", devices::GloveMotion::still}});
    command.option("--seconds", options->for_s, "End after so many; 0: when it is ended by a signal")
        .within(0.0, 86400.0)
        .show_default();
    command
        .option("--silent-from", options->silent_from_s,
                "A drill: send nothing from so many seconds on after a session has begun, as a glove whose cable is "
                "pulled; 0: never")
        .within(0.0, 86400.0);
    command.option("--silent-for", options->silent_for_s, "... for so many seconds; 0: for good").within(0.0, 86400.0);
    command.flag("--motors-off", options->motors_off, "A drill: the motors are off, and it says so");
    command.option("--dead", options->dead, "A drill: the piston of a finger gives nothing, whatever it is told")
        .one_of(kDeadNames);
    command.flag("--in-pairs", options->in_pairs,
                 "A drill: its sets come two at a time, as through an adapter that waits for 16 ms");
    command.option("--frames", options->version, "The version of its frames, 1 or 2: docs/glove.md")
        .within(std::uint64_t{1}, std::uint64_t{2})
        .show_default();
    return action([options] { return emulate_glove(*options); });
}

CommandAction add_glove(Command command) {
    command.require_subcommand();
    return add_commands(
        command, {{"emulate",
                   "A glove that is not there: prints the port on which a session finds it, and runs until it is ended",
                   add_glove_emulate}});
}

}  // namespace

CommandRow glove_row() { return {"glove", "A force-feedback glove on a serial line", add_glove}; }

}  // namespace burin::app
