// SPDX-License-Identifier: MIT
// Checks and writes what the commands put out: meshes, reports, tables and figures. Places are checked before the first
// long step, so that hours of work do not end at a missing folder. Files are written as base/file_io.hpp writes them.
#pragma once

#include <span>
#include <string>

#include "base/error.hpp"
#include "base/json.hpp"

namespace burin::app {

inline constexpr const char* kStandardOutput = "-";

// Checks whether a file can be written there. Nothing to check for standard output and for an empty path, where no file
// is wanted.
[[nodiscard]] Result<void> check_place(const std::string& path);

// Makes the folder of a file that will be written; nothing to make for standard output and for an empty path.
[[nodiscard]] Result<void> make_folder_of(const std::string& path);

// Checks whether all these files can be written, each to a place of its own and none over one of the inputs
// (session/record/input_files.hpp), by whatever path; a file that is still to be made counts as well. Standard output
// and empty paths need no check.
[[nodiscard]] Result<void> check_places(std::span<const std::string> outputs, std::span<const std::string> inputs = {});
// Checks meshes of a known format and a report likewise.
[[nodiscard]] Result<void> check_outputs(std::span<const std::string> exports, const std::string& report,
                                         std::span<const std::string> inputs = {});
// Checks likewise a report of what was felt, with the plot and the table beside it; empty: none.
[[nodiscard]] Result<void> check_felt_report(const std::string& report, std::span<const std::string> inputs);
// Checks whether an output is not one of the inputs, nor a file that an input names which is a recording
// (app/cli/recorded_files.hpp).
[[nodiscard]] Result<void> check_overwrites_none(const std::string& output, std::span<const std::string> inputs);

// Writes a file, or to standard output; nothing where the path is empty.
[[nodiscard]] Result<void> write_output(const std::string& path, const std::string& text);

[[nodiscard]] Result<void> write_text(const std::string& path, const std::string& text);
[[nodiscard]] Result<void> write_report(const std::string& path, const Json& report);

}  // namespace burin::app
