// SPDX-License-Identifier: MIT
// burin demo: carves an ornament into a ball by a simulated hand, without a device or a display, from files that come
// with the program, in any working folder; burin demo world, study, hand likewise.
// burin demo wand --out DIR: the cube test of the wand thesis, with pictures, plots and a table; exit status 1 where a
// force or a torque has another sign than the thesis says (activities/wand/cube_test.hpp).
#pragma once

#include <memory>

#include "app/cli/command_line.hpp"
#include "base/error.hpp"

namespace burin::app {

class DemoCommand {
public:
    // Adds the command and its options; the command line must outlive the object.
    explicit DemoCommand(Command app);
    ~DemoCommand();
    DemoCommand(const DemoCommand&) = delete;
    DemoCommand& operator=(const DemoCommand&) = delete;

    [[nodiscard]] bool parsed() const;
    [[nodiscard]] Result<void> run() const;

private:
    struct Options;
    std::unique_ptr<Options> options_;
    Command command_, world_, study_, hand_, wand_;
};

}  // namespace burin::app
