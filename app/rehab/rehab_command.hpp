// SPDX-License-Identifier: MIT
// burin rehab NAME, burin rehab report: exercises of a hand in a glove (activities/rehab), with the therapist's
// settings of one file.
#pragma once

#include <memory>
#include <vector>

#include "app/cli/command_line.hpp"
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
    // An exercise's subcommand, with what it was given.
    struct Of;
    [[nodiscard]] Result<void> run(const Of& of) const;

    Command command_;
    std::vector<std::unique_ptr<Of>> exercises_;
    struct Report;
    std::unique_ptr<Report> report_;
};

}  // namespace burin::app
