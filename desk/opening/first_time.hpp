// SPDX-License-Identifier: MIT
// Remembers that the user has seen the first steps, by an empty file in the user's configuration folder,
// $XDG_CONFIG_HOME/burin/first-steps-seen, else below ~/.config. Thread: the frame's.
#pragma once

namespace burin::session {

[[nodiscard]] bool is_first_time();
// Notes that they have been seen. A folder that cannot be written is no error: they are then shown each time.
void remember_first_time();

}  // namespace burin::session
