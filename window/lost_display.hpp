// SPDX-License-Identifier: MIT
// What becomes of the program when its display goes: the X server dies, or the connection to it breaks.
//
// Xlib ends a program then, by exit(), in whatever call finds it out. Here it does not: the call returns, windows have
// no more events, and display_is_lost() says so, whereupon a session ends in order. No call is to follow: later ones
// fill Xlib's buffer, which nobody empties, and the first that does not fit ends the program by a fault.
// For window/ alone, but for display_is_lost() (window.hpp).
#pragma once

namespace burin::window {

// Has the program outlive the connection that GLFW has opened. Main thread, each time that GLFW has started.
void outlive_display();

// Returns whether the connection is at its end; found out here, it is lost from now on. Main thread, before each call
// that needs the display.
[[nodiscard]] bool display_hangs_up();

}  // namespace burin::window
