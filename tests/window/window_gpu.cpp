// SPDX-License-Identifier: MIT
// Windows on a virtual display: what opens, what is refused, and which events arrive.
#include <sys/wait.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <semaphore>
#include <thread>

#include "base/clock.hpp"
#include "tests/window/window_test.hpp"
#include "window/key_names.hpp"

namespace burin::window {

namespace {

bool can_run(const char* program) {
    return std::system((std::string("command -v ") + program + " >/dev/null 2>&1").c_str()) == 0;
}

// In a child of its own, as a process that has once had a display keeps it.
int exit_status_without_display(const char* display) {
    const pid_t child = fork();
    if (child == 0) {
        display != nullptr ? setenv("DISPLAY", display, 1) : unsetenv("DISPLAY");
        const auto refused = Window::create({});
        const auto no_monitors = monitors();
        const bool clear = !refused && !no_monitors && refused.error().line().contains("DISPLAY") &&
                           refused.error().remedy.contains("xvfb-run");
        _exit(clear ? 0 : 1);
    }
    int status = 0;
    waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

}  // namespace

TEST(NoDisplay, IsSaidWithTheVariableAndTheRemedy) {
    EXPECT_EQ(exit_status_without_display(nullptr), 0);
    EXPECT_EQ(exit_status_without_display(""), 0);
    EXPECT_EQ(exit_status_without_display(":987"), 0) << "nobody answers there";
}

TEST_F(WindowTest, OpensWithTheSizeAskedForAndKnowsItsMonitor) {
    const Window window = open({.width = 333, .height = 222, .x = 51, .y = 37});
    EXPECT_EQ(window.framebuffer().width, 333);
    EXPECT_EQ(window.framebuffer().height, 222);
    EXPECT_EQ(window.on_monitor().x, 51);
    EXPECT_EQ(window.on_monitor().y, 37);
    EXPECT_FALSE(window.full_screen());
    EXPECT_DOUBLE_EQ(window.content_scale(), 1.0);
    const auto all = monitors();
    ASSERT_TRUE(all);
    ASSERT_FALSE(all->empty());
    EXPECT_EQ(all->front().width, 1280);
    EXPECT_EQ(all->front().height, 800);
    EXPECT_EQ(window.monitor().name, all->front().name);
}

TEST_F(WindowTest, FillsAMonitorByIndexOrNameAndComesBack) {
    Window window = open({.width = 300, .height = 200, .x = 11, .y = 12});
    ASSERT_TRUE(window.fill_monitor("0"));
    EXPECT_TRUE(window.full_screen());
    EXPECT_EQ(window.framebuffer().width, 1280);
    window.leave_full_screen();
    EXPECT_FALSE(window.full_screen());
    EXPECT_EQ(window.framebuffer().width, 300);
    const Window full = open({.full_screen = window.monitor().name});
    EXPECT_TRUE(full.full_screen());
    EXPECT_EQ(full.framebuffer().height, 800);
    EXPECT_EQ(full.on_monitor().x, 0);
}

TEST_F(WindowTest, NamesTheMonitorsThereAreWhenOneIsMissing) {
    const auto refused = Window::create({.full_screen = "Wall"});
    ASSERT_FALSE(refused);
    EXPECT_TRUE(refused.error().line().contains("'Wall'"));
    EXPECT_TRUE(refused.error().remedy.contains("0 (")) << refused.error().line();
    EXPECT_FALSE(Window::create({.full_screen = "7"}));
    EXPECT_FALSE(Window::create({.width = 0}));
    EXPECT_FALSE(Window::create({.height = 1 << 20}));
}

// One that does not sleep is awake before anybody wakes it; one that nobody wakes sleeps all the time that it may.
TEST_F(WindowTest, SleepsUntilItIsWoken) {
    constexpr double kLongest_s = 60.0;
    Window window = open();
    while (!window.wait(0.2).empty()) {  // what opening brought
    }
    MonotonicClock clock;
    for (int times = 0; times < 5; ++times) {
        std::binary_semaphore may_wake(0);
        std::atomic<bool> woken{false};
        std::thread waker([&] {
            may_wake.acquire();
            for (int i = 0; i < 20'000; ++i) std::this_thread::yield();  // meanwhile it has gone to sleep
            woken = true;
            wake();
        });
        const Nanoseconds from_ns = clock.now_ns();
        may_wake.release();
        const std::vector<WindowEvent> events = window.wait(kLongest_s);
        EXPECT_TRUE(woken) << "it was awake before";
        EXPECT_LT(seconds(clock.now_ns() - from_ns), kLongest_s) << "nobody woke it";
        EXPECT_TRUE(events.empty()) << "to be woken is no event";
        waker.join();
    }
    wake();  // before it sleeps: it does not miss that
    const Nanoseconds from_ns = clock.now_ns();
    static_cast<void>(window.wait(kLongest_s));
    EXPECT_LT(seconds(clock.now_ns() - from_ns), kLongest_s);
}

TEST_F(WindowTest, TellsOfANewSizeAndAskedToClose) {
    Window window = open();
    window.set_size(401, 303);
    const auto resized =
        next<ResizeEvent>(window, [](const ResizeEvent& e) { return e.width == 401 && e.height == 303; });
    EXPECT_TRUE(resized);
    EXPECT_FALSE(window.asked_to_close());
    window.ask_to_close();
    EXPECT_TRUE(window.asked_to_close());
}

TEST_F(WindowTest, HearsKeysAndTheMouse) {
    if (!can_run("xdotool")) GTEST_SKIP() << "xdotool is not installed";
    Window window = open({.width = 320, .height = 200, .x = 100, .y = 50});
    static_cast<void>(window.wait(0.2));
    const auto run = [](const std::string& what) {
        return std::system(("xdotool " + what + " >/dev/null 2>&1").c_str());
    };
    ASSERT_EQ(run("mousemove 150 80"), 0);
    const auto moved = next<MouseMoveEvent>(window, [](const MouseMoveEvent&) { return true; });
    ASSERT_TRUE(moved);
    EXPECT_EQ(moved->x, 50.0);
    EXPECT_EQ(moved->y, 30.0);
    ASSERT_EQ(run("click 3 click 4"), 0);
    const auto pressed = next<MouseButtonEvent>(window, [](const MouseButtonEvent& e) { return e.down; });
    ASSERT_TRUE(pressed);
    EXPECT_EQ(pressed->button, 1) << "the right one";
    EXPECT_EQ(pressed->x, 50.0);
    ASSERT_EQ(run("click 5"), 0);
    EXPECT_TRUE(next<ScrollEvent>(window, [](const ScrollEvent& e) { return e.y < 0.0; }));
    // Without a window manager nobody gives a window the keyboard: the pointer does.
    ASSERT_EQ(run("key --clearmodifiers ctrl+z"), 0);
    const auto z = next<KeyEvent>(window, [](const KeyEvent& e) { return e.key == "z" && e.press == Press::down; });
    ASSERT_TRUE(z);
    EXPECT_TRUE(z->held.control);
    EXPECT_FALSE(z->held.shift);
    ASSERT_EQ(run("key F5"), 0);
    EXPECT_TRUE(next<KeyEvent>(window, [](const KeyEvent& e) { return e.key == "f5" && e.press == Press::up; }));
    ASSERT_EQ(run("type b"), 0);
    const auto typed = next<TextEvent>(window, [](const TextEvent&) { return true; });
    ASSERT_TRUE(typed);
    EXPECT_EQ(typed->character, U'b');
}

TEST_F(WindowTest, KeepsTheClipboard) {
    Window window = open();
    EXPECT_EQ(window.clipboard(), "");
    window.set_clipboard("12 mm");
    EXPECT_EQ(window.clipboard(), "12 mm");
}

TEST(KeyNames, AreEachKeysOwn) {
    std::vector<std::string_view> names;
    for (int key = 0; key <= 348; ++key) {
        if (key_name(key) != "unknown") names.push_back(key_name(key));
    }
    EXPECT_GT(names.size(), 110u);
    std::ranges::sort(names);
    EXPECT_EQ(std::ranges::adjacent_find(names), names.end());
    EXPECT_EQ(key_name(-1), "unknown");
    EXPECT_EQ(key_name(65), "a");
    EXPECT_EQ(key_name(57), "9");
    EXPECT_EQ(key_name(314), "f25");
}

}  // namespace burin::window
