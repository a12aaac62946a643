// SPDX-License-Identifier: MIT
// burin bench: what Burin does in numbers (bench/), as tables, JSON, CSV and a figure.
//   burin bench stroke     one engine and resolution through STROKE-1000, with every figure
//   burin bench pareto     time against error over resolutions, engines and peers
//   burin bench haptics    what a tick costs, and how true the proxy is
//   burin bench stability  how stiff a wall may be before a simulated device shakes
//   burin bench workspace  each workspace technique across the wall, in a simulated hand
//   burin bench record     what it costs to keep every tick
//   burin bench document   what it costs to keep the work: journal, save, open, size
//   burin bench study      a whole simulated study against real time
//   burin bench world      from a VRML world's text to its triangles, beside Coin
#pragma once

#include <memory>
#include <vector>

#include "app/cli/commands.hpp"

namespace burin::app {

class BenchCommand {
public:
    // Adds the command and its options; the command line must outlive the object.
    explicit BenchCommand(Command app);
    ~BenchCommand();
    BenchCommand(const BenchCommand&) = delete;
    BenchCommand& operator=(const BenchCommand&) = delete;

    [[nodiscard]] bool parsed() const;
    // What was asked for. Places for output are looked at before the first long step.
    [[nodiscard]] Result<void> run() const;

private:
    struct Options;
    std::unique_ptr<Options> options_;
    Command command_;
    Command stroke_;
    Command pareto_;
    std::vector<BenchSubcommand> others_;
};

}  // namespace burin::app
