// SPDX-License-Identifier: MIT
// burin world: worlds of objects that are touched (docs/formats.md).
//   burin world FILE                           opens a world in a live session, with --workpiece beside a workpiece
//   burin world FILE --stroke STROKE           explores a world by a simulated hand (app/world/world_explore.hpp)
//   burin world FILE --stroke STROKE --device simulated-wand    the same with a wand (app/world/world_wand.hpp)
//   burin world check FILE... [--json OUT]     what is in each file, or all that is wrong with it; exit status 1 then
#pragma once

#include <memory>
#include <string>

#include "app/cli/command_line.hpp"
#include "base/error.hpp"

namespace burin::app {

class WorldCommand {
public:
    // Adds the command and its options; the command line must outlive the object.
    explicit WorldCommand(Command app);
    ~WorldCommand();
    WorldCommand(const WorldCommand&) = delete;
    WorldCommand& operator=(const WorldCommand&) = delete;

    [[nodiscard]] bool parsed() const;
    // Returns what is wrong with the usage, for exit status 2; empty where nothing is.
    [[nodiscard]] std::string misuse() const;
    [[nodiscard]] Result<void> run() const;

private:
    struct Options;
    std::unique_ptr<Options> options_;
    Command command_;
    Command check_;
};

}  // namespace burin::app
