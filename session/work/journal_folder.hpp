// SPDX-License-Identifier: MIT
// Where the journals of sessions lie, and which of them hold work that was not saved. Any thread.
#pragma once

#include <string>
#include <vector>

#include "session/work/opened_work.hpp"

namespace burin::session {

// As --journal names no folder at all.
inline constexpr const char* kNoJournal = "none";

// Returns the folder of a person's journals: burin/journals in XDG_STATE_HOME, or in ~/.local/state; empty: there is
// none. A relative path does not count (XDG Base Directory 0.8).
[[nodiscard]] std::string usual_journal_folder();
// Makes the folder and returns a path in it for the journal of work of this name. Fails where no file can be made.
[[nodiscard]] Result<std::string> new_journal(const std::string& folder, const std::string& name);

// Opens a document as open_document() does; one whose last session died before it was saved comes back with what the
// newest of its journals in the folder holds, and names the others. An empty folder: there is none.
[[nodiscard]] Result<OpenedWork> open_document_and_journal(const std::string& path, const std::string& folder,
                                                           std::size_t undo_bytes = 0);
// Says, in a line each, which unsaved work the folder holds, the newest first, and the command that opens it.
[[nodiscard]] std::vector<std::string> unsaved_work_in(const std::string& folder);

}  // namespace burin::session
