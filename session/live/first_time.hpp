// SPDX-License-Identifier: MIT
// Whether somebody has seen the first steps already: an empty file in the user's folder for settings says so,
// $XDG_CONFIG_HOME/burin/first-steps-seen, else below ~/.config. Thread: the frame's.
#pragma once

namespace burin::session {

[[nodiscard]] bool is_first_time();
// Notes that they have been seen. A folder that cannot be written is no error: they are then shown each time.
void remember_first_time();

}  // namespace burin::session
