// SPDX-License-Identifier: MIT
// burin glove emulate: a force-feedback glove that is not there, on a pseudo-terminal.
#pragma once

#include <memory>

#include "app/cli/command_line.hpp"
#include "base/error.hpp"

namespace burin::app {

class GloveCommand {
public:
    // Adds the command and its options; the command line must outlive the object.
    explicit GloveCommand(Command app);
    ~GloveCommand();
    GloveCommand(const GloveCommand&) = delete;
    GloveCommand& operator=(const GloveCommand&) = delete;

    [[nodiscard]] bool parsed() const;
    [[nodiscard]] Result<void> run() const;

private:
    struct Options;
    std::unique_ptr<Options> options_;
    Command command_;
};

}  // namespace burin::app
