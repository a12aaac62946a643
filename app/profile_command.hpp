// SPDX-License-Identifier: MIT
// burin profile: a session from an input log, in real time with a live session's threads, and what its frames and ticks took.
//   burin profile [--input LOG] [--window] [--driver-threads 0,1,2] [--json OUT]
#pragma once

#include <memory>

#include "app/command_line.hpp"
#include "base/error.hpp"

namespace burin {

class ProfileCommand {
public:
    // Adds the command and its options; the command line must outlive the object.
    explicit ProfileCommand(Command app);
    ~ProfileCommand();
    ProfileCommand(const ProfileCommand&) = delete;
    ProfileCommand& operator=(const ProfileCommand&) = delete;

    [[nodiscard]] bool parsed() const;
    [[nodiscard]] Result<void> run() const;

private:
    struct Options;
    std::unique_ptr<Options> options_;
    Command command_;
};

}  // namespace burin
