// SPDX-License-Identifier: MIT
#include "window/lost_display.hpp"

#include <dlfcn.h>
#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <atomic>

#include "window/window.hpp"

// Xlib's, which GLFW loads at run time.
extern "C" {
struct _XDisplay;
}

namespace burin::window {
namespace {

using ErrorHandler = int (*)(_XDisplay*);
using ExitHandler = void (*)(_XDisplay*, void*);
using SetErrorHandler = ErrorHandler (*)(ErrorHandler);
using SetExitHandler = void (*)(_XDisplay*, ExitHandler, void*);

// Written by whichever thread finds out.
std::atomic<bool> g_display_is_lost{false};
int (*g_connection_of)(_XDisplay*) = nullptr;
_XDisplay* g_display = nullptr;  // main thread; null where it cannot be outlived

// GLFW waits for the connection's socket, which is at its end now, so that each wait would end at once and be begun
// again for ever. A pipe that says nothing takes the socket's place.
void on_lost_display(_XDisplay* display, void*) {
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) == 0) {
        dup3(ends[0], g_connection_of(display), O_CLOEXEC);
        close(ends[0]);  // the other end stays open: closed, it would be an event
    }
    g_display_is_lost.store(true, std::memory_order_release);  // release: whoever sees it sees the pipe in place
}

// Xlib's own says what has happened, and ends the program.
int say_nothing(_XDisplay*) { return 0; }

// library: of dlopen(), or RTLD_DEFAULT, which is null.
template <typename Function>
Function named(void* library, const char* name) {
    return reinterpret_cast<Function>(dlsym(library, name));
}

}  // namespace

bool display_hangs_up() {
    if (g_display == nullptr || display_is_lost()) return display_is_lost();
    pollfd connection{.fd = g_connection_of(g_display), .events = 0, .revents = 0};
    if (poll(&connection, 1, 0) <= 0 || (connection.revents & (POLLHUP | POLLERR)) == 0) return false;
    on_lost_display(g_display, nullptr);
    return true;
}

bool display_is_lost() { return g_display_is_lost.load(std::memory_order_acquire); }

// Where one of these is missing, as with GLFW for Wayland or Xlib before 1.7, a lost display ends the program.
void outlive_display() {
    g_display_is_lost.store(false, std::memory_order_release);
    g_display = nullptr;
    const auto display_of_glfw = named<_XDisplay* (*)()>(RTLD_DEFAULT, "glfwGetX11Display");
    _XDisplay* const display = display_of_glfw != nullptr ? display_of_glfw() : nullptr;
    void* const xlib = display != nullptr ? dlopen("libX11.so.6", RTLD_NOLOAD | RTLD_LAZY) : nullptr;
    if (xlib == nullptr) return;
    const auto handle_errors = named<SetErrorHandler>(xlib, "XSetIOErrorHandler");
    const auto handle_exit = named<SetExitHandler>(xlib, "XSetIOErrorExitHandler");
    g_connection_of = named<int (*)(_XDisplay*)>(xlib, "XConnectionNumber");
    if (handle_errors != nullptr && handle_exit != nullptr && g_connection_of != nullptr) {
        handle_errors(say_nothing);
        handle_exit(display, on_lost_display, nullptr);
        g_display = display;
    }
    dlclose(xlib);  // GLFW keeps it
}

}  // namespace burin::window
