// SPDX-License-Identifier: MIT
// The files that a recording was made from. No output may be written over them: then it could not be done again. Any
// thread.
#pragma once

#include <string>
#include <vector>

namespace burin::app {

// Returns the files that a recording names, a session file or a text log: world, workpiece, stroke, wall, and the files
// of a tool and a device, with all that these read; for a session file also those that SQLite keeps beside it. Names
// are as they were recorded, so relative to where that was. Nothing for a file that is no recording.
[[nodiscard]] std::vector<std::string> files_named_by(const std::string& recording);

}  // namespace burin::app
