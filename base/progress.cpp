// SPDX-License-Identifier: MIT
#include "base/progress.hpp"

#include <unistd.h>

#include <cstdio>

namespace burin {
namespace {
constexpr Nanoseconds kFirst_ns = kNanosecondsPerSecond;
constexpr Nanoseconds kOnTerminal_ns = kNanosecondsPerSecond / 5;
constexpr Nanoseconds kElsewhere_ns = 10 * kNanosecondsPerSecond;
}  // namespace

Progress::Progress(std::string what)
    : what_(std::move(what)), next_ns_(clock_.now_ns() + kFirst_ns), terminal_(isatty(STDERR_FILENO) != 0) {}

Progress::~Progress() {
    if (shown_ && terminal_) std::fputc('\n', stderr);
}

void Progress::show(double done) {
    const Nanoseconds now_ns = clock_.now_ns();
    if (now_ns < next_ns_) return;
    std::fprintf(stderr, terminal_ ? "\r%s: %3.0f %%" : "%s: %3.0f %%\n", what_.c_str(), 100.0 * done);
    std::fflush(stderr);
    shown_ = true;
    next_ns_ = now_ns + (terminal_ ? kOnTerminal_ns : kElsewhere_ns);
}

}  // namespace burin
