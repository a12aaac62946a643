// SPDX-License-Identifier: MIT
// What a process that was killed has left half made: files for a save, and journals that had not begun.
// A file is touched only where no process of its number lives and none has it locked. Nothing here fails: what cannot
// be removed stays.
#pragma once

#include <string>

namespace burin::document {

// Returns a name beside the place that nobody has, under which this process makes what shall take the place.
[[nodiscard]] std::string name_while_saving(const std::string& path);
// Removes what saves to this place have left whose process was killed.
void remove_left_saves(const std::string& path);
// Returns whether a process has locked this file, as the one that writes it has. Not for a file that this process has
// open: its locks would be dropped.
[[nodiscard]] bool is_locked(const std::string& path);
// Removes a journal that holds nothing and whose process is dead; returns whether it was one.
bool remove_hollow_journal(const std::string& path);

}  // namespace burin::document
