// SPDX-License-Identifier: MIT
// burin session: session files, which --record writes (docs/formats.md, "Session files").
//   burin session info FILE [--json OUT]       hands, columns, ticks, gaps, clocks, versions
//   burin session check FILE                   reads all of it and names what is damaged; exit status 1 then
//   burin session compare A B [--columns ...]  the first difference by tick, column and both values; exit status 1 then
#pragma once

#include <memory>
#include <string>

#include "app/cli/command_line.hpp"
#include "app/cli/commands.hpp"
#include "base/error.hpp"

namespace burin::app {

class SessionCommand {
public:
    // Adds the command and its options; the command line must outlive the object.
    explicit SessionCommand(Command app);
    ~SessionCommand();
    SessionCommand(const SessionCommand&) = delete;
    SessionCommand& operator=(const SessionCommand&) = delete;

    [[nodiscard]] bool parsed() const;
    [[nodiscard]] Result<void> run() const;

private:
    struct Options;
    std::unique_ptr<Options> options_;
    Command command_;
    Command info_, check_;
};

// burin convert FILE.session [OUT] --to csv|npy|hdf5|mat|bids|log [--columns LIST] [--part NAME]: the ticks of one
// hand, or a derived table. OUT must be new. Damaged blocks are left out and named; then it fails, with the rest
// written.
[[nodiscard]] Result<void> convert_session(const ConvertOptions& options);

}  // namespace burin::app
