// SPDX-License-Identifier: MIT
// What becomes of the program when its display goes: the X server dies, or the connection to it breaks.
//
// Xlib ends a program then, by exit(), in whatever call finds it out. Here it does not: the call returns, all later
// ones do nothing, windows have no more events, and display_is_lost() says so, whereupon a session ends in order.
// For window/ alone, but for display_is_lost() (window.hpp).
#pragma once

namespace burin::window {

// Has the program outlive the connection that GLFW has opened. Main thread, each time that GLFW has started.
void outlive_display();

// Returns whether the connection is at its end, also before any call has found that out. Main thread.
[[nodiscard]] bool display_hangs_up();

}  // namespace burin::window
