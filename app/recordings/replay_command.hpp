// SPDX-License-Identifier: MIT
// burin replay: does a recording again (docs/formats.md, "Replaying").
//   burin replay FILE                   computes every tick again from what is stored, and compares every column bit
//                                       for bit; exit status 1 and the first difference where one differs
//   burin replay FILE --through WORLD   feels the stored motion in a world: a derived table in FILE. Computed again, it
//                                       is compared with the one that is there
#pragma once

#include <memory>
#include <string>

#include "app/cli/command_line.hpp"
#include "base/error.hpp"

namespace burin::app {

class ReplayCommand {
public:
    // Adds the command and its options; the command line must outlive the object.
    explicit ReplayCommand(Command app);
    ~ReplayCommand();
    ReplayCommand(const ReplayCommand&) = delete;
    ReplayCommand& operator=(const ReplayCommand&) = delete;

    [[nodiscard]] bool parsed() const;
    // Returns what is wrong with the usage, for exit status 2; empty where nothing is.
    [[nodiscard]] std::string misuse() const;
    [[nodiscard]] Result<void> run() const;

private:
    struct Options;
    std::unique_ptr<Options> options_;
    Command command_;
};

}  // namespace burin::app
