// SPDX-License-Identifier: MIT
// Shows the progress of long work in a line on standard error: rewritten in place on a terminal, a new line every ten
// seconds elsewhere, and nothing for work of less than a second.
#pragma once

#include <unistd.h>

#include <cstdio>
#include <string>
#include <utility>

#include "base/clock.hpp"

namespace burin::sculpt {

class Progress {
public:
    explicit Progress(std::string what)
        : what_(std::move(what)), next_ns_(clock_.now_ns() + kFirst_ns), terminal_(isatty(STDERR_FILENO) != 0) {}
    ~Progress() {
        if (shown_ && terminal_) std::fputc('\n', stderr);
    }
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    // From 0 to 1; cheap enough to be called at every step.
    void show(double done) {
        const Nanoseconds now_ns = clock_.now_ns();
        if (now_ns < next_ns_) return;
        std::fprintf(stderr, terminal_ ? "\r%s: %3.0f %%" : "%s: %3.0f %%\n", what_.c_str(), 100.0 * done);
        std::fflush(stderr);
        shown_ = true;
        next_ns_ = now_ns + (terminal_ ? kOnTerminal_ns : kElsewhere_ns);
    }

private:
    static constexpr Nanoseconds kFirst_ns = kNanosecondsPerSecond;
    static constexpr Nanoseconds kOnTerminal_ns = kNanosecondsPerSecond / 5;
    static constexpr Nanoseconds kElsewhere_ns = 10 * kNanosecondsPerSecond;

    std::string what_;
    MonotonicClock clock_;
    Nanoseconds next_ns_;
    bool terminal_, shown_ = false;
};

}  // namespace burin::sculpt
