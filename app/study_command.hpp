// SPDX-License-Identifier: MIT
// burin study: the figures of a study.
//   burin study analyse --data FILE.csv [--json OUT] [--out FOLDER]
#pragma once

#include <memory>

#include "app/command_line.hpp"
#include "base/error.hpp"

namespace burin::app {

class StudyCommand {
public:
    // Adds the command and its options; the command line must outlive the object.
    explicit StudyCommand(Command app);
    ~StudyCommand();
    StudyCommand(const StudyCommand&) = delete;
    StudyCommand& operator=(const StudyCommand&) = delete;

    [[nodiscard]] bool parsed() const;
    [[nodiscard]] Result<void> run() const;

private:
    struct Options;
    std::unique_ptr<Options> options_;
    Command command_;
    Command analyse_;
};

}  // namespace burin::app
