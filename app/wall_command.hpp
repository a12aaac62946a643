// SPDX-License-Identifier: MIT
// burin wall: what a wall file says, whether it makes sense, and how to measure a screen.
//   burin wall show FILE [--svg OUT] [--json OUT]
//   burin wall check FILE                                         exit status 1 when there is an error
//   burin wall calibrate --wall FILE --samples CSV --screen NAME --out FILE
#pragma once

#include <memory>

#include "app/command_line.hpp"
#include "base/error.hpp"

namespace burin {

class WallCommand {
public:
    // Adds the command and its options; the command line must outlive the object.
    explicit WallCommand(Command app);
    ~WallCommand();
    WallCommand(const WallCommand&) = delete;
    WallCommand& operator=(const WallCommand&) = delete;

    [[nodiscard]] bool parsed() const;
    [[nodiscard]] Result<void> run() const;

private:
    struct Options;
    std::unique_ptr<Options> options_;
    Command command_;
    Command show_;
    Command check_;
};

}  // namespace burin
