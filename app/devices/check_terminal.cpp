// SPDX-License-Identifier: MIT
#include "app/devices/check_terminal.hpp"

#include <poll.h>
#include <unistd.h>

#include <array>
#include <cstdio>

namespace burin::app {

bool TerminalGuide::is_there() { return ::isatty(STDIN_FILENO) == 1; }

TerminalGuide::TerminalGuide(bool is_quiet, bool takes_keys)
    : is_quiet_(is_quiet), takes_keys_(takes_keys), shows_(!is_quiet && ::isatty(STDOUT_FILENO) == 1) {
    if (!takes_keys_) return;
    takes_keys_ = ::tcgetattr(STDIN_FILENO, &before_) == 0;
    termios keys = before_;
    keys.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);
    keys.c_cc[VMIN] = 0;
    keys.c_cc[VTIME] = 0;
    if (takes_keys_) ::tcsetattr(STDIN_FILENO, TCSANOW, &keys);
}

TerminalGuide::~TerminalGuide() {
    if (has_shown_) std::printf("\n");
    if (takes_keys_) ::tcsetattr(STDIN_FILENO, TCSAFLUSH, &before_);
}

void TerminalGuide::say(const std::string& line) {
    if (is_quiet_) return;
    std::printf("%s%s\n", has_shown_ ? "\r\x1b[K" : "", line.c_str());
    std::fflush(stdout);
    has_shown_ = false;
}

void TerminalGuide::show(const std::string& line) {
    if (!shows_) return;
    std::printf("\r%s\x1b[K", line.c_str());
    std::fflush(stdout);
    has_shown_ = true;
}

bench::CheckAnswers TerminalGuide::answers(Nanoseconds now_ns) {
    bench::CheckAnswers answers;
    answers.ends = signals_.came();
    pollfd waits{STDIN_FILENO, POLLIN, 0};
    while (takes_keys_ && ::poll(&waits, 1, 0) > 0) {
        std::array<char, 16> keys{};
        const ssize_t count = ::read(STDIN_FILENO, keys.data(), keys.size());
        if (count <= 0) {
            takes_keys_ = false;  // the terminal was closed: nobody holds anything
            answers.ends = true;
            held_until_ns_ = 0;
            break;
        }
        for (ssize_t i = 0; i < count; ++i) {
            const char key = keys[static_cast<std::size_t>(i)];
            if (key == ' ') held_until_ns_ = now_ns + (now_ns < held_until_ns_ ? kAgain_ns : kFirst_ns);
            answers.goes_on = answers.goes_on || key == '\n' || key == '\r';
            answers.skips = answers.skips || key == 's';
            answers.ends = answers.ends || key == 'q' || key == '\x1b';
        }
    }
    answers.holds = now_ns < held_until_ns_;
    return answers;
}

}  // namespace burin::app
