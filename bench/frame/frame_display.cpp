// SPDX-License-Identifier: MIT
#include "bench/frame/frame_display.hpp"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <string>
#include <utility>

namespace burin::bench {
namespace {

constexpr int kPatience_ms = 10'000;

// Runs after fork, so it calls only what is allowed between fork and
// exec. Xvfb writes the number of the free display that it found.
[[noreturn]] void become_xvfb(int number_to) {
    prctl(PR_SET_PDEATHSIG, SIGTERM);  // ends when this process ends for any reason
    const int nowhere = ::open("/dev/null", O_RDWR);
    for (const int output : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) dup2(nowhere, output);
    constexpr int kNumber = 3;
    if (number_to == kNumber)
        fcntl(kNumber, F_SETFD, 0);
    else
        dup2(number_to, kNumber);
    execlp("Xvfb", "Xvfb", "-displayfd", "3", "-screen", "0", "640x480x24", "+extension", "GLX", "-noreset",
           "-nolisten", "tcp", static_cast<char*>(nullptr));
    _exit(127);
}

// Returns the display's number as text; empty if none was received.
std::string read_number(int from) {
    std::string text;
    pollfd waiting{from, POLLIN, 0};
    while (!text.ends_with('\n')) {
        std::array<char, 16> some{};
        if (poll(&waiting, 1, kPatience_ms) <= 0) return {};
        const ssize_t count = ::read(from, some.data(), some.size());
        if (count <= 0) return {};
        text.append(some.data(), static_cast<std::size_t>(count));
    }
    text.pop_back();
    return text;
}

}  // namespace

Result<FrameDisplay> FrameDisplay::open() {
    const char* present = getenv("DISPLAY");
    if (present != nullptr && *present != '\0') return FrameDisplay(0);
    std::array<int, 2> ends{};
    if (pipe2(ends.data(), O_CLOEXEC) != 0) return fail("Xvfb", "no pipe can be made to it", "close some files");
    const pid_t child = fork();
    if (child == 0) become_xvfb(ends[1]);
    ::close(ends[1]);
    FrameDisplay display(child > 0 ? child : 0);
    const std::string number = child > 0 ? read_number(ends[0]) : std::string{};
    ::close(ends[0]);
    if (number.empty()) {
        return fail("Xvfb", "did not start, and there is no DISPLAY",
                    "install xvfb (scripts/setup --peers), or set DISPLAY");
    }
    setenv("DISPLAY", (":" + number).c_str(), 1);
    return display;
}

FrameDisplay::FrameDisplay(FrameDisplay&& other) noexcept : server_(std::exchange(other.server_, 0)) {}

FrameDisplay& FrameDisplay::operator=(FrameDisplay&& other) noexcept {
    if (this != &other) {
        close();
        server_ = std::exchange(other.server_, 0);
    }
    return *this;
}

FrameDisplay::~FrameDisplay() { close(); }

void FrameDisplay::close() {
    if (server_ == 0) return;
    kill(server_, SIGTERM);
    waitpid(server_, nullptr, 0);
    unsetenv("DISPLAY");
    server_ = 0;
}

}  // namespace burin::bench
