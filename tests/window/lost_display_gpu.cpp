// SPDX-License-Identifier: MIT
// A display that dies between two frames, before any call has found it out.
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>

#include "tests/window/xvfb.hpp"
#include "window/window.hpp"

namespace burin::window {
namespace {

// Asks for the monitor of a window first when the server is dead. Ends this process.
[[noreturn]] void ask_a_dead_display() {
    const Xvfb& server = Xvfb::running();
    auto opened = Window::create({.width = 64, .height = 48});
    if (!opened) {
        std::fprintf(stderr, "no window: %s", opened.error().line().c_str());
        std::_Exit(2);
    }
    server.die();
    static_cast<void>(monitors());
    static_cast<void>(opened->monitor());
    static_cast<void>(opened->poll());
    std::fprintf(stderr, display_is_lost() ? "it is lost" : "it is there");
    std::_Exit(0);
}

}  // namespace

TEST(LostDisplay, IsOutlivedByWhoAsksForItsMonitors) {
    if (Xvfb::running().name().empty()) GTEST_SKIP() << "Xvfb is not installed or does not start";
    GTEST_FLAG_SET(death_test_style, "threadsafe");  // in a process that has no display yet
    EXPECT_EXIT(ask_a_dead_display(), testing::ExitedWithCode(0), "it is lost");
}

}  // namespace burin::window
