// SPDX-License-Identifier: MIT
// The emulators that `burin devices emulate NAME` runs, in a terminal beside a session's: each stands in for a device
// and speaks as that device does, so that the real driver is at work. To add one, enter it in the table of
// emulator_registry.cpp; the command's help reads that table.
// Thread: the one that calls.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "base/error.hpp"
#include "devices/emulators/emulated_motion.hpp"

namespace burin::devices {

struct EmulatorOptions {
    std::string at;      // address or port where it is found, as it spells it; empty: its usual one
    std::string layout;  // of its reports, where there are several; empty: its usual one
    SilenceDrill silence;
    std::function<bool()> ends;
    // Told once, when the emulator can be found: how a session is started with it, such as "--device glove:/dev/pts/3".
    std::function<void(const std::string& how)> is_there;
};

struct EmulatorKind {
    std::string_view name;   // as the command spells it
    std::string_view usage;  // what it is, for the help
    Result<void> (*run)(const EmulatorOptions& options);
    bool has_layouts = false;
};
[[nodiscard]] std::span<const EmulatorKind> emulator_kinds();
// Runs the emulator of that name until it is to end. An Error names those that there are, or says why it cannot run.
[[nodiscard]] Result<void> run_emulator(std::string_view name, const EmulatorOptions& options);
// Returns all names with what they are, for the help.
[[nodiscard]] std::string emulator_usage();

}  // namespace burin::devices
