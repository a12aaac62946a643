// SPDX-License-Identifier: MIT
// burin rehab ball: exercises of a hand in a glove (activities/rehab), with the therapist's settings of one file.
#pragma once

#include <memory>

#include "app/command_line.hpp"
#include "base/error.hpp"

namespace burin::app {

class RehabCommand {
public:
    // Adds the command and its options; the command line must outlive the object.
    explicit RehabCommand(Command app);
    ~RehabCommand();
    RehabCommand(const RehabCommand&) = delete;
    RehabCommand& operator=(const RehabCommand&) = delete;

    [[nodiscard]] bool parsed() const { return command_.parsed(); }
    [[nodiscard]] Result<void> run() const;

private:
    struct Options;
    std::unique_ptr<Options> options_;
    Command command_, ball_;
};

}  // namespace burin::app
