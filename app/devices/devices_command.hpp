// SPDX-License-Identifier: MIT
// burin devices: which devices and trackers there are, and why others are not; emulators of them; and a guided check of
// a force-feedback device.
#pragma once

#include <memory>

#include "app/cli/command_line.hpp"
#include "base/error.hpp"

namespace burin::app {

class DevicesCommand {
public:
    // Adds the command and its options; the command line must outlive the object.
    explicit DevicesCommand(Command app);
    ~DevicesCommand();
    DevicesCommand(const DevicesCommand&) = delete;
    DevicesCommand& operator=(const DevicesCommand&) = delete;

    [[nodiscard]] bool parsed() const { return command_.parsed(); }
    // Returns the exit status: 0, or kCannotTell of a check (app/devices/device_check.hpp).
    [[nodiscard]] Result<int> run() const;

private:
    [[nodiscard]] Result<void> list() const;
    [[nodiscard]] Result<void> emulate() const;
    [[nodiscard]] Result<int> test() const;

    struct Options;
    std::unique_ptr<Options> options_;
    Command command_, emulate_, test_;
};

}  // namespace burin::app
