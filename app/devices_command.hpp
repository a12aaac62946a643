// SPDX-License-Identifier: MIT
// burin devices: which devices and trackers there are, and why others are not; and emulators of them.
#pragma once

#include <memory>

#include "app/command_line.hpp"
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
    [[nodiscard]] Result<void> run() const;

private:
    struct Options;
    std::unique_ptr<Options> options_;
    Command command_, emulate_;
};

}  // namespace burin::app
